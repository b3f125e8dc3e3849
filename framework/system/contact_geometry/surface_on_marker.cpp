// The points of a surface against a sphere around a marker (pressing_sphere.hpp), or against the plane that a marker
// carries (pressing_plane.hpp): F = F(x_p, v_p, marker) at each point with a negative gap,
//
//     Q = sum R_p^T (+-F_p),   wrench on the marker = sum w(F_p),   S += c_k K + c_d D,   K = -dQ/dq, D = -dQ/dv
//
// R_p: shape functions of the surface's nodes at p. The sign is - under a sphere, where F acts on the sphere, and + on
// a plane. K is the derivative at constant velocities; the change of the marker's J^T is added elsewhere.
#include <algorithm>
#include <limits>

#include "system/contact_geometry/pressing_plane.hpp"
#include "system/contact_geometry/pressing_sphere.hpp"
#include "system/contact_geometry/surface_contact.hpp"
#include "system/contact_geometry/surface_points.hpp"

namespace trammel::model {

namespace {

using V3 = Eigen::Vector3d;
using Change = MarkerPointChange;

template <class Partner>
class SurfaceOnMarker final : public SurfaceContact {
 public:
  SurfaceOnMarker(const Model& model, const ContactEntry& entry, MarkerMotions& markers)
      : SurfaceContact(entry),
        markers_(markers),
        points_(model.bodies[std::size_t(entry.surface->body)], *entry.surface->by_points,
                Partner::marker_is_A ? entry.geometry.radius : std::numeric_limits<double>::infinity()),
        pressure_(entry),
        marker_(markers.slot(Partner::marker_is_A ? entry.A : entry.B)),
        surface_(markers.surface_slot(entry.surface->body)) {}

  std::vector<int> slots() const override {
    return Partner::marker_is_A ? std::vector{marker_, surface_} : std::vector{surface_, marker_};
  }

  void rows(const Point& point, Rows& rows) override {
    const Motion& marker = markers_.motion(marker_, point.t, point.q, point.v);
    if constexpr (Partner::marker_is_A) {
      surface_row(entry_.geometry.radius + points_.half_thickness(), marker,
                  markers_.nearest(surface_, marker.x, point.t, point.q, point.v), rows);
    } else {
      PointOnPlane sheet = entry_.geometry;
      sheet.radius = points_.half_thickness();
      contact_rows(sheet, deepest(point, partner(point)), marker, false, rows);
    }
  }

  void press(const Point& point, double approach_speed) override {
    const Partner other = partner(point);
    touches_.clear();
    approach_ = approach_speed;
    sums_ = {};
    on_marker_.setZero(6);
    V3 low, high;
    for (std::size_t i = 0; i < points_.patches(); ++i) {
      points_.bounds(i, point.q, low, high);
      if (other.gap_to_box(low, high) >= 0) continue;
      const SurfacePatch& patch = points_.patch(i);
      const auto x = points_.positions(patch, point.q);
      SurfacePoints::Points v;
      for (Eigen::Index k = 0; k < x.rows(); ++k) {
        Touch touch{i, k, x.row(k), V3::Zero(), {}};
        if (other.gap(touch.x) >= 0) continue;
        if (v.size() == 0) v = points_.velocities(patch, point.v);
        touch.v = v.row(k);
        other.look(touch.x, touch.v, touch.at);
        pressure_.ask(touch.at, patch.area(k), approach_, sums_);
        on_marker_ += other.on_marker(touch.at, touch.x);
        touches_.push_back(touch);
      }
    }
  }

  const PressureSums& sums() const override { return sums_; }
  std::optional<OnMarker> on_marker() const override { return OnMarker{marker_, on_marker_}; }

  void add_force(Vec& f) const override {
    markers_.add_wrench(marker_, on_marker_, 1, f);
    by_patch([&](const SurfacePatch& patch, auto first, auto last) {
      SurfacePoints::OnNodes nodes = SurfacePoints::OnNodes::Zero(3, patch.R.cols());
      for (auto touch = first; touch != last; ++touch)
        nodes.noalias() += sign() * touch->at.F * patch.R.row(touch->point);
      points_.add_force(patch, nodes, f);
    });
  }

