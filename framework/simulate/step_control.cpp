#include "simulate/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "linear/dense/eps.hpp"

namespace trammel::simulate {
namespace {
constexpr int most_halvings = 10;  // of a fixed step that the method rejects
// Of a step: what it may miss of the way to a stop, and a fixed step of an equal part of that way, for the round-off of
// times must not cost a step of its own; and the shortening up to which a step does not count as cut.
constexpr double nearly_there = 1e-10, equal_parts = 1e-9, not_cut = 1e-9;
constexpr double least_error = 1e-4;  // of the tolerance: a smaller one lengthens the next step no further
// Factors from one step to the next.
constexpr double safety = 0.9, least_factor = 0.2, largest_factor = 5.0, least_after_rejection = 0.1;
constexpr double worth_a_change = 1.25;  // even steps are not lengthened by less
constexpr int last_even_steps = 8;       // before a stop, of equal lengths
}  // namespace

StepControl::StepControl(const StepChoice& choice, double every, int order, bool even)
    : choice_(choice), every_(every), order_(order), even_(even) {
  choice_.most = std::min(choice_.most, 20 * every_);
  wish_ = choice_.initial > 0 ? choice_.initial : std::max(every_, choice_.least);
  wish_ = std::min(wish_, choice_.most);
}

double StepControl::resolution(double t) {
  return 16 * eps * t;
}

double StepControl::smallest(double t) const {
  return std::max(choice_.least, resolution(std::max(std::abs(t), every_)));
}

StepControl::Proposal StepControl::propose(double t, double stop, double most) {
  const double h = controlled() ? std::min({wish_, choice_.most, most}) : *choice_.fixed;
  const double left = stop - t;
  if (controlled() && !(even_ && left < last_even_steps * h)) {
    planned_ = 0;
    if (h >= left * (1 - nearly_there)) return {left, stop};
    if (2 * h > left) return {left / 2, t + left / 2};
    return {h, t + h};
  }
  if (planned_ == 0 || stop_ != stop || planned_for_ != h) plan(t, stop, h);
  const double t_next = done_ + 1 == planned_ ? stop_ : t0_ + double(done_ + 1) * h_;
  if (halvings_ == 0) return {h_, t_next};
  const double halved = std::ldexp(t_next - t, -halvings_);
  return {halved, t + halved};
}

void StepControl::plan(double t, double stop, double h) {
  const double length = stop - t;
  t0_ = t, stop_ = stop, planned_for_ = h, done_ = 0;
  planned_ = std::max(1LL, static_cast<long long>(std::ceil(length / h - equal_parts)));
  h_ = length / double(planned_);
  const double rounding = 4 * eps * std::max(std::abs(stop), std::abs(t));
  if (std::abs(h_ - h) * double(planned_) <= rounding) h_ = h;
}

void StepControl::accepted(const Proposal& taken, double error) {
  if (planned_ > 0) ++done_;
  if (done_ == planned_ || halvings_ > 0) planned_ = 0;
  halvings_ = 0;
  if (!controlled()) return;
  const double e = std::max(error, least_error), p = order_;
  double factor =
      std::clamp(safety * std::pow(e, -0.7 / p) * std::pow(error_before_, 0.4 / p), least_factor, largest_factor);
  if (even_) {
    factor = std::min(safety * std::pow(std::max(e, error_before_), -1 / p), largest_factor);
    if (factor < worth_a_change) factor = 1;
  }
  const double next = taken.h * factor;
  const bool shortened = taken.h < std::min(wish_, choice_.most) * (1 - not_cut);
  wish_ = std::min(shortened ? std::max(next, wish_) : next, choice_.most);
  error_before_ = e;
}

void StepControl::rejected_for_error(double h, double error) {
  // If the error is not finite, max returns its first argument.
  wish_ = h * std::max(least_after_rejection, safety * std::pow(error, -1.0 / order_));
}

void StepControl::rejected(double h) {
  if (controlled())
    wish_ = h / 4;
  else
    ++halvings_;
}

bool StepControl::too_small(double t) const {
  if (controlled()) return wish_ < smallest(t);
  return halvings_ > most_halvings || t + std::ldexp(h_, -halvings_) == t;
}

void StepControl::archive(Archive& a, const std::string& prefix) {
  a(prefix + "t0", t0_), a(prefix + "stop", stop_), a(prefix + "h", h_), a(prefix + "planned", planned_);
  a(prefix + "planned_for", planned_for_);
  a(prefix + "done", done_), a(prefix + "halvings", halvings_);
  a(prefix + "wish", wish_), a(prefix + "error_before", error_before_);
  for (const double x : {t0_, stop_, h_, wish_})
    if (std::isnan(x)) throw std::out_of_range(prefix + "h");
}

}  // namespace trammel::simulate
