// Measures the claims of integrators, for our tests and those of plugin authors. A measurement returns a value and a
// table of the underlying figures; a check returns a Report that converts to bool. The GoogleTest suites are in
// testing/suites.hpp, an example of a plugin author's test in framework/testing/README.md.
#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <trammel/integrator.hpp>
#include <trammel/parameters.hpp>
#include <trammel/testing/problems.hpp>

namespace trammel {

// Returns a fresh, prepared integrator at each call.
using Maker = std::function<std::unique_ptr<Integrator>()>;
// Makes it from the plugins in `folder` (the path of a library or of a folder of libraries).
Maker from_plugin(const std::string& folder, const std::string& name,
                  const std::vector<std::pair<std::string, ParameterValue>>& settings = {});

// Takes `n` equal steps to `until`. Throws std::runtime_error with time and reason if one is rejected.
State integrate(Integrator& method, System& system, const State& start, double until, int n,
                const std::function<void(const State&)>& after_each_step = {});

// The least-squares slope of log(error) over log(h), from n, 2n, 4n, ... steps.
struct Order {
  double value = 0;
  std::string table;
};
Order fit_order(int n, int runs, const std::function<double(int n)>& error);

// The same against a problem's closed form; errors of q and v are root mean squares over all steps of a run.
struct Fit {
  double order_q = 0, order_v = 0, order_lambda = 0;  // lambda: NaN without rows
  std::string table;
};
Fit measure_order(const Maker& method, const Problem& problem, int n, int runs = 4);

// Roots of the method's amplification matrix that its trajectories excite, found from these trajectories (matrix pencil
// of Hua and Sarkar).
struct Amplification {
  double radius = 0;
  std::vector<std::complex<double>> roots;
};
Amplification amplification(const Maker& method, double Omega);  // x'' = -Omega^2 x, h = 1
// x'' + 2 zeta Omega x' + Omega^2 x = 0, h = 1
Amplification amplification(const Maker& method, double Omega, double zeta);
// For a particle with the row q = 0, started off the row in position and velocity, h = 1: how its violation shrinks.
Amplification row_amplification(const Maker& method);

enum class Axis { imaginary, negative_real };  // x'' = -z^2 x, and v' = -z v, h = 1
// The smallest z up to `most`, in a scan by 0.01, above which the radius exceeds 1 + 1e-6; `most` if there is none.
double stability_limit(const Maker& method, Axis axis, double most = 8);

// The largest relative change of energy over `n` steps.
double energy_drift(const Maker& method, const Problem& problem, int n);

// Largest norms of g and G v + g_t after steps.
struct ConstraintDrift {
  double position = 0, velocity = 0;
};
ConstraintDrift constraint_drift(const Maker& method, const Problem& problem, int n);

// The estimated error of each step beside the true one, both as root mean squares over q and v and over the steps of a
// run with steps h, and again with h/2, h/4, ... over the same time. For methods that satisfy rows by positions only,
// over q.
struct EstimateFit {
  struct Run {
    double h, estimate, error;
    double ratio() const { return estimate / error; }
  };
  std::vector<Run> runs;  // the largest step first
  double order = 0;       // of the estimate, by least squares
  int claimed_order = 0;  // its error_order()
  std::string table;
};
EstimateFit measure_estimate(const Maker& method, const Problem& problem, double h, int runs = 3);

// Equal bit for bit; NaN equals nothing.
bool same_bits(const Vec& a, const Vec& b);
bool same_bits(const State& a, const State& b);

struct Report {
  bool holds = true;
  std::string table;
  explicit operator bool() const { return holds; }
  void claim(const std::string& sentence, bool true_, const std::string& found = "");
};
// A claim by name ("HasItsOrderOnThePendulum") and the function that tests it. `register_suite` (testing/suites.hpp)
// makes one test of each check.
struct Check {
  std::string name;
  std::function<Report()> find_out;
  // An exception of the component counts as a failed check.
  Report operator()() const;
};

// All checks of an integrator, for `register_suite`.
struct IntegratorClaims {
  double order = 1;
  int steps = 64;              // per second, so many that convergence is asymptotic
  double imaginary_limit = 0;  // of stability; 0: no claim
  double real_limit = 0;       // likewise
  double energy = 0.05;        // largest relative change on the pendulum
  double constraints = 1e-2;   // [m, m/s] largest violation if the method does not satisfy the rows exactly
};
std::vector<Check> integrator_checks(const Maker& method, const IntegratorClaims& claims);

// The orders of q and v equal `order` within +- `tolerance`.
Report check_order(const Maker& method, const Problem& problem, double order, int n, double tolerance = 0.2);
// The stability limit on the axis equals `limit` with a relative error of 1e-3.
Report check_stability(const Maker& method, Axis axis, double limit);
// The estimate of the local error, if there is one, has its error_order() and is near the true error on a motion of
// `omega` [rad/s] with steps h to h/4. If it is of higher order than the method: 0.9 to 1.1 times the true error (with
// rows up to 4 times, since the part across them is estimated and then removed). If it is the error of an embedded
// method of lower order: 1 to 100/(omega h)^(order + 1 - error_order) times.
Report check_estimate(const Maker& method, const Problem& problem, double omega, double h);
Report check_energy(const Maker& method, const Problem& problem, int n, double allowed);
// The rows are satisfied to 1e-9 where the method's traits claim so, otherwise within `allowed`.
Report check_constraints(const Maker& method, const Problem& problem, int n, double allowed);
// Trials with other step sizes before each step change no bit of the run or of `now`, whatever `next` contains on
// entry.
Report trial_leaves_no_trace(const Maker& method, const Problem& problem);
// A fresh integrator that reads the archive continues the run bit for bit.
Report resumes_bitwise(const Maker& method, const Problem& problem);

}  // namespace trammel
