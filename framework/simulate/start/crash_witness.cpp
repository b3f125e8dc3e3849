#include "simulate/start/crash_witness.hpp"

#include "plugin/breadcrumb.hpp"

namespace trammel::simulate {

void CrashWitness::follow(const Setup& setup, const model::AssembledSystem& system, Clock clock) {
  leave();
  integrator_ = setup.integrator_origin;
  system_ = &system;
  clock_ = clock;
  watching_ = true;
}

void CrashWitness::leave() {
  watching_ = false;
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
    if (site.origin) {
      who.origin = site.origin, who.call = site.call;
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
