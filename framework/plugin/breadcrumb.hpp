// The plugin call in progress, so that its name can be reported if the process ends there, by a crash or by exit().
#pragma once

#include "plugin/plugin_error.hpp"

namespace trammel::plugin {

struct PresentCall {
  const Origin* origin = nullptr;  // null: no call in progress
  const char* call = "";
};
PresentCall present_call() noexcept;

// Call this once. From then on a process that a plugin forks within a call ends where that call would return: the run
// belongs to its parent, and both would write to the same files.
void end_forks_of_calls() noexcept;

// Marks a call in progress during its lifetime; its destructor restores the enclosing call.
class Breadcrumb {
 public:
  Breadcrumb(const Origin& origin, const char* call) noexcept;
  ~Breadcrumb();
  Breadcrumb(const Breadcrumb&) = delete;
  Breadcrumb& operator=(const Breadcrumb&) = delete;

 private:
  PresentCall before_;
};

}  // namespace trammel::plugin
