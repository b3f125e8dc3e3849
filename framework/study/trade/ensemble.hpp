// Beyond the horizon of a chaotic motion: distributions over starts that differ by 1e-10, in place of trajectories.
#pragma once

#include <string>
#include <vector>

#include "study/trade/errors.hpp"
#include "study/trade/runner.hpp"

namespace trammel::study {

struct Distribution {
  std::string what;                                 // "first impact [s]"
  double mean = 0, spread = 0;                      // of the choice: mean and standard deviation
  double reference_mean = 0, reference_spread = 0;  // of the reference
  // Their means differ by less than twice the standard error of this difference.
  bool alike() const;
  int starts = 0;
};

// As many of 16 starts as the budget allows; none if it allows fewer than 4.
std::vector<Distribution> compare_ensembles(const Overrides& choice, double choice_cpu, const Overrides& reference,
                                            double reference_cpu, const Measure& measure, Runner& run);

}  // namespace trammel::study
