// A scene in other units of length, or elsewhere, has the same events.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double eps = std::numeric_limits<double>::epsilon();

// Where a scene is and how long its metre is; gravity stays, so times go with the square root of the length.
struct Place {
  double length = 1;
  double x = 0, y = 0;
  double time() const { return std::sqrt(length); }
};

struct Draw {
  explicit Draw(unsigned seed) : random(seed) {}
  double operator()(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random); }
  std::mt19937 random;
};

// A ball that falls on a rough floor and bounces to rest, beside a spring that swings against a wall. Coordinates that
// a shift rounds are written after it: what is drawn are multiples of 2^-20, which a shift of up to 2^32 leaves as they
// are.
double digits(double x) {
  return std::ldexp(std::round(std::ldexp(x, 20)), -20);
}

std::string bouncing(unsigned seed, const Place& at) {
  Draw draw(seed);
  const double s = at.length, v = s / at.time();
  const double height = digits(draw(0.5, 2)), speed = draw(-1, 1), e = draw(0.3, 0.7), far = digits(draw(0.2, 0.6));
  return fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"ball": {{"type": "point_mass", "mass": 1, "position": [{x:.17g}, {ball:.17g}], "velocity": [{u:.17g}, 0]}},
             "swing": {{"type": "point_mass", "mass": 1, "position": [{swing:.17g}, {y:.17g}]}}}},
  "forces": {{"spring": {{"type": "spring_damper", "between": [{{"point": [{x:.17g}, {y:.17g}]}}, "swing.point"],
                        "stiffness": {k:.17g}, "length": {rest:.17g}}},
             "up": {{"type": "load", "on": "swing.point", "force": {{"x": 0, "y": 9.81}}}}}},
  "contacts": {{"floor": {{"type": "constraint_method", "restitution": {e:.17g},
                         "friction": {{"type": "coulomb", "static": 0.3, "kinetic": 0.2}},
                         "between": ["ball.point", {{"plane": {{"point": [0, {y:.17g}], "normal": [0, 1]}}}}]}},
               "wall": {{"type": "constraint_method", "restitution": 1,
                        "between": ["swing.point", {{"plane": {{"point": [{wall:.17g}, 0], "normal": [-1, 0]}}}}]}}}},
  "simulate": {{"until": {until:.17g}}}, "record": {{"every": {every:.17g}, "observe": {{"x": "ball.point.x"}}}}}})",
      fmt::arg("x", at.x * s), fmt::arg("y", at.y * s), fmt::arg("ball", (at.y + height) * s), fmt::arg("u", speed * v),
      fmt::arg("swing", (at.x + 1 - far) * s), fmt::arg("k", 40 / s), fmt::arg("rest", s), fmt::arg("e", e),
      fmt::arg("wall", (at.x + 1 + far / 2) * s), fmt::arg("until", 4 * at.time()),
      fmt::arg("every", 0.05 * at.time()));
}

