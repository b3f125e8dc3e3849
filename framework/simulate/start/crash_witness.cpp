#include "simulate/start/crash_witness.hpp"

#include "plugin/breadcrumb.hpp"
#include "simulate/start/blame.hpp"

namespace trammel::simulate {

void CrashWitness::follow(const Setup& setup, const scene::Value& root, plugin::Registry& registry,
                          const model::AssembledSystem& system, Clock clock) {
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
  system_ = &system;
  clock_ = clock;
  watching_ = true;
}

void CrashWitness::leave() {
  watching_ = false;
  origins_.clear();
  system_ = nullptr;
  clock_ = {};
  recorder_ = nullptr;
  result_ = nullptr;
}

CrashWitness::Culprit CrashWitness::culprit() const noexcept {
  Culprit who;
  if (watching_) {
    const model::CallSite& site = system_->last_call();
    if (clock_.t) who.t = *clock_.t;
    if (clock_.steps) who.step = *clock_.steps + 1;
    for (const auto& [name, origin] : origins_)
      if (name == site.component) {
        who.origin = &origin, who.call = site.call;
        return who;
      }
  }
  const plugin::PresentCall guarded = plugin::present_call();
  who.origin = guarded.origin, who.call = guarded.call;
  if (!guarded.origin && watching_ && clock_.steps) {
    who.origin = &integrator_, who.call = "step";
    who.certain = false;
  }
  return who;
}

void CrashWitness::rescue(const char* status, std::string_view reason) const noexcept {
  if (recorder_) recorder_->rescue();
  if (result_) result_->write(status, reason);
}

}  // namespace trammel::simulate
