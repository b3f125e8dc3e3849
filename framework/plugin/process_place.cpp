#include "plugin/process_place.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace trammel::plugin {

// A folder that cannot be opened, as one that was removed, is not returned to.
ProcessPlace::ProcessPlace() : folder_(::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)), mask_(::umask(0)) {
  ::umask(mode_t(mask_));
}

ProcessPlace::~ProcessPlace() {
  put_back();
  if (folder_ >= 0) ::close(folder_);
}

void ProcessPlace::put_back() noexcept {
  if (folder_ >= 0) static_cast<void>(!::fchdir(folder_));
  ::umask(mode_t(mask_));
}

}  // namespace trammel::plugin
