// A planar slider: marker B moves along a line fixed in marker A's frame and does not turn against A.
//
//     g_1 = n . d                              d = x_B - x_A;  s = R_A axis, n = s turned by +90 degrees
//     g_2 = theta_B - theta_A - angle          the offset may be a law of time
//
// With omega of A, n' = -omega s and s' = omega n, hence
//     g_1'  = n . d' - omega s . d
//     g_1'' = n . d'' - alpha s . d - 2 omega s . d' - omega^2 n . d
// lambda_1 [N] presses across the guide, lambda_2 [N m] holds the angle.
#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;
using Eigen::Vector2d;

struct Prismatic : Joint {
  std::optional<Vec3> axis;  // left out: x
  TimeFunction angle;

  void prepare(const World& world) override {
    if (world.space != Space::planar)
      throw ParameterError("type", "prismatic is planar; this scene is spatial. Set \"space\": \"planar\"");
    axis_ = axis.value_or(Vector2d::UnitX());
    const double length = axis_.stableNorm();
    if (!(length > 0))
      throw ParameterError("axis", "the axis is zero; expected a direction in marker A's axes, e.g. [1, 0]");
    axis_ /= length;
  }
  int row_count(Space) const override { return 2; }

  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const override {
    const Vector2d s = A.R * axis_;
    const Vector2d n(-s.y(), s.x());
    const Vector2d d = B.x - A.x;
    const Vector2d d_dot = B.V.head<2>() - A.V.head<2>();
    const double omega = A.V(2);
    const TimeFunction::Jet offset = angle.jet(t);

    rows.g << n.dot(d), B.angle - A.angle - offset.value;
    rows.H_A.row(0) << -n.transpose(), -s.dot(d);
    rows.H_B.row(0) << n.transpose(), 0;
    rows.H_A(1, 2) = -1;
    rows.H_B(1, 2) = 1;
    rows.g_t(1) = -offset.rate;
    rows.gamma << omega * (2 * s.dot(d_dot) + omega * n.dot(d)), offset.second;
  }

 private:
  Vector2d axis_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<Prismatic>("prismatic", "planar slider: B moves along an axis of A and does not turn against it")
        .source("A. A. Shabana, Dynamics of Multibody Systems: prismatic joint")
        .parameter("axis", &Prismatic::axis,
                   {.doc = "direction of sliding in marker A's axes, any length; [1, 0] if left out"})
        .parameter("angle", &Prismatic::angle,
                   {.unit = "rad", .doc = "of B's frame against A's; a number or a law of t", .derivatives = 2}))
