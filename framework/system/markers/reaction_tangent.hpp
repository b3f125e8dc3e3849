// The change of a constraint's reaction with the coordinates, at constant multipliers: S += c d(sum_k J_k^T H_k^T
// lambda)/dq.
#pragma once

#include <span>

#include "system/markers/marker_motions.hpp"

namespace trammel::model {

struct ConstraintReaction {
  const Constraint& constraint;
  const ReactionTangent* exact;  // null: by differences of the rows
  std::span<const int> slots;    // of the constraint's markers
  const Vec6& lambda;            // of the constraint's rows
};
void add_reaction_tangent(const ConstraintReaction& reaction, MarkerMotions& markers, double t, const Vec& q,
                          const Vec& v, double c, Matrix& S);

}  // namespace trammel::model
