// The contract of a body's markers, checked along the path t + s, q (+) s v, where v' = 0:
//
//     dx/ds = V, dR/ds R^T = (omega x);   V = J v + V_t;   dV/ds = bias
//     d(J^T F)/dq = the reaction's exact derivative
#include <Eigen/Geometry>
#include <set>

#include <trammel/linear_rows.hpp>

#include "testing/body_under_test.hpp"

namespace trammel {
namespace {

Report markers_are_whole(const TriedBody& b) {
  return compare("markers have names, sizes of one space, and rotations for R", [&](Comparison& c) {
    const auto names = b.body->markers();
    c.holds(std::set<std::string>(names.begin(), names.end()).size() == names.size(), "two markers of one name");
    b.for_each_marker([&](std::size_t i, const BodyAt& at, const std::string& where) {
      const Motion m = b.motion(i, at);
      const Eigen::Index n = m.x.size(), twist = n == 2 ? 3 : 6;
      const auto dofs = Eigen::Index(m.dofs.size());
      const bool sizes = (n == 2 || n == 3) && m.R.rows() == n && m.R.cols() == n && m.V.size() == twist &&
                         m.bias.size() == twist && m.J.rows() == twist && m.J.cols() == dofs;
      c.holds(sizes, where + ": x, R, V, bias, dofs and J do not fit each other");
      const std::set<int> distinct(m.dofs.begin(), m.dofs.end());
      const bool own = distinct.empty() || (*distinct.begin() >= 0 && *distinct.rbegin() < b.nv);
      c.holds(own && distinct.size() == m.dofs.size(), where + ": dofs are not distinct coordinates of the body");
      if (!sizes) return;
      c.within(m.R.transpose() * m.R, Mat::Identity(n, n), 1e-13, where + ": R^T R");
      c.holds(Mat(m.R).determinant() > 0, where + ": R is a reflection");
      if (n == 2) c.within(m.R.col(0), Eigen::Vector2d(std::cos(m.angle), std::sin(m.angle)), 1e-13, where + ": R e_x");
    });
  });
}

Report motion_is_filled_whole(const TriedBody& b) {
  return compare("motion() into a used object gives what a fresh one gets", [&](Comparison& c) {
    const BodyAt elsewhere = b.start();
    const bool shared = dynamic_cast<const SharedMotion*>(b.body.get()) != nullptr;
    b.for_each_marker([&](std::size_t i, const BodyAt& at, const std::string& where) {
      const Motion fresh = b.motion(i, at);
      Motion used = b.motion(shared ? (i + 1) % b.body->markers().size() : i, elsewhere);
      b.body->motion(int(i), at.t, at.q, at.v, used);
      c.within(used.x, fresh.x, 0, where + ": x");
      c.within(used.R, fresh.R, 0, where + ": R");
      c.within(used.V, fresh.V, 0, where + ": V");
      c.within(used.bias, fresh.bias, 0, where + ": bias");
      c.within(used.J, fresh.J, 0, where + ": J");
      c.holds(used.dofs == fresh.dofs, where + ": dofs");
    });
  });
}

// x and the angle, or x and the rotation vector from `base`.
Vec pose(const Motion& m, const Motion& base) {
  Vec p(m.V.size());
  if (m.x.size() == 2)
    p << m.x, m.angle;
  else {
    const Eigen::AngleAxisd turn{Eigen::Matrix3d(m.R * base.R.transpose())};
    p << m.x, turn.angle() * turn.axis();
  }
  return p;
}

Report velocity_is_the_rate_of_the_pose(const TriedBody& b) {
  return compare("a marker's V is the rate of its pose", [&](Comparison& c) {
    const Vec a = Vec::Zero(b.nv);
    b.for_each_marker([&](std::size_t i, const BodyAt& at, const std::string& where) {
      const Motion m = b.motion(i, at);
      c.derivative(m.V,
                   difference([&](double s) { return pose(b.motion(i, b.along(at, a, s)), m); }, b.path_step(at, a)),
                   where + ": V");
    });
  });
}

Report jacobian_is_that_of_the_velocity(const TriedBody& b) {
  return compare("a marker's V changes with v by J", [&](Comparison& c) {
    b.for_each_marker([&](std::size_t i, const BodyAt& at, const std::string& where) {
      const Motion m = b.motion(i, at);
      const Vec V_t = b.motion(i, {at.t, at.q, Vec::Zero(b.nv)}).V, own = b.of_dofs(m, at.v);
      const double size = m.V.norm() + V_t.norm() + (m.J.cwiseAbs() * own.cwiseAbs()).norm();
      c.within(m.V, V_t + m.J * own, 1e-14 * size, where + ": V");  // linear in v: round-off only
      for (Eigen::Index k = 0; k < own.size(); ++k) {
        const Vec one = b.motion(i, {at.t, at.q, Vec::Unit(b.nv, m.dofs[std::size_t(k)])}).V;
        c.within(one - V_t, m.J.col(k), 1e-14 * (one.norm() + V_t.norm()),
                 fmt::format("{}: J by dof {}", where, m.dofs[std::size_t(k)]));
      }
    });
  });
}

Report bias_is_the_rest_of_the_acceleration(const TriedBody& b) {
  return compare("a marker's V changes in time, at v' = 0, by its bias", [&](Comparison& c) {
    const Vec a = Vec::Zero(b.nv);
    b.for_each_marker([&](std::size_t i, const BodyAt& at, const std::string& where) {
      const auto V = [&](double s) { return Vec(b.motion(i, b.along(at, a, s)).V); };
      c.derivative(b.motion(i, at).bias, difference(V, b.path_step(at, a)), where + ": bias");
    });
  });
}

Report reaction_derivative_is_exact(const TriedBody& b) {
  return compare("add_reaction_derivative adds c d(J^T F)/dq, where it is offered", [&](Comparison& c) {
    const auto* offered = dynamic_cast<const ReactionDerivative*>(b.body.get());
    if (!offered) return;
    b.for_each_marker([&](std::size_t i, const BodyAt& at, const std::string& where) {
      const Wrench F = Vec::LinSpaced(b.motion(i, at).V.size(), 1, -0.7);
      Mat S = Mat::Zero(b.nv, b.nv);
      Matrix into = Matrix::onto(S);
      offered->add_reaction_derivative(int(i), at.t, at.q, F, 2, into);
      const auto generalised = [&](const BodyAt& x) {
        const Motion m = b.motion(i, x);
        Vec Q = Vec::Zero(b.nv);
        const Vec own = m.J.transpose() * F;
        for (std::size_t k = 0; k < m.dofs.size(); ++k) Q(m.dofs[k]) += own(Eigen::Index(k));
        return Q;
      };
      b.for_each_direction(at, generalised, true, [&](Eigen::Index j, const Difference& d) {
        c.derivative(S.col(j) / 2, d, fmt::format("{}, column {}", where, j));
      });
    });
  });
}

Report motion_is_linear_if_claimed(const TriedBody& b) {
  return compare("x = x_0 + J q with constant J and axes, where LinearMarkers says so", [&](Comparison& c) {
    if (!dynamic_cast<const LinearMarkers*>(b.body.get())) return;
    const BodyAt zero{0, Vec::Zero(b.start().q.size()), Vec::Zero(b.nv)};
    b.for_each_marker([&](std::size_t i, const BodyAt& at, const std::string& where) {
      const Motion m = b.motion(i, at), m_0 = b.motion(i, zero);
      c.within(m.J, m_0.J, 0, where + ": J");
      c.within(m.R, m_0.R, 0, where + ": R");
      c.within(m.bias, Vec::Zero(m.bias.size()), 0, where + ": bias");
      if (m.dofs != m_0.dofs || m.J.cols() != m_0.J.cols()) return c.holds(false, where + ": other dofs");
      const Vec own = b.of_dofs(m, at.q), own_v = b.of_dofs(m, at.v);
      const auto n = m.x.size();
      const double size = m.x.norm() + m_0.x.norm() + (m.J.cwiseAbs() * own.cwiseAbs()).norm();
      c.within(m.x, m_0.x + (m.J * own).head(n), 1e-14 * size, where + ": x");
      c.within(m.V, m.J * own_v, 1e-14 * (m.J.cwiseAbs() * own_v.cwiseAbs()).norm(), where + ": V");
    });
  });
}

}  // namespace

std::vector<std::pair<const char*, Report (*)(const TriedBody&)>> marker_looks() {
  return {{"MarkersAreWhole", markers_are_whole},
          {"MotionIsFilledWhole", motion_is_filled_whole},
          {"VelocityIsTheRateOfThePose", velocity_is_the_rate_of_the_pose},
          {"JacobianIsThatOfTheVelocity", jacobian_is_that_of_the_velocity},
          {"BiasIsTheRestOfTheAcceleration", bias_is_the_rest_of_the_acceleration},
          {"ReactionDerivativeIsExact", reaction_derivative_is_exact},
          {"MotionIsLinearIfClaimed", motion_is_linear_if_claimed}};
}

}  // namespace trammel
