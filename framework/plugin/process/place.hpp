// The working folder, by which names of files are found, and the access that new files get: a library may change both
// while it is loaded, and results would go elsewhere.
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
