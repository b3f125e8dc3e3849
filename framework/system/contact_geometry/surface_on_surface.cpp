// The points of a surface A against another surface B, each against the point of B that is nearest to it.
//
//     d = x - y(xi),  d . y_a = 0 (a = u, v),  l = |d|,  n = d/l,   gap = l - h_A/2 - h_B/2
//     u = v_x - J v_B,   s = u - (n . u) n,    F on x, -F on y: Q_A = R^T F,  Q_B = -J^T F
//
// so that contact acts on both faces of either sheet, and all forces of a pair sum to 0. The nearest point moves along
// B; at B's edge its u or v is constant. With dx and the change z of B's coordinates
//
//     H dxi = [y_a . (dx - J z) + d . J_a z],  H_ab = y_a . y_b - d . y_ab
//     dgap = n . (dx - J z),   dn = P/l (dx - J z - y_a dxi_a),   du = -J_a v_B dxi_a
//     drate = dn . u + n . du,  ds = du - drate n - (n . u) dn,   dQ_B = -J^T dF - J_a^T F dxi_a
//
// Angular momentum is conserved if F is along n; friction acts at two points with the distance h_A/2 + h_B/2.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "system/contact_geometry/surface_contact.hpp"
#include "system/contact_geometry/surface_points.hpp"

namespace trammel::model {

namespace {

using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix3d;
using SurfacePointChange = PointChange<Eigen::Dynamic>;
using Along = Eigen::Matrix<double, 2, Eigen::Dynamic>;  // dxi per change of some variables

constexpr double no_determinant = 1e-12;  // of H, relative to |r_u|^2 |r_v|^2: round-off at a centre of curvature

struct Box {
  V3 low, high;
};
// Lower and upper bound of the distance between a point of one box and the nearest point of the other.
double apart(const Box& a, const Box& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).norm();
}
double farthest(const Box& a, const Box& b) {
  return (a.high - b.low).cwiseMax(b.high - a.low).norm();
}

// The motion of the nearest point along B: derivatives by x in the first three columns, by B's coordinates in the
// others.
Along slide(const SurfaceJet& y, const V3& d) {
  const auto m = y.J.cols();
  Eigen::Matrix2d H;
  H << y.r_u.dot(y.r_u) - d.dot(y.r_uu), y.r_u.dot(y.r_v) - d.dot(y.r_uv), 0, y.r_v.dot(y.r_v) - d.dot(y.r_vv);
  H(1, 0) = H(0, 1);
  Along right(2, 3 + m);
  right << y.r_u.transpose(), d.transpose() * y.J_u - y.r_u.transpose() * y.J, y.r_v.transpose(),
      d.transpose() * y.J_v - y.r_v.transpose() * y.J;
  const V3 leaving(y.end[0] * d.dot(y.r_u), y.end[1] * d.dot(y.r_v), 0);
  for (int a = 0; a < 2; ++a)
    if (leaving(a) > 0) {
      H(0, 1) = H(1, 0) = 0;
      H(a, a) = a == 0 ? y.r_u.squaredNorm() : y.r_v.squaredNorm();
      right.row(a).setZero();
    }
  const double determinant = H.determinant();
  if (!(determinant > no_determinant * y.r_u.squaredNorm() * y.r_v.squaredNorm()))
    return Along::Zero(2, 3 + m);  // a centre of curvature
  return H.inverse() * right;
}

class SurfaceOnSurface final : public SurfaceContact {
 public:
  SurfaceOnSurface(const Model& model, const ContactEntry& entry, MarkerMotions& markers)
      : SurfaceContact(entry),
        side_(*entry.surface),
        markers_(markers),
        points_(model.bodies[std::size_t(entry.surface->body)], *entry.surface->by_points,
                std::numeric_limits<double>::infinity()),
        other_(model.bodies[std::size_t(entry.surface->other)]),
        pressure_(entry),
        reach_(points_.half_thickness() + other_.surface->half_thickness()),
        slot_A_(markers.surface_slot(entry.surface->body)),
        slot_B_(markers.surface_slot(entry.surface->other)) {}

  std::vector<int> slots() const override { return {slot_A_, slot_B_}; }

  void rows(const Point& point, Rows& rows) override {
    find_touches(point);
    Motion &A = markers_.surface_motion(slot_A_), &B = markers_.surface_motion(slot_B_);
    points_.motion(points_.patch(deepest_.patch), deepest_.point, point.q, point.v, A);
    motion_of_other(point, B);
    surface_row(reach_, A, B, rows);
  }

