#include "simulate/spring_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "complementarity/admissible_forces.hpp"
#include "complementarity/row_basis.hpp"

namespace trammel::simulate {
namespace {

using complementarity::ContactPoint;
using complementarity::ContactSolution;
using complementarity::LcpOutcome;

// Of the largest rate: what an event's margin may be below 0, what is left at the end, and what moves wedged contacts no more.
constexpr double tolerance = 1e-13, negligible = 1e-12, still = 1e-9;
// Of the largest rate: slips that are none, in the plane and in space, where the direction of a slip turns the faster the slower it is.
constexpr double no_slip = 1e-11, no_slip_in_space = 1e-9;
constexpr double step_error = 2e-13;
constexpr int columns = 6, order = 2 * columns;
// Of the largest rate: what may be left of an impact that had not ended without being told.
constexpr double worth_telling = 1e-3;
// In units of the springs' time: how far ahead the forces are looked at where contacts begin to push.
constexpr double ahead = 1e-6;
constexpr int most_steps = 20000;
constexpr double compliance = 1e-9;
// Of the largest pivot: rows that depend on others leave round-off.
constexpr double dependence = 1e-10;

Eigen::CompleteOrthogonalDecomposition<Mat> decomposed(const Mat& A) {
  Eigen::CompleteOrthogonalDecomposition<Mat> qr;
  qr.setThreshold(dependence);
  return qr.compute(A);
}

}  // namespace

SpringImpact::SpringImpact(std::vector<SpringContact> contacts, const Mat& A, const Vec& u, int tangents)
    : A_(A), u_before_(u), t_(tangents), n_(Eigen::Index(contacts.size())), m_(u.size()) {
  double softest = 0;
  for (const SpringContact& c : contacts) {
    contacts_.push_back({c});
    softest = std::max(softest, A(c.normal, c.normal));
  }
  if (softest > 0) k_ = 1 / softest;
  v_ = u.size() > 0 ? u.lpNorm<Eigen::Infinity>() : 0;
  slow_ = (t_ == 1 ? no_slip : no_slip_in_space) * v_;
  x_.setZero(n_), P_.setZero(m_), told_.setZero(m_), lost_friction_.setZero(n_), lost_normal_.setZero(n_),
      compressed_.setZero(n_);
}

ContactSolution SpringImpact::run() {
  if (v_ == 0) return {LcpOutcome::solved, 0};
  u_ = rates();
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (u_[contacts_[i].normal] < -tolerance * v_) press(i);
  bool ended = false;
  for (int phase = 0; !ended && phase < most_phases; ++phase) {
    begin_phase();
    ended = finished() || wedged();
    if (ended) break;
    if (!advance_to_event()) break;
    handle_events();
  }
  const double left = std::max(fastest_approach() / v_, x_.norm() / v_);
  cut_short_ = !ended && left > worth_telling;
  return close();
}

bool SpringImpact::finished() const {
  const Vec u = rates();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const int n = contacts_[i].normal;
    if (u[n] < -negligible * v_ || std::sqrt(k_ * A_(n, n)) * x_[Eigen::Index(i)] > negligible * v_) return false;
  }
  return true;
}

// Springs in balance with each other or with friction: nothing changes any more.
bool SpringImpact::wedged() {
  derivative(state(), dy_);
  for (const Contact& c : contacts_) {
    const double rate = u_[c.normal] / v_;
    if (rate < -still || (c.presses && rate > still)) return false;
  }
  return (A_ * f_).lpNorm<Eigen::Infinity>() <= still * v_;
}

// --- events ---

void SpringImpact::press(std::size_t i) {
  contacts_[i].presses = contacts_[i].compresses = true;
  contacts_[i].x_0 = x_[Eigen::Index(i)];
}

