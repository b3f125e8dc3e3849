#include "complementarity/exact_modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "complementarity/shares/admissible_forces.hpp"
#include "complementarity/shares/carrying_equations.hpp"
#include "complementarity/shares/independent_rows.hpp"

namespace trammel::complementarity {
namespace {

using Tangent = ContactRole::Tangent;
using Eigen::Index;

constexpr double mode_tolerance = 1e-12;     // relative to the forces and to the accelerations
constexpr double round_off_of_sums = 1e-15;  // of the sizes of their terms

Eigen::Vector2d along_tangents(const Vec& x, const ContactPoint& p) {
  Eigen::Vector2d both = Eigen::Vector2d::Zero();
  both.head(p.tangents) = x.segment(p.tangent, p.tangents);
  return both;
}

}  // namespace

std::vector<ContactRole> roles_of(const std::vector<ContactPoint>& points, const Vec& F, const Vec& a, double nothing) {
  return roles_of(points, F, a, nothing, Vec::Constant(Index(points.size()), nothing));
}

std::vector<ContactRole> roles_of(const std::vector<ContactPoint>& points, const Vec& F, const Vec& a, double nothing,
                                  const Vec& no_slip) {
  std::vector<ContactRole> roles;
  const double no_force = mode_tolerance * F.lpNorm<Eigen::Infinity>();
  for (const ContactPoint& p : points) {
    ContactRole& role = roles.emplace_back();
    const double N = p.normal >= 0 ? F[p.normal] : p.given;
    role.closed = p.normal < 0 || N > no_force || a[p.normal] <= nothing;
    if (!role.closed) continue;
    if (p.slides()) role.tangent = Tangent::slides, role.ratio = p.ratio;
    if (!p.held()) continue;
    const Eigen::Vector2d a_t = along_tangents(a, p);
    const bool moves = a_t.norm() > no_slip[Index(roles.size()) - 1];
    role.tangent = moves ? Tangent::slides : Tangent::sticks;
    // Near its bound the direction of the force has more digits.
    const bool bound = N > no_force && along_tangents(F, p).norm() > 0.5 * p.coefficient * N;
    if (moves) role.ratio = p.coefficient * (bound ? along_tangents(F, p) : Eigen::Vector2d(-a_t)).normalized();
  }
  return roles;
}

namespace {

class ExactModes {
 public:
  ExactModes(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& a, double nearby, Vec& F)
      : points_(points), A_(A), b_(b), F_(F), a_(a) {
    roles_ = roles_of(points, F, a_, nearby * acceleration_scale());
  }

  // With forces as springs where contacts slide; with others only if there are no modes for these.
  bool solve() {
    const std::vector<ContactRole> roles = roles_;
    const Vec F = F_, a = a_;
    if (!settle_modes()) {
      if (!other_forces_exist_) return false;
      roles_ = roles, F_ = F, a_ = a;
      as_springs_ = false;
      if (!settle_modes()) return false;
    }
    share_by_accelerations();
    return true;
  }

  // Accelerations along implied rows are set to 0 if they differ by no more than the rows' angle to the basis.
  // Accelerations along different rows are compared in units of the rows' lengths.
  Vec accelerations() const {
    const Vec length = A_.diagonal().cwiseSqrt();
    double fastest = 0;
    for (Index i = 0; i < a_.size(); ++i)
      if (length[i] > 0) fastest = std::max(fastest, std::abs(a_[i]) / length[i]);
    Vec a = a_;
    for (const Index i : carrying_.rows.implied)
      if (std::abs(a[i]) <= std::sqrt(round_off_of_shares) * length[i] * fastest) a[i] = 0;
    return a;
  }

 private:
  struct Settled {
    std::vector<ContactRole> roles;
    Vec F, a;
    CarryingRows carrying;
  };

  // Iterates until forces and modes agree: for friction, to the round-off of each contact's own accelerations. If this
  // is not reached, agreement to the round-off of the largest acceleration is sufficient. False: it found no such
  // modes, or they repeat.
  bool settle_modes() {
    const int most = 6 * int(points_.size()) + 20;
    std::vector<std::vector<ContactRole>> tried;
    std::optional<Settled> settled;
    for (int i = 0; i < most; ++i) {
      if (std::find(tried.begin(), tried.end(), roles_) != tried.end()) break;
      tried.push_back(roles_);
      if (!find_forces()) break;
      const std::vector<ContactRole> found = roles_;
      const double contradicted = change_worst();
      if (contradicted == 0) return true;
      if (contradicted <= mode_tolerance * acceleration_scale() && !settled)
        settled = Settled{found, F_, a_, carrying_};
    }
    if (!settled) return false;
    roles_ = settled->roles, F_ = settled->F, a_ = settled->a, carrying_ = settled->carrying;
    return true;
  }

