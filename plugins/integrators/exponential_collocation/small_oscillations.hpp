// Undamped small oscillations of a system about a state, on the null space of its rows:
//
//     P^T K P phi = omega^2 M phi,  phi^T M phi = 1,    K = d(M a - f + W^T lambda)/dq with a and lambda held,
//     P = 1 - M^-1 G^T (G M^-1 G^T)^-1 G
//
// All of them, a basis: an increment x has the amplitudes Psi x, Psi = Phi^-1 = Phi^T M; what hardly swings has omega = 0. K is taken by
// differences and by its symmetric part: an integrator that leaves to the rest of its force what these oscillations are not
// needs it no better. Dense: nv^3.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <trammel/integrator.hpp>

namespace trammel {

class SmallOscillations {
 public:
  // About `state`, with the a and lambda of its equations of motion. Of a system whose mass matrix is singular: all omega = 0.
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
  // Of the linearisation.
  Eigen::LLT<Mat> cholesky_;
  Eigen::SelfAdjointEigenSolver<Mat> solver_;
  Mat M_, K_, KP_, P_;
  Vec r_, moved_r_, unit_, q_, x_, mu_, no_rows_;
};

}  // namespace trammel
