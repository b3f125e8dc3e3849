// Making an integrator from a plugin, and the loop of a run without events.
#include <fmt/format.h>

#include <stdexcept>

#include <trammel/testing/measurements.hpp>

#include "testing/plugin_folder.hpp"

namespace trammel {

Maker from_plugin(const std::string& folder, const std::string& name,
                  const std::vector<std::pair<std::string, ParameterValue>>& settings) {
  const Declaration& declaration = plugin_folder(folder).find(Kind::integrator, name).declaration;
  for (const auto& [key, value] : settings) {
    bool known = false;
    for (const Parameter& p : declaration.parameters) known = known || p.name == key;
    if (!known) throw std::runtime_error(fmt::format("{} has no parameter \"{}\"", name, key));
  }
  return [&declaration, settings] {
    std::unique_ptr<Component> component = declaration.make();
    for (const auto& [key, value] : settings)
      for (const Parameter& p : declaration.parameters)
        if (p.name == key) p.set(*component, value);
    component->prepare(World{});
    return std::unique_ptr<Integrator>(&dynamic_cast<Integrator&>(*component.release()));
  };
}

State integrate(Integrator& method, System& system, const State& start, double until, int n,
                const std::function<void(const State&)>& after_each_step) {
  const double h = (until - start.t) / n;
  State now = start, next;
  method.restart(system, now);
  for (int i = 0; i < n; ++i) {
    if (const Outcome outcome = method.step(system, now, h, next); !outcome)
      throw std::runtime_error(fmt::format("step {} at t = {:.6g} s was rejected: {}", i + 1, now.t, outcome.reason()));
    method.accept(system, now, next);
    std::swap(now, next);
    if (after_each_step) after_each_step(now);
  }
  return now;
}

}  // namespace trammel