void SpringImpact::end_compression(std::size_t i) {
  Contact& c = contacts_[i];
  const auto at = Eigen::Index(i);
  const double stored = k_ / 2 * (x_[at] * x_[at] - c.x_0 * c.x_0);
  compressed_[at] += stored;
  lost_normal_[at] += (1 - c.e * c.e) * stored;
  x_[at] = std::sqrt(c.x_0 * c.x_0 + c.e * c.e * (x_[at] * x_[at] - c.x_0 * c.x_0));
  c.compresses = false;
  c.presses = x_[at] > 0;
  // What is left of the rate, where an event is located to a few units of `tolerance`.
  if (A_(c.normal, c.normal) > 0 && std::abs(u_[c.normal]) <= 10 * negligible * v_)
    P_[c.normal] = std::max(0.0, P_[c.normal] - u_[c.normal] / A_(c.normal, c.normal));
}

void SpringImpact::handle_normal(std::size_t i) {
  Contact& c = contacts_[i];
  if (!c.presses) return press(i);
  if (c.compresses) return end_compression(i);
  if (u_[c.normal] < -tolerance * v_) press(i);
  if (x_[Eigen::Index(i)] <= tolerance * v_) x_[Eigen::Index(i)] = 0, c.presses = c.compresses = false;
}

void SpringImpact::handle_events() {
  all_margins(state(), margins_);
  std::vector<std::size_t> stuck;
  bool gave_way = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (contacts_[i].mode == Tangent::sticks) stuck.push_back(i);
    if (contacts_[i].mode == Tangent::sticks && margins_[i].tangent < -tolerance) gave_way = true;
    if (margins_[i].normal < -tolerance) handle_normal(i);
  }
  u_ = rates();
  choose_tangents();
  const auto sticks = [this](std::size_t i) { return contacts_[i].mode == Tangent::sticks; };
  if (gave_way && std::all_of(stuck.begin(), stuck.end(), sticks)) force_slip();
}

// --- the course between two events ---

Vec SpringImpact::state() const {
  Vec y(2 * n_ + m_);
  y << x_, P_, lost_friction_;
  return y;
}

void SpringImpact::take(const Vec& y) {
  x_ = y.head(n_), P_ = y.segment(n_, m_), lost_friction_ = y.tail(n_);
  u_ = rates();
  for (Contact& c : contacts_)
    if (c.mode == Tangent::slides && slip(c, u_).norm() > 2 * slow_) c.slid = true;
}

void SpringImpact::forces(const Vec& y, const Vec& u, Vec& f) const {
  f.setZero(m_);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    if (!c.presses) continue;
    const double F = f[c.normal] = k_ * y[Eigen::Index(i)];
    if (c.mode != Tangent::slides) continue;
    const bool turns = t_ == 2 && c.slid;
    const Vec direction = turns ? Vec(slip(c, u).normalized()) : Vec(c.direction.head(t_));
    f.segment(c.tangent, t_) = -c.mu * F * direction;
  }
  if (!sticking_.empty()) f(sticking_) = hold_ * f;
}

void SpringImpact::derivative(const Vec& y, Vec& dy) {
  u_.noalias() = A_ * y.segment(n_, m_);
  u_ += u_before_;
  forces(y, u_, f_);
  dy.resize(y.size());
  dy.segment(n_, m_) = f_;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    dy[Eigen::Index(i)] = c.presses ? -u_[c.normal] : 0;
    const bool slides = c.presses && c.mode == Tangent::slides;
    dy[n_ + m_ + Eigen::Index(i)] = slides ? -f_.segment(c.tangent, t_).dot(u_.segment(c.tangent, t_)) : 0;
  }
}

// Whether a slip in space has turned by more than 60 degrees against u: then it has passed 0, where friction jumps.
bool SpringImpact::turned_from(const Vec& u) const {
  for (const Contact& c : contacts_) {
    if (t_ == 1 || !c.presses || c.mode != Tangent::slides || !c.slid) continue;
    const Vec s = slip(c, u), now = slip(c, u_);
    if (s.dot(now) < 0.5 * s.norm() * now.norm()) return true;
  }
  return false;
}

// False: friction jumps on the way.
bool SpringImpact::midpoint(const Vec& y, double h, int n, Vec& y_end) {
  const double d = h / n;
  derivative(y, dy_);
  const Vec u = u_;
  Vec before = y, now = y + d * dy_;
  bool smooth = true;
  for (int i = 1; i < n && smooth; ++i) {
    derivative(now, dy_);
    smooth = !turned_from(u);
    middle_ = before + 2 * d * dy_;
    before.swap(now), now.swap(middle_);
  }
  derivative(now, dy_);
  y_end = 0.5 * (before + now + d * dy_);
  return smooth && !turned_from(u);
}

