#include "simulate/crash_witness.hpp"

#include "simulate/blame.hpp"

namespace trammel::simulate {

void CrashWitness::follow(const Setup& setup, const scene::Value& root, plugin::Registry& registry,
                          Simulator& simulator) {
  leave();
  const auto all = [&](const auto& entries, const char* some_call) {
    for (const auto& entry : entries)
      origins_.emplace_back(&entry.name, origin_of({&entry.name, some_call}, root, registry));
  };
  all(setup.model->bodies, "force");
  all(setup.model->joints, "rows");
  all(setup.model->forces, "wrench");
  all(setup.model->contacts, "normal");
  integrator_ = setup.integrator_origin;
  simulator_ = &simulator;
  watching_ = true;
}

void CrashWitness::leave() {
  watching_ = false;
  origins_.clear();
  simulator_ = nullptr;
  recorder_ = nullptr;
}

CrashWitness::Culprit CrashWitness::culprit() const noexcept {
  const model::CallSite& site = simulator_->system().last_call();
  const double t = simulator_->state().t;
  const long long step = simulator_->statistics().steps + 1;
  for (const auto& [name, origin] : origins_)
    if (name == site.component) return {&origin, site.call, t, step, true};
  return {&integrator_, "step", t, step, false};
}

void CrashWitness::rescue() const noexcept {
  if (recorder_) recorder_->rescue();
}

}  // namespace trammel::simulate
