// Roots of a method's map on linear problems, from two trajectories with h = 1: states y_k obey y_(k+1) = A y_k on the
// excited modes, so with blocks Y_0, Y_1 of states shifted by one step the roots are the eigenvalues of
//
//     U^T Y_1 V Sigma^-1,      Y_0 = U Sigma V^T cut where round-off begins
//
// Source: Hua and Sarkar, IEEE Trans. ASSP 38 (1990) 814 (the matrix pencil). The first four steps, where a multistep
// method may start by another, are left out.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/decompositions.hpp>
#include <trammel/testing/measurements.hpp>

namespace trammel {
namespace {

constexpr int skipped = 4, deep = 8, wide = 8;

// Columns y_skipped, ... of one trajectory.
Mat trajectory(Integrator& method, System& s, const State& start, double v_scale) {
  Mat y(2, deep + wide + 1);
  int k = -skipped;
  integrate(method, s, start, deep + wide + skipped + 1, deep + wide + skipped + 1, [&](const State& x) {
    if (k >= 0) y.col(k) << x.q[0], x.v[0] / v_scale;
    ++k;
  });
  return y;
}

// Of a problem of one coordinate; v_scale: its speeds per length [1/s].
Amplification roots(const Maker& make, Problem p, double v_scale) {
  Mat Y0(2 * deep, 2 * wide), Y1 = Y0;
  for (int j = 0; j < 2; ++j) {
    p.exact = [=](double, Vec& q, Vec& v) { q = Vec::Constant(1, j == 0), v = Vec::Constant(1, j == 1 ? v_scale : 0); };
    const auto system = p.system();
    const auto method = make();
    const Mat y = trajectory(*method, *system, p.solution(0), v_scale);
    for (int c = 0; c < wide; ++c)
      for (int r = 0; r < deep; ++r) {
        Y0.block(2 * r, j * wide + c, 2, 1) = y.col(r + c);
        Y1.block(2 * r, j * wide + c, 2, 1) = y.col(r + c + 1);
      }
  }
  const Eigen::JacobiSVD<Mat> svd(Y0, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Vec sigma = svd.singularValues();
  // The force of a stiff spring is v_scale^2 times the position: its round-off returns to the next step's positions.
  const double round_off = std::max(1e-11, 16 * std::numeric_limits<double>::epsilon() * v_scale * v_scale);
  const Eigen::Index rank = (sigma.array() > round_off * sigma[0]).count();
  const Mat A = svd.matrixU().leftCols(rank).transpose() * Y1 * svd.matrixV().leftCols(rank) *
                sigma.head(rank).cwiseInverse().asDiagonal();
  Amplification found;
  const Eigen::VectorXcd z = Eigen::EigenSolver<Mat>(A, false).eigenvalues();
  found.roots.assign(z.begin(), z.end());
  std::sort(found.roots.begin(), found.roots.end(), [](auto a, auto b) { return std::abs(a) > std::abs(b); });
  if (!found.roots.empty()) found.radius = std::abs(found.roots.front());
  return found;
}

Amplification roots(const Maker& make, double stiffness, double damping) {
  Problem p;
  p.name = "linear";
  p.M = Mat::Ones(1, 1);
  p.force = [=](double, const Vec& q, const Vec& v) -> Vec { return -stiffness * q - damping * v; };
  return roots(make, p, std::max(1e-3, std::max(std::sqrt(stiffness), damping)));
}

}  // namespace

Amplification row_amplification(const Maker& make) {
  Problem p;
  p.name = "row";
  p.M = Mat::Ones(1, 1);
  p.force = [](double, const Vec&, const Vec&) -> Vec { return Vec::Zero(1); };
  p.rows = [](double, const Vec& q, const Vec& /*v*/) -> Problem::Rows {
    return {.g = q, .g_t = Vec::Zero(1), .gamma = Vec::Zero(1), .G = Mat::Ones(1, 1)};
  };
  return roots(make, p, 1);
}

Amplification amplification(const Maker& make, double Omega) {
  return roots(make, Omega * Omega, 0);
}

Amplification amplification(const Maker& make, double Omega, double zeta) {
  return roots(make, Omega * Omega, 2 * zeta * Omega);
}

double stability_limit(const Maker& make, Axis axis, double most) {
  const auto unstable = [&](double z) {
    return (axis == Axis::imaginary ? roots(make, z * z, 0) : roots(make, 0, z)).radius > 1 + 1e-6;
  };
  double low = 0, high = 0.01;
  while (!unstable(high)) {
    if (high >= most) return most;
    low = high, high += 0.01;
  }
  for (int i = 0; i < 20; ++i) (unstable((low + high) / 2) ? high : low) = (low + high) / 2;
  return high;
}

Report check_stability(const Maker& make, Axis axis, double limit) {
  const double found = stability_limit(make, axis, 1.1 * limit + 0.1);
  Report report;
  report.claim(fmt::format("stable up to {} on the {} axis", limit, axis == Axis::imaginary ? "imaginary" : "real"),
               std::abs(found - limit) <= 1e-3 * limit, fmt::format("found {:.6g}", found));
  return report;
}

}  // namespace trammel
