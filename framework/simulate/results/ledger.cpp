#include "simulate/results/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace trammel::simulate {
namespace {

using Balance = model::AssembledSystem::Balance;

constexpr double little = 1e-16;            // of the energy: round-off of a single step
constexpr double worth_more = 1e-12;        // of the energy: work of a step that more than its middle is evaluated for
constexpr double work_by_reactions = 1e-9;  // of all power: more needs the multipliers inside the step

double size(const Balance& p) {
  return std::abs(p.drives) + std::abs(p.dampers) + std::abs(p.contacts) + std::abs(p.constraints) +
         std::abs(p.markers) + p.friction.lpNorm<1>();
}

double supply(const Balance& p) {
  return p.drives + p.constraints + p.markers;
}
// True for methods whose steps the cubic through their ends does not follow: high order, or inner steps of their own.
bool resolves_long_steps(const Traits& traits) {
  return traits.order > 4 || traits.order == 0;
}
double dissipation(const Balance& p) {
  return p.contacts + p.friction.sum() + p.dampers;
}

}  // namespace

Ledger::Ledger(model::AssembledSystem& system, Integrator& integrator)
    : system_(system),
      between_(system, integrator),
      dense_(resolves_long_steps(integrator.traits()) ? dynamic_cast<DenseOutput*>(&integrator) : nullptr),
      impacts_(system.model().contacts.size()) {
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
  energy_scale_ = std::abs(energy_start_);
}

void Ledger::restart(const State& state) {
  now_ = balance(state.t, state.q, state.v, state.lambda);
  g_dot_ = system_.g_dot();
}

void Ledger::step(const State& now, const State& next) {
  step_begin_ = totals(), step_ = next.t - now.t;
  powers_.clear();
  end_ = balance(next.t, next.q, next.v, next.lambda);
  g_dot_end_ = system_.g_dot();
  // Work of rows at the level of round-off is not worth an evaluation.
  const double work = (size(now_) + size(end_)) * (next.t - now.t);
  if (work > little * energy_scale_) energy_scale_ = std::max(energy_scale_, kinetic(next.v));
  const bool matters = work > worth_more * energy_scale_;
  const bool rubs = system_.rubs();
  if (OscillatingSteps* steps = between_.oscillating(); steps && (matters || rubs))
    integrate_by(*steps, now, next);
  else if (dense_ && (matters || rubs))
    integrate_by_dense_output(now, next);
  else if (work > little * energy_scale_ || rubs)
    integrate_by_middle(now, next);
  std::swap(now_, end_);
  g_dot_.swap(g_dot_end_);
}

// At the system's point.
double Ledger::kinetic(const Vec& v) {
  momentum_.setZero(v.size());
  system_.add_mass_times(1, v, momentum_);
  return v.dot(momentum_) / 2;
}

void Ledger::integrate_by(OscillatingSteps& steps, const State& now, const State& next) {
  const int last = steps.quadrature_points() - 1;
  steps.evaluated(system_, now, next, 1, inside_);
  if (!inside_.q.allFinite() || !inside_.v.allFinite()) return integrate_by_middle(now, next);
  for (int i = 0; i <= last; ++i) {
    const double weight = steps.evaluated(system_, now, next, i, inside_);
    if (i == 0 || i == last) {
      add(weight, i == 0 ? now_ : end_);
      continue;
    }
    middle_ = balance(inside_.t, inside_.q, inside_.v, inside_.lambda);
    middle_.constraints += off_rows(inside_.lambda, (inside_.t - now.t) / (next.t - now.t));
    add(weight, middle_);
  }
}

void Ledger::integrate_by_middle(const State& now, const State& next) {
  const double h = next.t - now.t;
  between_.at(now, next, 0.5, inside_);
  evaluate_inside(now, next, 0.5);
  add_at(0, h / 6, now_), add_at(0.5, 4 * h / 6, middle_), add_at(1, h / 6, end_);
}

// Exact for polynomials of degree 7.
void Ledger::integrate_by_dense_output(const State& now, const State& next) {
  const double h = next.t - now.t, apart = std::sqrt(21) / 14;
  add_at(0, h / 20, now_), add_at(1, h / 20, end_);
  for (const auto& [theta, weight] :
       {std::pair(0.5 - apart, 49.0 / 180), {0.5, 16.0 / 45}, {0.5 + apart, 49.0 / 180}}) {
    dense_->interpolate(system_, now, next, theta, inside_);
    if (!inside_.q.allFinite() || !inside_.v.allFinite()) between_.at(now, next, theta, inside_);
    evaluate_inside(now, next, theta);
    add_at(theta, weight * h, middle_);
  }
}

