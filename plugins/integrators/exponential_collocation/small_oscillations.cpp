#include "small_oscillations.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace trammel {

namespace {

// Relative to the fastest mode. Slower modes are treated as part of the remaining force.
constexpr double slow = 1e-4;

void archive_matrix(Archive& archive, const std::string& name, Mat& m) {
  Vec entries = Eigen::Map<const Vec>(m.data(), m.size());
  long long rows = m.rows();
  archive(name + "_rows", rows);
  archive(name, entries);
  if (rows < 0 || (rows == 0 ? entries.size() != 0 : entries.size() % rows != 0)) throw std::length_error(name);
  m = Eigen::Map<const Mat>(entries.data(), rows, rows > 0 ? entries.size() / rows : 0);
}

}  // namespace

void SmallOscillations::residual(System& s, double t, const Vec& q, const State& at, Vec& r) const {
  s.move_to(t, q, at.v);
  r = -s.f();
  s.add_mass_times(1, at.a, r);
  s.add_reaction(1, at.lambda, r);
}

void SmallOscillations::differentiate(System& s, const State& state) {
  // Relative to the size of q: balances round-off and curvature of the force.
  const double size = state.q.lpNorm<Eigen::Infinity>(), dq = 0x1p-24 * (size > 0 ? size : 1);
  const Eigen::Index n = state.v.size();
  K_.resize(n, n);
  residual(s, state.t, state.q, state, r_);
  for (Eigen::Index j = 0; j < n; ++j) {
    unit_.setZero(n);
    unit_[j] = dq;
    s.retract(state.q, unit_, q_);
    residual(s, state.t, q_, state, moved_r_);
    K_.col(j) = (moved_r_ - r_) / dq;
  }
}

// Computes M and replaces K by P^T K P. False: the rows are singular.
bool SmallOscillations::put_on_rows(System& s, const State& state) {
  const Eigen::Index n = state.v.size();
  const bool rows = s.sizes().nc > 0;
  M_.resize(n, n), P_.setIdentity(n, n);
  no_rows_.setZero(s.sizes().nc);
  s.move_to(state.t, state.q, state.v);
  if (rows) s.factorise({1, 0, 0}, state.a, state.lambda, Factors::projection);
  for (Eigen::Index j = 0; j < n; ++j) {
    unit_.setZero(n);
    unit_[j] = 1;
    r_.setZero(n);
    s.add_mass_times(1, unit_, r_);
    M_.col(j) = r_;
    r_ = -r_;
    if (!rows) continue;
    if (!s.correct(r_, no_rows_, x_, mu_, Factors::projection)) return false;
    P_.col(j) = x_;
  }
  if (rows) {
    KP_.noalias() = K_ * P_;
    K_.noalias() = P_.transpose() * KP_;
  }
  KP_ = K_.transpose();
  K_ = 0.5 * (K_ + KP_);
  return true;
}

void SmallOscillations::linearise(System& s, const State& state) {
  const Eigen::Index n = state.v.size();
  omega_.setZero(n), omega_2_.setZero(n), phi_.setIdentity(n, n), psi_.setIdentity(n, n);
  if (n == 0) return;
  differentiate(s, state);
  if (!put_on_rows(s, state) || !K_.allFinite()) return;
  cholesky_.compute(M_);  // M = L L^T: L^-1 K L^-T y = omega^2 y, phi = L^-T y
  if (cholesky_.info() != Eigen::Success || cholesky_.rcond() < 1e-14) return;
  cholesky_.matrixL().solveInPlace(K_);
  KP_ = K_.transpose();
  cholesky_.matrixL().solveInPlace(KP_);
  solver_.compute(KP_);
  if (solver_.info() != Eigen::Success) return;
  const Vec& squares = solver_.eigenvalues();  // ascending
  const double least = slow * slow * std::max(squares[n - 1], 0.0);
  omega_2_ = (squares.array() > least).select(squares, 0);
  omega_ = omega_2_.cwiseSqrt();
  phi_ = solver_.eigenvectors();
  cholesky_.matrixU().solveInPlace(phi_);
  psi_.noalias() = phi_.transpose() * M_;
}

void SmallOscillations::archive(Archive& archive) {
  archive("omega_2", omega_2_);
  omega_ = omega_2_.cwiseSqrt();
  archive_matrix(archive, "shapes", phi_);
  archive_matrix(archive, "amplitudes", psi_);
  if (phi_.cols() != omega_.size() || psi_.rows() != omega_.size() || psi_.cols() != phi_.rows())
    throw std::length_error("shapes");
}

}  // namespace trammel
