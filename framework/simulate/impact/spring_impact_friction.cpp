// Decides which contacts stick and slide while springs push, and computes the forces that hold those that stick.
#include "simulate/impact/spring_impact.hpp"

#include <cmath>

#include <trammel/decompositions.hpp>

namespace trammel::simulate {

using complementarity::ContactPoint;
using complementarity::LcpOutcome;

namespace {

// In units of the springs' time: where contacts begin to push, the forces this much later are used.
constexpr double ahead = 1e-6;
// Of the largest pivot: smaller pivots are round-off of dependent rows.
constexpr double dependence = 1e-10;
// Accelerations that forces leave, of those without these forces: an error of the solution.
constexpr double held_within = 1e-9;

Eigen::CompleteOrthogonalDecomposition<Mat> decomposed(const Mat& A) {
  Eigen::CompleteOrthogonalDecomposition<Mat> qr;
  qr.setThreshold(dependence);
  return qr.compute(A);
}

}  // namespace

std::vector<ContactPoint> SpringImpact::resting_points(const Vec& F, const std::vector<std::size_t>& resting,
                                                       const std::vector<bool>& let_go) const {
  std::vector<ContactPoint> points;
  int next = 0;
  for (std::size_t j = 0; j < resting.size(); ++j) {
    const Contact& c = contacts_[resting[j]];
    ContactPoint p;
    p.tangent = next, p.tangents = t_;
    p.kind = ContactPoint::Tangent::resting;
    p.coefficient = let_go[j] ? c.mu : c.mu_0;
    p.given = F[c.normal];
    points.push_back(p);
    next += t_;
  }
  return points;
}

std::vector<Eigen::Index> SpringImpact::sticking_rows() const {
  std::vector<Eigen::Index> rows;
  for (const Contact& c : contacts_)
    for (int k = 0; k < t_ && c.presses && c.mode == Tangent::sticks; ++k) rows.push_back(c.tangent + k);
  return rows;
}

// Along these rows, by the forces f. They lie in the range of A: where rows depend on each other, no friction holds the
// round-off that the product leaves outside of it, and where forces balance this round-off is all that is left.
Vec SpringImpact::accelerations(const std::vector<Eigen::Index>& rows, const Vec& f) const {
  const Mat A = A_(rows, rows);
  const Vec b = (A_ * f)(rows);
  return A * decomposed(A).solve(b);
}

// True if some forces inside the cones hold all sticking contacts under the forces f.
bool SpringImpact::some_forces_hold(const Vec& f) const {
  std::vector<std::size_t> sticking;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].presses && contacts_[i].mode == Tangent::sticks) sticking.push_back(i);
  const std::vector<ContactPoint> points = resting_points(f, sticking, std::vector<bool>(sticking.size(), false));
  Vec others = f;
  others(sticking_).setZero();
  const Vec b = accelerations(sticking_, others);
  Vec T, a;
  if (complementarity::solve_contacts(points, A_(sticking_, sticking_), b, T, a).outcome != LcpOutcome::solved)
    return false;
  return a.lpNorm<Eigen::Infinity>() <= held_within * b.lpNorm<Eigen::Infinity>();
}

// Contacts without slip stick or begin to slide, by the forces a moment later.
void SpringImpact::choose_tangents() {
  Vec F = Vec::Zero(m_), f = Vec::Zero(m_);
  const std::vector<std::size_t> resting = choose_sliding(F, f);
  if (resting.empty()) return;
  const double largest = F.maxCoeff();
  if (largest > 0) F /= largest, f /= largest;
  const Vec a = beginning_slips(resting, F, f);
  for (std::size_t j = 0; j < resting.size(); ++j) {
    Contact& c = contacts_[resting[j]];
    const Vec begins = a.segment(Eigen::Index(j) * t_, t_);
    c.slid = false;
    c.mode = begins.isZero(0) ? Tangent::sticks : Tangent::slides;
    if (c.mode == Tangent::slides) c.direction.head(t_) = begins.normalized();
  }
}

