#include "plugin/process/place.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace trammel::plugin {

// A folder that cannot be opened, for example because it was removed, is not restored.
ProcessPlace::ProcessPlace() : folder_(::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)), mask_(::umask(0)) {
  ::umask(mode_t(mask_));
}

ProcessPlace::~ProcessPlace() {
  ::umask(mode_t(mask_));
  if (folder_ < 0) return;
  static_cast<void>(!::fchdir(folder_));
  ::close(folder_);
}

}  // namespace trammel::plugin
