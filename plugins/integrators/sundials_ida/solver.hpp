// SUNDIALS' IDA on Equations, one internal step after another. Errors of the C library are values here, and exceptions
// of the system do not pass through it.
#pragma once

#include <exception>
#include <memory>

#include <trammel/outcome.hpp>

#include "equations.hpp"

namespace trammel::ida {

struct Tolerances {
  double relative = 1e-6, absolute = 1e-9;
  int max_order = 5;
  double max_step = 0;  // [s] 0: none
};

// The solution inside one internal step, by the polynomial with which IDA itself interpolates:
//     y(t) = sum_j c_j (t - end)^j / j!,   begin <= t <= end,   y = (q, v)
struct Segment {
  double begin = 0, end = 0;
  int order = 0;
  Mat derivatives;  // (nq + nv) x (order + 1), of y at the end

  void evaluate(double t, Eigen::Index nq, Vec& q, Vec& v) const;
};

class Solver {
 public:
  explicit Solver(const Tolerances& tolerances);
  ~Solver();

  // Starts at `now`, with the first order.
  void restart(System& s, const State& now);
  // Takes one internal step; Equations::use must have been called if others have used the system. On success `segment`
  // is the solution in it. After a failure IDA stays at its last point. Throws what the system threw.
  Outcome advance(Segment& segment);

  Equations& equations() { return equations_; }

 private:
  struct Library;
  struct Callbacks;
  void set_up(double t);  // the library, for the first step from t
  int of_weights(const double* y, double* weights) const;
  double first_step(const State& now) const;
  template <class Call>
  int guarded(Call&& call);

  Tolerances tolerances_;
  Equations equations_;
  std::exception_ptr thrown_;
  std::unique_ptr<Library> ida_;
};

}  // namespace trammel::ida