// The estimated error, in parts of `step_error`.
double SpringImpact::extrapolate(const Vec& y, double h, Vec& y_end) {
  std::vector<Vec> row(columns), last(columns);
  for (int j = 0; j < columns; ++j) {
    if (!midpoint(y, h, 2 * (j + 1), row[0])) return std::numeric_limits<double>::infinity();
    for (int k = 1; k <= j; ++k) {
      const double ratio = double(j + 1) / double(j + 1 - k);
      row[std::size_t(k)] =
          row[std::size_t(k - 1)] + (row[std::size_t(k - 1)] - last[std::size_t(k - 1)]) / (ratio * ratio - 1);
    }
    row.swap(last);
  }
  y_end = last[columns - 1];
  const Vec off = y_end - last[columns - 2];
  double error = 0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    error = std::max(error, std::abs(off[i]) / std::max(v_, std::abs(y[i])));
    error = std::max(error, std::abs(off[n_ + m_ + i]) / (k_ * v_ * v_));
  }
  for (Eigen::Index i = 0; i < m_; ++i) error = std::max(error, std::abs(off[n_ + i]) * std::sqrt(A_(i, i) / k_) / v_);
  return error / step_error;
}

bool SpringImpact::advance_to_event() {
  Vec y = state(), y_end, inside, slope, slope_end;
  double gone = 0;
  for (int step = 0; step < most_steps; ++step) {
    const double error = extrapolate(y, h_, y_end);
    const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-30), -1.0 / (order - 1)), 0.2, 3.0);
    if (!(error <= 1) && h_ > 1e-12) {
      h_ *= std::isfinite(error) ? factor : 0.2;
      continue;
    }
    // A margin that is negative within the step only.
    derivative(y, slope), derivative(y_end, slope_end);
    const auto between = [&](double s) {
      const double r = 1 - s;
      return Vec(r * r * (1 + 2 * s) * y + s * s * (3 - 2 * s) * y_end + h_ * s * r * (r * slope - s * slope_end));
    };
    const double at_end = margin(y_end);
    if (at_end >= -tolerance && h_ > 1e-3 &&
        std::min({margin(between(0.25)), margin(between(0.5)), margin(between(0.75))}) < -tolerance) {
      h_ /= 2;
      continue;
    }
    if (at_end >= -tolerance) {
      y = y_end;
      take(y);
      gone += h_;
      h_ = std::min(h_ * factor, 1e9);
      if (gone > 1e8 || finished() || wedged()) return gone <= 1e8;
      continue;
    }
    // The event, by the method of Illinois; the margin ends just below 0.
    const double aim = 5 * tolerance;
    double lo = 0, hi = h_, at_lo = std::max(0.0, margin(y)) + aim, at_hi = at_end + aim;
    for (int i = 0, side = 0; i < 100 && at_hi < -4 * tolerance && hi - lo > 1e-15 * (1 + gone); ++i) {
      double h = hi - at_hi * (hi - lo) / (at_hi - at_lo);
      if (i > 20 || !(h > lo && h < hi)) h = 0.5 * (lo + hi);
      extrapolate(y, h, inside);
      const double at = margin(inside) + aim;
      if (at <= 4 * tolerance) {
        hi = h, at_hi = at, y_end = inside;
        if (side < 0) at_lo /= 2;
        side = -1;
      } else {
        lo = h, at_lo = at;
        if (side > 0) at_hi /= 2;
        side = 1;
      }
    }
    take(y_end);
    standing_ = gone + hi > 1e-12 ? 0 : standing_ + 1;
    return standing_ <= 50 + 10 * n_;
  }
  return false;
}

// --- margins ---

double SpringImpact::margin(const Vec& y) {
  all_margins(y, margins_);
  double least = std::numeric_limits<double>::infinity();
  for (const Margins& m : margins_) least = std::min({least, m.normal, m.tangent});
  return least;
}

