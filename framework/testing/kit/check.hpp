// A check of the conformance kit: a claim about a component, the equation behind it, the line of the public header that
// asks for it, and the function that measures it.
//
//     trammel check build/heun.so --only integrator.trial-leaves-no-trace --in-process
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <trammel/testing/measurements.hpp>

namespace trammel::kit {

struct Subject;

enum class Level { quick, full };

// crashed: the process ended in the middle of the check; timed_out: it was ended because it took too long.
enum class Verdict { passed, failed, warned, skipped, crashed, timed_out };
const char* to_string(Verdict verdict);

// A sentence of a public header, word for word (white space aside).
struct Contract {
  std::string header, line;
};

struct Finding {
  Verdict verdict = Verdict::passed;
  std::string text;  // what was measured, or why it was not
};
Finding finding(const Report& report);

struct Words {
  std::string name;      // "integrator.trial-leaves-no-trace"
  std::string claim;     // one sentence
  std::string equation;  // that a failure violates
  Contract contract;
};

// Claims about one kind of component: their names begin alike, and one header states what they judge.
struct ClaimsOf {
  const char* kind;    // "correction."
  const char* header;  // "trammel/correction.hpp"
  Words operator()(const char* name, const char* claim, const char* equation, const char* line) const {
    return {std::string(kind) + name, claim, equation, {header, line}};
  }
};

struct Check {
  Words words;
  Level level = Level::quick;
  std::function<Report(const Subject&)> find_out;
  // Why the check does not apply to the subject, such as an ability that it does not have; "": it applies.
  std::function<std::string(const Subject&)> left_out = {};
};

using Checks = std::vector<Check>;

}  // namespace trammel::kit
