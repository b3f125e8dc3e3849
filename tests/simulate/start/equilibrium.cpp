// "initial": "equilibrium": the state of rest that a run starts from, against closed forms.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

// The row at t = 0 of a run that ends there.
Finished at_rest(const std::string& bodies, const std::string& rest, const std::string& observe) {
  return run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, -10], "bodies": )" + bodies + ", " + rest +
                  R"(, "initial": "equilibrium", "integrator": {"type": "dormand_prince", "step": {"tolerance": 1e-9}},
                  "simulate": {"until": 0}, "record": {"every": 1, "observe": )" +
                  observe + "}}");
}

const char* const floor_of_ball = R"("between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})";

TEST(Equilibrium, OfAWeightOnASpringIsItsSag) {
  const Finished run =
      at_rest(R"({"ball": {"type": "point_mass", "mass": 2, "position": [0.3, 1]}})",
              R"("forces": {"spring": {"type": "spring_damper", "between": [{"point": [0.3, 2]}, "ball.point"],
                                 "stiffness": 400, "damping": 3, "length": 1}})",
              R"({"x": "ball.point.x", "y": "ball.point.y", "vy": "ball.point.vy", "ay": "ball.point.ay"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("y"), 1 - 20.0 / 400, 1e-14);
  EXPECT_NEAR(run.end("x"), 0.3, 1e-14);
  EXPECT_EQ(run.end("vy"), 0);
  EXPECT_NEAR(run.end("ay"), 0, 1e-12);
}

// In units of length, under the same gravity: stiffnesses are per unit.
struct Hanging {
  const char* how;
  std::string scene(double unit) const {
    const auto m = [&](double x) { return fmt::format("{:.17g}", x * unit); };
    const std::string kind = how;
    const std::string place = kind == "by a hinge" ? m(-0.3) + ", " + m(-0.1)
                              : kind == "on feet"  ? "0, " + m(0.2)
                                                   : "0, 0";
    const auto foot = [&](const char* name) {
      return fmt::format(R"("{0}": {{"type": "constraint_method", "between": ["b.{0}",
          {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                         name);
    };
    const std::string rest = kind == "on a spring" ? fmt::format(R"("forces": {{"s": {{"type": "spring_damper",
            "between": [{{"point": [0, {}]}}, "b.p"], "stiffness": {:.17g}, "length": {}}}}})",
                                                                 m(1), 100 / unit, m(0.5))
                             : kind == "by a hinge"
                                 ? R"("joints": {"j": {"type": "revolute", "between": ["ground", "b.p"]}})"
                                 : fmt::format(R"("contacts": {{{}, {}}})", foot("l"), foot("r"));
    return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
      "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "position": [{}],
                         "markers": {{"p": [{}, {}], "l": [{}, 0], "r": [{}, 0]}}}}}},
      {}, "initial": "equilibrium", "simulate": {{"until": 0}},
      "record": {{"every": 1, "observe": {{"x": "b.com.x", "y": "b.com.y", "angle": "b.angle"}}}}}})",
                       unit * unit / 12, place, m(0.3), m(0.1), m(-0.5), m(0.5), rest);
  }
};

TEST(Equilibrium, IsTheSameInAnyUnitOfLength) {
  for (const Hanging& body : {Hanging{"on a spring"}, Hanging{"by a hinge"}, Hanging{"on feet"}}) {
    const Finished here = run_text(body.scene(1));
    ASSERT_TRUE(here.done()) << body.how << ": " << here.report.reason;
    for (const double unit : {1e-9, 1e-6, 1e-3, 1e3, 1e6}) {
      const Finished there = run_text(body.scene(unit));
      ASSERT_TRUE(there.done()) << body.how << ", " << unit << ": " << there.report.reason;
      EXPECT_NEAR(there.end("x") / unit, here.end("x"), 1e-11) << body.how << ", " << unit;
      EXPECT_NEAR(there.end("y") / unit, here.end("y"), 1e-11) << body.how << ", " << unit;
      EXPECT_NEAR(there.end("angle"), here.end("angle"), 1e-11) << body.how << ", " << unit;
    }
  }
}

TEST(Equilibrium, OfAPendulumHangsThoughItStartedNearTheTop) {
  const Finished run = at_rest(
      R"json({"rod": {"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": ["=cos(1.4)", "=sin(1.4)"], "angle": 1.4,
                  "markers": {"hinge": [-1, 0]}}})json",
      R"("joints": {"hinge": {"type": "revolute", "between": ["ground", "rod.hinge"]}})", R"({"angle": "rod.angle"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("angle"), -pi / 2, 1e-13);
}

