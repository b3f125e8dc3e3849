// A slide whose guide rubs pushes a box, at whose corners friction shares the weight.
#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

std::string rubs(double mu) {
  return fmt::format(R"({{"type": "coulomb", "static": {0:.17g}, "kinetic": {0:.17g}}})", mu);
}

struct PushedBox {
  double width = 0.1, height = 0.3, box = 1, slide = 0.8;     // halves [m], masses [kg]
  double floor = 0.4, face = 0.5, guide = 0.1, length = 0.3;  // coefficients, and the length of the guide
  double at_x = -0.2, at_y = -0.15, push = 10, lift = 0, counter = 0, counter_y = 0;  // loads [N/s] and where they act

  // The box is held by four contacts, named in this order.
  Finished run(const std::vector<int>& order) const {
    const auto contact = [](const char* corner, const char* plane, double mu) {
      return fmt::format(R"({{"type": "constraint_method", "restitution": 0, "between": ["b.{}", {{"plane": {}}}],
                              "friction": {}}})",
                         corner, plane, rubs(mu));
    };
    const char* on_floor = R"({"point": [0, 0], "normal": [0, 1]})";
    const char* on_slide = R"({"point": [0, 0], "normal": [1, 0], "on": "d.f"})";
    const std::array<std::string, 4> contacts = {contact("l", on_floor, floor), contact("r", on_floor, floor),
                                                 contact("l", on_slide, face), contact("tl", on_slide, face)};
    std::string all;
    for (std::size_t i = 0; i < order.size(); ++i)
      all += fmt::format(R"({}"c{}": {})", i == 0 ? "" : ", ", i, contacts[std::size_t(order[i])]);
    return run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, -{g}],
            "bodies": {{"b": {{"type": "rigid_body", "mass": {m}, "inertia": {I}, "position": [0, {h}],
                              "markers": {{"l": [-{w}, -{h}], "r": [{w}, -{h}], "tl": [-{w}, {h}],
                                           "hand": [{w}, {cy}]}}}},
                       "d": {{"type": "rigid_body", "mass": {M}, "inertia": {J}, "position": [-{w}, {h}],
                              "markers": {{"f": [0, 0], "k": [{x}, {y}]}}}}}},
            "forces": {{"k": {{"type": "load", "on": "d.k", "force": {{"x": "={push}*t", "y": "={lift}*t"}}}},
                        "hand": {{"type": "load", "on": "b.hand", "force": {{"x": "=-{counter}*t"}}}}}},
            "joints": {{"g": {{"type": "prismatic", "between": [{{"point": [0, {h}]}}, "d.com"], "axis": [1, 0],
                              "length": {length}, "friction": {guide}}}}},
            "contacts": {{{all}}}, "simulate": {{"until": 1}},
            "record": {{"every": 0.02, "observe": {{"x": "b.com.x"}}}}}})",
        fmt::arg("g", 9.81), fmt::arg("m", box), fmt::arg("I", box * (width * width + height * height) / 3),
        fmt::arg("h", height), fmt::arg("w", width), fmt::arg("cy", counter_y), fmt::arg("M", slide),
        fmt::arg("J", 0.1 * slide), fmt::arg("x", at_x), fmt::arg("y", at_y), fmt::arg("push", push),
        fmt::arg("lift", lift), fmt::arg("counter", counter), fmt::arg("length", length),
        fmt::arg("guide", rubs(guide)), fmt::arg("all", all)));
  }
};

void expect_alike(const Finished& one, const Finished& other) {
  ASSERT_TRUE(one.done()) << one.report.reason;
  ASSERT_TRUE(other.done()) << other.report.reason;
  const std::vector<Event> slips = one.of_kind("slip"), others = other.of_kind("slip");
  ASSERT_EQ(others.empty(), slips.empty());
  if (!slips.empty()) {
    EXPECT_NEAR(others.front().t, slips.front().t, 1e-8);
  }
  EXPECT_NEAR(other.end("x"), one.end("x"), 1e-7);
}

// The load of the guide's ends passes through 0 while all is at rest.
TEST(ABoxPushedByASlide, MovesAlikeHoweverItsContactsAreNamed) {
  std::vector<int> order = {0, 1, 2, 3};
  const Finished first = PushedBox{}.run(order);
  while (std::next_permutation(order.begin(), order.end())) expect_alike(first, PushedBox{}.run(order));
}

// In some of them the friction of the guide follows from forces that are shared, until no load of the guide is that of
// forces which it holds. In the last one that load jumps where springs end.
TEST(ABoxPushedByASlide, SlipsAtOneTimeWhateverItsSizesAre) {
  std::mt19937 random(20261129);
  const auto between = [&random](double low, double high) { return low + (high - low) * random() / 4294967296.0; };
  for (int k = 0; k < 26; ++k) {
    PushedBox p{.width = between(0.05, 0.2), .height = between(0.1, 0.4), .box = between(0.5, 2)};
    p.slide = between(0.4, 1.5), p.floor = between(0.2, 0.6), p.face = between(0.2, 0.7);
    p.guide = between(0.05, 0.3), p.length = between(0.1, 0.4);
    p.at_x = -between(0, 0.3), p.at_y = between(-p.height, p.height), p.push = between(10, 25);
    p.lift = between(-4, 4), p.counter = between(0, 2), p.counter_y = between(-p.height, p.height);
    if (k >= 10 && k != 25) continue;
    SCOPED_TRACE(k);
    const Finished first = p.run({0, 1, 2, 3});
    for (const std::vector<int>& order : {std::vector{2, 0, 3, 1}, {3, 2, 1, 0}}) expect_alike(first, p.run(order));
  }
}

}  // namespace
}  // namespace trammel::test
