// Iterative refinement of a solution of A x = b by approximate factors of A (Wilkinson 1963; Higham, Accuracy and
// Stability of Numerical Algorithms, chapter 12):
//
//     r = b - A x by A itself,   solve for dx by the factors,   x := x + dx          until there is no further gain
//
// Solvers differ in the norm of r and dx and in their criterion for another correction; the loop is the same.
#pragma once

#include <concepts>
#include <limits>

namespace trammel::numerics {

struct Refinement {
  int most;            // largest number of corrections
  double enough;       // no further correction if r is at most this
  double falls = 0.5;  // r must fall below this part of the last one, otherwise it is round-off; infinity: no such test
  double settled = 0;  // a correction of at most this size is the last one
  double contracts = std::numeric_limits<double>::infinity();  // a larger correction diverges and is not applied
};

// The equations of one solution. residual: evaluates r and returns its size; correction: solves for dx and returns its
// size; apply: x := x + dx. Each class chooses the scale of both sizes.
template <class Equations>
concept Refinable = requires(Equations& equations) {
  { equations.residual() } -> std::same_as<double>;
  { equations.correction() } -> std::same_as<double>;
  equations.apply();
};

struct Refined {
  double residual = 0;    // the last one evaluated
  double correction = 0;  // the last one solved for
};

template <Refinable Equations>
Refined refine(Equations&& equations, const Refinement& rule) {
  Refined result;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0;; ++i) {
    result.residual = equations.residual();
    if (!(result.residual > rule.enough) || i == rule.most || !(result.residual < rule.falls * before)) return result;
    before = result.residual;
    result.correction = equations.correction();
    if (!(result.correction < rule.contracts)) return result;
    equations.apply();
    if (result.correction <= rule.settled) return result;
  }
}

}  // namespace trammel::numerics
