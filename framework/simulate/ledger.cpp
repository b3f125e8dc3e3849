#include "simulate/ledger.hpp"

#include <cmath>
#include <numeric>

namespace trammel::simulate {
namespace {

using Balance = model::AssembledSystem::Balance;

double size(const Balance& p) {
  return std::abs(p.drives) + std::abs(p.dampers) + std::abs(p.contacts) + std::abs(p.constraints);
}

}  // namespace

Ledger::Ledger(model::AssembledSystem& system) : system_(system), impacts_(system.model().contacts.size()) {}

Balance Ledger::balance(double t, const Vec& q, const Vec& v, const Vec& lambda) {
  system_.move_to(t, q, v);
  return system_.balance(lambda);
}

void Ledger::start(const State& state) {
  system_.move_to(state.t, state.q, state.v);
  energy_start_ = system_.energy().total();
}

void Ledger::restart(const State& state) {
  now_ = balance(state.t, state.q, state.v, state.lambda);
}

void Ledger::step(const State& now, const State& next) {
  const Balance end = balance(next.t, next.q, next.v, next.lambda);
  const double h = next.t - now.t, power = size(now_) + size(end);
  // A closed contact's row does work at the level of round-off; that is not worth an evaluation.
  if (power * h > 1e-16 * std::abs(energy_start_)) {
    system_.difference(next.q, now.q, dq_);
    dq_ = 0.5 * dq_ + (h / 8) * (now.v - next.v);
    system_.retract(now.q, dq_, q_);
    v_ = 0.5 * (now.v + next.v) + (h / 8) * (now.a - next.a);
    lambda_ = 0.5 * (now.lambda + next.lambda);
    const Balance middle = balance(now.t + h / 2, q_, v_, lambda_);
    const auto simpson = [h](double begin, double mid, double finish) { return h / 6 * (begin + 4 * mid + finish); };
    drives_ += simpson(now_.drives, middle.drives, end.drives);
    dampers_ += simpson(now_.dampers, middle.dampers, end.dampers);
    contacts_ += simpson(now_.contacts, middle.contacts, end.contacts);
    constraints_ += simpson(now_.constraints, middle.constraints, end.constraints);
  }
  now_ = end;
}

double Ledger::impact_total() const {
  return std::accumulate(impacts_.begin(), impacts_.end(), 0.0);
}

void Ledger::archive(Archive& a) {
  a("energy_start", energy_start_), a("drives", drives_), a("constraints", constraints_), a("dampers", dampers_);
  a("contacts", contacts_), a("refinements", refinements_);
  a("power_drives", now_.drives), a("power_dampers", now_.dampers), a("power_contacts", now_.contacts);
  a("power_constraints", now_.constraints);
  Vec impacts = Eigen::Map<const Vec>(impacts_.data(), Eigen::Index(impacts_.size()));
  a("lost_to_impacts", impacts);
  impacts_.assign(impacts.data(), impacts.data() + impacts.size());
}

}  // namespace trammel::simulate
