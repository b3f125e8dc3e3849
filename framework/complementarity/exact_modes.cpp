#include "complementarity/exact_modes.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "complementarity/admissible_forces.hpp"

namespace trammel::complementarity {
namespace {

using Tangent = ContactRole::Tangent;
using Eigen::Index;

constexpr double round_off = 1e-12;  // of the forces and of the accelerations
// Of a row's own stiffness: less is none, as at Painleve's critical coefficient.
constexpr double singular = 1e-12;

Eigen::Vector2d part(const Vec& x, const ContactPoint& p) {
  Eigen::Vector2d both = Eigen::Vector2d::Zero();
  both.head(p.tangents) = x.segment(p.tangent, p.tangents);
  return both;
}

}  // namespace

std::vector<ContactRole> roles_of(const std::vector<ContactPoint>& points, const Vec& F, const Vec& a, double nothing) {
  std::vector<ContactRole> roles;
  const double no_force = round_off * F.lpNorm<Eigen::Infinity>();
  for (const ContactPoint& p : points) {
    ContactRole& role = roles.emplace_back();
    const double N = p.normal >= 0 ? F[p.normal] : p.given;
    role.closed = p.normal < 0 || N > no_force || a[p.normal] <= nothing;
    if (!role.closed) continue;
    if (p.slides()) role.tangent = Tangent::slides, role.ratio = p.ratio;
    if (!p.held()) continue;
    const Eigen::Vector2d a_t = part(a, p);
    const bool moves = a_t.norm() > nothing;
    role.tangent = moves ? Tangent::slides : Tangent::sticks;
    // A force near its bound has the direction with more digits.
    const bool bound = N > no_force && part(F, p).norm() > 0.5 * p.coefficient * N;
    if (moves) role.ratio = p.coefficient * (bound ? part(F, p) : Eigen::Vector2d(-a_t)).normalized();
  }
  return roles;
}

namespace {

class ExactModes {
 public:
  ExactModes(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double nearby, Vec& F)
      : points_(points), A_(A), b_(b), F_(F) {
    a_ = A * F + b;
    roles_ = roles_of(points, F, a_, nearby * acceleration_scale());
  }

  bool solve() {
    if (!settle_modes()) return false;
    share_by_accelerations();
    return true;
  }

 private:
  // Forces and modes that do not contradict each other. False: it found none.
  bool settle_modes() {
    const int most = 6 * int(points_.size()) + 20;
    for (int i = 0; i < most; ++i) {
      if (!find_forces()) return false;
      if (!change_worst()) return true;
    }
    return false;
  }

  // How contacts share must not depend on the modes that were tried on the way: once more from those that the accelerations show,
  // with all contacts closed that do not part and all tangents sticking that do not move.
  void share_by_accelerations() {
    const std::vector<ContactRole> on_the_way = roles_;
    roles_ = roles_of(points_, F_, a_, round_off * acceleration_scale());
    const auto same = [](const ContactRole& x, const ContactRole& y) {
      return x.closed == y.closed && x.idle == y.idle && x.tangent == y.tangent;
    };
    if (std::equal(roles_.begin(), roles_.end(), on_the_way.begin(), same)) return;
    const Vec F = F_, a = a_;
    const double nothing = largest_violation * acceleration_scale();
    if (!settle_modes() || !((a_ - a).lpNorm<Eigen::Infinity>() <= nothing)) F_ = F, a_ = a;
  }

  double acceleration_scale() const {
    if (b_.size() == 0) return 0;
    return b_.lpNorm<Eigen::Infinity>() + (A_.cwiseAbs() * F_.cwiseAbs()).maxCoeff();
  }

  // A_R F + b_R = 0 for the resultants.
  bool find_forces() {
    carrying_ = carrying_rows(points_, A_, roles_);
    const auto& [basis, implied, K] = carrying_.rows;
    const Index n = Index(basis.size());
    Mat along = Mat::Zero(b_.size(), n + K.rows());  // F by the forces along rows
    for (Index k = 0; k < n + K.rows(); ++k) along(row_at(k), k) = 1;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const ContactPoint& p = points_[i];
      if (roles_[i].tangent != Tangent::slides || !roles_[i].closed) continue;
      if (p.normal < 0) continue;
      for (Index k = 0; k < n + K.rows(); ++k)
        if (row_at(k) == p.normal) along.col(k).segment(p.tangent, p.tangents) += roles_[i].ratio.head(p.tangents);
    }
    Vec given = Vec::Zero(b_.size());  // that slide under a given force
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (const ContactPoint& p = points_[i]; p.normal < 0 && p.held() && roles_[i].tangent == Tangent::slides)
        given.segment(p.tangent, p.tangents) = p.given * roles_[i].ratio.head(p.tangents);
    F_ = given;
    if (n > 0) {
      const Mat X = (A_ * along * carrying_.share)(basis, Eigen::all);
      const Vec scale =
          A_.diagonal()(basis).unaryExpr([](double x) { return std::exp2(-std::round(std::log2(x) / 2)); });
      const Eigen::FullPivLU<Mat> lu(scale.asDiagonal() * X * scale.asDiagonal());
      if (!(std::abs(lu.matrixLU()(n - 1, n - 1)) > singular)) return false;
      lambda_ = scale.cwiseProduct(lu.solve(-scale.cwiseProduct((b_ + A_ * given)(basis))));
      if (!lambda_.allFinite()) return false;
      F_ += along * (carrying_.share * lambda_);
    }
    a_ = A_ * F_ + b_;
    share_admissibly();
    return F_.allFinite();
  }