// A block on two corners rocks to rest.
std::string rocking(unsigned seed, const Place& at) {
  Draw draw(seed);
  const double s = at.length, half = 0.25, angle = -draw(0.08, 0.16);
  const double x = -half * std::cos(angle) - std::sin(angle), y = -half * std::sin(angle) + std::cos(angle);
  return fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": {inertia:.17g}, "position": [{x:.17g}, {y:.17g}],
                       "angle": {angle:.17g},
                       "markers": {{"left": [{left:.17g}, {low:.17g}], "right": [{right:.17g}, {low:.17g}]}}}}}},
  "contacts": {{"left": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 10, "kinetic": 10}},
                        "between": ["block.left", {{"plane": {{"point": [0, {floor:.17g}], "normal": [0, 1]}}}}]}},
               "right": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 10, "kinetic": 10}},
                         "between": ["block.right", {{"plane": {{"point": [0, {floor:.17g}], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": {until:.17g}}}, "record": {{"every": {every:.17g}, "observe": {{"a": "block.angle"}}}}}})",
      fmt::arg("inertia", (1 + half * half) / 3 * s * s), fmt::arg("x", (at.x + x) * s), fmt::arg("y", (at.y + y) * s),
      fmt::arg("angle", angle), fmt::arg("left", -half * s), fmt::arg("right", half * s), fmt::arg("low", -s),
      fmt::arg("floor", at.y * s), fmt::arg("until", 2 * at.time()), fmt::arg("every", 0.02 * at.time()));
}

std::string warnings(const Finished& run) {
  return run.result.at("warnings").dump();
}

// Of kinds that no place decides: impacts in a contact that was open.
std::vector<Event> impacts(const std::string& scene) {
  const Finished run = run_text(scene);
  EXPECT_TRUE(run.done()) << run.report.reason;
  return run.of_kind("impact");
}

// The same contacts in the same order, at the same times up to `off`, in units of the scene's.
void expect_same(const std::vector<Event>& here, const std::vector<Event>& there, const Place& at, double off,
                 const std::string& what) {
  ASSERT_EQ(there.size(), here.size()) << what;
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(there[i].contact, here[i].contact) << what << ", impact " << i;
    EXPECT_NEAR(there[i].t / at.time(), here[i].t, off) << what << ", impact " << i;
  }
}

// Errors of 1e-9 a step, of which there are some tens between impacts, grown by a few bounces.
constexpr double of_steps = 3e-7;

TEST(Scales, AScaledSceneHasTheSameImpacts) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const std::vector<Event> here = impacts(bouncing(seed, {}));
    ASSERT_GT(here.size(), 8u);
    for (const double length : {1e-9, 1e-6, 1e-3, 1e3, 1e6}) {
      const Place at{.length = length};
      expect_same(here, impacts(bouncing(seed, at)), at, of_steps, fmt::format("seed {}, length {}", seed, length));
    }
  }
}

// Whose gap sets no scale but its own, nor does the speed of a fall from there.
TEST(Scales, APlaneFarOffLeavesTheOtherContactsAsTheyAre) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const std::string scene = bouncing(seed, {});
    const std::vector<Event> here = impacts(scene);
    ASSERT_GT(here.size(), 8u);
    for (const double far : {1e3, 1e6, 1e9, 1e12}) {
      std::string with_it = scene;
      const std::string contacts = R"("contacts": {)";
      with_it.insert(with_it.find(contacts) + contacts.size(),
                     fmt::format(R"("sky": {{"type": "constraint_method", "restitution": 1,
                        "between": ["ball.point", {{"plane": {{"point": [0, {:.17g}], "normal": [0, -1]}}}}]}}, )",
                                 far));
      expect_same(here, impacts(with_it), {}, of_steps, fmt::format("seed {}, plane at {} m", seed, far));
    }
  }
}

TEST(Scales, AMovedSceneHasTheSameImpacts) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const std::vector<Event> here = impacts(bouncing(seed, {}));
    for (const double far : {1e3, 1e5, 5e6}) {
      const Place at{.x = far, .y = -2 * far};
      // Bounces whose flight doubles do not hold there end; of the rest, times to the rounding of a gap over the speed
      // of impact.
      std::vector<Event> there = impacts(bouncing(seed, at));
      std::vector<Event> held;
      for (const Event& event : here) {
        const double speed = event.detail.at("separation"), rises = speed * speed / (2 * 9.81);
        if (event.contact == "contacts.wall" || rises > 1e4 * eps * 2 * far) held.push_back(event);
      }
      const auto fast = [&](const Event& event) {
        const double speed = event.detail.at("separation"), rises = speed * speed / (2 * 9.81);
        return event.contact == "contacts.wall" || rises > 1e4 * eps * 2 * far;
      };
      std::erase_if(there, [&](const Event& event) { return !fast(event); });
      const double slowest = std::sqrt(2 * 9.81 * 1e4 * eps * 2 * far);
      expect_same(held, there, at, of_steps + 400 * eps * 2 * far / slowest, fmt::format("seed {}, {} m", seed, far));
    }
  }
}

TEST(Scales, ABlockOfAnySizeRocksToRestInTheSameImpacts) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const std::vector<Event> here = impacts(rocking(seed, {}));
    ASSERT_GE(here.size(), 2u);
    for (const double length : {1e-9, 1e-6, 1e-3, 1e3, 1e6}) {
      const Place at{.length = length};
      expect_same(here, impacts(rocking(seed, at)), at, 1e-5, fmt::format("seed {}, length {}", seed, length));
    }
  }
}