  // The shares must not depend on the modes tried before. Therefore they are formed again, with all contacts closed
  // that do not part and all tangents sticking that do not move. But if sliding contacts share, contacts that are idle
  // or at their bounds in the nearby solution stay so: equal springs led there, and with the shares of springs alone
  // there may be no solution.
  void share_by_accelerations() {
    const std::vector<ContactRole> on_the_way = roles_;
    roles_ = roles_of(points_, F_, a_, mode_tolerance * acceleration_scale(), mode_tolerance * own_scales());
    keep_beside_sliding(on_the_way);
    const auto same = [](const ContactRole& x, const ContactRole& y) {
      return x.closed == y.closed && x.idle == y.idle && x.tangent == y.tangent;
    };
    if (std::equal(roles_.begin(), roles_.end(), on_the_way.begin(), same)) return;
    const Vec F = F_, a = a_;
    const double nothing = largest_violation * acceleration_scale();
    if (!settle_modes() || !((a_ - a).lpNorm<Eigen::Infinity>() <= nothing)) F_ = F, a_ = a;
  }

  void keep_beside_sliding(const std::vector<ContactRole>& on_the_way) {
    const auto slides = [](const ContactRole& r) { return r.tangent == Tangent::slides; };
    if (std::none_of(roles_.begin(), roles_.end(), slides)) return;
    const CarryingRows carrying = carrying_rows(points_, A_, roles_);
    if (!carrying.sliding_shares) return;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      ContactRole& role = roles_[i];
      const ContactRole& before = on_the_way[i];
      if (!carrying.indeterminate[i] || !role.closed || points_[i].normal < 0) continue;
      if (!before.closed || before.idle)
        make_idle(role);
      else if (before.tangent == Tangent::slides && role.tangent == Tangent::sticks)
        role.tangent = Tangent::slides, role.ratio = before.ratio;
    }
  }

  static void make_idle(ContactRole& role) {
    role.idle = true;
    if (role.tangent == Tangent::sticks) role.tangent = Tangent::none;
  }

  double acceleration_scale() const {
    if (b_.size() == 0) return 0;
    return b_.lpNorm<Eigen::Infinity>() + (A_.cwiseAbs() * F_.cwiseAbs()).maxCoeff();
  }

  // By contact, of the accelerations along its tangents.
  Vec own_scales() const {
    const Vec terms = b_.cwiseAbs() + A_.cwiseAbs() * F_.cwiseAbs();
    const double largest = acceleration_scale();
    Vec scales = Vec::Zero(Index(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const ContactPoint& p = points_[i];
      if (p.tangent < 0) continue;
      const double own = scale_of_slip(terms.segment(p.tangent, p.tangents).maxCoeff(), largest);
      const double error_of_shares = 10 * A_(p.tangent, p.tangent) * F_.lpNorm<Eigen::Infinity>();
      scales[Index(i)] = std::min(largest, std::max(own, error_of_shares));
    }
    return scales;
  }

  bool find_forces() {
    for (;;) {
      carrying_ = carrying_rows(points_, A_, roles_);
      const CarryingEquations equations(points_, A_, b_, roles_, carrying_);
      if (!equations.regular()) return false;
      F_ = equations.forces();
      a_ = A_ * F_ + b_;
      if (!F_.allFinite()) return false;
      if (change_loose_ones()) continue;
      share_admissibly(equations);
      return true;
    }
  }

  // An idle contact whose row does not follow from those that carry is held by none of them: it carries its own force
  // where that presses, and opens where it pulls. True if there are any.
  bool change_loose_ones() {
    bool any = false;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double own = roles_[i].idle ? F_[points_[i].normal] : 0;
      if (own > 0) roles_[i] = closed(i), any = true;
      if (own < 0) roles_[i].closed = roles_[i].idle = false, any = true;
    }
    return any;
  }

  Index row_at(Index k) const {
    const auto& [basis, implied, K] = carrying_.rows;
    const auto i = std::size_t(k);
    return i < basis.size() ? basis[i] : implied[i - basis.size()];
  }

  double normal_force(std::size_t i) const { return points_[i].normal >= 0 ? F_[points_[i].normal] : points_[i].given; }
  // The acceleration that contradicts a contact's mode. (A contradicting force counts as the acceleration that it
  // causes, because forces of light bodies are small.)
  double pull(std::size_t i) const {
    const int normal = points_[i].normal;
    return normal >= 0 ? -A_(normal, normal) * F_[normal] : 0;
  }
  double beyond_cone(std::size_t i) const {
    const ContactPoint& p = points_[i];
    return A_(p.tangent, p.tangent) * (along_tangents(F_, p).norm() - p.coefficient * std::max(0.0, normal_force(i)));
  }

