#include "plugin/plugin_error.hpp"

#include <fmt/format.h>

#include <utility>

#include "scene/shortened.hpp"

namespace trammel::plugin {

namespace {

// plugin /x/my_method.so: integrator my_method (integrator): step at t = 0.1 s, step 1000: out of luck
std::string text(const Origin& origin, const std::string& call, const std::string& cause, std::optional<double> t,
                 std::optional<long long> step) {
  std::string text = fmt::format("plugin {}: ", origin.file);
  if (!origin.component.empty()) {
    text += origin.component;
    if (!origin.path.empty()) text += fmt::format(" ({})", origin.path);
    text += ": ";
  }
  if (!call.empty()) text += call;
  if (t) text += fmt::format(" at t = {} s", *t);
  if (step) text += fmt::format(", step {}", *step);
  if (!call.empty()) text += ": ";
  return scene::printable(text + cause);  // names and causes come from the library
}

}  // namespace

PluginError::PluginError(std::string file, std::string cause)
    : PluginError(Origin{std::move(file), "", ""}, "", std::move(cause), {}, {}) {}

PluginError::PluginError(Origin origin, std::string call, std::string cause, std::optional<double> t)
    : PluginError(std::move(origin), std::move(call), std::move(cause), t, {}) {}

PluginError::PluginError(Origin origin, std::string call, std::string cause, std::optional<double> t,
                         std::optional<long long> step)
    : std::runtime_error(text(origin, call, cause, t, step)),
      origin_(std::move(origin)),
      call_(std::move(call)),
      cause_(std::move(cause)),
      t_(t),
      step_(step) {}

PluginError PluginError::in_step(long long step) const {
  return {origin_, call_, cause_, t_, step};
}

}  // namespace trammel::plugin
