#include <cmath>

#include <trammel/newton.hpp>

namespace trammel {

void Newton::start() {
  state_ = State::iterating;
  wants_factors_ = true;
  iterations_ = 0;
  last_change_ = 0;
  reason_ = "";
}

void Newton::judge(double change, bool at_round_off) {
  if (!std::isfinite(change)) return fail("Newton's iteration left the finite numbers");
  ++iterations_;
  const bool first = iterations_ == 1;
  const double theta = first ? 0 : change / last_change_;
  // The first increment has no rate: it must be within the tolerance itself.
  const double error = first ? change : theta / (1 - theta) * change;
  const bool shrinking = theta < 1;
  if (change == 0 || (shrinking && error <= tolerance) || (theta >= 0.5 && at_round_off)) {
    state_ = State::converged;
    return;
  }
  if (iterations_ >= max_iterations) return fail("Newton's iteration did not converge");
  wants_factors_ = theta > 0.3;
  last_change_ = change;
}

void Newton::fail(const char* reason) {
  state_ = State::failed;
  reason_ = reason;
}

}  // namespace trammel
