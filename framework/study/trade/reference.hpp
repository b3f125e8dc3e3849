// The reference solution: two methods of families that share no formula, tightened until they agree.
//
// Digits in which they agree are trusted, and no error below ten times their disagreement is claimed. The search takes
// a quarter of the budget at most.
#pragma once

#include <optional>

#include "study/trade/errors.hpp"
#include "study/trade/methods.hpp"
#include "study/trade/runner.hpp"

namespace trammel::study {

inline constexpr double loosest_reference = 1e-8;  // tolerance

struct ReferenceRun {
  Method method;
  double tolerance = 0;
  CaseResult result;
};

struct TradeReference {
  ReferenceRun first, second;  // errors are measured against the first
  double disagreement = 0;     // largest scaled difference until trusted_until
  double differ_at = 0;        // [s] time after which they differ by more than the target; the end: never
  double trusted_until = 0;    // [s] the last record before they differ by more than a tenth of the target
  bool chaotic = false;        // they differ by more than the target before the end
  double floor() const { return 10 * disagreement; }
};

// Empty: no two families reached the end; `why` has the reason.
std::optional<TradeReference> find_reference(const Methods& methods, Runner& run, double target,
                                             const std::vector<std::string>& observed, std::string& why);

}  // namespace trammel::study