// x = cos t, y = 0.5 sin t in units of the length; 1e-9 a step, 20 s.
// A deck that slides on two piers and comes to rest: what stands turns by the round-off of the loads, over its size.
std::string bridge(double s) {
  const double time = std::sqrt(s);
  std::vector<std::string> bodies = {fmt::format(
      R"("deck": {{"type": "rigid_body", "mass": 2, "inertia": {:.17g}, "position": [{:.17g}, {:.17g}],
                  "velocity": [{:.17g}, 0], "markers": {{"under": [0, {:.17g}]}}}})",
      0.05 * s * s, 0.013 * s, 0.25 * s, 0.5 * s / time, -0.05 * s)};
  std::vector<std::string> contacts;
  for (const auto& [pier, x] : {std::pair{"left", -0.3}, {"right", 0.3}}) {
    bodies.push_back(fmt::format(
        R"("{}": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "position": [{:.17g}, {a:.17g}],
                  "markers": {{"bl": [-{a:.17g}, -{a:.17g}], "br": [{a:.17g}, -{a:.17g}],
                               "tl": [-{a:.17g}, {a:.17g}], "tr": [{a:.17g}, {a:.17g}]}}}})",
        pier, 0.005 * s * s, x * s, fmt::arg("a", 0.1 * s)));
    for (const char* corner : {"bl", "br", "tl", "tr"})
      contacts.push_back(fmt::format(
          R"("{0}_{1}": {{"type": "constraint_method", "restitution": 0,
                          "friction": {{"type": "coulomb", "static": {2}, "kinetic": {2}}},
                          "between": ["{0}.{1}", {{"plane": {{"point": [0, 0], "normal": [0, {3}]{4}}}}}]}})",
          pier, corner, corner[0] == 't' ? 0.3 : 0.6, corner[0] == 't' ? -1 : 1,
          corner[0] == 't' ? R"(, "on": "deck.under")" : ""));
  }
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
      "bodies": {{{}}}, "contacts": {{{}}}, "simulate": {{"until": {:.17g}}},
      "record": {{"every": {:.17g}, "observe": {{"x": "deck.com.x"}}}}}})",
                     fmt::join(bodies, ", "), fmt::join(contacts, ", "), 0.4 * time, 0.02 * time);
}

TEST(Scales, ABridgeOfAnySizeTakesStepsOfItsMotion) {
  const Finished metres = run_text(bridge(1));
  ASSERT_TRUE(metres.done()) << metres.report.reason;
  for (const double size : {1e-6, 1e-3, 1e3}) {
    const Finished run = run_text(bridge(size));
    ASSERT_TRUE(run.done()) << size << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << size << ": " << run.result["warnings"].dump();
    EXPECT_EQ(run.events.size(), metres.events.size()) << size;
    // Two for each of the 20 records. Round-off may halve a step; it must not decide it (74,027 of micrometres once).
    EXPECT_LE(run.result["counts"]["steps"].get<int>(), 40) << size;
    EXPECT_NEAR(run.end("x") / size, metres.end("x"), 1e-7) << size;
  }
}

TEST(Scales, ASpringOfAnySizeAnywhereSwingsAsAccurately) {
  for (const double length : {1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double far : {0.0, 1e3, 1e6}) {
      const double x = far * length;
      const std::string scene = fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
          "bodies": {{"b": {{"type": "point_mass", "mass": 1, "position": [{:.17g}, 0], "velocity": [0, {:.17g}]}}}},
          "forces": {{"s": {{"type": "spring_damper", "between": [{{"point": [{:.17g}, 0]}}, "b.point"], "stiffness": 1, "length": 0}}}},
          "simulate": {{"until": 20}}, "record": {{"every": 1, "observe": {{"x": "b.point.x", "y": "b.point.y"}}}}}})",
          x + length, 0.5 * length, x);
      const Finished run = run_text(scene);
      ASSERT_TRUE(run.done()) << run.report.reason;
      const double off = 1e-6 + 100 * eps * far;
      EXPECT_NEAR((run.end("x") - x) / length, std::cos(20), off) << length << " m, at " << x;
      EXPECT_NEAR(run.end("y") / length, 0.5 * std::sin(20), off) << length << " m, at " << x;
    }
}

