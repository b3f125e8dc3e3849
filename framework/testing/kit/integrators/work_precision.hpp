// Accuracy against cost of integrators on problems with known answers, and how honest their error estimates are.
#pragma once

#include <string>
#include <vector>

#include <trammel/testing/measurements.hpp>

namespace trammel::kit {

struct Contender {
  std::string name;
  Maker make;
};

// One run: with fixed steps, or with steps that the method's estimate controls.
struct Work {
  double setting = 0;      // h [s], or the tolerance
  double error = 0;        // root mean square of q and v at four times; NaN: the run failed
  double evaluations = 0;  // of the system at a point, and factorisations
  std::string failure = {};
};
std::vector<Work> with_fixed_steps(const Maker& method, const Problem& problem, int most);
// Empty if the method offers no estimate. Tolerances 1e-3 to 1e-9, absolute and relative.
std::vector<Work> with_controlled_steps(const Maker& method, const Problem& problem);

// Of runs that ended well.
struct Honesty {
  int runs = 0;
  int deceived = 0;       // runs whose error was more than ten times what was asked for
  double mean_ratio = 0;  // geometric mean of error over tolerance
  double largest_ratio = 0;
};
Honesty honesty(const std::vector<Work>& controlled);

}  // namespace trammel::kit
