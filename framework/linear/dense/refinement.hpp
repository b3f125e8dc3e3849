// Iterative refinement of a solution of A x = b by approximate factors of A (Wilkinson 1963; Higham, Accuracy and
// Stability of Numerical Algorithms, chapter 12):
//
//     r = b - A x by A itself,   solve for dx by the factors,   x := x + dx          until nothing is gained any more
//
// What differs from solver to solver is the size in which r and dx are measured, and what is worth another correction;
// the loop is the same.
#pragma once

#include <concepts>
#include <limits>

namespace trammel::numerics {

struct Refinement {
  int most;            // corrections
  double enough;       // r is no more: no further correction
  double falls = 0.5;  // r falls to less than this part of the one before, else it is round-off; infinity: not asked
  double settled = 0;  // after a correction of no more than this, x is as good as the factors can make it
  double contracts = std::numeric_limits<double>::infinity();  // a correction of no less does not converge: not applied
};

// Of one solution. residual: evaluates r; correction: dx for this r; apply: x := x + dx. Both sizes are the equations'
// own, as relative as they make them.
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