// A pendulum's quarter swing does not know how long its metre is; steps are a hundredth of the period, index 2 methods
// of second order.
TEST(Scales, APendulumOfAnyLengthSwingsAlikeByImplicitMethods) {
  for (const char* type : {"hht_alpha", "newmark", "generalized_alpha"}) {
    double angle_of_a_metre = 0;
    for (const double L : {1.0, 1e-6, 1e-3, 1e3, 1e4, 1e6}) {
      const double t = std::sqrt(L);
      const std::string scene = fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
          "bodies": {{"bar": {{"type": "rigid_body", "mass": 2, "inertia": {:.17g}, "position": [{:.17g}, 0],
                             "markers": {{"hinge": [{:.17g}, 0]}}}}}},
          "joints": {{"hinge": {{"type": "revolute", "between": ["ground", "bar.hinge"]}}}},
          "integrator": {{"type": "{}", "step": {:.17g}}},
          "simulate": {{"until": {:.17g}}}, "record": {{"every": {:.17g}, "observe": {{"angle": "bar.angle"}}}}}})",
          L * L / 6, L / 2, -L / 2, type, 0.01 * t, 5 * t, 0.1 * t);
      const Finished run = run_text(scene);
      ASSERT_TRUE(run.done()) << type << ", " << L << " m: " << run.report.reason;
      if (L == 1) angle_of_a_metre = run.end("angle");
      EXPECT_NEAR(run.end("angle"), angle_of_a_metre, 1e-7)
          << type << ", " << L << " m";  // 500 steps, 1e-11 each, amplified
    }
  }
}

TEST(Scales, AJointHasNoSizeOfRoundOff) {
  for (const double place : {0.3, 0.7, 1.1, 123.4, 1e6 + 0.3}) {
    const double near = std::nextafter(place, 2 * place);
    for (const char* x : {"com", "com"}) {
      const Finished run = run_text(fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
          "bodies": {{"w": {{"type": "rigid_body", "mass": 1, "inertia": 1, "position": [{:.17g}, {:.17g}], "angular_velocity": 3}}}},
          "joints": {{"a": {{"type": "revolute", "between": [{{"point": [{:.17g}, {:.17g}]}}, "w.{}"]}}}},
          "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"w": "w.angular_velocity"}}}}}})",
          near, place, place, near, x));
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_NEAR(run.end("w"), 3, 1e-12);
    }
  }
}

// Two bars, the hinge of the first of them given `times`. What doubles hold of a place is what its rows hold to.
std::string bars(double place, int times, const char* integrator) {
  std::string hinges;
  for (int i = 0; i < times; ++i)
    hinges += fmt::format(R"("a{}": {{"type": "revolute", "between": [{{"point": [{:.17g}, {:.17g}]}}, "u.in"]}}, )", i,
                          place, place);
  return fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"u": {{"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [{:.17g}, {:.17g}],
                   "markers": {{"in": [-0.5, 0], "out": [0.5, 0]}}}},
             "l": {{"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [{:.17g}, {:.17g}],
                   "markers": {{"in": [-0.5, 0]}}}}}},
  "joints": {{{}"b": {{"type": "revolute", "between": ["u.out", "l.in"]}}}},
  "integrator": {}, "simulate": {{"until": 1}},
  "record": {{"every": 0.1, "observe": {{"u": "u.angle", "l": "l.angle"}}}}}})",
      place + 0.5, place, place + 1.5, place, hinges, integrator);
}

