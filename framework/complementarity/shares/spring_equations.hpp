// The equations for the forces of contacts at rest of which it is known which press as springs:
//
//     E_A F_A = lambda,    Z^T (N_A, -x) = 0          (springs_at_rest.hpp)
//
// as independent rows. Columns: the forces of the contacts that press, then the slacks x of those that part; both of
// those that are undecided, none of those that touch.
#pragma once

#include <vector>

#include "complementarity/shares/admissible_forces.hpp"

namespace trammel::complementarity {

struct SpringEquations {
  std::vector<SharingContact> contacts;  // with a slack as a contact that has a normal force only
  std::vector<Eigen::Index> columns;     // of the forces, among those of all contacts
  std::vector<Eigen::Index> slack_of;    // by contact: the column of its slack, or -1
  Mat E;
  Vec lambda;
  double missed = 0;  // of the resultants: what no forces carry, whatever their signs are

  Vec forces_of_all(const Vec& own, Eigen::Index count) const;  // 0 where nothing presses
  void unload_slacks();                                         // spare_load counts them
};

// Columns: the normal forces that are in balance with each other, E_n Z = 0.
Mat self_stress(const Mat& E_n);

SpringEquations spring_equations(const SpringSet& set, const std::vector<SharingContact>& contacts, const Mat& E,
                                 const Mat& Z, const Vec& lambda);

}  // namespace trammel::complementarity