void SpringImpact::all_margins(const Vec& y, std::vector<Margins>& margins) {
  derivative(y, dy_);
  margins.assign(contacts_.size(), {});
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    const double x = y[Eigen::Index(i)] / v_, rate = u_[c.normal] / v_;
    margins[i].normal = !c.presses ? rate : c.compresses ? -rate : std::min(x, rate);
    if (!c.presses || c.mode == Tangent::none) continue;
    if (c.mode == Tangent::sticks) {
      margins[i].tangent = (c.mu_0 * f_[c.normal] - f_.segment(c.tangent, t_).norm()) / (k_ * v_);
    } else {
      const Vec s = slip(c, u_);
      const bool turns = t_ == 2 && c.slid;
      margins[i].tangent = (turns ? s.norm() - slow_ : s.dot(c.direction.head(t_)) + (c.slid ? 0 : 2 * slow_)) / v_;
    }
  }
  if (!dependent_) return;
  // Of dependent contacts these friction forces are one choice of many.
  const auto too_large = [](const Contact& c, const Margins& m) {
    return c.presses && c.mode == Tangent::sticks && m.tangent < -tolerance;
  };
  bool any = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) any = any || too_large(contacts_[i], margins[i]);
  if (!any || !some_forces_hold(f_)) return;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].mode == Tangent::sticks) margins[i].tangent = std::max(0.0, margins[i].tangent);
}

// --- friction ---

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

// Whether any forces in the cones hold all that stick, at the forces f.
bool SpringImpact::some_forces_hold(const Vec& f) const {
  std::vector<std::size_t> sticking;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].presses && contacts_[i].mode == Tangent::sticks) sticking.push_back(i);
  const std::vector<ContactPoint> points = resting_points(f, sticking, std::vector<bool>(sticking.size(), false));
  Vec others = f;
  others(sticking_).setZero();
  const Vec b = (A_ * others)(sticking_);
  Vec T, a;
  if (complementarity::solve_contacts(points, A_(sticking_, sticking_), b, T, a).outcome != LcpOutcome::solved)
    return false;
  return a.lpNorm<Eigen::Infinity>() <= 1e-9 * b.lpNorm<Eigen::Infinity>();
}

// Those without slip stick or begin to slide, as the forces a moment later decide.
void SpringImpact::choose_tangents() {
  std::vector<std::size_t> resting;
  Vec F = Vec::Zero(m_), f = Vec::Zero(m_);
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    if (c.presses) f[c.normal] = F[c.normal] = k_ * std::max(0.0, x_[Eigen::Index(i)] - ahead * u_[c.normal]);
    c.mode = Tangent::none;
    if (!rubs(c)) continue;
    const Vec s = slip(c, u_);
    if (s.norm() > 2 * slow_) {
      c.mode = Tangent::slides, c.slid = true;
      c.direction.head(t_) = s.normalized();
      f.segment(c.tangent, t_) = -c.mu * F[c.normal] * s.normalized();
      continue;
    }
    resting.push_back(i);
    for (int k = 0; k < t_; ++k) rows.push_back(c.tangent + k);
  }
  if (resting.empty()) return;
  const double largest = F.maxCoeff();
  if (largest > 0) F /= largest, f /= largest;
  const Vec b = (A_ * f)(rows);
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
  for (std::size_t j = 0; j < resting.size(); ++j) {
    Contact& c = contacts_[resting[j]];
    const Vec begins = a.segment(Eigen::Index(j) * t_, t_);
    c.slid = false;
    c.mode = begins.isZero(0) ? Tangent::sticks : Tangent::slides;
    if (c.mode == Tangent::slides) c.direction.head(t_) = begins.normalized();
  }
}

// Friction at its bound that no look ahead tells to slide: the contact whose bound is exceeded most slides against its friction.
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
  // What is left of their slip.
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
  hold_ = -qr.solve(others);
}

// --- the end ---

