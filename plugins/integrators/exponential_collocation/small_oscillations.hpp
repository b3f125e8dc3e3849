// Undamped small oscillations of a system about a state, on the null space of its rows:
//
//     P^T K P phi = omega^2 M phi,  phi^T M phi = 1,    K = d(M a - f + W^T lambda)/dq at constant a, lambda,
//     P = 1 - M^-1 G^T (G M^-1 G^T)^-1 G
//
// The modes form a basis: an increment x has the amplitudes Psi x, Psi = Phi^-1 = Phi^T M; slow modes have omega = 0. K
// is computed by differences and made symmetric. This is accurate enough for an integrator that treats the difference
// to the true acceleration as a remaining force. The cost is O(nv^3).
#pragma once

#include <trammel/decompositions.hpp>

#include <trammel/integrator.hpp>

namespace trammel {

class SmallOscillations {
 public:
  // Linearises about `state` with a and lambda of its equations of motion. If the mass matrix is singular, all omega =
  // 0.
  void linearise(System& s, const State& state);

  const Vec& omega() const { return omega_; }      // (nv) [1/s]
  const Vec& omega_2() const { return omega_2_; }  // (nv) [1/s^2] omega^2
  const Mat& shapes() const { return phi_; }       // Phi (nv x nv)
  const Mat& amplitudes() const { return psi_; }   // Psi (nv x nv)

  void archive(Archive& archive);

 private:
  void residual(System& s, double t, const Vec& q, const State& at, Vec& r) const;
  void differentiate(System& s, const State& state);
  bool put_on_rows(System& s, const State& state);

  Vec omega_, omega_2_;
  Mat phi_, psi_;
  // Scratch of the linearisation.
  Eigen::LLT<Mat> cholesky_;
  Eigen::SelfAdjointEigenSolver<Mat> solver_;
  Mat M_, K_, KP_, P_;
  Vec r_, moved_r_, unit_, q_, x_, mu_, no_rows_;
};

}  // namespace trammel