  void press(const Point& point, double approach_speed) override {
    find_touches(point);
    approach_ = approach_speed;
    sums_ = {};
    for (Touch& touch : touches_) {
      const SurfacePatch& patch = points_.patch(touch.patch);
      other_.sliding->jet(touch.at_B, q_of_other(point), touch.y);
      touch.v_B = Vec(Eigen::Index(touch.y.dofs.size()));
      for (std::size_t k = 0; k < touch.y.dofs.size(); ++k)
        touch.v_B(Eigen::Index(k)) = point.v(other_.v0 + touch.y.dofs[k]);
      const V3 d = touch.x - touch.y.r;
      const double l = d.norm();
      touch.u = V3(points_.velocities(patch, point.v).row(touch.point)) - touch.y.J * touch.v_B;
      PressedPoint& at = touch.at;
      at.n = d / l, at.gap = l - reach_, at.rate = at.n.dot(touch.u);
      at.slip = touch.u - at.rate * at.n;
      pressure_.ask(at, patch.area(touch.point), approach_, sums_);
    }
  }

  const PressureSums& sums() const override { return sums_; }

  void add_force(Vec& f) const override {
    for (const Touch& touch : touches_) {
      const SurfacePatch& patch = points_.sampled(touch.patch);
      points_.add_force(patch, touch.at.F * patch.R.row(touch.point), f);
      const Vec on_B = touch.y.J.transpose() * touch.at.F;
      for (std::size_t k = 0; k < touch.y.dofs.size(); ++k) f(other_.v0 + touch.y.dofs[k]) -= on_B(Eigen::Index(k));
    }
  }

  void add_tangent(const Point&, double c_k, double c_d, Matrix& S) override {
    for (const Touch& touch : touches_) {
      const SurfacePatch& patch = points_.sampled(touch.patch);
      const SurfaceJet& y = touch.y;
      const auto m = y.J.cols();
      SurfacePoints::OnNodes F = SurfacePoints::OnNodes::Zero(3, 3 + m);  // with c_k and c_d, by x and B's coordinates
      Mat on_B = Mat::Zero(m, 3 + m);
      SurfacePointChange by;
      if (c_k != 0) {
        const Along dxi = by_position(touch, by);
        const auto dF = pressure_.change(touch.at, approach_, by);
        F += c_k * dF;
        on_B -= c_k * (y.J.transpose() * dF);
        for (int a = 0; a < 2; ++a) on_B -= c_k * ((a == 0 ? y.J_u : y.J_v).transpose() * touch.at.F) * dxi.row(a);
      }
      if (c_d != 0) {
        by_velocity(touch, by);
        const auto dF = pressure_.change(touch.at, approach_, by);
        F += c_d * dF;
        on_B -= c_d * (y.J.transpose() * dF);
      }
      const auto R = patch.R.row(touch.point);
      Mat square(3 * R.size(), 3 * R.size()), by_B(3 * R.size(), m), B_by_nodes(m, 3 * R.size());
      for (Eigen::Index J = 0; J < R.size(); ++J) {
        for (Eigen::Index I = 0; I < R.size(); ++I) square.block<3, 3>(3 * I, 3 * J) = -R(I) * R(J) * F.leftCols<3>();
        by_B.middleRows<3>(3 * J) = -R(J) * F.rightCols(m);
        B_by_nodes.middleCols<3>(3 * J) = -R(J) * on_B.leftCols<3>();
      }
      points_.add_square(patch, square, S);
      points_.add_rows(patch, by_B, other_.v0, y.dofs, S);
      points_.add_columns(patch, B_by_nodes, other_.v0, y.dofs, S);
      S.from(other_.v0, other_.v0).add(y.dofs, on_B.rightCols(m), -1);
    }
  }

  void raise_pressure(int body, std::vector<double>& of_patch) const override {
    if (body != side_.body && body != side_.other) return;
    for (const Touch& touch : touches_) {
      const double p = touch.at.weight * touch.at.N / points_.sampled(touch.patch).area(touch.point);
      const std::size_t patch = body == side_.body ? touch.patch : std::size_t(touch.y.patch);
      of_patch[patch] = std::max(of_patch[patch], p);
    }
  }

 private:
  struct Touch {
    std::size_t patch = 0;
    Eigen::Index point = 0;
    V3 x = V3::Zero();
    Eigen::Vector2d at_B = Eigen::Vector2d::Zero();
    // The following are filled if the point is pressed:
    SurfaceJet y;
    V3 u = V3::Zero();
    Vec v_B;
    PressedPoint at;
  };

  Vec q_of_other(const Point& point) const { return point.q.segment(other_.q0, other_.nq); }

