#include "simulate/verdicts/forces_in_modes.hpp"

#include <algorithm>
#include <cmath>

#include "complementarity/exact_modes.hpp"
#include "simulate/verdicts/errors_of_solutions.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;

void ForcesInModes::find(const State& state) {
  system_.set_modes(at_.modes);
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
}

bool ForcesInModes::exist(const State& state) try {
  find(state);
  return a_.allFinite() && lambda_.allFinite();
} catch (const model::LocksItself&) {
  return false;
}

std::vector<bool> ForcesInModes::can_be_exerted(const State& state) {
  const std::vector<std::size_t> island = problem_.islands();
  if (!exist(state)) return std::vector<bool>(island.size(), false);
  std::vector<double> largest(island.size(), 0), worst(island.size(), 0);
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Participant& p = problem_.who[i];
    const model::ContactMode& mode = at_.modes.contacts[p.contact];
    if (!mode.closed || !p.unilateral) continue;
    const double N = system_.normal_force(p.contact, lambda_);
    double& most = worst[island[i]];
    largest[island[i]] = std::max(largest[island[i]], std::abs(N));
    most = std::max(most, -N);
    if (mode.friction != model::ContactMode::Friction::stick) continue;
    const double bound = system_.model().contacts[p.contact].coulomb->static_coefficient() * std::max(0.0, N);
    most = std::max(most, system_.friction_force(p.contact, lambda_).norm() - bound);
  }
  std::vector<bool> exerted;
  for (std::size_t k = 0; k < island.size(); ++k) exerted.push_back(worst[k] <= most_error_of_forces * largest[k]);
  return exerted;
}

std::vector<bool> ForcesInModes::moves_as_found() const {
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<bool> all(island.size(), true);
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Participant& p = problem_.who[i];
    double off = p.unilateral ? std::abs(system_.acceleration({p.contact, 0}, a_) - p.a_n) : 0;
    if (p.tangent != Participant::Tangent::none)
      off = std::max(off, (system_.slip_acceleration(p.contact, a_) - p.a_t).norm());
    const double nothing =
        std::max(p.nothing, complementarity::largest_violation * at_.largest[std::size_t(p.contact)]);
    if (!(off <= nothing)) all[island[i]] = false;
  }
  return all;
}

std::vector<bool> ForcesInModes::presses_as_found() const {
  const std::vector<std::size_t> island = problem_.islands();
  const std::vector<double> largest = problem_.largest_in_island();
  std::vector<bool> all(island.size(), true);
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Participant& p = problem_.who[i];
    const double error = most_error_of_forces * largest[i];
    if (at_.modes.contacts[p.contact].friction != Friction::slide || p.idle || p.N <= error) continue;
    if (!(system_.normal_force(p.contact, lambda_) > error)) all[island[i]] = false;
  }
  return all;
}

}  // namespace trammel::simulate