TEST(Scales, MovedJointsHoldAndSwingAsAtTheOrigin) {
  for (const char* integrator : {R"({"type": "dop853", "step": {"tolerance": 1e-9}})",
                                 R"({"type": "dop853", "rows": "projected", "step": {"tolerance": 1e-9}})",
                                 R"({"type": "hht_alpha", "step": 1e-3})"})
    for (const int times : {1, 2}) {
      const Finished here = run_text(bars(0, times, integrator));
      ASSERT_TRUE(here.done()) << here.report.reason;
      for (const double place : {1e5, 1e8}) {
        const Finished there = run_text(bars(place, times, integrator));
        ASSERT_TRUE(there.done()) << integrator << ", " << place << " m: " << there.report.reason;
        // Joints open by the round-off of the place, which turns bars of 1 m by as much; a swing of 1 s amplifies it by
        // some tens.
        for (const char* angle : {"u", "l"})
          EXPECT_NEAR(there.end(angle), here.end(angle), 1e-8 + 100 * eps * place) << integrator << ", " << place;
      }
    }
}

std::string error_of(const std::string& scene) {
  try {
    run_text(scene);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "it ran";
}

// Positions and velocities agree at the start, accelerations of 2 and 4 lengths per s^2 do not.
TEST(Scales, LawsThatContradictEachOtherAreNamedAtEverySize) {
  const char* const scene = R"json({{"trammel": 1, "space": "planar", "parameters": {{"u": {}}},
    "bodies": {{"m": {{"type": "point_mass", "mass": 1, "position": ["=u", 0]}}}},
    "joints": {{"a": {{"type": "distance", "between": ["ground", "m.point"], "length": "=u*(1+t^2)"}},
                "b": {{"type": "distance", "between": ["ground", "m.point"], "length": "=u*(1+2*t^2)"}}}},
    "simulate": {{"until": 1}}}})json";
  for (const double length : {1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6})
    EXPECT_THAT(error_of(fmt::format(fmt::runtime(scene), length)),
                HasSubstr("joints.a, joints.b hold at the start but prescribe motions that contradict each other"))
        << length;
}

// A hinged bar of any length, whose end a second joint wants elsewhere.
TEST(Scales, JointsThatContradictEachOtherAreNamedAtEverySize) {
  const char* const scene = R"json({{"trammel": 1, "space": "planar", "parameters": {{"u": {}}},
    "bodies": {{"bar": {{"type": "rigid_body", "mass": 1, "inertia": "=u^2/12", "position": ["=u/2", 0],
                        "markers": {{"l": ["=-u/2", 0], "r": ["=u/2", 0]}}}}}},
    "joints": {{"hinge": {{"type": "revolute", "between": ["ground", "bar.l"]}},
                "far": {{"type": "distance", "between": [{{"point": [0, "=2*u"]}}, "bar.com"],
                         "length": "=u*sqrt(4.25)"}},
                "end": {{"type": "revolute", "between": [{{"point": ["=1.2*u", 0]}}, "bar.r"]}}}},
    "simulate": {{"until": 1}}}})json";
  for (const double length : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    EXPECT_THAT(error_of(fmt::format(fmt::runtime(scene), length)),
                HasSubstr("joints.hinge, joints.end contradict each other"))
        << length;
}

// Tolerances that are parameters of a method, too.
TEST(Scales, IdaKeepsItsAbsoluteToleranceInTheScenesUnit) {
  if (!std::filesystem::exists(TRAMMEL_BUILD_DIR "/lib/trammel/sundials_ida.so")) GTEST_SKIP() << "it is not built";
  const char* const scene = R"json({{"trammel": 1, "space": "planar", "parameters": {{"u": {}}},
    "gravity": [0, "=-9.81*u"],
    "bodies": {{"a": {{"type": "point_mass", "mass": 1, "position": ["=u", 0]}},
                "b": {{"type": "point_mass", "mass": 1, "position": ["=2*u", 0]}}}},
    "joints": {{"p": {{"type": "distance", "between": ["ground", "a.point"], "length": "=u"}},
                "q": {{"type": "distance", "between": ["a.point", "b.point"], "length": "=u"}}}},
    "integrator": {{"type": "sundials_ida", "rtol": 1e-6, "step": 0.01}},
    "simulate": {{"until": 2}}, "record": {{"every": 0.1, "observe": {{"x": "b.point.x"}}}}}})json";
  const Finished here = run_text(fmt::format(fmt::runtime(scene), 1));
  ASSERT_TRUE(here.done()) << here.report.reason;
  for (const double length : {1e-9, 1e-6, 1e6}) {
    const Finished there = run_text(fmt::format(fmt::runtime(scene), length));
    ASSERT_TRUE(there.done()) << there.report.reason;
    // Errors of 1e-6 a step that a double pendulum enlarges ten times; with 1e-9 m the smallest is off by 0.16 lengths.
    EXPECT_NEAR(there.end("x") / length, here.end("x"), 3e-5) << length;
  }
}

