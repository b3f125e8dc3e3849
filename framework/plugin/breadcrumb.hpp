// Which plugin is being called: for who must name it when the process ends there, by a crash or by exit().
#pragma once

#include "plugin/plugin_error.hpp"

namespace trammel::plugin {

struct PresentCall {
  const Origin* origin = nullptr;  // null: none is known
  const char* call = "";
};
PresentCall present_call() noexcept;

// Says that a call goes on, while it lives; the one around it goes on afterwards.
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
