// Two markers at a constant distance L, planar or spatial, to change:
//
//     g = (d . d - L^2)/2,   d = x_B - x_A
//     g_dot = d . (v_B - v_A),   g_ddot = d . (a_B - a_A) + |v_B - v_A|^2
//
// so H_A = -d^T, H_B = d^T on the linear velocities, and gamma = -|v_B - v_A|^2.
#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct MyJoint final : Joint {
  double length = 1;

  int row_count(Space) const override { return 1; }

  void rows(double, const Motion& A, const Motion& B, Rows& r) const override {
    const auto n = A.x.size();
    const Vec3 d = B.x - A.x, u = B.V.head(n) - A.V.head(n);
    r.g(0) = (d.squaredNorm() - length * length) / 2;
    r.H_A.row(0).head(n) = -d.transpose();
    r.H_B.row(0).head(n) = d.transpose();
    r.gamma(0) = -u.squaredNorm();
  }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<MyJoint>("my_joint", "two markers at a constant distance, to change")
                   .source("any text on multibody dynamics")
                   .parameter("length", &MyJoint::length,
                              {.unit = "m", .min = 0, .above_min = true, .doc = "between the markers"}))
