// The order of a method about which only the claimed order is known: steps are shortened until the errors meet
// round-off, and the slope log(e_1/e_2)/log(h_1/h_2) of the last halving above it is extrapolated to h = 0:
//
//     s(h) = p + c h     from the slopes of the last two halvings
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <trammel/testing/measurements.hpp>

namespace trammel::kit {

struct Convergence {
  struct Run {
    int steps;
    double error;  // NaN: a step was rejected
  };
  std::string problem;
  double until = 1;                 // [s] the runs' time: h = until/steps
  std::vector<Run> runs = {};       // the largest step first
  std::size_t first = 0, last = 0;  // the runs of the fit: [first, last)
  double order = 0;                 // slope by least squares; NaN: not measured
  double slope = 0, limit = 0;      // of the last halving; extrapolated to h = 0
  std::size_t halving = 1;          // runs to go back for steps twice as long
  bool measured() const { return last - first > 2 * halving; }
  std::string table() const;
};

// Step numbers n_0, 2 n_0, 4 n_0, ... up to `most`; with 3 n_0, 6 n_0, ... between them for orders above 4, whose
// errors leave room for few halvings only.
std::vector<int> step_numbers(int n_0, int most, int order);

// `error(n)` of a run with n steps, relative to a size of 1.
Convergence converge(const std::string& problem, double until, const std::vector<int>& steps,
                     const std::function<double(int n)>& error);

// Against the problem's closed form, else against its own motion to round-off (flow.hpp), at quarters of its time.
Convergence converge(const Maker& method, const Problem& problem, int most);

// The claimed order, from both sides: it lies between the last slope and its limit, within 0.2, and one of the two
// rounds to it. Above order 6 slopes do not settle before errors meet round-off: then from below only, within 0.4. A
// method of order 5 or higher may be at round-off from the first steps on; that is said and holds.
Report has_order(const Convergence& c, int order);

// At least this order: what shrinks may do so faster where errors cancel.
void claim_shrinks(Report& report, const Convergence& c, int order);

}  // namespace trammel::kit
