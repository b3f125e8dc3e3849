#include "equations.hpp"

#include <cmath>
#include <limits>

namespace trammel::ida {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double no_velocity = 1e-12;  // relative to 1 and the velocities: D z of a smaller z is left out
constexpr int most_iterations = 10;    // onto the position rows
constexpr double slow = 0.5;           // an iteration that reduces the violation by less has reached round-off
constexpr double settled = 1e-9;       // [unit of the rows] if it is below this
constexpr int passes = 3;  // onto the velocity rows, with the factors of q before it moved; the last reduce round-off

}  // namespace

void Equations::restart(System& s) {
  use(s);
  const auto [nq, nv, nc] = s.sizes();
  nq_ = nq, nv_ = nv, nc_ = nc;
  zero_.setZero(nv_), zero_rows_.setZero(nc_);
  dpi_.setZero(nv_), dmu_.setZero(nc_), redundant_lambda_.setZero(nc_), redundant_mu_.setZero(nc_);
  flat_ = nq_ == nv_;  // a rotation has more numbers than rates
}

void Equations::use(System& s) {
  system_ = &s;
  stale_ = true;
}

void Equations::start(const State& now, double* y, double* y_dot) const {
  Eigen::Map<Vec> to(y, size()), rates(y_dot, size());
  to.setZero(), rates.setZero();
  to.head(nq_) = now.q, to.segment(nq_, nv_) = now.v;
  if (nc_ > 0) to.segment(nq_ + nv_, nc_) = now.lambda;
  Vec q_dot(nq_);
  system_->rate(now.q, now.v, q_dot);
  rates.head(nq_) = q_dot, rates.segment(nq_, nv_) = now.a;
}

void Equations::read(double t, const double* y, const double* y_dot, Point& to) const {
  const double* const lambda = y + nq_ + nv_;
  to.t = t;
  to.q = View(y, nq_), to.v = View(y + nq_, nv_);
  to.q_dot = View(y_dot, nq_), to.a = View(y_dot + nq_, nv_);
  to.lambda = View(lambda, nc_);
  if (nc_ > 0) to.pi = View(lambda + nc_, nv_), to.mu = View(lambda + nc_ + nv_, nc_);
}

bool Equations::residual(double t, const double* y, const double* y_dot, double* F) {
  System& s = *system_;
  read(t, y, y_dot, at_);
  q_ = at_.q;
  s.normalise(q_);
  s.move_to(t, q_, at_.v);
  applied_ = -s.f();
  if (nc_ > 0) s.add_reaction(1, at_.lambda, applied_);
  Eigen::Map<Vec> result(F, size());

  z_ = at_.v;
  if (nc_ > 0) z_ -= at_.pi;
  moved_.resize(nq_);
  s.rate(at_.q, z_, moved_);
  result.head(nq_) = at_.q_dot - moved_;
  r_ = applied_;
  s.add_mass_times(1, at_.a, r_);
  result.segment(nq_, nv_) = r_;
  if (nc_ > 0) {
    const Eigen::Index rows = nq_ + nv_;
    rates_ = s.g_dot();
    result.segment(rows, nc_) = rates_;
    r_.setZero(nv_);
    s.add_mass_times(1, at_.pi, r_);
    s.add_rows_force(1, at_.mu, r_);
    result.segment(rows + nc_, nv_) = r_;
    result.segment(rows + nc_ + nv_, nc_) = s.g();
  }
  return result.allFinite();
}

bool Equations::factorise(double t, double c, const double* y, const double* y_dot) {
  read(t, y, y_dot, set_up_);
  system_->normalise(set_up_.q);
  if (!factors_at(set_up_, c)) return false;
  if (nc_ > 0) {
    find_redundant_part(set_up_.lambda, redundant_lambda_);
    find_redundant_part(set_up_.mu, redundant_mu_);
  }
  return true;
}

bool Equations::factors_at(const Point& at, double c) {
  if (!at.q.allFinite() || !at.v.allFinite() || !at.a.allFinite()) return false;
  c_ = c, stale_ = false;
  system_->move_to(at.t, at.q, at.v);
  system_->factorise({1, 1 / c, 1 / (c * c)}, at.a, at.lambda);
  if (nc_ > 0) system_->factorise({}, zero_, zero_rows_, Factors::projection);
  return true;
}

// Rows that depend on each other leave a part of the multipliers free: no equation restores it, and the extrapolation
// of each step would enlarge its round-off. It is the difference from the multipliers of minimum norm
// with the same force; the factors must be those of the point.
void Equations::find_redundant_part(const Vec& multipliers, Vec& part) {
  r_.setZero(nv_);
  system_->add_rows_force(-1, multipliers, r_);
  part.setZero(nc_);
  if (system_->correct(r_, zero_rows_, change_, dmu_, Factors::projection)) part = multipliers - dmu_;
}

