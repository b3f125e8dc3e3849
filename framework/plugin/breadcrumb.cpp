#include "plugin/breadcrumb.hpp"

namespace trammel::plugin {

namespace {
// A global variable, because a signal handler has no other access.
thread_local PresentCall present;
}  // namespace

PresentCall present_call() noexcept {
  return present;
}

Breadcrumb::Breadcrumb(const Origin& origin, const char* call) noexcept : before_(present) {
  present = {&origin, call};
}
Breadcrumb::~Breadcrumb() {
  present = before_;
}

}  // namespace trammel::plugin
