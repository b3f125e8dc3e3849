// A program over second-order cones:
//
//     minimise  x.D x / 2 - s,     G x + u s = r,     x in the cones x_0 >= |x_1|, one after the other;   D >= 0
//     diagonal
//
// s is free, and left out if u is empty. Solved by a primal-dual interior point method with the scaling of Nesterov and
// Todd and the correction of Mehrotra (Vandenberghe, The CVXOPT linear and quadratic cone program solvers, 2010). It
// works for thin cones and for programs without an interior solution, and ends at round-off. Rows may be of any size;
// those that follow from others are left out.
#pragma once

#include <limits>
#include <vector>

#include <trammel/types.hpp>

namespace trammel::complementarity {

struct ConeProgram {
  std::vector<Eigen::Index> cones;  // sizes, 1 is x_0 >= 0
  Vec D;
  Mat G;
  Vec u, r;  // r of the order of 1
  // If D = 0, the search ends as soon as s is certain to be less than this.
  double wanted = -std::numeric_limits<double>::infinity();
};

struct ConeSolution {
  Vec x, y;  // y: D x - G^T y = z, in the cones; u.y = -1
  double s = 0;
  double off = 0;  // the largest of the residuals, of rows divided by their pivots, and the gap x.z
};
ConeSolution solve_cone_program(const ConeProgram& program);

}  // namespace trammel::complementarity
