// Eigenvalues and modes of a linearised system: solutions dq = Re(x e^(lambda t)).
//
//     (lambda^2 M + lambda D + K) x = 0      on the null space of the constraints (linearisation.hpp)
//
// Undamped (D = 0, K symmetric): K x = omega^2 M x, a symmetric problem; lambda = i omega, or sqrt(-omega^2) where the
// system leaves the state. Else the pencil of first order in (x, lambda x), eigenvalues in conjugate pairs or real.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "modes/linearisation.hpp"

namespace trammel::simulate {

// Skew part, of the largest entry, of a matrix that is symmetric except for errors of differences.
inline constexpr double skew_by_differences = noise_of_differences;
// Rates of decay below this share are round-off of differences: of the slowest motion's frequency, or of that which
// Krylov's method is shifted to.
inline constexpr double no_damping = 1e-8;

struct Mode {
  enum class Kind {
    zero,         // lambda = 0: a rigid motion, without stiffness
    oscillation,  // Im lambda > 0, Re lambda <= 0; one of its pair
    decay,        // real, < 0: overdamped
    growth,       // real, > 0: unstable
    flutter,      // Im lambda > 0, Re lambda > 0: unstable
  };
  Kind kind = Kind::zero;
  std::complex<double> lambda;  // [1/s]
  Eigen::VectorXcd x;           // increments of q (nv); the largest is 1

  bool unstable() const { return kind == Kind::growth || kind == Kind::flutter; }
  double damping_ratio() const;  // -Re lambda/|lambda|; 0 of a zero mode
};
const char* to_string(Mode::Kind kind);

struct Spectrum {
  std::vector<Mode> modes;  // the lowest by |lambda|, ascending
  int degrees = -1;         // of freedom, m; -1: not counted
  int redundant = 0;        // rows
  bool damped = false;      // or gyroscopic, or with follower forces
  bool frozen = false;      // the state moves, and its coefficients are those of one instant
  Eigen::Vector3d frame_rate = Eigen::Vector3d::Zero();  // Linearisation's
};

// The lowest `count` modes by dense matrices: the cost is m^3, all modes are found. Throws model::NotSolvable.
Spectrum dense_modes(const Linearisation& linearisation, int count);

// Completes lambda, x and kind. `growth` counts as round-off below a fraction of |lambda| and of `fastest` [1/s].
Mode made_mode(std::complex<double> lambda, Eigen::VectorXcd x, bool zero, double fastest);

}  // namespace trammel::simulate