  void add_tangent(const Point& point, double c_k, double c_d, Matrix& S) override {
    const Partner other = partner(point);
    const Motion& marker = markers_.last_motion(marker_);
    const bool marker_moves = markers_.body(marker_) >= 0;
    Mat6 on_itself = Mat6::Zero(6, 6);
    Change by;
    by_patch([&](const SurfacePatch& patch, auto first, auto last) {
      const Eigen::Index nodes = patch.R.cols();
      Mat square = Mat::Zero(3 * nodes, 3 * nodes), by_marker = Mat::Zero(3 * nodes, 6),
          on_the_marker = Mat::Zero(6, 3 * nodes);
      for (auto touch = first; touch != last; ++touch) {
        M39 point_by = M39::Zero();
        M69 marker_by = M69::Zero();
        const auto add = [&](double c, bool moves) {
          const M39 F = pressure_.change(touch->at, approach_, by);
          point_by -= c * sign() * F;
          marker_by -= c * other.change_on_marker(touch->at, touch->x, F, by, moves);
        };
        if (c_k != 0) other.by_position(touch->at, touch->x, touch->v, by), add(c_k, true);
        if (c_d != 0) other.by_velocity(touch->at, touch->x, by), add(c_d, false);
        const auto R = patch.R.row(touch->point);
        on_itself += marker_by.rightCols<6>();
        for (Eigen::Index J = 0; J < nodes; ++J) {
          for (Eigen::Index I = 0; I < nodes; ++I)
            square.block<3, 3>(3 * I, 3 * J) += R(I) * R(J) * point_by.leftCols<3>();
          if (!marker_moves) continue;
          by_marker.middleRows<3>(3 * J) += R(J) * point_by.rightCols<6>();
          on_the_marker.middleCols<3>(3 * J) += R(J) * marker_by.leftCols<3>();
        }
      }
      points_.add_square(patch, square, S);
      if (!marker_moves) return;
      const int v0 = markers_.first_velocity(marker_);
      points_.add_columns(patch, marker.J.transpose() * on_the_marker, v0, marker.dofs, S);
      points_.add_rows(patch, by_marker * marker.J, v0, marker.dofs, S);
    });
    markers_.add_pair(marker_, marker_, on_itself, 1, S);
    if (c_k != 0) markers_.add_reaction_derivative(marker_, point.t, point.q, -on_marker_, c_k, S);
  }

  void raise_pressure(int body, std::vector<double>& of_patch) const override {
    if (body != entry_.surface->body) return;
    for (const Touch& touch : touches_) {
      const double area = points_.sampled(touch.patch).area(touch.point);
      of_patch[touch.patch] = std::max(of_patch[touch.patch], touch.at.weight * touch.at.N / area);
    }
  }

  double all_behind(const Point& point) override {
    if (Partner::marker_is_A) return -1;
    const Partner other = partner(point);
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points_.patches(); ++i) {
      const auto x = points_.positions(points_.patch(i), point.q);
      for (Eigen::Index k = 0; k < x.rows(); ++k)
        highest = std::max(highest, other.gap(x.row(k)) + 2 * points_.half_thickness());
    }
    return -highest;
  }

 private:
  struct Touch {
    std::size_t patch;
    Eigen::Index point;
    V3 x, v;
    PressedPoint at;
  };

  static constexpr double sign() { return Partner::marker_is_A ? -1 : 1; }  // of F on a point
  Partner partner(const Point& point) {
    return {entry_.geometry, markers_.motion(marker_, point.t, point.q, point.v), points_.half_thickness()};
  }

  // Calls f(patch, first touch, one past the last) for each patch with touches.
  template <class F>
  void by_patch(F&& f) const {
    for (auto first = touches_.begin(); first != touches_.end();) {
      const auto last = std::find_if(first, touches_.end(), [&](const Touch& t) { return t.patch != first->patch; });
      f(points_.sampled(first->patch), first, last);
      first = last;
    }
  }

  // The motion of the point with the least gap.
  const Motion& deepest(const Point& point, const Partner& other) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t patch = 0;
    Eigen::Index which = 0;
    V3 low, high;
    for (std::size_t i = 0; i < points_.patches(); ++i) {
      points_.bounds(i, point.q, low, high);
      if (other.gap_to_box(low, high) >= least) continue;
      const auto x = points_.positions(points_.patch(i), point.q);
      for (Eigen::Index k = 0; k < x.rows(); ++k)
        if (const double gap = other.gap(x.row(k)); gap < least) least = gap, patch = i, which = k;
    }
    Motion& motion = markers_.surface_motion(surface_);
    points_.motion(points_.patch(patch), which, point.q, point.v, motion);
    return motion;
  }

  MarkerMotions& markers_;
  SurfacePoints points_;
  PointPressure pressure_;
  int marker_, surface_;
  std::vector<Touch> touches_;
  PressureSums sums_;
  double approach_ = 0;
  Wrench on_marker_ = Wrench::Zero(6);
};

}  // namespace

std::unique_ptr<ContactGeometry> surface_on_marker(const Model& model, const ContactEntry& entry,
                                                   MarkerMotions& markers) {
  if (entry.surface->against == SurfaceSide::Against::sphere)
    return std::make_unique<SurfaceOnMarker<PressingSphere>>(model, entry, markers);
  return std::make_unique<SurfaceOnMarker<PressingPlane>>(model, entry, markers);
}

}  // namespace trammel::model