TEST(Equilibrium, OfABallAboveAHertzContactIsItsIndentation) {
  const Finished run = at_rest(R"({"ball": {"type": "point_mass", "mass": 2, "position": [0.7, 1]}})",
                               R"("contacts": {"floor": {"type": "continuous_force", "stiffness": 1e7, "exponent": 1.5,
                                 "damping": "none", )" +
                                   std::string(floor_of_ball) + "}",
                               R"({"x": "ball.point.x", "y": "ball.point.y", "force": "contacts.floor.force"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("y"), -std::pow(20 / 1e7, 1 / 1.5), 1e-15);
  EXPECT_NEAR(run.end("x"), 0.7, 1e-14);
  EXPECT_NEAR(run.end("force"), 20, 1e-9);
}

TEST(Equilibrium, OfABlockAboveRigidContactsRestsOnThem) {
  const char* const feet = R"("contacts": {
    "left": {"type": "constraint_method", "between": ["block.left", {"plane": {"point": [0, 0], "normal": [0, 1]}}]},
    "right": {"type": "constraint_method", "between": ["block.right", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}})";
  const Finished run =
      at_rest(R"({"block": {"type": "rigid_body", "mass": 3, "inertia": 0.4, "position": [0.1, 0.9], "angle": 0.2,
                                 "markers": {"left": [-0.4, -0.5], "right": [0.8, -0.5]}}})",
              feet,
              R"({"y": "block.com.y", "angle": "block.angle", "left": "contacts.left.force",
                                 "right": "contacts.right.force"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("y"), 0.5, 1e-14);
  EXPECT_NEAR(run.end("angle"), 0, 1e-14);
  EXPECT_NEAR(run.end("left"), 20, 1e-11);
  EXPECT_NEAR(run.end("right"), 10, 1e-11);
}

TEST(Equilibrium, LetsContactsGoThatWouldPull) {
  // It starts on the floor, under a spring that holds the weight higher up.
  const Finished run = at_rest(
      R"({"ball": {"type": "point_mass", "mass": 1, "position": [0, 0]}})",
      R"("forces": {"spring": {"type": "spring_damper", "between": [{"point": [0, 3]}, "ball.point"], "stiffness": 100,
                    "length": 1}},
         "contacts": {"floor": {"type": "constraint_method", )" +
          std::string(floor_of_ball) + "}",
      R"({"y": "ball.point.y", "closed": "contacts.floor.closed"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("y"), 2 - 0.1, 1e-13);
  EXPECT_EQ(run.end("closed"), 0);
}

// A light ball that a spring holds off the floor it starts on, and a heavy block on the floor, which nothing ties to it
// but what `heavy` adds.
std::string beside(const char* heavy, double mass) {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -10],
  "parameters": {{"M": {:.17g}}},
  "bodies": {{"ball": {{"type": "point_mass", "mass": 1e-3, "position": [0, 0]}},
             "block": {{"type": "point_mass", "mass": "=M", "position": [5, 0]}}}},
  "joints": {{"ball": {{"type": "point_on_line", "between": ["ground", "ball.point"], "axis": [0, 1]}},
             "block": {{"type": "point_on_line", "between": [{{"point": [5, 0]}}, "block.point"], "axis": [0, 1]}}}},
  "forces": {{"spring": {{"type": "spring_damper", "between": [{{"point": [0, 1]}}, "ball.point"], "stiffness": 1,
                        "length": 0.985}}{}}},
  "contacts": {{"floor": {{"type": "constraint_method", {},
               "other": {{"type": "constraint_method",
                         "between": ["block.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": 1}},
  "record": {{"every": 1, "observe": {{"y": "ball.point.y", "N": "contacts.floor.force"}}}}}})",
                     mass, heavy, floor_of_ball);
}

TEST(Equilibrium, OfALightBodyDoesNotDependOnAHeavyOneElsewhere) {
  for (
      const char* heavy :
      {"",
       R"(, "tie": {"type": "spring_damper", "between": ["block.point", "ball.point"], "stiffness": 1e-9, "length": 5})"})
    for (const double mass : {1e-3, 1.0, 1e3, 1e6, 1e9, 1e12}) {
      const std::string scene = beside(heavy, mass);
      for (const Finished& run :
           {run_text(scene, {{"initial", "\"equilibrium\""}}), run_static(scene, {{"static.steps", "1"}})}) {
        ASSERT_TRUE(run.done()) << run.report.reason;
        EXPECT_NEAR(run.end("y"), 0.005, 1e-10) << "mass " << mass;  // LoadPath: 1e-9 of the load; the tie: less
        EXPECT_EQ(run.end("N"), 0) << "mass " << mass;
      }
    }
}