  // Contacts whose shares may be changed, because they do not slide and only their resultants matter; `columns`:
  // columns of their forces.
  std::vector<SharingContact> sharing_contacts(std::vector<Index>& columns) const {
    const auto column_of = [&](int row) {
      Index k = 0;
      while (row_at(k) != row) ++k;
      columns.push_back(k);
      return Index(columns.size()) - 1;
    };
    std::vector<SharingContact> sharing;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const ContactPoint& p = points_[i];
      const ContactRole& role = roles_[i];
      if (!shares_at_rest(i)) continue;
      SharingContact& c = sharing.emplace_back();
      c.given = p.given, c.coefficient = p.coefficient;
      if (p.normal >= 0) c.normal = column_of(p.normal);
      for (int k = 0; k < p.tangents && role.tangent == Tangent::sticks; ++k)
        c.tangents.push_back(column_of(p.tangent + k));
    }
    return sharing;
  }

  bool shares_at_rest(std::size_t i) const {
    const ContactRole& role = roles_[i];
    return carrying_.indeterminate[i] && role.closed && !role.idle && role.tangent != Tangent::slides;
  }

  bool springs_push() const {
    const double little = mode_tolerance * acceleration_scale();
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (shares_at_rest(i) && pull(i) > little) return false;
    return true;
  }

  bool springs_are_in_cones() const {
    const Vec no_slip = mode_tolerance * own_scales();
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (shares_at_rest(i) && roles_[i].tangent == Tangent::sticks && beyond_cone(i) > no_slip[Index(i)]) return false;
    return true;
  }

  // Takes the least admissible forces where springs would pull or leave a cone. Resultants are corrected by the
  // accelerations that K and the projections leave: round-off of forces that may be many times larger than those that
  // accelerate. Beside sliding contacts the normal forces stay those of springs, since the motion depends on them.
  void share_admissibly(const CarryingEquations& equations) {
    const bool push = springs_push();
    if (push && springs_are_in_cones()) return;
    const bool as_springs = as_springs_ && carrying_.sliding_shares;
    other_forces_exist_ = other_forces_exist_ || as_springs;
    if (as_springs && !push) return;  // those that pull are idle
    if (!share_beside_sliding(equations) && carrying_.sliding_shares && !as_springs) share_with_sliding();
  }

  // Sliding contacts keep the shares of springs. False: there are no admissible shares.
  bool share_beside_sliding(const CarryingEquations& equations) {
    std::vector<Index> columns;
    const std::vector<SharingContact> sharing = sharing_contacts(columns);
    const Mat E = carrying_.rows.resultants()(Eigen::all, columns);
    Vec forces(E.cols());
    for (std::size_t k = 0; k < columns.size(); ++k) forces[Index(k)] = F_[row_at(columns[k])];
    Vec resultants = E * forces, y;
    for (int corrections = 0; corrections < 3; ++corrections) {
      const double missed = admissible_forces(sharing, E, resultants, forces, &y);
      const double round_off = round_off_of_sums * (E.cwiseAbs() * forces.cwiseAbs()).norm();
      if (!(missed <= mode_tolerance * resultants.norm() + round_off)) return corrections > 0;
      for (std::size_t k = 0; k < columns.size(); ++k) F_[row_at(columns[k])] = forces[Index(k)];
      a_ = A_ * F_ + b_;
      resultants += equations.correction(a_);
    }
    return true;
  }

  // Changes shares along self-stresses of the force directions, n + p t for sliding contacts, which leave all
  // accelerations unchanged.
  void share_with_sliding() {
    std::vector<Index> columns;
    std::vector<SharingContact> sharing = sharing_contacts(columns);
    std::vector<Index> rows;
    for (const Index k : columns) rows.push_back(row_at(k));
    std::vector<std::size_t> sliding;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (carrying_.indeterminate[i] && points_[i].normal >= 0 && roles_[i].closed &&
          roles_[i].tangent == Tangent::slides)
        sliding.push_back(i);
    const Index n = Index(rows.size());
    Mat moved(A_.rows(), n + Index(sliding.size()));
    moved.leftCols(n) = A_(Eigen::all, rows);
    Vec forces(moved.cols());
    forces.head(n) = F_(rows);
    for (std::size_t k = 0; k < sliding.size(); ++k) {
      const ContactPoint& p = points_[sliding[k]];
      const Index column = n + Index(k);
      moved.col(column) =
          A_.col(p.normal) + A_.middleCols(p.tangent, p.tangents) * roles_[sliding[k]].ratio.head(p.tangents);
      forces[column] = F_[p.normal];
      sharing.emplace_back().normal = column;
    }
    const Mat E = independent_rows(moved);
    const Vec kept = E * forces;
    if (!(admissible_forces(sharing, E, kept, forces) <= mode_tolerance * kept.norm())) return;
    Vec F = F_;
    F(rows) = forces.head(n);
    for (std::size_t k = 0; k < sliding.size(); ++k) {
      const ContactPoint& p = points_[sliding[k]];
      const double N = F[p.normal] = forces[n + Index(k)];
      F.segment(p.tangent, p.tangents) = N * roles_[sliding[k]].ratio.head(p.tangents);
    }
    const Vec a = A_ * F + b_;
    if (!((a - a_).lpNorm<Eigen::Infinity>() <= largest_violation * acceleration_scale())) return;
    F_ = F, a_ = a;
  }

