// Where a law of time jumps: step, sign, floor, abs, min and max are switches, and a law is smooth between two of them.
//
// A base that follows "=abs(sin(t))" would change its velocity at once, by an infinite force. The jet of such a law is that of
// one branch and says nothing of it, so the switches are looked for, and value and rates are compared on both sides.
#pragma once

#include <optional>

#include <trammel/time_function.hpp>

namespace trammel::scene {

struct Jump {
  double t;        // [s] just after it
  int derivative;  // 0: of the value, 1: of the rate
  double by;       // after less before
};

// The first jump of the value or of a derivative lower than `derivatives`. Switches that are thrown and thrown back within a
// 4096th of begin..end may be missed.
std::optional<Jump> find_jump(const TimeFunction& law, int derivatives, double begin, double end);

}  // namespace trammel::scene
