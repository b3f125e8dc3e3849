// Checks of a body with flat coordinates against differences, at states that the test chooses.
#pragma once

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <trammel/body.hpp>

namespace trammel::test {

// Derivative of a smooth function of one number by five points; the error is about h^4 f'''''/30 + eps |f| / h ~ 1e-12.
template <class F>
auto derivative(F f, double at, double h = 1e-3) {
  using T = decltype(f(at));
  return T((8 * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12 * h));
}

// Of values of order one to ten: the derivative's error, with some room.
constexpr double difference_error = 1e-9;

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

}  // namespace trammel::test
