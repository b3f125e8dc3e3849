#include "scene/laws/continuity.hpp"

#include <cmath>
#include <vector>

#include "scene/laws/law_code.hpp"

namespace trammel::scene {
namespace {

using Jet = TimeFunction::Jet;
using Way = std::vector<double>;

constexpr double continuous = 1e-9;  // of both values and of 1: round-off of a formula at neighbouring instants

std::optional<Jump> compare(const Jet& before, const Jet& after, int derivatives, double t) {
  const auto jumps = [](double a, double b) { return std::abs(b - a) > continuous * (1 + std::abs(a) + std::abs(b)); };
  if (jumps(before.value, after.value)) return Jump{t, 0, after.value - before.value};
  if (derivatives > 1 && jumps(before.rate, after.rate)) return Jump{t, 1, after.rate - before.rate};
  return {};
}

}  // namespace

std::optional<Jump> find_jump(const TimeFunction& law, int derivatives, double begin, double end) {
  if (!law.code() || derivatives < 1) return {};
  constexpr int pieces = 4096;
  Way before, after, middle;
  law.code()->branches(begin, before);
  if (before.empty()) return {};
  for (int i = 1; i <= pieces; ++i) {
    double low = begin + (end - begin) * (i - 1) / pieces, high = begin + (end - begin) * i / pieces;
    law.code()->branches(high, after);
    const Way at_end = after;
    if (before != after) {
      for (double t = low + (high - low) / 2; t > low && t < high; t = low + (high - low) / 2) {
        law.code()->branches(t, middle);
        (middle == before ? low : high) = t;
      }
      if (const auto jump = compare(law.jet(low), law.jet(high), derivatives, high)) return jump;
    }
    before = at_end;
  }
  return {};
}

}  // namespace trammel::scene
