// A contact problem, and what its answer must obey, written down once more and simply: independent of the code that
// solves it.
#pragma once

#include <string>
#include <vector>

#include "complementarity/contact_forces.hpp"

namespace trammel::complementarity {

struct Problem {
  std::vector<ContactPoint> points;
  Mat A;  // Delassus matrix
  Vec b;
  std::string kind;  // what it is, for messages
};

struct Answer {
  LcpOutcome outcome = LcpOutcome::gave_up;
  double violation = 0;
  Vec F, a;
};
Answer solve(const Problem& problem, double nothing = 0);

// [m/s^2] What is no acceleration: 1e-9 of b, and 1e-13 of the shares of F in A F, its round-off.
double little(const Problem& problem, const Vec& F);

// [m/s^2] The largest failure of a normal force, a friction force (times their own A_ii), or an acceleration of a = A F
// + b to obey the law of its contact.
double offence(const Problem& problem, const Vec& F, const Vec& a);

// The same contacts in another order: contact k of the result is contact order[k] of `problem`; rows move with their
// contacts.
Problem permuted(const Problem& problem, const std::vector<std::size_t>& order);
// Its answer in the rows of `problem`.
Vec permuted_back(const Problem& problem, const std::vector<std::size_t>& order, const Vec& x);

}  // namespace trammel::complementarity
