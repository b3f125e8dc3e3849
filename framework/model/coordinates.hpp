// Configurations on manifolds: N(q), retraction and difference for each part of a body's coordinates.
#pragma once

#include <trammel/body.hpp>

namespace trammel::model {

// For one part; q, v, dq are the segments of this part.
void rate(const Coordinates::Part& part, const double* q, const double* v, double* q_dot);
void normalise(const Coordinates::Part& part, double* q);
void retract(const Coordinates::Part& part, const double* q, const double* dq, double* q_new);
void difference(const Coordinates::Part& part, const double* q1, const double* q0, double* dq);

}  // namespace trammel::model