TEST(Equilibrium, OnATableInUniformTranslationMovesWithIt) {
  const Finished run = at_rest(
      R"json({"table": {"type": "moving_base", "x": "=0.3*sin(7*t)", "y": "=0.2*t"},
          "block": {"type": "rigid_body", "mass": 3, "inertia": 0.4, "position": [0, 0.5],
                    "markers": {"left": [-0.4, -0.5], "right": [0.4, -0.5]}}})json",
      R"("contacts": {
        "left": {"type": "continuous_force", "stiffness": 1e5, "restitution": 0.5, "friction": {"type": "coulomb", "static": 0.5, "kinetic": 0.4},
                 "between": ["block.left", {"plane": {"point": [0, 0], "normal": [0, 1], "on": "table.origin"}}]},
        "right": {"type": "continuous_force", "stiffness": 1e5, "restitution": 0.5, "friction": {"type": "coulomb", "static": 0.5, "kinetic": 0.4},
                 "between": ["block.right", {"plane": {"point": [0, 0], "normal": [0, 1], "on": "table.origin"}}]}})",
      R"({"vx": "block.com.vx", "vy": "block.com.vy", "omega": "block.com.omega"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("vx"), 2.1, 1e-12);
  EXPECT_NEAR(run.end("vy"), 0.2, 1e-12);
  EXPECT_NEAR(run.end("omega"), 0, 1e-11);
}

TEST(Equilibrium, OnATableMovesWithItWhicheverWayFrictionIsDecided) {
  const Finished run = at_rest(
      R"json({"table": {"type": "moving_base", "x": "=0.3*sin(7*t)"}, "block": {"type": "point_mass", "mass": 3}})json",
      R"("contacts": {"foot": {"type": "continuous_force", "stiffness": 1e5, "restitution": 0.5,
          "friction": {"type": "coulomb", "static": 0.5, "kinetic": 0.4, "method": "lcp_every_step"},
          "between": ["block.point", {"plane": {"point": [0, 0], "normal": [0, 1], "on": "table.origin"}}]}})",
      R"({"vx": "block.point.vx"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("vx"), 2.1, 1e-12);
  EXPECT_EQ(run.of_kind("slip").size(), 0u);
}

TEST(Equilibrium, OfADrivenRodFollowsItsDrive) {
  // A pendulum on a hinge that a base carries round: its equilibrium hangs below the hinge, which moves with omega x r.
  const Finished run = at_rest(
      R"json({"wheel": {"type": "moving_base", "angle": "=2*t", "markers": {"rim": [1.5, 0]}},
          "rod": {"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [1.5, -1], "angle": "=-pi/2",
                  "markers": {"hinge": [-1, 0]}}})json",
      R"("joints": {"hinge": {"type": "revolute", "between": ["wheel.rim", "rod.hinge"]}})",
      R"({"vx": "rod.com.vx", "vy": "rod.com.vy", "omega": "rod.com.omega"})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("vx"), 0, 1e-9);  // (omega dt)^2 of the differences
  EXPECT_NEAR(run.end("vy"), 3, 1e-7);
  EXPECT_NEAR(run.end("omega"), 0, 1e-9);
}

TEST(Equilibrium, OfWhatNothingHoldsIsRefusedWithItsName) {
  try {
    at_rest(R"({"ball": {"type": "point_mass", "mass": 2, "position": [0, 1]}})", R"("forces": {})", "{}");
    FAIL() << "a falling ball has no equilibrium";
  } catch (const scene::SceneError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("no static equilibrium was found: bodies.ball is left with an acceleration of 10"), text.npos)
        << text;
  }
}

TEST(Equilibrium, IsOneOfTheWordsOfInitial) {
  try {
    run_text(R"({"trammel": 1, "bodies": {"ball": {"type": "point_mass", "mass": 2}}, "initial": "equilibrum",
      "integrator": {"type": "runge_kutta_4", "step": 1e-3}, "simulate": {"until": 1}})");
    FAIL();
  } catch (const scene::SceneError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("found \"equilibrum\", expected \"check\" or \"project\" or \"equilibrium\""), text.npos)
        << text;
    EXPECT_NE(text.find("Did you mean \"equilibrium\"?"), text.npos) << text;
  }
}

}  // namespace
}  // namespace trammel::test
