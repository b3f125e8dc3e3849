// Anderson acceleration: a solution of s(x) = 0, where s is the step that some approximate Newton's method would take at x.
//
//     x <- x + s - (dX + dS) gamma,    gamma: the least |s - dS gamma|,    dX, dS: the last changes of x and s
//
// On linear equations it is GMRES preconditioned by what makes s of the residual (Walker, Ni 2011): as many steps as that is wrong in
// directions, wherever they are, be it wrong by more than what there is.
#pragma once

#include <trammel/types.hpp>

namespace trammel::numerics {

class Anderson {
 public:
  // The change of x that follows the step `s`, found where the last changes have led.
  Vec next(const Vec& s);

 private:
  static constexpr Eigen::Index remembered = 30;

  Vec last_x_, last_s_;  // the last change of x and the s before it
  Mat dX_, dS_;
};

}  // namespace trammel::numerics
