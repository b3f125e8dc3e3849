#include "simulate/event/event_values.hpp"

#include <utility>

#include "simulate/contact/signed_loads.hpp"

namespace trammel::simulate {
namespace {

using Kind = EventFunction::Kind;

// Rates of the rows in g appear at most as many times in the rows that follow from them, and so do drifts.
constexpr double most_leverage = 10;

}  // namespace

EventValues::EventValues(model::AssembledSystem& system, const Integrator& integrator, const ContactScale& scale)
    : system_(system),
      scale_(scale),
      own_force_(!integrator.traits().holds_position && !integrator.traits().holds_velocity) {}

void EventValues::move_to(const State& state) {
  system_.move_to(state.t, state.q, state.v);
  accelerated_ = false;
}

ValueAndSlope EventValues::at(EventFunction& function, const State& state) {
  const auto accelerate = [&] {
    if (!std::exchange(accelerated_, true)) system_.accelerate({}, a_, lambda_);
  };
  if (function.kind == Kind::slide) return slip(function.contact, state.a);
  if (function.kind == Kind::follow) {
    accelerate();
    return {function.little - system_.departure(function.group, a_), 0};
  }
  if (function.kind == Kind::lean) return {most_leverage - system_.leverage(function.group), 0};
  if (function.kind == Kind::span) return {function.little - system_.off_span(function.group), 0};
  if (function.is_gap()) {
    const double sign = function.kind == Kind::leave ? -1 : 1;
    return {gap_or_slip(function), sign * system_.gap_rate(function.contact)};
  }
  if (function.kind == Kind::hold && function.at_ends)
    return {scale_.of(function.contact).no_acceleration() - system_.slip_acceleration(function.contact, state.a).norm(),
            0};
  if (!own_force_) accelerate();
  return {force(function, state.t, forces(state)), 0};
}

bool EventValues::fill(std::vector<EventFunction>& functions, ValueAndSlope EventFunction::*where, const State& state) {
  move_to(state);
  for (EventFunction& function : functions) function.*where = at(function, state);
  return accelerated_;
}

ValueAndSlope EventValues::slip(int contact, const Vec& a) {
  const model::Tangential& direction = system_.modes().contacts[std::size_t(contact)].direction;
  return {direction.dot(system_.slip(contact)), direction.dot(system_.slip_acceleration(contact, a))};
}

double EventValues::gap_or_slip(const EventFunction& function) {
  const int contact = function.contact;
  if (function.kind == Kind::slide)
    return system_.modes().contacts[std::size_t(contact)].direction.dot(system_.slip(contact));
  return (function.kind == Kind::leave ? -1 : 1) * system_.gap(contact);
}

double EventValues::gap_acceleration(const EventFunction& function, const State& state) {
  move_to(state);
  return (function.kind == Kind::leave ? -1 : 1) * system_.acceleration({function.contact, 0}, state.a);
}

double EventValues::force(EventFunction& function, double t, const Vec& lambda) {
  if (function.kind == Kind::idle) return -system_.spring_force(function.contact, lambda);
  if (function.kind == Kind::unload) {  // friction that holds exactly at its bound (equal blocks) leaves no spare load
    function.bound = system_.largest_load(function.group, lambda);
    return std::max(function.little, critical_force * function.bound) +
           system_.spare_load_as_springs(function.group, lambda);
  }
  const double N = system_.normal_force(function.contact, lambda);
  if (function.kind == Kind::load) {
    function.bound = N;
    return function.side * signed_loads(system_, function.contact, t, lambda)[std::size_t(function.bearing)];
  }
  if (function.kind == Kind::hold)
    function.bound = system_.model().contacts[std::size_t(function.contact)].coulomb->static_coefficient() * N;
  return function.kind == Kind::press ? N : function.bound - system_.friction_force(function.contact, lambda).norm();
}

std::vector<double> EventValues::force_slopes(const std::vector<EventFunction*>& functions, const State& state,
                                              double dt) {
  std::vector<double> slopes;
  move_to(state);
  system_.accelerate({}, a_, lambda_);
  for (EventFunction* each : functions) slopes.push_back(-force(*each, state.t, lambda_) / dt);
  dq_ = dt * state.v + (0.5 * dt * dt) * state.a;
  system_.retract(state.q, dq_, moved_.q);
  moved_.v = state.v + dt * state.a;
  system_.move_to(state.t + dt, moved_.q, moved_.v);
  system_.accelerate({}, a_, lambda_);
  for (std::size_t i = 0; i < functions.size(); ++i) slopes[i] += force(*functions[i], state.t + dt, lambda_) / dt;
  return slopes;
}

}  // namespace trammel::simulate
