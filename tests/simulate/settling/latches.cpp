// Contacts that wait for a joint's row, and latches, which then hold it for good.
#include "simulate/start/setup.hpp"

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// Two points on the x axis, 1 and 3 kg, the left one on its way to the other with 2 m/s.
std::string points(const std::string& contact, const std::string& more = "") {
  return R"({"trammel": 1, "space": "planar",
    "bodies": {"left": {"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [2, 0]},
               "right": {"type": "point_mass", "mass": 3, "position": [3, 0]}},
    "contacts": {"stop": )" +
         contact + R"(},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-11}}, "simulate": {"until": 2},
    "record": {"every": 0.1, "observe": {"left": "left.point.x", "right": "right.point.x", "v_left": "left.point.vx",
                                         "v_right": "right.point.vx", "gap": "contacts.stop.gap"}})" +
         more + "}";
}
std::string at_distance(const char* type, const char* rest, double length, const char* from) {
  return fmt::format(R"({{"type": "{}"{}, "between": ["left.point", "right.point"], "from": "{}",
                         "reaches": {{"type": "distance", "length": {}}}}})",
                     type, rest, from, length);
}

TEST(Latch, LocksWithTheCommonVelocityAndTellsWhatItLost) {
  const Finished run = run_text(points(at_distance("latch", "", 1, "above")));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> locks = run.of_kind("latch");
  ASSERT_EQ(run.events.size(), 1u);
  ASSERT_EQ(locks.size(), 1u);
  EXPECT_NEAR(locks[0].t, 1, 1e-12);
  EXPECT_NEAR(locks[0].detail.at("energy_lost"), 1.5, 1e-12);  // 1/2 m_reduced u^2 = 0.75/2 4
  EXPECT_NEAR(run.end("v_left"), 0.5, 1e-12);
  EXPECT_NEAR(run.end("v_right"), 0.5, 1e-12);
  EXPECT_NEAR(run.result["energy_dissipated"]["impact"]["stop"].get<double>(), 1.5, 1e-12);
  EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-12);
}

TEST(Latch, HoldsWhenItIsPulled) {
  // The force on the right point pulls it away as soon as it is locked.
  const Finished run = run_text(
      points(at_distance("latch", "", 1, "above"),
             R"(, "forces": {"pull": {"type": "load", "on": "right.point", "force": {"x": "=step(t-1.2)*5"}}})"),
      {{"integrator", R"({"type": "runge_kutta_4", "step": 1e-3})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.events.size(), 1u);
  EXPECT_NEAR(run.end("right") - run.end("left"), 1, 1e-9);
}

TEST(Latch, HoldsThroughALaterImpact) {
  // Locked at t = 1, the pair goes on to the wall at x = 4 with 0.5 m/s and rebounds as one body.
  std::string scene = points(at_distance("latch", "", 1, "above"));
  const std::string wall = R"("wall": {"type": "constraint_method", "restitution": 0.5,
      "between": ["right.point", {"plane": {"point": [3.25, 0], "normal": [-1, 0]}}]}, )";
  scene.insert(scene.find("\"stop\""), wall);
  const Finished run = run_text(scene);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("impact").size(), 1u);
  EXPECT_NEAR(run.end("v_left"), -0.25, 1e-12);
  EXPECT_NEAR(run.end("v_right"), -0.25, 1e-12);
  EXPECT_NEAR(run.end("gap"), 0, 1e-12);
}

// A crank of 1 m and a rod of 2 m from its end to a slider on the x axis, which so comes as far as x = 3; or of 1 and 2
// units.
std::string slider(double wanted, const char* from, const std::string& crank_row = "", double unit = 1) {
  return fmt::format(R"json({{
    "trammel": 1, "space": "planar", "parameters": {{"u": {}}},
    "bodies": {{"pin": {{"type": "point_mass", "mass": 1, "position": [0, "=u"], "velocity": ["=u", 0]}},
               "slider": {{"type": "point_mass", "mass": 1, "position": ["=sqrt(3)*u", 0], "velocity": ["=u", 0]}}}},
    "joints": {{"crank": {{"type": "distance", "between": ["ground", "pin.point"], "length": {}}},
               "rod": {{"type": "distance", "between": ["pin.point", "slider.point"], "length": "=2*u"}},
               "guide": {{"type": "point_on_line", "between": ["ground", "slider.point"], "axis": [1, 0]}}}},
    "contacts": {{"stop": {{"type": "latch", "between": ["ground", "slider.point"], "from": "{}",
                          "reaches": {{"type": "distance", "length": {}}}}}}},
    "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-9}}}},
    "simulate": {{"until": 2}}, "initial": {{"consistent": "project"}}, "record": {{"every": 0.1}}}})json",
                     unit, crank_row.empty() ? R"("=u")" : crank_row, from, wanted * unit);
}
std::string refused(const std::string& scene) {
  try {
    simulate::set_up(scene::Scene::parse(scene, "test.json"), registry());
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(Latch, ThatTheJointsKeepFromClosingIsRefusedWithHowNearItComes) {
  const std::string far = refused(slider(3.25, "below")), near = refused(slider(0.75, "above"));
  EXPECT_NE(far.find("contacts.stop"), std::string::npos) << far;
  EXPECT_NE(far.find("can never lock"), std::string::npos) << far;
  // |d| - L at |d| = 3 and 1, whatever the scale of the distance's row
  EXPECT_NE(far.find("no nearer to 0 than 0.25 "), std::string::npos) << far;
  EXPECT_NE(near.find("no nearer to 0 than 0.25 "), std::string::npos) << near;
}

TEST(Latch, ThatCanJustCloseIsAccepted) {
  EXPECT_EQ(refused(slider(2.999, "below")), "");
  EXPECT_EQ(refused(slider(1.001, "above")), "");
}

TEST(Latch, IsJudgedAlikeAtEverySize) {
  for (const double unit : {1e-6, 1e-3, 1e3, 1e6}) {
    EXPECT_NE(refused(slider(3.25, "below", "", unit)).find("can never lock"), std::string::npos) << unit;
    EXPECT_EQ(refused(slider(2.9, "below", "", unit)), "") << unit;
  }
}

TEST(Latch, IsNotJudgedWhereRowsDependOnTime) {
  EXPECT_EQ(refused(slider(3.25, "below", "\"=1+0.5*t\"")), "");
}

TEST(RowLimit, IsARopeFromBelow) {
  // They fly apart and the rope of 4 m jerks them back, elastically: the velocities of an elastic collision.
  const Finished run = run_text(points(at_distance("constraint_method", R"(, "restitution": 1)", 4, "below")),
                                {{"bodies.left.velocity", "[-2, 0]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("impact").size(), 1u);
  EXPECT_NEAR(run.of_kind("impact")[0].t, 0.5, 1e-12);
  EXPECT_NEAR(run.end("v_left"), 1, 1e-12);
  EXPECT_NEAR(run.end("v_right"), -1, 1e-12);
}

TEST(RowLimit, TakesACompliantLawToo) {
  const Finished run = run_text(
      points(at_distance("continuous_force", R"(, "stiffness": 1e6, "exponent": 1, "damping": "none")", 1, "above")),
      {{"integrator", R"({"type": "runge_kutta_4", "step": 1e-4})"}, {"simulate.until", "1.1"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("v_left"), -1, 2e-6);  // elastic, up to the method's error in 27 steps of contact
  EXPECT_NEAR(run.end("v_right"), 1, 2e-6);
}

}  // namespace
}  // namespace trammel::test
