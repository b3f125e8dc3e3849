// Finds where a law of time jumps. step, sign, floor, abs, min and max are switches; a law is smooth between two
// switching times.
//
// A base that follows "=abs(sin(t))" would have to change its velocity instantly, by an infinite force. The jet of such
// a law describes one branch only and does not show the jump. Therefore the switching times are located, and the value
// and the rates on both sides are compared.
#pragma once

#include <optional>

#include <trammel/time_function.hpp>

namespace trammel::scene {

struct Jump {
  double t;        // [s] just after it
  int derivative;  // 0: of the value, 1: of the rate
  double by;       // value after minus value before
};

// The first jump of the value or of a derivative lower than `derivatives`. Two switchings within 1/4096 of begin..end
// that cancel each other may be missed.
std::optional<Jump> find_jump(const TimeFunction& law, int derivatives, double begin, double end);

}  // namespace trammel::scene
