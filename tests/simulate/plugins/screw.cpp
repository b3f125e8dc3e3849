// The row of a screw, beside a cylindrical joint: B slides along A's axis n by the lead p for each turn, in space.
//
//     g = n . d - p/(2 pi) psi,    d = x_B - x_A,    psi [rad] the angle of B against A about n, over whole turns
//     g' = n . d' + (n x d)... = n . (V_B - V_A) + omega_A . (n x d) - p/(2 pi) h . (omega_B - omega_A)
//
// h, the gradient of psi, is n while the cylindrical joint holds, which is where gamma is right.
#include <numbers>

#include <trammel/axis_angle.hpp>
#include <trammel/counts_turns.hpp>
#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Screw final : Joint, CountsTurns {
  double lead = 0;

  void prepare(const World&) override { angle_ = AxisAngle(Eigen::Vector3d::UnitZ()); }
  int row_count(Space) const override { return 1; }
  void follow(const Motion& A, const Motion& B) override { turns_.follow(angle_.angle(A, B)); }
  void archive(Archive& a) override { turns_.archive(a); }

  void rows(double, const Motion& A, const Motion& B, Rows& r) const override {
    const double p = lead / (2 * std::numbers::pi);
    const Eigen::Vector3d n = A.R.col(2), d = B.x - A.x, h = angle_.gradient(A, B);
    const Eigen::Vector3d omega_A = A.V.tail(3), omega_B = B.V.tail(3), n_dot = omega_A.cross(n);
    r.g(0) = n.dot(d) - p * turns_.near_last(angle_.angle(A, B));
    r.H_A.row(0) << -n.transpose(), (n.cross(d) + p * h).transpose();
    r.H_B.row(0) << n.transpose(), -p * h.transpose();
    r.gamma(0) = -omega_A.cross(n_dot).dot(d) - 2 * n_dot.dot(Eigen::Vector3d(B.V.head(3) - A.V.head(3))) +
                 p * n_dot.dot(omega_B - omega_A);
  }

 private:
  AxisAngle angle_;
  CountedAngle turns_;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::joint<Screw>("screw", "for tests: a joint that counts turns")
                   .parameter("lead", &Screw::lead, {.unit = "m", .doc = "advance in a turn"}))
