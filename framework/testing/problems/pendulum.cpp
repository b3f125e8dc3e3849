// A point of 1 kg on a rod of 1 m: theta'' = -g sin(theta), in one coordinate, in one of varying mass, and in two with
// a row.
//
//     sin(theta/2) = k sn(w t + u_0; k),  theta' = 2 k w cn,  w^2 = g,  k^2 = sin^2(theta_0/2) + omega_0^2/(4 g)
//
// Source: Whittaker, Analytical Dynamics, section 44; sn and cn by descending Landen steps, Abramowitz and Stegun 16.4.
#include <array>
#include <cmath>

#include <trammel/testing/problems.hpp>

namespace trammel::problems {
namespace {

constexpr double g = 9.81;  // [m/s^2]

double amplitude(double u, double k) {
  std::array<double, 12> a{1}, c{k};
  double b = std::sqrt(1 - k * k);
  std::size_t n = 0;
  while (std::abs(c[n]) > 1e-17 && n + 1 < a.size()) {
    a[n + 1] = (a[n] + b) / 2;
    c[n + 1] = (a[n] - b) / 2;
    b = std::sqrt(a[n] * b);
    ++n;
  }
  double phi = std::ldexp(a[n] * u, int(n));
  for (; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  return phi;
}

std::pair<double, double> swing(double theta_0, double omega_0, double t) {
  const double w = std::sqrt(g), s0 = std::sin(theta_0 / 2), k = std::hypot(s0, omega_0 / (2 * w));
  const double phi = amplitude(w * t + std::ellint_1(k, std::asin(std::min(1.0, s0 / k))), k);
  return {2 * std::asin(k * std::sin(phi)), 2 * k * w * std::cos(phi)};
}

}  // namespace

Problem pendulum(double theta_0, double omega_0) {
  Problem p{"pendulum", "theta'' = -g sin(theta)", "Whittaker, Analytical Dynamics, section 44"};
  p.M = Mat::Ones(1, 1);
  p.force = [](double, const Vec& q, const Vec&) -> Vec { return Vec::Constant(1, -g * std::sin(q[0])); };
  p.exact = [=](double t, Vec& q, Vec& v) {
    const auto [theta, rate] = swing(theta_0, omega_0, t);
    q = Vec::Constant(1, theta), v = Vec::Constant(1, rate);
  };
  p.energy = {g, [](const State& s) { return s.v.squaredNorm() / 2 - g * std::cos(s.q[0]); }};
  return p;
}

Problem pendulum_with_rod(double theta_0, double omega_0, std::vector<double> row_weights) {
  Problem p{"pendulum_with_rod", "x'' = -lambda x, y'' = -g - lambda y, (x^2 + y^2 - 1)/2 = 0",
            "Whittaker, Analytical Dynamics, section 44"};
  p.M = Mat::Identity(2, 2);
  p.force = [](double, const Vec&, const Vec&) -> Vec { return Eigen::Vector2d(0, -g); };
  const Vec w = Eigen::Map<Vec>(row_weights.data(), Eigen::Index(row_weights.size()));
  p.rows = [w](double, const Vec& q, const Vec& v) -> Problem::Rows {
    return {w * (q.squaredNorm() - 1) / 2, 0 * w, -w * v.squaredNorm(), w * q.transpose()};
  };
  p.exact = [=](double t, Vec& q, Vec& v) {
    const auto [theta, rate] = swing(theta_0, omega_0, t);
    q = Eigen::Vector2d(std::sin(theta), -std::cos(theta));
    v = rate * Eigen::Vector2d(std::cos(theta), std::sin(theta));
  };
  p.energy = {g, [](const State& s) { return s.v.squaredNorm() / 2 + g * s.q[1]; }};
  return p;
}

Problem pendulum_on_swinging_pivot(double reach) {
  Problem p = pendulum_with_rod();
  p.name = "pendulum_on_swinging_pivot";
  p.equations = "the pendulum with a rod of length 1 m to the pivot (reach sin 3t, 0)";
  p.closed_form = false;
  p.energy = {};
  p.rows = [reach](double t, const Vec& q, const Vec& v) -> Problem::Rows {
    const double x = reach * std::sin(3 * t), x_t = 3 * reach * std::cos(3 * t), x_tt = -9 * x;
    const Eigen::Vector2d d(q[0] - x, q[1]), u(v[0] - x_t, v[1]);
    return {Vec::Constant(1, (d.squaredNorm() - 1) / 2), Vec::Constant(1, -d[0] * x_t),
            Vec::Constant(1, -u.squaredNorm() + d[0] * x_tt), d.transpose()};
  };
  p.exact = [reach, still = p.exact](double, Vec& q, Vec& v) {
    still(0, q, v);
    v[0] += 3 * reach;
  };
  return p;
}

Problem pendulum_of_varying_mass(double theta_0, double omega_0) {
  Problem p{"pendulum_of_varying_mass", "cosh(q)^2 q'' + cosh(q) sinh(q) q'^2 = -g sin(sinh(q)) cosh(q)",
            "Whittaker, Analytical Dynamics, section 44"};
  p.mass = [](const Vec& q) -> Mat { return Mat::Constant(1, 1, std::pow(std::cosh(q[0]), 2)); };
  p.force = [](double, const Vec& q, const Vec& v) -> Vec {
    const double c = std::cosh(q[0]), s = std::sinh(q[0]);
    return Vec::Constant(1, -c * (g * std::sin(s) + s * v[0] * v[0]));
  };
  p.exact = [=](double t, Vec& q, Vec& v) {
    const auto [theta, rate] = swing(theta_0, omega_0, t);
    q = Vec::Constant(1, std::asinh(theta)), v = Vec::Constant(1, rate / std::hypot(1, theta));
  };
  p.M = p.mass(Vec::Constant(1, std::asinh(theta_0)));
  p.energy = {
      g, [](const State& s) { return std::pow(std::cosh(s.q[0]) * s.v[0], 2) / 2 - g * std::cos(std::sinh(s.q[0])); }};
  return p;
}

Problem stiff_pendulum(double k) {
  Problem p{"stiff_pendulum", "x'' = -k (r - 1) x/r, y'' = -g - k (r - 1) y/r", "Hairer and Wanner II, section VII.2"};
  p.closed_form = false;
  p.M = Mat::Identity(2, 2);
  p.force = [=](double, const Vec& q, const Vec&) -> Vec {
    return Eigen::Vector2d(0, -g) - k * (q.norm() - 1) * q.normalized();
  };
  p.exact = [=](double, Vec& q, Vec& v) {  // the start, with the static stretch
    const double theta = 1, rate = 0.4, r = 1 + (g * std::cos(theta) + rate * rate) / k;
    q = r * Eigen::Vector2d(std::sin(theta), -std::cos(theta));
    v = rate * Eigen::Vector2d(std::cos(theta), std::sin(theta));
  };
  p.energy = {g, [=](const State& s) {
                const double d = s.q.norm() - 1;
                return s.v.squaredNorm() / 2 + g * s.q[1] + k * d * d / 2;
              }};
  return p;
}

}  // namespace trammel::problems
