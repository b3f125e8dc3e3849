// Compliant contacts: entry and exit are events, located, and what happens between them obeys the law.
//
//     A mass m at speed v against F = K |gap|: in touch for pi / sqrt(K/m), back with v; depth v / sqrt(K/m).
#include <cmath>
#include <numbers>
#include <random>

#include <nlohmann/json.hpp>

#include "block.hpp"
#include "support/between.hpp"
#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

// 2 m/s from 1 m, m = 1, K = 1e4: in touch from 0.5 s for pi/100 s.
const std::string linear_buffer = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"ball": {"type": "point_mass", "mass": 1, "position": [0, 1], "velocity": [0, -2]}},
  "contacts": {"buffer": {"type": "continuous_force", "stiffness": 1e4, "exponent": 1, "damping": "none",
                          "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
  "integrator": {"type": "runge_kutta_4", "step": 1e-3, "contact_step": 1e-4},
  "simulate": {"until": 0.8},
  "record": {"every": 1e-2, "observe": {"y": "ball.point.y", "vy": "ball.point.vy"}}
})";

class Buffer : public testing::TestWithParam<Method> {};

TEST_P(Buffer, IsEnteredAndLeftWhenItsClosedFormSays) {
  const Finished run = run_text(linear_buffer, {{"integrator", GetParam().json}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.events.size(), 2u);
  EXPECT_EQ(run.events[0].kind, "contact_close");
  EXPECT_EQ(run.events[1].kind, "contact_open");
  EXPECT_NEAR(run.events[0].t, 0.5, 1e-14);
  EXPECT_DOUBLE_EQ(run.events[0].detail.at("approach"), 2);
  // (h omega)^4 / 120 of the half period for the least accurate one, omega = 100.
  EXPECT_NEAR(run.events[1].t, 0.5 + pi / 100, 1e-11);
  EXPECT_NEAR(run.events[1].detail.at("separation"), 2, 1e-8);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(
    All, Buffer,
    testing::Values(Method{"runge_kutta_4", R"({"type": "runge_kutta_4", "step": 1e-3, "contact_step": 1e-4})"},
                    Method{"dop853", R"({"type": "dop853", "step": {"tolerance": 1e-12}})"},
                    Method{"dormand_prince", R"({"type": "dormand_prince", "step": {"tolerance": 1e-12}})"}),
    method_name);

TEST(CompliantContact, IsLocatedToTheOrderOfASecondOrderMethod) {
  const auto error = [](const char* step) {
    const Finished run =
        run_text(linear_buffer,
                 {{"integrator",
                   fmt::format(R"({{"type": "hht_alpha", "alpha": 0, "step": 1e-3, "contact_step": {}}})", step)}});
    return run.of_kind("contact_open").at(0).t - (0.5 + pi / 100);
  };
  EXPECT_NEAR(error("2e-4") / error("1e-4"), 4, 0.4);
}

TEST(CompliantContact, MayBeShorterThanAStepAndIsStillSeen) {
  // In touch for pi/1e4 s, a third of a step: the gap is positive at both ends.
  const Finished run =
      run_text(linear_buffer, {{"contacts.buffer.stiffness", "1e8"}, {"integrator.contact_step", "1e-6"}});
  ASSERT_EQ(run.events.size(), 2u);
  EXPECT_NEAR(run.events[1].t - run.events[0].t, pi / 1e4, 1e-9);
}

TEST(CompliantContact, IsLeftOnlyByAContactThatSeparates) {
  // A ball dropped on a spring stays on it: damped, it comes to rest at m g / K.
  const Finished run =
      run_text(ball, {{"contacts.floor", R"({"type": "continuous_force", "stiffness": 1e3, "exponent": 1,
      "restitution": 0.2, "damping": "hunt_crossley",
      "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"},
                      {"bodies.ball.position", "[0, 0.001]"},
                      {"integrator.step", "1e-3"},
                      {"integrator.contact_step", "1e-4"},
                      {"record.observe", R"({"y": "ball.point.y"})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.events.back().kind, "contact_close");
  EXPECT_NEAR(run.end("y"), -1e-3, 2e-5);  // the hysteresis damps ever less, in proportion to the depth
}

TEST(CompliantContact, DissipatesWhatItsLedgerSays) {
  for (const char* law : {"lankarani_nikravesh", "hunt_crossley", "flores"}) {
    const Finished run = run_text(linear_buffer, {{"contacts.buffer.damping", law},
                                                  {"contacts.buffer.restitution", "0.7"},
                                                  {"contacts.buffer.exponent", "1.5"},
                                                  {"contacts.buffer.stiffness", "1e5"}});
    const double separation = run.of_kind("contact_open").at(0).detail.at("separation");
    const double lost = 0.5 * (4 - separation * separation);
    EXPECT_GT(lost, 0.2) << law;
    EXPECT_NEAR(run.result["energy_dissipated"]["contact_damping"].get<double>(), lost, 1e-5 * lost) << law;
    EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-5 * lost) << law;
  }
}

// Hysteresis damping is over the approach speed, so a contact that begins at rest has none: with next to no speed in
// its place it would be a viscosity that makes a spring of 2 kHz a matter of nanoseconds, and fixed steps of 1e-4 s
// blow up.
TEST(CompliantContact, BegunAtRestKeepsItsEnergy) {
  for (const char* position : {"[0, 0]", "[0, -1e-4]", "[0, -4.5819e-4]"}) {
    const Finished run = run_text(linear_buffer, {{"gravity", "[0, -9.81]"},
                                                  {"bodies.ball.velocity", "[0, 0]"},
                                                  {"bodies.ball.position", position},
                                                  {"contacts.buffer.exponent", "1.5"},
                                                  {"contacts.buffer.stiffness", "1e6"},
                                                  {"contacts.buffer.damping", "lankarani_nikravesh"},
                                                  {"contacts.buffer.restitution", "0.5"},
                                                  {"integrator.step", "1e-4"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-9) << position;
    EXPECT_EQ(run.result["energy_dissipated"]["contact_damping"].get<double>(), 0) << position;
    for (const double v : run.series.at("vy")) EXPECT_LT(std::abs(v), 0.08) << position;  // of the swing about its rest
  }
}

// The heads of the cards move alike, so the apex that sticks between them has no depth, and its force is round-off: it
// neither has events nor shortens steps.
TEST(CompliantContact, ThatOnlyTouchesDoesNotHoldUpTheOthers) {
  for (const double mu : {0.1, 0.2})
    for (const double stiffness : {1e4, 1e5}) {
      const std::string law = fmt::format(
          R"("type": "continuous_force", "exponent": 1, "stiffness": {}, "restitution": 0, "damping": "hunt_crossley",
             "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}})",
          stiffness, mu, mu);
      const auto contact = [&law](const char* marker, const char* plane) {
        return fmt::format(R"({{{}, "between": ["{}", {{"plane": {{{}}}}}]}})", law, marker, plane);
      };
      const char *floor = R"("point": [0, 0], "normal": [0, 1])",
                 *roof = R"("point": [0, 0], "normal": [0, -1], "on": "roof.middle")",
                 *head = R"x("point": [0, 0], "normal": ["=-cos(a)", "=sin(a)"], "on": "right.head")x";
      const Finished run =
          run_file("contact/card_house.json", {{"contacts.left_foot", contact("left.foot", floor)},
                                               {"contacts.right_foot", contact("right.foot", floor)},
                                               {"contacts.apex", contact("left.head", head)},
                                               {"contacts.roof_left", contact("left.head", roof)},
                                               {"contacts.roof_right", contact("right.head", roof)},
                                               {"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-9}})"},
                                               {"simulate.until", "0.01"}});
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_LT(run.result["counts"]["steps"], 5000) << mu << " " << stiffness;
      EXPECT_LT(run.result["counts"]["locating_steps"], 20000) << mu << " " << stiffness;
    }
}

// A block whose two feet just touch the floor, with a bar hinged to its side and a load on the bar that grows with t.
nlohmann::json block_that_just_touches(std::mt19937& random) {
  const double w = between(random, 0.2, 0.5), h = between(random, 0.1, 0.3), bar = between(random, 0.2, 0.5);
  const double m = between(random, 0.5, 4);
  nlohmann::json s = {{"trammel", 1},
                      {"space", "planar"},
                      {"gravity", {0, -9.81}},
                      {"bodies",
                       {{"block", standing_block(0, w, h, between(random, 2, 8))},
                        {"bar",
                         {{"type", "rigid_body"},
                          {"mass", m},
                          {"inertia", m * bar * bar / 12},
                          {"position", {w + bar / 2, h / 2}},
                          {"markers", {{"left", {-bar / 2, 0}}, {"right", {bar / 2, 0}}}}}}}},
                      {"joints", {{"hinge", {{"type", "revolute"}, {"between", {"block.right", "bar.left"}}}}}},
                      {"simulate", {{"until", 0.01}}},
                      {"record", {{"every", 0.005}, {"observe", {{"x", "block.com.x"}}}}}};
  const std::string x = fmt::format("={}*t", between(random, 10, 40)), y = fmt::format("={}*t", between(random, -5, 5));
  s["forces"]["pull"] = {{"type", "load"}, {"on", "bar.right"}, {"force", {{"x", x}, {"y", y}}}};
  for (const char* foot : {"bl", "br"}) {
    const double mu = between(random, 0.05, 0.4);
    s["contacts"][foot] = {
        {"type", "continuous_force"},
        {"stiffness", 1e3},
        {"exponent", 1},
        {"damping", "none"},
        {"between", {std::string("block.") + foot, {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}}}}}},
        {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}}};
  }
  return s;
}

// The load grows as t, and what presses the feet as t^2: one or both slip at once, before they stick.
TEST(CompliantContact, SlipsWhereNothingPressesYet) {
  std::mt19937 random(1);
  for (int i = 0; i < 40; ++i) {
    const Finished run = run_text(block_that_just_touches(random).dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << i << ": " << run.result["warnings"].dump();
    const std::vector<Event> slips = run.of_kind("slip");
    ASSERT_FALSE(slips.empty()) << i;
    EXPECT_LT(slips.front().t, 1e-10) << i;
  }
}

}  // namespace
}  // namespace trammel::test