ContactSolution SpringImpact::close() {
  taken_at_end_ = k_ / 2 * x_.squaredNorm();
  lost_normal_ += k_ / 2 * x_.cwiseAbs2();
  for (Eigen::Index i = 0; i < n_; ++i)
    if (const Contact& c = contacts_[std::size_t(i)]; c.compresses)
      compressed_[i] += k_ / 2 * (x_[i] * x_[i] - c.x_0 * c.x_0);
  x_.setZero();
  for (const double yields : {compliance, compliance, 0.0}) {
    const double closing = fastest_approach();
    if (closing <= (yields > 0 ? tolerance : still) * v_) break;
    const ContactSolution solution = end_approaches(yields);
    if (yields == 0 && solution.outcome != LcpOutcome::solved) return solution;
  }
  share_sticking_forces();
  return {LcpOutcome::solved, 0};
}

double SpringImpact::fastest_approach() const {
  const Vec u = rates();
  double fastest = 0;
  for (const Contact& c : contacts_) fastest = std::max(fastest, -u[c.normal]);
  return fastest;
}

// An impact without restitution, if possible with friction. `yields`: what a contact gives way, of the largest entry of A, so that round-off
// in the rates of dependent contacts is no contradiction.
ContactSolution SpringImpact::end_approaches(double yields) {
  const Vec u = rates();
  const Mat A = A_ + yields * A_.diagonal().maxCoeff() * Mat::Identity(m_, m_);
  std::vector<ContactPoint> points;
  for (const Contact& c : contacts_) {
    ContactPoint& p = points.emplace_back();
    p.normal = c.normal;
    if (!(c.mu_0 > 0) || c.tangent < 0) continue;
    p.tangent = c.tangent, p.tangents = t_, p.coefficient = c.mu_0;
    p.kind = ContactPoint::Tangent::resting;
  }
  Vec P, a;
  ContactSolution solution = complementarity::solve_contacts(points, A, u, P, a);
  if (solution.outcome != LcpOutcome::solved) {
    for (ContactPoint& p : points) p.kind = ContactPoint::Tangent::none;
    solution = complementarity::solve_contacts(points, A, u, P, a);
  }
  if (solution.outcome != LcpOutcome::solved) return solution;
  const Vec mean = u + 0.5 * A_ * P;
  for (Eigen::Index i = 0; i < n_; ++i) {
    const Contact& c = contacts_[std::size_t(i)];
    taken_at_end_ += std::abs(P[c.normal] * mean[c.normal]);
    lost_normal_[i] -= P[c.normal] * mean[c.normal];
    if (c.tangent >= 0) lost_friction_[i] -= P.segment(c.tangent, t_).dot(mean.segment(c.tangent, t_));
  }
  P_ += P;
  return solution;
}

// The friction impulses of contacts that stick together are one choice of many: where it leaves a cone, the least one that does not.
void SpringImpact::share_sticking_forces() {
  told_ = P_;
  for (const Contact& c : contacts_) told_[c.normal] = std::max(0.0, P_[c.normal]);  // but for round-off it is
  bool outside = false;
  std::vector<Eigen::Index> rows;
  for (const Contact& c : contacts_) {
    if (c.tangent < 0 || c.mu_0 == 0) continue;
    outside = outside || told_.segment(c.tangent, t_).norm() > c.mu_0 * told_[c.normal] * (1 + 1e-9);
    for (int k = 0; k < t_; ++k) rows.push_back(c.tangent + k);
  }
  if (!outside) return;
  const complementarity::RowBasis basis = complementarity::find_basis(A_, rows);
  std::vector<Eigen::Index> order_of = basis.basis;
  order_of.insert(order_of.end(), basis.implied.begin(), basis.implied.end());
  std::vector<complementarity::SharingContact> sharing;
  for (const Contact& c : contacts_) {
    if (c.tangent < 0 || c.mu_0 == 0) continue;
    complementarity::SharingContact& s = sharing.emplace_back();
    for (int k = 0; k < t_; ++k)
      s.tangents.push_back(std::find(order_of.begin(), order_of.end(), c.tangent + k) - order_of.begin());
    s.coefficient = c.mu_0, s.given = told_[c.normal];
  }
  const Mat E = basis.resultants();
  Vec shared;
  complementarity::admissible_forces(sharing, E, E * P_(order_of), shared);
  Vec told = told_;
  told(order_of) = shared;
  if ((A_ * (told - P_)).lpNorm<Eigen::Infinity>() <= still * v_) told_ = told;
}

}  // namespace trammel::simulate
