// The cost of the evaluations of a system, independent of the machine.
#pragma once

namespace trammel::model {

// Counts of the expensive operations.
struct Counts {
  long long residual_evaluations = 0;  // evaluations of f
  long long jacobian_evaluations = 0;  // of the iteration matrix
  long long factorizations = 0;
  // Newton iterations of implicit methods: points with a solution by the iteration matrix. Several solutions at one
  // point (velocity rows, position rows, a test for round-off) count once; solutions for rows without a residual do not
  // count.
  long long newton_iterations = 0;
};

}  // namespace trammel::model
