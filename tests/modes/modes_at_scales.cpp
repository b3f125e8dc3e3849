// Modes of scenes in other units of length, and elsewhere: those at the origin in metres.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "support/modes_of.hpp"

namespace trammel::test {
namespace {

constexpr double units[] = {1e-9, 1e-6, 1e-3, 1e3, 1e6};     // [m]
constexpr double places[] = {1e2, 1e4, 1e5, 1e6, 1e7, 1e8};  // [m] from the origin, of scenes of 1 m

// Masses and stiffnesses stay, and so do times: gravity is a length over s^2.
struct Place {
  double unit = 1, x = 0;
  std::string at(double x_in_units) const { return fmt::format("{:.17g}", (x + x_in_units) * unit); }
  std::string length(double in_units) const { return fmt::format("{:.17g}", in_units * unit); }
  std::string inertia(double in_units) const { return fmt::format("{:.17g}", in_units * unit * unit); }
};

// Multiples of 2^-20, which a shift by up to 2^32 leaves as they are.
struct Draw {
  explicit Draw(unsigned seed) : random(seed) {}
  double operator()(double least, double most) {
    return std::ldexp(std::round(std::ldexp(std::uniform_real_distribution<double>(least, most)(random), 20)), -20);
  }
  std::mt19937 random;
};

using Scene = std::string (*)(unsigned seed, const Place& at);

// A body that hangs on two springs and dampers, or on three in space.
std::string on_springs(unsigned seed, const Place& at) {
  Draw draw(seed);
  std::string springs, markers;
  for (const double side : {1.0, -1.0}) {
    const char name = side > 0 ? 'p' : 'q';
    const double foot = draw(0.35, 0.55) * side, k = draw(40, 60), c = draw(0, 1), l = draw(0.4, 0.6);
    markers += fmt::format(R"({}"{}": [{}, {}])", markers.empty() ? "" : ", ", name, at.length(0.3 * side),
                           at.length(draw(0, 0.2)));
    springs += fmt::format(
        R"({}"{}": {{"type": "spring_damper", "between": [{{"point": [{}, 0]}}, "b.{}"], "stiffness": {},
                    "damping": {}, "length": {}}})",
        springs.empty() ? "" : ", ", name, at.at(foot), name, k, c, at.length(l));
  }
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {}], "initial": "equilibrium",
    "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": {}, "position": [{}, {}], "markers": {{{}}}}}}},
    "forces": {{{}}}, "simulate": {{"until": 1}}}})",
                     at.length(-9.81), at.inertia(0.08), at.at(0), at.length(-1), markers, springs);
}

std::string on_springs_in_space(unsigned seed, const Place& at) {
  Draw draw(seed);
  std::string springs, markers;
  for (int i = 0; i < 3; ++i) {
    const double x = i == 0 ? 0.4 : i == 1 ? -0.4 : 0, y = i == 2 ? -0.4 : 0.3;
    markers += fmt::format(R"({}"m{}": [{}, {}, {}])", i > 0 ? ", " : "", i, at.length(x), at.length(y),
                           at.length(draw(0, 0.2)));
    springs += fmt::format(R"({}"s{}": {{"type": "spring_damper", "between": [{{"point": [{}, {}, 0]}}, "b.m{}"],
                           "stiffness": {}, "length": {}}})",
                           i > 0 ? ", " : "", i, at.at(x + draw(-0.1, 0.1)), at.length(y + draw(-0.1, 0.1)), i,
                           draw(40, 60), at.length(draw(0.6, 0.8)));
  }
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, {}], "initial": "equilibrium",
    "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": [{}, {}, {}], "position": [{}, 0, {}],
                       "markers": {{{}}}}}}},
    "forces": {{{}}}, "simulate": {{"until": 1}}}})",
                     at.length(-9.81), at.inertia(0.1), at.inertia(0.12), at.inertia(0.15), at.at(0), at.length(-1.2),
                     markers, springs);
}