TEST(Scales, MovedJointsThatContradictEachOtherAreNamed) {
  for (const double place : {0.0, 1e5, 1e8}) {
    std::string scene = bars(place, 2, R"({"type": "dop853", "step": {"tolerance": 1e-9}})");
    const std::string second = fmt::format(R"("a1": {{"type": "revolute", "between": [{{"point": [{:.17g}, )", place);
    scene.replace(scene.find(second), second.size(),
                  fmt::format(R"("a1": {{"type": "revolute", "between": [{{"point": [{:.17g}, )", place + 0.25));
    try {
      run_text(scene);
      FAIL() << "it ran, at " << place << " m";
    } catch (const scene::SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr("joints.a0, joints.a1 contradict each other")) << place;
    }
  }
}

TEST(Scales, AnAbsoluteToleranceLargerThanTheMotionIsSaid) {
  const std::string step =
      R"("integrator": {"type": "dop853", "step": {"tolerance": 1e-9, "absolute": 1e-7}}, "simulate")";
  std::string scene = bouncing(1, {.length = 1e-6});
  scene.replace(scene.find("\"simulate\""), 10, step);
  const Finished run = run_text(scene);
  EXPECT_THAT(warnings(run), HasSubstr("integrator.step.absolute"));
  EXPECT_THAT(warnings(run_text(bouncing(1, {.length = 1e-6}))), Not(HasSubstr("absolute")));
}

TEST(Scales, ACaptureSpeedAboveAllImpactsIsSaid) {
  std::string scene = bouncing(1, {.length = 1e-6});
  const std::string law = R"("restitution": 1,)";
  scene.replace(scene.find(law), law.size(), R"("restitution": 1, "capture_speed": 0.01,)");
  const Finished run = run_text(scene);
  EXPECT_THAT(warnings(run), HasSubstr("no impact of contacts.wall was faster than its capture_speed"));
}

// Nothing has accelerated yet: there is none to carry over.
TEST(Scales, AContactThatTouchesAtTheStartCarriesNoAcceleration) {
  const Overrides at_rest = {{"parameters.h", "0"}, {"contacts.floor.restart", "carry"}, {"simulate.until", "0.2"}};
  for (const char* type : {"runge_kutta_4", "hht_alpha", "newmark", "generalized_alpha"}) {
    Overrides overrides = at_rest;
    overrides.push_back({"integrator.type", type});
    const Finished run = run_file("tour/02_bouncing_ball.json", overrides);
    ASSERT_TRUE(run.done()) << type << ": " << run.report.reason;
    EXPECT_NEAR(run.end("y"), 0, 1e-12) << type;
    EXPECT_NEAR(run.end("x"), 0.1, 1e-12) << type;
  }
  const Finished beam = run_file("beam_impact/figure_9.json", {{"bodies.beam.angle", "0"}, {"simulate.until", "0.01"}});
  EXPECT_TRUE(beam.done()) << beam.report.reason;
}

// Two feet at one point hold no turn, whatever carries them.
TEST(Scales, AnEquilibriumThatNothingDeterminesNamesTheFreeDirection) {
  try {
    run_file("free_standing/1s.json", {{"parameters.b0", "0"}});
    FAIL() << "it ran";
  } catch (const scene::SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("initial"));
    EXPECT_THAT(error.what(), HasSubstr("nothing holds bodies.main in x, its angle"));
  }
  EXPECT_TRUE(run_file("free_standing/1s.json", {{"simulate.until", "0.1"}}).done());
}

