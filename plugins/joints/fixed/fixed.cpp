// A planar weld: the two markers keep one place and one relative angle.
//
//     g = (x_B - x_A,  theta_B - theta_A - angle) = 0   (3 rows)
//
// The angle may be a law of time, which makes the weld an ideal rotary drive. lambda [N, N, N m], world axes.
#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Fixed : Joint {
  TimeFunction angle;

  void prepare(const World& world) override {
    if (world.space != Space::planar)
      throw ParameterError("type", "fixed is planar; this scene is spatial. Set \"space\": \"planar\"");
  }
  int row_count(Space) const override { return 3; }

  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const override {
    const TimeFunction::Jet offset = angle.jet(t);
    rows.g << B.x - A.x, B.angle - A.angle - offset.value;
    rows.H_A = -Eigen::Matrix3d::Identity();
    rows.H_B = Eigen::Matrix3d::Identity();
    rows.g_t(2) = -offset.rate;
    rows.gamma(2) = offset.second;
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<Fixed>("fixed", "planar weld: two markers share one point and one orientation")
        .source("A. A. Shabana, Dynamics of Multibody Systems: rigid joint")
        .parameter("angle", &Fixed::angle,
                   {.unit = "rad", .doc = "of B's frame against A's; a number or a law of t", .derivatives = 2}))
