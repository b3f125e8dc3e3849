#include "simulate/ledger.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace trammel::simulate {
namespace {

using Balance = model::AssembledSystem::Balance;

double size(const Balance& p) {
  return std::abs(p.drives) + std::abs(p.dampers) + std::abs(p.contacts) + std::abs(p.constraints) +
         std::abs(p.markers) + p.friction.lpNorm<1>();
}

}  // namespace

Ledger::Ledger(model::AssembledSystem& system, Integrator& integrator)
    : system_(system), between_(system, integrator), impacts_(system.model().contacts.size()) {
  friction_.setZero(Eigen::Index(impacts_.size()));
  now_.friction = friction_;
}

const Balance& Ledger::balance(double t, const Vec& q, const Vec& v, const Vec& lambda) {
  system_.move_to(t, q, v);
  return system_.balance(lambda);
}

void Ledger::start(const State& state) {
  system_.move_to(state.t, state.q, state.v);
  energy_start_ = system_.energy().total();
}

void Ledger::restart(const State& state) {
  now_ = balance(state.t, state.q, state.v, state.lambda);
  g_dot_ = system_.g_dot();
}

void Ledger::step(const State& now, const State& next) {
  take_end(next);
  // A closed contact's row does work at the level of round-off; that is not worth an evaluation.
  const double work = (size(now_) + size(end_)) * (next.t - now.t);
  if (!(work > 1e-16 * std::abs(energy_start_))) return move_on();
  if (between_.smooth() || work < 1e-12 * std::abs(energy_start_)) {
    between_.at(now, next, 0.5, middle_state_);
    integrate(now, next, middle_state_);
    return move_on();
  }
  constexpr int parts = 4;
  begin_ = now;
  for (int i = 1; i <= parts; ++i) {
    part_end_ = next;
    if (i < parts) {
      between_.at(now, next, double(i) / parts, part_end_);
      system_.move_to(part_end_.t, part_end_.q, part_end_.v);
      system_.accelerate({}, part_end_.a, part_end_.lambda);
    }
    between_.at(now, next, (i - 0.5) / parts, middle_state_);
    take_end(part_end_);
    integrate(begin_, part_end_, middle_state_);
    move_on();
    std::swap(begin_, part_end_);
  }
}

void Ledger::take_end(const State& end) {
  end_ = balance(end.t, end.q, end.v, end.lambda);
  g_dot_end_ = system_.g_dot();
}

void Ledger::move_on() {
  std::swap(now_, end_);
  g_dot_.swap(g_dot_end_);
}

void Ledger::integrate(const State& now, const State& next, const State& middle) {
  const double h = next.t - now.t, power = size(now_) + size(end_);
  system_.move_to(middle.t, middle.q, middle.v);
  lambda_ = 0.5 * (now.lambda + next.lambda);
  // Reactions do not follow their mean where they swing within a step.
  double work_of_rows = std::abs(now_.constraints) + std::abs(end_.constraints);
  const auto matters = [&] { return work_of_rows > 1e-9 * power; };
  if (!matters()) {
    middle_ = system_.balance(lambda_);
    work_of_rows += std::abs(middle_.constraints);
  }
  if (matters()) {
    system_.accelerate({}, a_, lambda_);
    middle_ = system_.balance(lambda_);
  }
  // The interpolation leaves contacts' rows between two states that are on them; the motion does not.
  const auto n = lambda_.size() - system_.held_rows();
  if (n > 0) middle_.constraints += lambda_.tail(n).dot((system_.g_dot() - 0.5 * (g_dot_ + g_dot_end_)).tail(n));
  const auto simpson = [h](double begin, double mid, double finish) { return h / 6 * (begin + 4 * mid + finish); };
  drives_ += simpson(now_.drives, middle_.drives, end_.drives);
  dampers_ += simpson(now_.dampers, middle_.dampers, end_.dampers);
  contacts_ += simpson(now_.contacts, middle_.contacts, end_.contacts);
  constraints_ += simpson(now_.constraints, middle_.constraints, end_.constraints);
  markers_ += simpson(now_.markers, middle_.markers, end_.markers);
  friction_ += h / 6 * (now_.friction + 4 * middle_.friction + end_.friction);
}

double Ledger::impact_total() const {
  return std::accumulate(impacts_.begin(), impacts_.end(), 0.0);
}

void Ledger::archive(Archive& a) {
  a("energy_start", energy_start_), a("drives", drives_), a("constraints", constraints_), a("dampers", dampers_);
  a("contacts", contacts_), a("refinements", refinements_);
  a("power_drives", now_.drives), a("power_dampers", now_.dampers), a("power_contacts", now_.contacts);
  a("power_constraints", now_.constraints);
  a("markers", markers_), a("friction", friction_);
  a("g_dot", g_dot_);
  a("power_markers", now_.markers), a("power_friction", now_.friction);
  Vec impacts = Eigen::Map<const Vec>(impacts_.data(), Eigen::Index(impacts_.size()));
  a("lost_to_impacts", impacts);
  impacts_.assign(impacts.data(), impacts.data() + impacts.size());
}

}  // namespace trammel::simulate