// A mass in space on a bushing between coinciding markers, which is preloaded by its weight.
std::string on_a_bushing(unsigned seed, const Place& at) {
  Draw draw(seed);
  const auto torsional = [&] { return at.inertia(draw(3, 9)); };
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, {}], "initial": "equilibrium",
    "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": [{}, {}, {}], "position": [{}, 0, 0],
                       "markers": {{"m": [{}, 0, {}]}}}}}},
    "forces": {{"s": {{"type": "bushing", "between": [{{"point": [{}, 0, {}]}}, "b.m"],
                       "stiffness": [{}, {}, {}], "torsional_stiffness": [{}, {}, {}]}}}},
    "simulate": {{"until": 1}}}})",
                     at.length(-1), at.inertia(0.1), at.inertia(0.12), at.inertia(0.15), at.at(0), at.length(0.25),
                     at.length(0.5), at.at(0.25), at.length(0.5), draw(20, 90), draw(20, 90), draw(20, 90), torsional(),
                     torsional(), torsional());
}

// A parallelogram of four bars between two points of the ground, in motion, a spring across it.
std::string parallelogram(unsigned seed, const Place& at) {
  Draw draw(seed);
  const double b = draw(0.1, 0.3), k = draw(5, 20);
  const auto bar = [&](const char* name, double x, double y, double half, bool upright) {
    const double hx = upright ? 0 : half, hy = upright ? half : 0;
    return fmt::format(R"("{}": {{"type": "rigid_body", "mass": 1, "inertia": {}, "position": [{}, {}],
                          "markers": {{"a": [{}, {}], "e": [{}, {}]}}}})",
                       name, at.inertia(half * half / 3), at.at(x), at.length(y), at.length(-hx), at.length(-hy),
                       at.length(hx), at.length(hy));
  };
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {}], "bodies": {{{}, {}, {}}},
    "joints": {{"g": {{"type": "revolute", "between": [{{"point": [{}, 0]}}, "l.a"]}},
                "h": {{"type": "revolute", "between": [{{"point": [{}, 0]}}, "r.a"]}},
                "i": {{"type": "revolute", "between": ["l.e", "c.a"]}},
                "j": {{"type": "revolute", "between": ["r.e", "c.e"]}}}},
    "forces": {{"s": {{"type": "spring_damper", "between": [{{"point": [{}, {}]}}, "c.com"],
                       "stiffness": {}, "length": 0}}}},
    "simulate": {{"until": 1}}}})",
                     at.length(-1), bar("l", 0, 0.5, 0.5, true), bar("r", b, 0.5, 0.5, true),
                     bar("c", b / 2, 1, b / 2, false), at.at(0), at.at(b), at.at(b / 2), at.length(1.5), k);
}

// One that a second bar across it holds as the first does: a row is redundant.
std::string parallelogram_with_a_spare_bar(unsigned seed, const Place& at) {
  std::string scene = parallelogram(seed, at);
  Draw draw(seed);
  const double b = draw(0.1, 0.3);
  const auto add = [&](const std::string& before, const std::string& more) {
    scene.insert(scene.find(before) + before.size(), more);
  };
  add(R"("bodies": {)",
      fmt::format(R"("m": {{"type": "rigid_body", "mass": 1, "inertia": {}, "position": [{}, {}],
      "markers": {{"a": [0, {}], "e": [0, {}]}}}}, )",
                  at.inertia(1.0 / 12), at.at(b / 2), at.length(0.5), at.length(-0.5), at.length(0.5)));
  add(R"("joints": {)", fmt::format(R"("m": {{"type": "revolute", "between": [{{"point": [{}, 0]}}, "m.a"]}},
      "n": {{"type": "revolute", "between": ["m.e", "c.com"]}}, )",
                                    at.at(b / 2)));
  return scene;
}

// A mass that circles on a spring at v^2/r = k (r - l)/m.
std::string circling(unsigned seed, const Place& at) {
  Draw draw(seed);
  const double rate = draw(1, 5), k = 2 * rate * rate;  // r = 1, l = 1/2
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": {}, "position": [{}, 0], "velocity": [0, {}],
                       "angular_velocity": {:.17g}}}}},
    "forces": {{"s": {{"type": "spring_damper", "between": [{{"point": [{}, 0]}}, "b.com"], "stiffness": {:.17g},
                       "length": {}}}}},
    "simulate": {{"until": 1}}}})",
                     at.inertia(0.08), at.at(1), at.length(rate), rate, at.at(0), k, at.length(0.5));
}