// Fills middle_. lambda is the mean of both ends, which is of second order and ignores oscillations within the step; it
// is used only where lambda has no power.
void Ledger::evaluate_inside(const State& now, const State& next, double theta) {
  const double power = size(now_) + size(end_);
  double work_of_reactions = std::abs(now_.constraints) + std::abs(end_.constraints);
  system_.move_to(inside_.t, inside_.q, inside_.v);
  lambda_ = (1 - theta) * now.lambda + theta * next.lambda;
  const bool rubs = system_.rubs_by_reactions();
  const auto matters = [&] { return rubs || work_of_reactions > work_by_reactions * power; };
  if (!matters()) {
    middle_ = system_.balance(lambda_);
    work_of_reactions += std::abs(middle_.constraints);
  }
  if (matters()) {
    system_.accelerate({}, a_, lambda_);
    middle_ = system_.balance(lambda_);
  }
  middle_.constraints += off_rows(lambda_, theta);
}

// Power of contacts' rows that the interpolated motion violates between two states on the rows. The true motion does
// not violate them.
double Ledger::off_rows(const Vec& lambda, double theta) {
  const auto n = lambda.size() - system_.held_rows();
  if (n == 0) return 0;
  return lambda.tail(n).dot((system_.g_dot() - (1 - theta) * g_dot_ - theta * g_dot_end_).tail(n));
}

void Ledger::add(double duration, const Balance& power) {
  drives_ += duration * power.drives;
  dampers_ += duration * power.dampers;
  contacts_ += duration * power.contacts;
  constraints_ += duration * power.constraints;
  markers_ += duration * power.markers;
  friction_ += duration * power.friction;
}

void Ledger::add_at(double theta, double duration, const Balance& power) {
  add(duration, power);
  powers_.push_back({theta, supply(power), dissipation(power)});
}

// Gauss's rule with three points, exact for the polynomial through up to five powers.
Ledger::Totals Ledger::totals_inside(double theta) const {
  const Totals end = totals();
  if (powers_.empty() || between_.swings())
    return {step_begin_.supplied + theta * (end.supplied - step_begin_.supplied),
            step_begin_.dissipated + theta * (end.dissipated - step_begin_.dissipated)};
  Totals inside = step_begin_;
  const double apart = std::sqrt(0.15);
  for (const auto& [place, weight] : {std::pair(0.5 - apart, 5.0 / 18), {0.5, 4.0 / 9}, {0.5 + apart, 5.0 / 18}})
    for (const PowersAt& each : powers_) {
      double share = weight * theta * step_;
      for (const PowersAt& other : powers_)
        if (other.theta != each.theta) share *= (theta * place - other.theta) / (each.theta - other.theta);
      inside.supplied += share * each.supplied, inside.dissipated += share * each.dissipated;
    }
  return inside;
}

double Ledger::impact_total() const {
  return std::accumulate(impacts_.begin(), impacts_.end(), 0.0);
}

void Ledger::archive(Archive& a) {
  a("energy_start", energy_start_), a("energy_scale", energy_scale_), a("drives", drives_),
      a("constraints", constraints_), a("dampers", dampers_);
  a("contacts", contacts_), a("refinements", refinements_);
  a("power_drives", now_.drives), a("power_dampers", now_.dampers), a("power_contacts", now_.contacts);
  a("power_constraints", now_.constraints);
  a("markers", markers_), a("friction", friction_);
  a("g_dot", g_dot_);
  a("power_markers", now_.markers), a("power_friction", now_.friction);
  Vec impacts = Eigen::Map<const Vec>(impacts_.data(), Eigen::Index(impacts_.size()));
  a("lost_to_impacts", impacts);
  const auto contacts = Eigen::Index(impacts_.size());
  if (impacts.size() != contacts || friction_.size() != contacts || now_.friction.size() != contacts ||
      g_dot_.size() != system_.sizes().nc)
    throw std::length_error("lost_to_impacts");
  impacts_.assign(impacts.data(), impacts.data() + impacts.size());
}

}  // namespace trammel::simulate
