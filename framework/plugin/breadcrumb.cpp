#include "plugin/breadcrumb.hpp"

#include <pthread.h>
#include <unistd.h>

namespace trammel::plugin {

namespace {
// A global variable, because a signal handler has no other access.
thread_local PresentCall present;

bool forked_in_call = false;
void in_child() {
  forked_in_call = present.origin;
}
}  // namespace

PresentCall present_call() noexcept {
  return present;
}

void end_forks_of_calls() noexcept {
  ::pthread_atfork(nullptr, nullptr, in_child);
}

Breadcrumb::Breadcrumb(const Origin& origin, const char* call) noexcept : before_(present) {
  present = {&origin, call};
}
Breadcrumb::~Breadcrumb() {
  present = before_;
  if (forked_in_call && !present.origin) ::_exit(1);
}

}  // namespace trammel::plugin