void expect_same_modes(const Modes& there, const Modes& here, double off, const std::string& what) {
  ASSERT_EQ(there.count(), here.count()) << what;
  EXPECT_EQ(there.result["degrees_of_freedom"], here.result["degrees_of_freedom"]) << what;
  EXPECT_EQ(there.result["redundant_rows"], here.result["redundant_rows"]) << what;
  for (std::size_t i = 0; i < here.count(); ++i) {
    EXPECT_EQ(there.kind(i), here.kind(i)) << what << ", mode " << i;
    EXPECT_NEAR(there.frequency(i), here.frequency(i), off * here.frequency(i)) << what << ", mode " << i;
  }
}

constexpr double of_round_off = 3e-8;
// Digits of a place of 1 unit, of which equilibria and frequencies have a hundred times.
constexpr double of_place = 5e-14;

void expect_the_same_everywhere(Scene scene, simulate::ModesOptions options = {}) {
  options.count = 9;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Modes here = modes_of(scene(seed, {}), {}, options);
    ASSERT_GT(here.count(), 0u);
    for (const double unit : units)
      expect_same_modes(modes_of(scene(seed, {.unit = unit}), {}, options), here, of_round_off,
                        fmt::format("seed {}, unit {}", seed, unit));
    for (const double x : places)
      expect_same_modes(modes_of(scene(seed, {.x = x}), {}, options), here, of_round_off + of_place * x,
                        fmt::format("seed {}, x = {}", seed, x));
  }
}

TEST(ModesAtScales, OfABodyOnSpringsAreThoseAtTheOrigin) {
  expect_the_same_everywhere(on_springs);
}

TEST(ModesAtScales, OfABodyOnSpringsInSpaceAreThoseAtTheOrigin) {
  expect_the_same_everywhere(on_springs_in_space);
}

TEST(ModesAtScales, OfABodyOnABushingAreThoseAtTheOrigin) {
  expect_the_same_everywhere(on_a_bushing);
}

TEST(ModesAtScales, OfAClosedLoopAreThoseAtTheOrigin) {
  EXPECT_EQ(modes_of(parallelogram(1, {})).result["degrees_of_freedom"], 1);
  expect_the_same_everywhere(parallelogram);
}

TEST(ModesAtScales, OfALoopThatIsHeldTwiceAreThoseAtTheOrigin) {
  const Modes modes = modes_of(parallelogram_with_a_spare_bar(1, {}));
  EXPECT_EQ(modes.result["degrees_of_freedom"], 1);
  EXPECT_EQ(modes.result["redundant_rows"], 1);
  expect_the_same_everywhere(parallelogram_with_a_spare_bar);
}

// omega^2 = k/m (1 + 3 (1 - l/r)) of the radius, seen from the frame that turns along.
TEST(ModesAtScales, OfACirclingMassFollowItsClosedForm) {
  simulate::ModesOptions options;
  options.steady = true, options.count = 9;
  const auto expect = [&](const Place& at, unsigned seed, double off) {
    const Modes modes = modes_of(circling(seed, at), {}, options);
    const double rate = Draw(seed)(1, 5);
    ASSERT_EQ(modes.oscillations().size(), 1u) << "unit " << at.unit << ", x = " << at.x;
    EXPECT_NEAR(modes.oscillations()[0], std::sqrt(5.0) * rate, off * rate) << "unit " << at.unit << ", x = " << at.x;
  };
  for (unsigned seed = 1; seed <= 3; ++seed) {
    expect({}, seed, of_round_off);
    for (const double unit : units) expect({.unit = unit}, seed, of_round_off);
    for (const double x : places)
      if (x <= 1e6) expect({.x = x}, seed, of_round_off + 1e-13 * x);
  }
}

}  // namespace
}  // namespace trammel::test