  // Finds the deepest point of A and all points with a negative gap, once per point of the system.
  void find_touches(const Point& point) {
    if (number_ == point.number) return;
    number_ = point.number;
    touches_.clear();
    const Vec q_B = q_of_other(point);
    bound_other(q_B);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points_.patches(); ++i) {
      Box patch;
      points_.bounds(i, point.q, patch.low, patch.high);
      choose_candidates(patch, std::max(least, reach_));
      if (candidates_.empty()) continue;
      const auto x = points_.positions(points_.patch(i), point.q);
      for (Eigen::Index k = 0; k < x.rows(); ++k) {
        Touch touch;
        touch.patch = i, touch.point = k, touch.x = x.row(k);
        if (beyond_candidates(touch.x, std::max(least, reach_))) continue;
        Vec3 y;
        other_.sliding->nearest_on(candidates_, q_B, touch.x, touch.at_B, y);
        const double distance = (touch.x - V3(y)).norm();
        if (distance < least) least = distance, deepest_ = touch;
        if (distance < reach_) touches_.push_back(touch);
      }
    }
  }

  void bound_other(const Vec& q_B) {
    boxes_.resize(std::size_t(other_.samples->patches()));
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      Vec3 low, high;
      other_.samples->bounds(int(i), q_B, low, high);
      boxes_[i] = {low, high};
    }
  }
  // B's patches that may contain the nearest point to a point in this box, if its distance is less than `within`.
  void choose_candidates(const Box& of_A, double within) {
    for (const Box& box : boxes_) within = std::min(within, farthest(of_A, box));
    candidates_.clear();
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (apart(of_A, boxes_[i]) <= within) candidates_.push_back(int(i));
  }
  bool beyond_candidates(const V3& x, double within) const {
    return std::none_of(candidates_.begin(), candidates_.end(), [&](int i) {
      return apart({x, x}, boxes_[std::size_t(i)]) < within;
    });
  }

  void motion_of_other(const Point& point, Motion& m) const {
    SurfaceJet y;
    other_.sliding->jet(deepest_.at_B, q_of_other(point), y);
    m.x = y.r;
    m.R = M3::Identity();
    m.angle = 0;
    m.dofs = y.dofs;
    m.J.setZero(6, y.J.cols());
    m.J.topRows(3) = y.J;
    m.V.setZero(6), m.bias.setZero(6);
    for (std::size_t k = 0; k < y.dofs.size(); ++k)
      m.V.head(3) += y.J.col(Eigen::Index(k)) * point.v(other_.v0 + y.dofs[k]);
  }

  // Derivatives by x in the first three columns, by B's coordinates in the others; also returns dxi.
  Along by_position(const Touch& touch, SurfacePointChange& by) const {
    const SurfaceJet& y = touch.y;
    const PressedPoint& at = touch.at;
    const V3 d = touch.x - y.r;
    SurfacePoints::OnNodes moved = of_both(y);
    by.gap = at.n.transpose() * moved;
    const Along dxi = slide(y, d);
    moved -= y.r_u * dxi.row(0) + y.r_v * dxi.row(1);
    by.n = (M3::Identity() - at.n * at.n.transpose()) / d.norm() * moved;
    const SurfacePoints::OnNodes du = -(y.J_u * touch.v_B) * dxi.row(0) - (y.J_v * touch.v_B) * dxi.row(1);
    by.rate = touch.u.transpose() * by.n + at.n.transpose() * du;
    by.slip = du - at.n * by.rate - at.rate * by.n;
    return dxi;
  }
  void by_velocity(const Touch& touch, SurfacePointChange& by) const {
    const SurfacePoints::OnNodes moved = of_both(touch.y);
    by.gap.setZero(moved.cols());
    by.n.setZero(3, moved.cols());
    by.rate = touch.at.n.transpose() * moved;
    by.slip = moved - touch.at.n * by.rate;
  }
  static SurfacePoints::OnNodes of_both(const SurfaceJet& y) {
    SurfacePoints::OnNodes moved(3, 3 + y.J.cols());
    moved << M3::Identity(), -y.J;
    return moved;
  }

  const SurfaceSide& side_;
  MarkerMotions& markers_;
  SurfacePoints points_;
  const BodyEntry& other_;
  PointPressure pressure_;
  double reach_;
  int slot_A_, slot_B_;
  long long number_ = -1;
  std::vector<Box> boxes_;       // around each patch of B
  std::vector<int> candidates_;  // indices of these patches
  Touch deepest_;
  std::vector<Touch> touches_;
  PressureSums sums_;
  double approach_ = 0;
};

}  // namespace

std::unique_ptr<ContactGeometry> surface_on_surface(const Model& model, const ContactEntry& entry,
                                                    MarkerMotions& markers) {
  return std::make_unique<SurfaceOnSurface>(model, entry, markers);
}

}  // namespace trammel::model
