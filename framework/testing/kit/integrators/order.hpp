// The order of a method about which only the claimed order is known: steps are halved until the errors meet round-off,
// and the slope is taken over the last halvings above it.
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
  double order = 0;                 // their slope by least squares; NaN: there are fewer than three
  double uncertainty = 0;           // half of the slope's change over the last two halvings
  bool exact = false;               // every run is at round-off: nothing to fit
  std::string table() const;
};

// `error(n)` of a run with n steps, relative to a size of 1; n = n_0, 2 n_0, ... up to `most`.
Convergence converge(const std::string& problem, double until, int n_0, int most,
                     const std::function<double(int n)>& error);

// Against the problem's closed form, else against its own motion to round-off (flow.hpp), at quarters of its time.
Convergence converge(const Maker& method, const Problem& problem, int most);

// The claimed order, from both sides. Within 0.2, and what the slope still changes; never as much as 0.5, which would
// take one order for another.
Report has_order(const Convergence& c, double order);

}  // namespace trammel::kit