  // Changes the mode with the largest contradicting acceleration, which is returned. 0: there is none.
  double change_worst() {
    const double nothing = mode_tolerance * acceleration_scale();
    const Vec no_slip = mode_tolerance * own_scales();
    double worst = 0;
    std::size_t who = points_.size();
    ContactRole wanted;
    const auto consider = [&](std::size_t i, double amount, double least,
                              ContactRole (ExactModes::*changed)(std::size_t) const) {
      if (amount > worst && amount > least) worst = amount, who = i, wanted = (this->*changed)(i);
    };
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const ContactPoint& p = points_[i];
      const ContactRole& role = roles_[i];
      if (!role.closed) {
        consider(i, -a_[p.normal], nothing, &ExactModes::closed);
      } else if (role.idle) {
        consider(i, A_(p.normal, p.normal) * spring_force(p.normal), nothing, &ExactModes::closed);
      } else {
        if (p.normal >= 0) consider(i, pull(i), nothing, &ExactModes::released);
        if (p.held() && role.tangent == Tangent::sticks)
          consider(i, beyond_cone(i), no_slip[Index(i)], &ExactModes::sliding);
        if (p.held() && role.tangent == Tangent::slides && normal_force(i) > 0)
          consider(i, along_tangents(a_, p).dot(role.ratio.normalized()), no_slip[Index(i)], &ExactModes::sticking);
      }
    }
    if (who < points_.size()) roles_[who] = wanted;
    return worst;
  }

  // The roles to which contacts change.
  ContactRole closed(std::size_t i) const {
    const ContactPoint& p = points_[i];
    ContactRole role = roles_[i];
    role.closed = true;
    role.idle = false;
    role.tangent = p.slides() ? Tangent::slides : p.held() ? Tangent::sticks : Tangent::none;
    if (p.slides()) role.ratio = p.ratio;
    return role;
  }
  ContactRole released(std::size_t i) const {
    ContactRole role = roles_[i];
    if (carrying_.indeterminate[i] && carrying_.sliding_shares) {
      make_idle(role);
      return role;
    }
    role.closed = false;
    if (role.tangent == Tangent::sticks) role.tangent = Tangent::none;
    return role;
  }
  ContactRole sliding(std::size_t i) const {
    ContactRole role = roles_[i];
    role.tangent = Tangent::slides;
    role.ratio = points_[i].coefficient * along_tangents(F_, points_[i]).normalized();
    return role;
  }
  ContactRole sticking(std::size_t i) const {
    ContactRole role = roles_[i];
    role.tangent = Tangent::sticks;
    return role;
  }

  // The force that an idle contact would have as one more spring among the carrying ones, K S y / (1 + K S K^T) for
  // their forces S y. It stays finite where they come to depend on each other and K grows without bounds.
  double spring_force(int row) const {
    const auto& [basis, implied, K] = carrying_.rows;
    const auto found = std::find(implied.begin(), implied.end(), Index(row));
    if (found == implied.end()) return 0;
    const Vec follows = K.row(found - implied.begin());
    const Mat share = carrying_.share.topRows(Index(basis.size()));
    return follows.dot(F_(basis)) / (1 + follows.dot(share * follows));
  }

  const std::vector<ContactPoint>& points_;
  const Mat& A_;
  const Vec& b_;
  Vec& F_;
  Vec a_;
  std::vector<ContactRole> roles_;
  CarryingRows carrying_;
  bool as_springs_ = true;           // where sliding contacts share
  bool other_forces_exist_ = false;  // contacts could carry otherwise
};

}  // namespace

bool make_exact(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double nearby, Vec& F, Vec& a) {
  Vec exact = F;
  ExactModes modes(points, A, b, a, nearby, exact);
  if (!modes.solve()) return false;
  F = exact;
  a = modes.accelerations();
  return true;
}

}  // namespace trammel::complementarity
