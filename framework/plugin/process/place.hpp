// The working folder, which relative file names refer to, and the access rights of new files (umask). A library may
// change both while it is loaded; results would then be written to the wrong place.
#pragma once

namespace trammel::plugin {

// Saves them in its constructor and restores them in its destructor.
class ProcessPlace {
 public:
  ProcessPlace();
  ~ProcessPlace();
  ProcessPlace(const ProcessPlace&) = delete;
  ProcessPlace& operator=(const ProcessPlace&) = delete;

 private:
  int folder_;
  unsigned mask_;
};

}  // namespace trammel::plugin
