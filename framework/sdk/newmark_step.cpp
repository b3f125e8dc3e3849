#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trammel/methods/newmark_step.hpp>

#include "linear/dense/eps.hpp"

namespace trammel {

namespace {

// Relative to the first increment after an extrapolated prediction. Methods of second order have a local error of v of
// 0.1 to 0.25 times that increment, so the error left by Newton's iteration is within a hundredth of it.
constexpr double share_of_first = 1e-3;
// An acceleration that changes by more than the part `smooth` of itself in a step is not extrapolated; nor is one from
// a step that was shorter by more than `longest_ahead`.
constexpr double smooth = 0.5, longest_ahead = 4;
// Rows may turn by this factor more than their coordinates move: levers may be shorter than the unit of length.
constexpr double turns = 10;
// Corrections of the rows alone, at the end of a step. Each multiplies the error of the one before by at most `turns`
// times the motion.
constexpr int most_passes = 4;
// Rows whose violation is still larger contradict each other: [m, rad], and relative to the largest place and its
// change.
constexpr double contradictory = 1e-8, contradictory_in_place = 1e-6;
constexpr double most_noise = 1e-3;  // of the velocity: round-off of the positions over the step, of formulation index3

double largest(const Vec& x) {
  return x.size() ? x.lpNorm<Eigen::Infinity>() : 0;
}
// The offset avoids a division by numbers near underflow (a motion that is damped out).
double relative(double change, double size) {
  return change / (size + 1e-280);
}

}  // namespace

// Metres and radians are not comparable: 1e-8 m is accurate to 1e-11 for a rod a kilometre long, 1e-8 rad is not. The
// scale of a coordinate is its own change in the step, but at least 1, and at most the scale of all coordinates
// together. Tolerances below a coordinate's round-off are avoided.
void NewmarkStep::measure(const State& now, double h) {
  sizes_q_ = h * now.v.cwiseAbs() + h * h * now.a.cwiseAbs() + dq.cwiseAbs();
  const double noise = 64 * eps / newton.tolerance;
  if (now.q.size() == now.v.size())
    sizes_q_ = sizes_q_.cwiseMax(noise * now.q.cwiseAbs());
  else
    sizes_q_ = sizes_q_.cwiseMax(noise * largest(now.q));
  sizes_q_ = sizes_q_.cwiseMax(1).cwiseMin(size_q_);
}

void NewmarkStep::begin(const System& s, const State& now, double h, double c_q, double c_v, State& next) {
  const Sizes sizes = s.sizes();
  c_q_ = c_q, c_v_ = c_v;
  size_q_ = largest(now.q) + h * largest(now.v) + h * h * largest(now.a) + largest(dq);
  size_v_ = largest(now.v) + h * largest(now.a) + largest(v);
  measure(now, h);
  zero_.setZero(sizes.nc > 0 ? sizes.nv : 0);
  pi_.setZero(formulation == Formulation::stabilised ? zero_.size() : 0);
  dpi_.resize(pi_.size());
  for (Vec* scratch : {&first_da_, &left_, &momentum_}) scratch->resize(sizes.nv);  // used in some steps only
  next.t = now.t + h;
  next.a = now.a;
  h_ = h;
  doubted_ = false;
  find_lead(now, now.a);
  next.lambda = now.lambda;
  newton.start();
  if (sizes.nv == 0) newton.judge(0, true);  // nothing to solve for
}

void NewmarkStep::find_lead(const State& now, const Vec& a) {
  lead_ = dq - h_ * now.v;
  lead_ += c_q_ * a;
  leads_ = c_q_ > 0 && largest(lead_) > h_ * largest(now.v);
}

void NewmarkStep::extrapolate(const State& now, const Vec& a_before, double ratio, State& next) {
  if (a_before.size() != now.a.size() || !iterating() || ratio > longest_ahead) return;
  increment_ = ratio * (now.a - a_before);
  if (!(largest(increment_) <= smooth * largest(now.a))) return;
  next.a = now.a + increment_;
  find_lead(now, next.a);
  newton.start(share_of_first);
}

void NewmarkStep::update(const System& s, const State& now, State& next) {
  increment_ = dq + c_q_ * next.a;
  if (pi_.size() > 0) increment_ += pi_;
  s.retract(now.q, increment_, next.q);
  next.v = v + c_v_ * next.a;
}

void NewmarkStep::move(System& s, const State& now, State& next) {
  update(s, now, next);
  s.move_to(next.t, next.q, next.v);
}

void NewmarkStep::factorise(System& s, Blend blend, const State& next) {
  s.factorise(blend, next.a, next.lambda);
  of_pi_ = Factors::iteration;
  if (s.sizes().nc == 0 || formulation == Formulation::index3) return;
  // If W = G, both products agree to the last bit for any multipliers. These vectors are scratch until correct_rows.
  rc_.setLinSpaced(s.sizes().nc, 1, 2);
  da_ = dpi_ = zero_;
  s.add_reaction(1, rc_, da_);
  s.add_rows_force(1, rc_, dpi_);
  if (da_ == dpi_) return;
  s.factorise(blend, next.a, next.lambda, Factors::projection);
  of_pi_ = Factors::projection;
}

bool NewmarkStep::correct_rows(System& s, const Vec& r, State& next) {
  if (s.sizes().nc == 0) {
    rc_.resize(0);
    if (!s.correct(r, rc_, da_, dlambda_)) return false;
  } else if (formulation == Formulation::index3) {
    rc_ = s.g() / c_q_;
    if (!s.correct(r, rc_, da_, dlambda_)) return false;
  } else {
    rc_ = s.g_dot() / c_v_;
    if (!s.correct(r, rc_, da_, dlambda_)) return false;
    // g after this increment, which moves q by c_q da with G da = -rc.
    rc_ = s.g() - c_q_ * rc_;
    if (!s.correct(zero_, rc_, dpi_, mu_, of_pi_)) return false;
    pi_ += dpi_;
  }
  next.a += da_;
  next.lambda += dlambda_;
  measure_change(next);
  return true;
}

// Stabilised form, for rows that are satisfied up to the iteration's last increment. v is corrected alone: q, and so G,
// stays, which makes the velocity rows linear, and one pass satisfies them. (Increments of a would turn the rows by h
// times the angular velocity.)
bool NewmarkStep::correct_rows_alone(System& s, State& next) {
  if (formulation == Formulation::index3) return correct_rows(s, zero_, next);
  rc_ = s.g();
  if (!s.correct(zero_, rc_, dpi_, mu_, of_pi_)) return false;
  rc_ = s.g_dot() / c_v_;
  if (!s.correct(zero_, rc_, da_, dlambda_)) return false;
  pi_ += dpi_ - c_q_ * da_;
  next.a += da_;
  next.lambda += dlambda_;
  measure_change(next);
  return true;
}

void NewmarkStep::measure_change(const State& next) {
  const double da = largest(da_), a = largest(next.a);
  change_q_ = relative(c_q_ * da + largest(dpi_), size_q_ + c_q_ * a);
  change_v_ = relative(c_v_ * da, size_v_ + c_v_ * a);
  change_each_ = change_q_;
  for (Eigen::Index i = 0; i < sizes_q_.size(); ++i) {
    const double change = std::abs(c_q_ * da_[i]) + (pi_.size() > 0 ? std::abs(dpi_[i]) : 0);
    change_each_ = std::max(change_each_, relative(change, sizes_q_[i] + c_q_ * std::abs(next.a[i])));
  }
  moved_ += change_each_;
}

// c_q a of a mode changes its force by omega^2 c_q M a, which exceeds M a if the step is too long for the mode, at any
// phase.
bool NewmarkStep::misled(System& s, const Vec& r) {
  if (!leads_) return false;
  leads_ = false;
  lead_ /= c_q_;
  da_.setZero(lead_.size());
  s.add_mass_times(1, lead_, da_);
  return largest(r) > largest(da_);
}

// Near a change of rank, at an angle theta from it, rows that are satisfied to their round-off d leave q uncertain by d
// / theta and v by d / theta^2; so does a rod beside a body 1e12 times as long, whose coordinates cannot change by less
// than their spacing. Then every increment moves q, and r with it. The iteration has converged if the increment due to
// r alone is within the tolerance, or moves q much less than the round-off of the rows does.
bool NewmarkStep::at_round_off(System& s, const Vec& r) {
  if (change_q_ <= 64 * eps || largest(r) <= 64 * eps * largest(s.f())) return true;
  if (s.sizes().nc == 0 || largest(s.g()) > 4 * eps * size_q_) return false;
  rc_.setZero(s.sizes().nc);
  if (!s.correct(r, rc_, da_, dlambda_)) return false;
  constexpr double little = 0.01;
  const double dv = c_v_ * largest(da_);
  return relative(dv, size_v_) <= newton.tolerance || c_v_ * dv <= little * change_q_ * size_q_;
}

// True if r exceeds a small part of the first increment's momentum M da, and round-off.
bool NewmarkStep::matters(System& s, const Vec& r) {
  if (largest(r) <= 64 * eps * largest(s.f())) return false;
  momentum_.setZero(r.size());
  s.add_mass_times(1, first_da_, momentum_);
  return largest(r) > share_of_first * largest(momentum_);
}

// A spring that the prediction stretches by d has the lateral stiffness k d/L, which c_q multiplies. Factors of that
// point then hide the part of r along soft motions across a stiff spring, and the iteration seems to have converged.
// True if r matters and stiffness takes up a part of it, r = -(M da + stiffness) in the last increment.
bool NewmarkStep::doubtful(System& s, const Vec& r) {
  constexpr double little = 0.1;
  left_ = r;
  s.add_reaction(1, dlambda_, left_);
  if (!matters(s, left_)) return false;
  const double left = largest(left_);
  s.add_mass_times(1, da_, left_);
  return largest(left_) > little * left;
}

void NewmarkStep::correct(System& s, Blend blend, const Vec& r, State& next) {
  if (std::exchange(doubted_, false) && !matters(s, r)) return newton.confirm();
  if (misled(s, r)) {
    next.a -= lead_;
    return;
  }
  const bool of_this_point = newton.wants_factors();
  if (of_this_point) factorise(s, blend, next), moved_ = 0;
  if (!correct_rows(s, r, next)) return newton.fail("the iteration matrix is singular");
  const double change = std::max(change_each_, change_v_);
  if (newton.first()) first_da_ = da_;
  newton.judge(change, !newton.fast(change) && at_round_off(s, r));
  doubted_ = newton.converged() && !of_this_point && doubtful(s, r);
  if (doubted_) newton.renew();
}

Outcome NewmarkStep::finish(System& s, const State& now, State& next) {
  if (!newton.converged()) return newton.outcome();
  if (s.sizes().nc > 0) {
    // Correcting the rows alone needs no force. Their factors are wrong by the motion of q since.
    double change = 0, missed = 0;
    int passes = 0;
    do {
      move(s, now, next);
      missed = largest(s.g());
      if (next.v.size() == 0) break;  // rows that move nothing
      if (!correct_rows_alone(s, next)) return Outcome::reject("the iteration matrix is singular");
      change = formulation == Formulation::index3 ? change_each_ : std::max(change_each_, change_v_);
    } while (change * std::min(newton.rate(), turns * moved_) > eps && ++passes < most_passes);
    if (missed > std::max(contradictory, contradictory_in_place * size_q_))
      return Outcome::reject("the joints' rows contradict each other");
    // Position rows divide their round-off by h^2. Reject the step if that is not small compared with the velocity.
    const double noise = eps * size_q_ * c_v_ / std::max(c_q_, std::numeric_limits<double>::min());
    if (formulation == Formulation::index3 && noise > most_noise * size_v_)
      return Outcome::reject(
          "the step is too small for formulation index3: round-off of the positions outweighs the velocity");
  }
  update(s, now, next);
  if (!(next.q.allFinite() && next.v.allFinite() && next.a.allFinite() && next.lambda.allFinite()))
    return Outcome::reject("the step left the finite numbers");
  return Outcome::accept();
}

}  // namespace trammel