// A rope that begins slack, with its ends in one point, in any unit and far from the origin: it lets the ball fall by
// its length L, and throws it back with e v.
TEST(ARope, ReboundsWhereverItIs) {
  for (const double length : {1e-3, 1.0, 1e3, 1e6})
    for (const double place : {0.0, 1e4, 1e8}) {
      if (length * 1e9 < place) continue;  // coordinates there do not resolve its motion
      const double falls = std::sqrt(2 * length / 9.81), end = 1.5 * falls, rises = end - falls;
      const Finished run = run_text(fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"ball": {{"type": "point_mass", "mass": 1, "position": [{0:.17g}, {0:.17g}]}}}},
  "contacts": {{"rope": {{"type": "constraint_method", "restitution": 0.5, "between": [{{"point": [{0:.17g}, {0:.17g}]}}, "ball.point"],
                        "from": "below", "reaches": {{"type": "distance", "length": {1:.17g}}}}}}},
  "simulate": {{"until": {2:.17g}}}, "record": {{"every": {3:.17g}, "observe": {{"y": "ball.point.y"}}}}}})",
          place, length, end, end / 20));
      ASSERT_TRUE(run.done()) << run.report.reason;
      ASSERT_EQ(run.events.size(), 1u) << length << " m at " << place << " m";
      EXPECT_NEAR(run.events[0].t, falls, falls * (1e-8 + 100 * eps * place / length));
      const double y = -length + 0.5 * std::sqrt(2 * 9.81 * length) * rises - 9.81 / 2 * rises * rises;
      EXPECT_NEAR(run.end("y") - place, y, 1e-8 * length + 100 * eps * place) << length << " m at " << place << " m";
    }
}

// What it is not tied to and cannot strike decides nothing for its impacts.
TEST(ABallBesideALargeBody, ReboundsAsAlone) {
  for (const double height : {1e-5, 1e-3, 1.0}) {
    const auto bounces = [&](double length) {
      const double settled = std::sqrt(2 * height / 9.81) * 1.8 / 0.2;
      return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"ball": {{"type": "point_mass", "mass": 1, "position": [0, {0:.17g}]}},
             "ship": {{"type": "rigid_body", "mass": 1e7, "inertia": 1e10, "markers": {{"bow": [{1:.17g}, 0]}}}}}},
  "joints": {{"mooring": {{"type": "fixed", "between": ["ground", "ship.com"]}}}},
  "contacts": {{"floor": {{"type": "constraint_method", "restitution": 0.8,
                         "between": ["ball.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": {2:.17g}}}, "record": {{"every": {3:.17g}, "observe": {{"y": "ball.point.y"}}}}}})",
                                  height, length, 1.2 * settled, settled / 10));
    };
    const Finished alone = bounces(height);
    ASSERT_TRUE(alone.done()) << alone.report.reason;
    EXPECT_EQ(alone.of_kind("impact").size(), 43u);
    for (const double length : {300.0, 1e4, 6.4e6}) {
      const Finished beside = bounces(length);
      ASSERT_TRUE(beside.done()) << beside.report.reason;
      EXPECT_EQ(beside.of_kind("impact").size(), 43u) << height << ", " << length;
    }
  }
}

// A body that rests is accelerated by the round-off of the forces that balance there, which is no motion to resolve.
TEST(ABallThatCameToRest, NeedsNoStepsOfExponentialCollocation) {
  for (const double height : {1e-3, 1.0, 1e3}) {
    const double settled = std::sqrt(2 * height / 9.81) * 1.7 / 0.3;
    const Finished run = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"ball": {{"type": "point_mass", "mass": 2, "position": [0, {:.17g}]}}}},
  "contacts": {{"floor": {{"type": "constraint_method", "restitution": 0.7,
                         "between": ["ball.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "integrator": {{"type": "exponential_collocation", "step": {{"tolerance": 1e-9}}}},
  "simulate": {{"until": {:.17g}}}, "record": {{"every": {:.17g}, "observe": {{"y": "ball.point.y"}}}}}})",
        height, 5 * settled, settled / 10));
    ASSERT_TRUE(run.done()) << run.report.reason;
    const double stabilised = 20;  // steps a second that stabilised rows ask for
    EXPECT_LT(run.result["counts"]["steps"].get<double>(), 1000 + stabilised * 5 * settled) << height;
    EXPECT_NEAR(run.end("y"), 0, 1e-12 * height);
  }
}

}  // namespace
}  // namespace trammel::test
