// The present call into a component: whom to name when it throws, crashes, or does not return.
#pragma once

#include <utility>

#include "plugin/plugin_error.hpp"

namespace trammel::model {

struct CallSite {
  const plugin::Origin* origin = nullptr;  // of the component, in the Model; null: none is being called
  const char* call = "";                   // the method, by its name in the interface
};

// Calls a component inside the call of another one, which continues afterwards. If it throws, `site` keeps naming it.
template <class Call>
auto call_inside(CallSite& site, const plugin::Origin& component, const char* name, Call call) {
  const CallSite around = std::exchange(site, {&component, name});
  auto result = call();
  site = around;
  return result;
}

}  // namespace trammel::model
