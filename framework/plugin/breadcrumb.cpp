#include "plugin/breadcrumb.hpp"

namespace trammel::plugin {

namespace {
// A handler of signals has no other way to learn what goes on.
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
