#include <algorithm>
#include <cmath>

#include <trammel/methods/newton.hpp>

namespace trammel {

namespace {

// If the increments have grown twice and are larger than this, the iteration diverges.
constexpr double hopeless = 0.1;
constexpr double slow = 0.3;  // ratio of two increments above which new factors are worth their cost

}  // namespace

void Newton::start(double share_of_first) {
  share_of_first_ = share_of_first;
  state_ = State::iterating;
  wants_factors_ = true;
  iterations_ = 0;
  rate_ = 1;
}

void Newton::judge(double change, bool at_round_off) {
  if (!std::isfinite(change)) return fail("Newton's iteration left the finite numbers");
  ++iterations_;
  // The first increment has no rate; it must itself be within the tolerance.
  const bool first = iterations_ == 1;
  if (first) enough_ = std::max(tolerance, share_of_first_ * change);
  const double rate_before = rate_;
  rate_ = first ? 1 : change / last_change_;
  const double error = first ? change : rate_ / (1 - rate_) * change;
  const bool shrinking = first || rate_ < 1;
  if (change == 0 || (shrinking && error <= enough_) || (!first && at_round_off)) {
    state_ = State::converged;
    return;
  }
  if (rate_before > 1 && rate_ > 1 && change > hopeless) return fail("Newton's iteration did not converge");
  if (iterations_ >= max_iterations) return fail("Newton's iteration did not converge");
  wants_factors_ = !first && rate_ > slow;
  last_change_ = change;
}

void Newton::fail(const char* reason) {
  state_ = State::failed;
  reason_ = reason;
}

}  // namespace trammel
