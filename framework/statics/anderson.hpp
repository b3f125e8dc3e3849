// Anderson acceleration: a solution of s(x) = 0, where s is the step that some approximate Newton's method would take
// at x.
//
//     x <- x + s - (dX + dS) gamma,    gamma: the least |s - dS gamma|,    dX, dS: the last changes of x and s
//
// On linear equations it is GMRES, preconditioned by the map from the residual to s (Walker, Ni 2011): it needs as many
// steps as there are directions in which this map is wrong, by whatever amount.
#pragma once

#include <trammel/types.hpp>

namespace trammel::numerics {

class Anderson {
 public:
  // The change of x for the step `s` at the current x.
  Vec next(const Vec& s);

 private:
  static constexpr Eigen::Index remembered = 30;

  Vec last_x_, last_s_;  // the last change of x and the s before it
  Mat dX_, dS_;
};

}  // namespace trammel::numerics
