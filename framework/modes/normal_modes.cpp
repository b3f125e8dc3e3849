#include "modes/normal_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <trammel/decompositions.hpp>

namespace trammel::simulate {
namespace {

using Complex = std::complex<double>;
using CVec = Eigen::VectorXcd;

// Round-off eps splits a double eigenvalue by sqrt(eps) = 1.5e-8 of the size of the problem, more where vectors are
// nearly parallel: a pair at 0 by less than this share of the fastest motion, one at i Omega by less than this share of
// Omega.
constexpr double split_at_zero = 1e-5, split_at_rotation = 1e-6;
// Growth that counts as round-off: a share of the motion's own |lambda|, and of the fastest one's.
constexpr double no_growth = 1e-9, round_off_of_fastest = 1e-13;

bool symmetric(const Mat& A) {
  return (A - A.transpose()).lpNorm<Eigen::Infinity>() <= skew_by_differences * A.lpNorm<Eigen::Infinity>();
}

// |A x| is no more than the round-off of its terms.
bool vanishes(const Mat& A, const CVec& x, double noise) {
  const Vec terms = A.cwiseAbs() * x.cwiseAbs();
  return (A * x).lpNorm<Eigen::Infinity>() <= noise * terms.lpNorm<Eigen::Infinity>();
}

// K x = omega^2 M x with columns y and ascending omega^2, both symmetric, M positive definite. The inverse problem
// M x = omega^-2 K x gives the low frequencies full accuracy beside high ones, where K is positive definite.
struct Undamped {
  Vec omega2;
  Mat y;
};
Undamped undamped(const Linearisation& l) {
  const Mat K = (l.K + l.K.transpose()) / 2, M = (l.M + l.M.transpose()) / 2;
  Eigen::GeneralizedSelfAdjointEigenSolver<Mat> solver;
  if (Eigen::LLT<Mat>(K).info() == Eigen::Success) {
    solver.compute(M, K);
    const Vec inverse = solver.eigenvalues().reverse();
    if (solver.info() == Eigen::Success && inverse.size() > 0 && inverse.minCoeff() > 0)
      return {inverse.cwiseInverse(), solver.eigenvectors().rowwise().reverse()};
  }
  solver.compute(K, M);
  if (solver.info() != Eigen::Success) throw model::NotSolvable("the mass matrix is not positive definite");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

// Each direction in the null space of K shifts a steady motion to another steady motion, and so does its rate: a double
// lambda = 0, which round-off eps splits into +-sqrt(eps). Returns which of the lambda = s mu these are; K is M^-1 K
// [1/s^2].
std::vector<bool> drifts_of(const Mat& K, double noise, double speed, double s, const Eigen::VectorXcd& mu) {
  std::vector<bool> drifts(std::size_t(mu.size()), false);
  if (speed == 0) return drifts;
  const Vec pivots = Eigen::ColPivHouseholderQR<Mat>(K).matrixQR().diagonal().cwiseAbs();
  const double zero = 100 * noise * std::max(pivots.maxCoeff(), speed * speed);
  std::vector<Eigen::Index> order(std::size_t(mu.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index i, Eigen::Index j) { return std::abs(mu(i)) < std::abs(mu(j)); });
  const double slow = split_at_zero * std::max(s * std::abs(mu(order.back())), speed);
  const auto most = std::size_t(2 * (pivots.array() <= zero).count());
  for (std::size_t k = 0; k < most; ++k) drifts[std::size_t(order[k])] = s * std::abs(mu(order[k])) <= slow;
  return drifts;
}

// An unrestrained body rests or drifts in the world, so it rotates as seen from the frame: a double lambda = i Omega,
// which round-off eps splits by sqrt(eps).
Complex without_drift(Complex lambda, double frame_rate) {
  const Complex round(0, frame_rate);
  return std::abs(lambda - round) <= split_at_rotation * frame_rate ? round : lambda;
}

// With lambda = s mu and columns of M scaled to 1: [0 1; -K/s^2 -D/s] (y, mu y) = mu (y, mu y).
void first_order(const Linearisation& l, const Vec& scale, std::vector<Mode>& modes) {
  const Eigen::Index m = l.M.rows();
  const Mat scaled_M = l.M * scale.asDiagonal(), scaled_K = l.K * scale.asDiagonal(),
            scaled_D = l.D * scale.asDiagonal();
  const Eigen::PartialPivLU<Mat> mass(scaled_M);
  const Mat K = mass.solve(scaled_K), D = mass.solve(scaled_D);
  const double s = std::max({std::sqrt(K.norm()), D.norm(), 1e-300});
  Mat A = Mat::Zero(2 * m, 2 * m);
  A.topRightCorner(m, m).setIdentity();
  A.bottomLeftCorner(m, m) = -K / (s * s);
  A.bottomRightCorner(m, m) = -D / s;
  const Eigen::EigenSolver<Mat> solver(A);
  if (solver.info() != Eigen::Success) throw model::NotSolvable("the eigenvalues could not be found");
  const Eigen::VectorXcd mu = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  const double fastest = s * mu.cwiseAbs().maxCoeff();
  const std::vector<bool> drifts = drifts_of(K, l.noise, l.speed, s, mu);
  for (Eigen::Index i = 0; i < 2 * m; ++i) {
    if (mu(i).imag() < 0) continue;
    const Complex lambda = s * mu(i);
    const CVec y = scale.asDiagonal() * vectors.col(i).head(m);
    // A motion without stiffness has lambda = 0 (double without damping, which round-off eps splits by sqrt(eps)) and
    // the lambda of its damping.
    const Vec size = y.cwiseAbs();
    const double damping = std::abs(y.dot(l.D * y)), terms = size.dot(l.D.cwiseAbs() * size);
    const bool undamped = damping <= l.noise * terms,
               slow = std::abs(lambda) * std::abs(y.dot(l.M * y)) < 0.5 * damping;
    const bool zero = drifts[std::size_t(i)] || (vanishes(l.K, y, l.noise) && (undamped || slow));
    modes.push_back(made_mode(without_drift(lambda, l.frame_rate.norm()), l.Z * y, zero, fastest));
  }
}

}  // namespace

double Mode::damping_ratio() const {
  return lambda == 0.0 ? 0 : -lambda.real() / std::abs(lambda);
}

const char* to_string(Mode::Kind kind) {
  switch (kind) {
    case Mode::Kind::zero:
      return "zero";
    case Mode::Kind::oscillation:
      return "oscillation";
    case Mode::Kind::decay:
      return "decay";
    case Mode::Kind::growth:
      return "unstable";
    case Mode::Kind::flutter:
      return "unstable oscillation";
  }
  return "";
}

Mode made_mode(Complex lambda, CVec x, bool zero, double fastest) {
  Eigen::Index largest = 0;
  if (x.size() > 0 && x.cwiseAbs().maxCoeff(&largest) > 0) x /= x(largest);
  if (zero) return {Mode::Kind::zero, 0, std::move(x)};
  const double round_off = no_growth * std::abs(lambda) + round_off_of_fastest * fastest;
  if (std::abs(lambda.real()) < round_off) lambda.real(0);
  const bool grows = lambda.real() > 0;
  const auto kind = lambda.imag() > 0 ? (grows ? Mode::Kind::flutter : Mode::Kind::oscillation)
                                      : (grows ? Mode::Kind::growth : Mode::Kind::decay);
  return {kind, lambda, std::move(x)};
}

Spectrum dense_modes(const Linearisation& l, int count) {
  Spectrum spectrum;
  spectrum.degrees = int(l.M.rows());
  spectrum.redundant = l.redundant;
  if (spectrum.degrees == 0) return spectrum;
  if (!l.M.allFinite() || !l.D.allFinite() || !l.K.allFinite())
    throw model::NotSolvable("the linearised equations have numbers that are not finite");

  const Vec scale = l.M.diagonal().cwiseAbs().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const double decay = (scale.asDiagonal() * l.D * scale.asDiagonal()).lpNorm<Eigen::Infinity>();
  spectrum.damped = true;
  if (symmetric(l.M) && symmetric(l.K)) {
    const Undamped u = undamped(l);
    double slowest = 0;  // [1/s]
    const double fastest = std::sqrt(u.omega2.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < u.omega2.size(); ++i) {
      const double omega2 = u.omega2(i), omega = std::sqrt(std::abs(omega2));
      // K of a steady motion is a sum of terms of speed^2.
      const bool zero = vanishes(l.K, u.y.col(i), l.noise) || std::abs(omega2) <= l.noise * l.speed * l.speed;
      if (!zero && (slowest == 0 || omega < slowest)) slowest = omega;
      const Complex lambda = omega2 < 0 ? Complex(omega, 0) : Complex(0, omega);
      spectrum.modes.push_back(made_mode(lambda, l.Z * u.y.col(i).cast<Complex>(), zero, fastest));
    }
    spectrum.damped = decay > no_damping * slowest;
  }
  if (spectrum.damped) {
    spectrum.modes.clear();
    first_order(l, scale, spectrum.modes);
  }
  std::stable_sort(spectrum.modes.begin(), spectrum.modes.end(),
                   [](const Mode& a, const Mode& b) { return std::abs(a.lambda) < std::abs(b.lambda); });
  if (int(spectrum.modes.size()) > count) spectrum.modes.resize(std::size_t(count));
  return spectrum;
}

}  // namespace trammel::simulate
