// What a run counts: for result.json, the summary and the progress bar.
#pragma once

#include <vector>

#include "simulate/results/recorder.hpp"

namespace trammel::simulate {

struct Statistics {
  long long steps = 0;           // accepted
  long long contact_steps = 0;   // of these, with a contact closed
  long long rejected = 0;        // by the method or its error estimate
  long long locating_steps = 0;  // repeated to locate events
  long long events = 0, impacts = 0;
  long long touches = 0;                       // a contact closed: the row or the force of its law became active
  double smallest_step = 0, largest_step = 0;  // [s] chosen by the step control
  ConstraintNorms largest;

  // Sizes at their changes; a run with very many keeps the first.
  struct SizesAt {
    double t;
    Sizes sizes;
  };
  static constexpr std::size_t most_sizes = 1000;
  std::vector<SizesAt> sizes;
  long long sizes_left_out = 0;

  void note_sizes(double t, Sizes now);
  void archive(Archive& a);
};

}  // namespace trammel::simulate