// xi_b_: the increment of q that belongs to b_1 / c, with the change of N(q) by it; off_: the part off the manifold.
void Equations::measure_tangent(const double* b) {
  const View b_1(b, nq_);
  if (flat_) {
    xi_b_ = b_1 / c_;
    off_.setZero(nq_);
    return;
  }
  xi_b_.resize(nv_), off_.resize(nq_), moved_.resize(nq_);
  z_ = at_.v;
  if (nc_ > 0) z_ -= at_.pi;
  change_ = at_.q + b_1 / c_;
  system_->rate(change_, z_, moved_);
  off_ = moved_;
  system_->rate(at_.q, z_, moved_);
  off_ = (b_1 + off_ - moved_) / c_;
  moved_ = at_.q + off_;
  system_->difference(moved_, at_.q, xi_b_);
  system_->rate(at_.q, xi_b_, moved_);
  off_ -= moved_;
}

// turned_: the change of G v + g_t by the increment xi_b of q. The change by the rest of xi is left out; it is of the
// order of h |v|/length, relative to the kept terms.
void Equations::measure_turning() {
  turned_.setZero(nc_);
  if (!(xi_b_.lpNorm<Eigen::Infinity>() > eps * at_.q.lpNorm<Eigen::Infinity>())) return;
  moved_.resize(nq_);
  system_->retract(q_, xi_b_, moved_);
  system_->move_to(at_.t, moved_, at_.v);
  turned_ = system_->g_dot() - rates_;
  system_->move_to(at_.t, q_, at_.v);
}

bool Equations::solve_projection(const double* b) {
  const double* const rows = b + nq_ + nv_;
  r_ = -View(rows + nc_, nv_);
  measure_turning();
  rc_ = turned_ - View(rows, nc_) + c_ * View(rows + nc_ + nv_, nc_);
  system_->add_rows_times(-c_, xi_b_, rc_);
  return system_->correct(r_, rc_, dpi_, dmu_, Factors::projection);
}

// r += D z by a difference of -f + W^T lambda; D is known to the System in its factors only.
void Equations::add_damping(const Vec& z, Vec& r) {
  const double size = z.lpNorm<Eigen::Infinity>(), speed = 1 + at_.v.lpNorm<Eigen::Infinity>();
  if (!(size > no_velocity * speed)) return;
  const double step = std::sqrt(eps) * speed / size;
  moved_ = at_.v + step * z;
  q_ = at_.q;
  system_->normalise(q_);
  system_->move_to(at_.t, q_, moved_);
  change_ = -system_->f();
  if (nc_ > 0) system_->add_reaction(1, at_.lambda, change_);
  r += (change_ - applied_) / step;
}

bool Equations::solve(const double* b, double* x) {
  if (stale_ && !factors_at(set_up_, c_)) return false;
  q_ = at_.q;
  system_->normalise(q_);
  system_->move_to(at_.t, q_, at_.v);
  measure_tangent(b);
  if (nc_ > 0 && !solve_projection(b)) return false;
  z_ = c_ * xi_b_ - dpi_;
  r_ = View(b + nq_, nv_);
  system_->add_mass_times(c_, z_, r_);
  add_damping(z_, r_);
  r_ /= -c_ * c_;
  rc_ = -View(b + size() - nc_, nc_);
  if (!system_->correct(r_, rc_, xi_, dlambda_)) return false;

  Eigen::Map<Vec> result(x, size());
  moved_.resize(nq_);
  system_->rate(at_.q, xi_, moved_);
  result.head(nq_) = moved_ + off_;
  result.segment(nq_, nv_) = c_ * (xi_ - xi_b_) + dpi_;
  if (nc_ > 0) {
    result.segment(nq_ + nv_, nc_) = c_ * c_ * dlambda_ - redundant_lambda_;
    result.segment(nq_ + nv_ + nc_, nv_) = dpi_;
    result.tail(nc_) = dmu_ - redundant_mu_;
    redundant_lambda_.setZero(), redundant_mu_.setZero();
  }
  return result.allFinite();
}

// Moves q by modified Newton iterations with the factors of its first value.
bool Equations::settle_positions(System& s, double t, Vec& q, Vec& v) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_iterations; ++i) {
    const double violation = s.g().lpNorm<Eigen::Infinity>();
    if (!(violation > eps * q.lpNorm<Eigen::Infinity>())) return std::isfinite(violation);
    if (violation > slow * before) return before < settled;  // round-off is left
    before = violation;
    rc_ = s.g();
    if (!s.correct(zero_, rc_, change_, dmu_, Factors::projection)) return false;
    moved_.resize(nq_);
    s.retract(q, change_, moved_);
    q = moved_;
    s.move_to(t, q, v);
  }
  return false;
}

bool Equations::project(System& s, double t, Vec& q, Vec& v) {
  if (nc_ == 0) return true;
  stale_ = true;
  s.move_to(t, q, v);
  s.factorise({}, zero_, zero_rows_, Factors::projection);
  if (!settle_positions(s, t, q, v)) return false;
  for (int pass = 0; pass < passes; ++pass) {
    rc_ = s.g_dot();
    if (!(rc_.lpNorm<Eigen::Infinity>() > eps * v.lpNorm<Eigen::Infinity>())) break;
    if (!s.correct(zero_, rc_, change_, dmu_, Factors::projection)) return false;
    v += change_;
    s.move_to(t, q, v);
  }
  return v.allFinite();
}

}  // namespace trammel::ida
