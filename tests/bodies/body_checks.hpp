// What every body with flat coordinates owes the assembly, each check against differences, to be called at any state.
#pragma once

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <trammel/body.hpp>

#include "../plugins/moving_marker.hpp"

namespace trammel::test {

inline Mat mass(const Body& body, const Vec& q) {
  Mat M = Mat::Zero(body.coordinates().nv(), body.coordinates().nv());
  Matrix into = Matrix::onto(M);
  body.mass(0, q, into);
  return M;
}

inline Vec force(const Body& body, const Vec& q, const Vec& v) {
  Vec f = Vec::Zero(body.coordinates().nv());
  body.force(0, q, v, f);
  return f;
}

inline Motion motion(const Body& body, int marker, const Vec& q, const Vec& v) {
  Motion m;
  body.motion(marker, 0, q, v, m);
  return m;
}

// `values(x)` differentiated by each entry of x, one column each.
template <class F>
Mat gradient(F values, const Vec& x) {
  Mat result(values(x).size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    result.col(i) = derivative([&](double s) -> Vec { return values(x + s * Vec::Unit(x.size(), i)); }, 0);
  return result;
}

inline void expect_markers_move_as_they_say(const Body& body, const Vec& q, const Vec& v) {
  for (int i = 0; i < int(body.markers().size()); ++i) {
    const Motion m = motion(body, i, q, v);
    const auto dim = m.x.size();
    ASSERT_EQ(m.dofs.size(), std::size_t(m.J.cols()));
    Vec v_of_dofs(m.J.cols());
    for (std::size_t k = 0; k < m.dofs.size(); ++k) v_of_dofs(Eigen::Index(k)) = v(m.dofs[k]);
    EXPECT_LT((m.V - m.J * v_of_dofs).norm(), 1e-14) << "V = J v, round-off";

    // Along q + v t, where v' = 0: the pose moves with V, and V with the bias.
    const auto along = [&](double t) { return motion(body, i, q + t * v, v); };
    const Vec x_dot = derivative([&](double t) -> Vec { return along(t).x; }, 0);
    EXPECT_LT((m.V.head(dim) - x_dot).norm(), difference_error) << body.markers()[std::size_t(i)];
    const Vec V_dot = derivative([&](double t) -> Vec { return along(t).V; }, 0);
    EXPECT_LT((m.bias - V_dot).norm(), 10 * difference_error) << body.markers()[std::size_t(i)];
    if (dim == 2) {
      EXPECT_NEAR(m.V(2), derivative([&](double t) { return along(t).angle; }, 0), difference_error);
      EXPECT_NEAR(m.R(0, 0), std::cos(m.angle), 1e-15);
      EXPECT_NEAR(m.R(1, 0), std::sin(m.angle), 1e-15);
    }
  }
}

// dE/dt = 0 along M a = f: what force and mass say agrees with what energy says.
inline void expect_energy_is_kept(const Body& body, const Vec& q, const Vec& v) {
  const Vec a = mass(body, q).ldlt().solve(force(body, q, v));
  const auto energy = [&](double t) { return body.energy(0, q + t * v + t * t / 2 * a, v + t * a).total(); };
  EXPECT_NEAR(derivative(energy, 0), 0, 100 * difference_error);  // energies of order 100 J
}

inline void expect_kinetic_energy_of_its_mass(const Body& body, const Vec& q, const Vec& v) {
  const double kinetic = body.energy(0, q, v).kinetic;
  EXPECT_NEAR(kinetic, 0.5 * v.dot(mass(body, q) * v), 1e-14 * kinetic);  // round-off
}

inline void expect_exact_tangent(const Body& body, const Vec& q, const Vec& v) {
  const Vec a = Vec::LinSpaced(v.size(), -1, 2);
  const Mat D = gradient([&](const Vec& u) -> Vec { return -force(body, q, u); }, v);
  const Mat K = gradient([&](const Vec& p) -> Vec { return mass(body, p) * a - force(body, p, v); }, q);
  Mat S = Mat::Zero(v.size(), v.size());
  Matrix into = Matrix::onto(S);
  dynamic_cast<const ExactTangent&>(body).add_tangent(0, q, v, a, {.c_m = 2, .c_d = 3, .c_k = 5}, into);
  EXPECT_LT((S - 2 * mass(body, q) - 3 * D - 5 * K).norm(), 100 * difference_error);
}

inline void expect_exact_reaction_derivative(const Body& body, const Vec& q, const Vec& v) {
  for (int i = 0; i < int(body.markers().size()); ++i) {
    const Wrench F = Vec::LinSpaced(motion(body, i, q, v).V.size(), 3, -2);
    const Mat expected = gradient([&](const Vec& p) -> Vec { return motion(body, i, p, v).J.transpose() * F; }, q);
    Mat S = Mat::Zero(v.size(), v.size());
    Matrix into = Matrix::onto(S);
    dynamic_cast<const ReactionDerivative&>(body).add_reaction_derivative(i, 0, q, F, 7, into);
    EXPECT_LT((S - 7 * expected).norm(), 10 * difference_error) << body.markers()[std::size_t(i)];
  }
}

}  // namespace trammel::test