// Contacts with a slip slide. Fills in the normal forces F and all known forces f a moment later; returns the contacts
// with friction and without slip.
std::vector<std::size_t> SpringImpact::choose_sliding(Vec& F, Vec& f) {
  std::vector<std::size_t> resting;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    if (c.presses) f[c.normal] = F[c.normal] = k_ * std::max(0.0, x_[Eigen::Index(i)] - ahead * u_[c.normal]);
    c.mode = Tangent::none;
    if (!rubs(c)) continue;
    const Slip s = slip(c, u_);
    if (!(s.norm() > 2 * slow_)) {
      resting.push_back(i);
      continue;
    }
    c.mode = Tangent::slides, c.slid = true;
    c.direction.head(t_) = s.normalized();
    f.segment(c.tangent, t_) = -c.mu * F[c.normal] * s.normalized();
  }
  return resting;
}

// The accelerations along the tangents of resting contacts, with mu_0 as long as they stick and mu once they slide.
Vec SpringImpact::beginning_slips(const std::vector<std::size_t>& resting, const Vec& F, const Vec& f) const {
  std::vector<Eigen::Index> rows;
  for (const std::size_t i : resting)
    for (int k = 0; k < t_; ++k) rows.push_back(contacts_[i].tangent + k);
  const Vec b = accelerations(rows, f);
  Vec T, a = Vec::Zero(b.size());
  std::vector<bool> let_go(resting.size(), false);
  for (bool settled = false; !settled;) {
    settled = true;
    const auto points = resting_points(F, resting, let_go);
    if (complementarity::solve_contacts(points, A_(rows, rows), b, T, a).outcome != LcpOutcome::solved) a = b;
    for (std::size_t j = 0; j < resting.size(); ++j) {
      if (let_go[j] || a.segment(Eigen::Index(j) * t_, t_).isZero(0)) continue;
      let_go[j] = true;
      const Contact& c = contacts_[resting[j]];
      settled = settled && c.mu == c.mu_0;
    }
  }
  return a;
}

// Friction is at its bound and the look ahead has found no slip: the contact that exceeds its bound most slides against
// its friction.
void SpringImpact::force_slip() {
  hold_sticking();
  derivative(state(), dy_);
  Contact* worst = nullptr;
  double most = 0;
  for (Contact& c : contacts_) {
    if (!c.presses || c.mode != Tangent::sticks) continue;
    const double over = f_.segment(c.tangent, t_).norm() - c.mu_0 * f_[c.normal];
    if (!worst || over > most) worst = &c, most = over;
  }
  if (!worst || f_.segment(worst->tangent, t_).isZero(0)) return;
  worst->mode = Tangent::slides;
  worst->direction.head(t_) = -f_.segment(worst->tangent, t_).normalized();
}

void SpringImpact::begin_phase() {
  if (P_.isZero(0)) choose_tangents();
  hold_sticking();
  if (sticking_.empty()) return;
  // Removes the rest of their slip.
  const Vec s = u_(sticking_);
  const Mat A_SS = A_(sticking_, sticking_);
  const Vec P = -decomposed(A_SS).solve(s);
  const Vec mean = s + 0.5 * A_SS * P;
  P_(sticking_) += P;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!contacts_[i].presses || contacts_[i].mode != Tangent::sticks) continue;
    lost_friction_[Eigen::Index(i)] -= P.segment(at, t_).dot(mean.segment(at, t_));
    at += t_;
  }
  u_ = rates();
}

void SpringImpact::hold_sticking() {
  sticking_ = sticking_rows();
  dependent_ = false;
  if (sticking_.empty()) return;
  const auto qr = decomposed(A_(sticking_, sticking_));
  dependent_ = qr.rank() < Eigen::Index(sticking_.size());
  Mat others = A_(sticking_, Eigen::all);
  for (const Eigen::Index row : sticking_) others.col(row).setZero();
  hold_ = qr.solve(others);
  hold_ *= -1;
}

}  // namespace trammel::simulate