  Index row_at(Index k) const {
    const auto& [basis, implied, K] = carrying_.rows;
    const auto i = std::size_t(k);
    return i < basis.size() ? basis[i] : implied[i - basis.size()];
  }

  double normal_force(std::size_t i) const { return points_[i].normal >= 0 ? F_[points_[i].normal] : points_[i].given; }
  double beyond_cone(std::size_t i) const {
    return part(F_, points_[i]).norm() - points_[i].coefficient * std::max(0.0, normal_force(i));
  }

  // Those that do not slide may share otherwise: their resultants alone matter.
  void share_admissibly() {
    const double little = round_off * F_.lpNorm<Eigen::Infinity>();
    bool wanted = false;
    std::vector<SharingContact> sharing;
    std::vector<Index> columns;
    const Mat E = carrying_.rows.resultants();
    const auto column_of = [&](int row) -> Index {
      for (Index k = 0; k < E.cols(); ++k)
        if (row_at(k) == row) {
          columns.push_back(k);
          return Index(columns.size()) - 1;
        }
      return -1;
    };
    std::vector<std::size_t> who;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const ContactPoint& p = points_[i];
      const ContactRole& role = roles_[i];
      if (!carrying_.indeterminate[i] || !role.closed || role.idle) continue;
      if (role.tangent == Tangent::slides) continue;
      SharingContact& c = sharing.emplace_back();
      who.push_back(i);
      c.given = p.given, c.coefficient = p.coefficient;
      if (p.normal >= 0) c.normal = column_of(p.normal);
      for (int k = 0; k < p.tangents && role.tangent == Tangent::sticks; ++k)
        c.tangents.push_back(column_of(p.tangent + k));
      wanted = wanted || normal_force(i) < -little || (!c.tangents.empty() && beyond_cone(i) > little);
    }
    if (!wanted) return;
    const Mat E_sharing = E(Eigen::all, columns);
    Vec now(E_sharing.cols()), shared;
    for (std::size_t k = 0; k < columns.size(); ++k) now[Index(k)] = F_[row_at(columns[k])];
    const Vec resultants = E_sharing * now;
    const double missed = admissible_forces(sharing, E_sharing, resultants, shared);
    if (!(missed <= round_off * resultants.norm())) return;
    for (std::size_t k = 0; k < columns.size(); ++k) F_[row_at(columns[k])] = shared[Index(k)];
    a_ = A_ * F_ + b_;
  }

  // The mode that is contradicted most, by a share of all forces or accelerations. False: none is.
  bool change_worst() {
    const double forces = F_.lpNorm<Eigen::Infinity>(), accelerations = acceleration_scale();
    double worst = round_off;
    std::size_t who = points_.size();
    ContactRole wanted;
    const auto consider = [&](std::size_t i, double amount, double scale, auto&& change) {
      if (!(amount > worst * scale)) return;
      worst = amount / scale;
      who = i;
      wanted = roles_[i];
      change(wanted);
    };
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const ContactPoint& p = points_[i];
      const ContactRole& role = roles_[i];
      if (!role.closed) {
        consider(i, -a_[p.normal], accelerations, [&](ContactRole& r) { close(i, r); });
        continue;
      }
      if (role.idle) {
        consider(i, spring_force(p.normal), forces, [](ContactRole& r) { r.idle = false; });
        continue;
      }
      if (p.normal >= 0)
        consider(i, -F_[p.normal], forces, [&](ContactRole& r) {
          if (carrying_.indeterminate[i] && carrying_.sliding_shares)
            r.idle = true;
          else
            r.closed = false;
          if (r.tangent == Tangent::sticks) r.tangent = Tangent::none;
        });
      if (!p.held()) continue;
      if (role.tangent == Tangent::sticks)
        consider(i, beyond_cone(i), forces, [&](ContactRole& r) {
          r.tangent = Tangent::slides;
          r.ratio = p.coefficient * part(F_, p).normalized();
        });
      if (role.tangent == Tangent::slides && normal_force(i) > 0)
        consider(i, part(a_, p).dot(role.ratio.normalized()), accelerations,
                 [](ContactRole& r) { r.tangent = Tangent::sticks; });
    }
    if (who == points_.size()) return false;
    roles_[who] = wanted;
    return true;
  }

  void close(std::size_t i, ContactRole& role) const {
    const ContactPoint& p = points_[i];
    role.closed = true;
    role.idle = false;
    role.tangent = p.slides() ? Tangent::slides : p.held() ? Tangent::sticks : Tangent::none;
    if (p.slides()) role.ratio = p.ratio;
  }

  // What an idle contact would carry as a spring among those that carry: K times the forces along the basis.
  double spring_force(int row) const {
    const auto& [basis, implied, K] = carrying_.rows;
    const auto found = std::find(implied.begin(), implied.end(), Index(row));
    if (found == implied.end()) return 0;
    return K.row(found - implied.begin()).dot(F_(basis));
  }

  const std::vector<ContactPoint>& points_;
  const Mat& A_;
  const Vec& b_;
  Vec& F_;
  Vec a_, lambda_;
  std::vector<ContactRole> roles_;
  CarryingRows carrying_;
};

}  // namespace

bool make_exact(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double nearby, Vec& F) {
  Vec exact = F;
  if (!ExactModes(points, A, b, nearby, exact).solve()) return false;
  F = exact;
  return true;
}

}  // namespace trammel::complementarity
