// Problems with known solutions, for measuring integrators. Each has its own file with its formulas in
// framework/testing/problems.
//
//     M(q) v' = f(t, q, v) - W^T lambda,   g(t, q) = 0,   q' = N(q) v;   W = G except with friction
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <trammel/integrator.hpp>

namespace trammel {

// A quantity that is constant along exact solutions; changes are divided by `scale`.
struct Invariant {
  double scale = 1;
  std::function<double(const State&)> value;
};

// Functions of configurations that do not form a vector space. Empty functions: q' = v, and increments are added.
struct Manifold {
  std::function<Vec(const Vec& q, const Vec& v)> rate = {};
  std::function<Vec(const Vec& q)> normalise = {};
  std::function<Vec(const Vec& q, const Vec& dq)> retract = {};
  std::function<Vec(const Vec& q1, const Vec& q0)> difference = {};
};

struct Problem {
  struct Rows {
    Vec g, g_t, gamma;  // G v + g_t = 0, G v' = gamma
    Mat G;
    Mat W = {};  // of the reactions -W^T lambda with friction; empty: G
  };

  std::string name, equations, source;
  double until = 1;  // [s] solutions are compared from t = 0 to this time
  Mat M = {};        // constant, or at the start
  std::function<Vec(double t, const Vec& q, const Vec& v)> force = {};
  std::function<Rows(double t, const Vec& q, const Vec& v)> rows = {};  // empty: none
  std::function<void(double t, Vec& q, Vec& v)> exact = {};             // without a closed form: the start for every t
  bool closed_form = true;
  Invariant energy = {};                       // without a value: not conserved
  std::function<Mat(const Vec& q)> mass = {};  // empty: M everywhere
  // c_d D + c_k K of the force, D = -df/dv, K = -df/dq; empty: by differences.
  std::function<Mat(const Blend& c, const Vec& q, const Vec& v)> tangent = {};
  Manifold manifold = {};
  std::function<Mat(const Vec& q)> rigid_motions = {};  // as HasRigidMotions; empty: the system knows none

  // A System with a dense orthogonal decomposition and derivatives by differences; it shares no code with the
  // framework's assembly.
  std::unique_ptr<System> system() const;
  State solution(double t) const;  // with consistent a and lambda; redundant rows: lambda of minimum norm
};

namespace problems {

// x'' = -omega^2 x - 2 zeta omega x', from x = 1, x' = 0; 0 <= zeta < 1.
Problem oscillator(double omega = 2, double zeta = 0);
// v' = lambda v, x' = v from x = 0, v = 1; lambda [1/s] must not be 0.
Problem first_order(double lambda = -1);
// x'' = -omega^2 x - 2 zeta omega x' + F cos(drive t), in its steady response.
Problem forced_oscillator(double omega = 2, double zeta = 0.1, double F = 1, double drive = 3);
// theta'' = -g sin theta (L = 1 m), from theta_0 > 0 and omega_0 >= 0; it swings and does not turn over.
Problem pendulum(double theta_0 = 1, double omega_0 = 0.4);
// The same in x and y with one constraint row per weight: the same row times its weight.
Problem pendulum_with_rod(double theta_0 = 1, double omega_0 = 0.4, std::vector<double> row_weights = {1});
// The same in the coordinate q with sinh(q) = theta, which makes the mass vary.
Problem pendulum_of_varying_mass(double theta_0 = 1, double omega_0 = 0.4);
// The pendulum with a rod whose pivot swings: g = ((x - p)^2 + y^2 - 1)/2, p = reach sin 3t [m]. No closed form: the
// start only.
Problem pendulum_on_swinging_pivot(double reach = 0.2);
// The pendulum with a spring of stiffness k [N/m] as its rod. No closed form: energy only.
Problem stiff_pendulum(double k = 1e4);
// A bead on a straight wire that turns at the given rate [rad/s] under gravity.
Problem bead_on_turning_wire(double turning = 2);
// A heavy symmetric top on its tip; q: unit quaternion (w, x, y, z), v: angular velocity in body axes. No closed form.
Problem heavy_top(double spin = 20);
// Masses of 1 kg and 1/ratio kg on a massless rod of 1 m that rotates in free flight.
Problem dumbbell(double ratio = 1e9);

// A ball of 0.1 kg dropped from `height` on the plane y = 0; g = 9.81 m/s^2.
struct BouncingBall {
  double height = 1, e = 0.8;
  double impact_time(int n) const;   // of the n-th impact, from 1 [s]
  double speed_before(int n) const;  // [m/s] > 0
  std::string scene(const std::string& integrator, double until) const;
};

// A uniform bar (2 m, 3 kg) in translation without gravity; its right end strikes a plane at `speed`.
struct StrikingBar {
  double speed = 2, e = 0.5;
  double impulse() const;           // [N s]
  double centre_velocity() const;   // [m/s] upwards, after
  double angular_velocity() const;  // [rad/s] counter-clockwise, after
  std::string scene(const std::string& integrator) const;
};

}  // namespace problems
}  // namespace trammel
