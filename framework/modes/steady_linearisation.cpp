#include "modes/steady_linearisation.hpp"

#include <algorithm>
#include <cmath>

#include <trammel/decompositions.hpp>

#include "system/on_rows/tangent_space.hpp"

namespace trammel::simulate {
namespace {

// Coefficients count as constant if they differ by at most this fraction of the rate of the motion [1/s], or of its
// square, and by so many times the noise of K.
constexpr double constant = 1e-7, noisy = 100;

// Rows against a vector in their null space.
constexpr double free_of_rows = 1e-7;

double largest_entry(const Mat& x) {
  return x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0;
}

// A in coordinates in which M is the identity.
Mat normalised(const Eigen::LLT<Mat>& mass, const Mat& A) {
  const Mat half = mass.matrixL().solve(A);
  return mass.matrixL().solve(half.transpose()).transpose();
}

bool agree(const Coefficients& a, const Coefficients& b, double rate, double noise) {
  const Mat M = (a.M + a.M.transpose()) / 2;
  const Eigen::LLT<Mat> mass(M);
  if (mass.info() != Eigen::Success) return false;
  const auto apart = [&](const Mat& x, const Mat& y) { return largest_entry(normalised(mass, y - x)); };
  const auto size = [&](const Mat& x) { return largest_entry(normalised(mass, x)); };
  return apart(a.M, b.M) <= constant && apart(a.D, b.D) <= constant * rate + noisy * noise * size(a.D) &&
         apart(a.K, b.K) <= constant * rate * rate + noisy * noise * size(a.K);
}

bool annihilates(const Mat& columns_transposed, const Mat& x, const Vec& sizes) {
  if (columns_transposed.cols() == 0 || x.cols() == 0) return true;
  return largest_entry(columns_transposed.transpose() * x) <=
         free_of_rows * largest_entry(sizes.asDiagonal() * columns_transposed);
}

}  // namespace

Coefficients coefficients_in(model::AssembledSystem& system, const TurningFrame& frame, const State& s, const Mat& Z,
                             const Mat& left) {
  system.move_to(s.t, s.q, s.v);
  const Mat M = tangent(system, {1, 0, 0}, s), D = tangent(system, {0, 1, 0}, s), K = tangent(system, {0, 0, 1}, s);
  const Mat Z_dot = frame.carried(Z), Y = frame.turned(Z), Y_dot = frame.carried(Y);
  return {left.transpose() * M * Z, left.transpose() * (M * (Z_dot + Y) + D * Z),
          left.transpose() * (M * Y_dot + D * Y + K * Z)};
}

std::optional<Linearisation> linearise_steady(model::AssembledSystem& system, const SteadyMotion& motion) {
  const State& s = motion.state;
  const model::Model& model = system.model();
  const FlatTurning flat = flat_turning(system, s.t, s.q);
  system.move_to(s.t, s.q, s.v);
  const TangentSpace space = tangent_space(system);
  const double noise = noise_of_stiffness(model), tau = motion.tau();
  for (const Eigen::Vector3d& rate : motion.rates) {
    const TurningFrame frame(model, flat, s, rate);
    const State later = steady_state(system, flat, frame.after(tau), rate);
    const TurningFrame frame_later(model, flat, later, rate);
    const Mat Z_later = frame.after(tau, space.Z), left_later = frame.after(tau, space.left);
    system.move_to(later.t, later.q, later.v);
    if (!annihilates(rows_transposed(system), Z_later, space.sizes.of)) continue;
    if (space.sliding && !annihilates(reactions_transposed(system), left_later, space.sizes.of)) continue;
    const Coefficients now = coefficients_in(system, frame, s, space.Z, space.left),
                       then = coefficients_in(system, frame_later, later, Z_later, left_later);
    if (!agree(now, then, 1 / tau, noise)) continue;
    system.move_to(s.t, s.q, s.v);
    return Linearisation{now.M, now.D, now.K, space.Z, space.redundant, noise, motion.speed, rate};
  }
  system.move_to(s.t, s.q, s.v);
  return {};
}

}  // namespace trammel::simulate
