// Impacts against closed forms: a ball under gravity (parabolas, exact for every method here) and a mass on a spring.
//
//     ball from h = 1 m, g = 10:  t_n = sqrt(2h/g) + 2 v0/g (e + ... + e^n),  v_n = e^n v0,  apex h e^(2n)
#include <cmath>
#include <numbers>
#include <random>

#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

const double v0 = std::sqrt(20.0), t0 = std::sqrt(0.2);

double impact_time(int n, double e) {
  double t = t0;
  for (int i = 1; i <= n; ++i) t += 0.2 * v0 * std::pow(e, i);
  return t;
}

class BouncingBall : public testing::TestWithParam<Method> {};

TEST_P(BouncingBall, StrikesWhenAndAsFastAsItsClosedForm) {
  const double e = 0.9;
  const Finished run = run_text(ball, {{"integrator", GetParam().json}, {"contacts.floor.restitution", "0.9"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> impacts = run.of_kind("impact");
  ASSERT_EQ(impacts.size(), 3u);  // at 0.447, 1.252, 1.977 s
  for (int n = 0; n < 3; ++n) {
    // Round-off of the steps, 2000 of them at most, and of t.
    EXPECT_NEAR(impacts[n].t, impact_time(n, e), 1e-11);
    EXPECT_NEAR(impacts[n].detail.at("approach"), std::pow(e, n) * v0, 1e-10);
    EXPECT_DOUBLE_EQ(impacts[n].detail.at("separation"), e * impacts[n].detail.at("approach"));
    EXPECT_NEAR(impacts[n].detail.at("impulse"), 0.1 * (1 + e) * std::pow(e, n) * v0, 1e-11);
  }
}

TEST_P(BouncingBall, RisesToItsApexes) {
  const double e = 0.9, apex_time = impact_time(0, e) + e * v0 / 10;
  const Finished run = run_text(ball, {{"integrator", GetParam().json},
                                       {"contacts.floor.restitution", "0.9"},
                                       {"simulate.until", fmt::format("{:.17g}", apex_time)}});
  EXPECT_NEAR(run.end("y"), e * e, 1e-10);
  EXPECT_NEAR(run.end("x"), 0.5 * apex_time, 1e-10);  // the floor is smooth
}

INSTANTIATE_TEST_SUITE_P(FixedSteps, BouncingBall, testing::ValuesIn(fixed_methods("1e-3")), method_name);
INSTANTIATE_TEST_SUITE_P(Controlled, BouncingBall, testing::ValuesIn(controlled_methods("1e-12")), method_name);

TEST(BouncingBallSticks, WhereTheNextFlightWouldBeShorterThanThreeSteps) {
  const double h = 1e-3, e = 0.5;
  const Finished run = run_text(ball);
  int last = 0;
  while (2 * v0 * std::pow(e, last + 1) / 10 >= 3 * h) ++last;
  EXPECT_EQ(run.result["counts"]["impacts"], last + 1);
  const std::vector<Event> closed = run.of_kind("contact_close");
  ASSERT_EQ(closed.size(), 1u);
  EXPECT_NEAR(closed[0].t, impact_time(last, e), 1e-11);
  EXPECT_EQ(run.events.back().kind, "contact_close");
}

TEST(BouncingBallSticks, BelowTheCaptureSpeedWithControlledSteps) {
  const Finished run = run_text(ball, {{"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-10}})"},
                                       {"contacts.floor.capture_speed", "1e-3"}});
  int last = 0;
  while (v0 * std::pow(0.5, last) > 1e-3) ++last;
  EXPECT_EQ(run.result["counts"]["impacts"], last + 1);
  ASSERT_EQ(run.of_kind("contact_close").size(), 1u);
  EXPECT_NEAR(run.of_kind("contact_close")[0].t, impact_time(last, 0.5), 1e-11);
}

TEST(BouncingBallSticks, AfterEveryFlightIfChatterIsAskedFor) {
  const Finished run = run_text(ball, {{"simulate.chatter_steps", "1e4"}});  // flights up to 10 s
  EXPECT_EQ(run.result["counts"]["impacts"], 1);
  EXPECT_EQ(run.of_kind("contact_close").size(), 1u);
}

TEST(PlasticImpact, RestsAtOnceHeldByItsWeight) {
  const Finished run = run_text(ball, {{"contacts.floor.restitution", "0"}});
  ASSERT_EQ(run.events.size(), 2u);
  EXPECT_EQ(run.events[0].kind, "impact");
  EXPECT_EQ(run.events[1].kind, "contact_close");
  EXPECT_NEAR(run.end("y"), 0, 1e-15);
  EXPECT_NEAR(run.end("force"), 1, 1e-12);  // m g
  EXPECT_NEAR(run.end("x"), 1, 1e-12);
  EXPECT_NEAR(run.result["energy_dissipated"]["impact_total"], 1, 1e-11);  // m g h
}

TEST(ElasticImpact, KeepsTheEnergy) {
  const Finished run = run_text(ball, {{"contacts.floor.restitution", "1"}, {"simulate.until", "50"}});
  EXPECT_EQ(run.result["counts"]["impacts"], int((50 - t0) / (2 * t0)) + 1);
  // 56 impacts located to an ulp of t; m g v ulp(50) = 3e-14 each, and 50000 steps of round-off.
  EXPECT_NEAR(run.end("energy_total"), 1.0125, 1e-11);
  EXPECT_EQ(run.result["energy_dissipated"]["impact_total"], 0);
}

TEST(ElasticImpact, IsNoChatterHoweverShortTheFlightIsForTheSteps) {
  const Finished run = run_text(ball, {{"contacts.floor.restitution", "1"}, {"simulate.chatter_steps", "1e4"}});
  EXPECT_GT(run.result["counts"]["impacts"], 1);
  EXPECT_NEAR(run.end("energy_total"), 1.0125, 1e-11);
}

// Two balls that strike at the same instants, one of which sticks for the shortness of its flight.
TEST(ElasticImpact, IsNoChatterBesideOneThatIs) {
  const Finished run = run_text(ball, {{"bodies.hard", R"({"type": "point_mass", "mass": 0.1, "position": [5, 1]})"},
                                       {"contacts.hard", R"({"type": "constraint_method", "restitution": 1,
                                   "between": ["hard.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"},
                                       {"simulate.chatter_steps", "1e4"}});
  EXPECT_EQ(run.result["counts"]["impacts"], 3);  // of the other one at sqrt(0.2) s, 3 sqrt(0.2) s, and the one's
  EXPECT_NEAR(run.end("energy_total"), 1 + 0.0125, 1e-11);
}

TEST(OscillatorAgainstAWall, FliesHalfAPeriodWhateverItsSpeed) {
  const Finished run = run_text(oscillator);
  const std::vector<Event> impacts = run.of_kind("impact");
  ASSERT_EQ(impacts.size(), 3u);
  for (int n = 0; n < 3; ++n) {
    // Fourth order: h^4/120 of phase a unit of time.
    EXPECT_NEAR(impacts[n].t, pi / 2 + n * pi, 1e-8 / 120 * 10);
    EXPECT_NEAR(impacts[n].detail.at("approach"), std::pow(0.5, n), 1e-9);
  }
}

TEST(OscillatorAgainstAWall, IsStruckToTheToleranceOfControlledSteps) {
  for (const Method& method : controlled_methods("1e-11")) {
    if (method.name == "hht_alpha_controlled") continue;  // second order: too many steps at this tolerance
    const Finished run = run_text(oscillator, {{"integrator", method.json}});
    const std::vector<Event> impacts = run.of_kind("impact");
    ASSERT_EQ(impacts.size(), 3u) << method.name;
    for (int n = 0; n < 3; ++n)
      EXPECT_NEAR(impacts[n].t, pi / 2 + n * pi, 1e-9) << method.name;  // 100 steps of the tolerance
  }
}

TEST(OscillatorAgainstAWall, ConvergesWithTheOrderOfTheMethod) {
  // Locating an event must not cost the method its order: the error of the third impact falls by 2^p.
  for (const auto& [type, factor] : {std::pair{"newmark", 4.0}, {"runge_kutta_4", 16.0}}) {
    const auto error = [&](const char* step) {
      const Finished run = run_text(oscillator, {{"integrator.type", type}, {"integrator.step", step}});
      return run.of_kind("impact").at(2).t - 2.5 * pi;
    };
    EXPECT_NEAR(error("0.05") / error("0.025"), factor, 0.1 * factor) << type;
  }
}

// A step of exponential collocation may hold a hundred swings, and the cubic through its ends none of them.
TEST(OscillatorAgainstAWall, IsStruckInItsFirstSwingThoughAStepMayHoldManySwings) {
  for (const char* tolerance : {"1e-4", "1e-8"})
    for (double x = -0.9; x < 0.95; x += 0.1) {  // of the wall; the mass is at cos 1000 t
      const std::string wall =
          fmt::format(R"(["mass.point", {{"plane": {{"point": [0, {:.17g}], "normal": [0, 1]}}}}])", 1 + x);
      const Finished run =
          run_text(oscillator,
                   {{"forces.spring.stiffness", "1e6"},
                    {"contacts.wall.between", wall},
                    {"simulate.until", "0.01"},
                    {"record.every", "0.01"},
                    {"integrator",
                     fmt::format(R"({{"type": "exponential_collocation", "step": {{"tolerance": {}}}}})", tolerance)}});
      ASSERT_TRUE(run.done()) << run.report.reason;
      const std::vector<Event> impacts = run.of_kind("impact");
      ASSERT_FALSE(impacts.empty()) << x;
      EXPECT_NEAR(impacts[0].t, std::acos(x) / 1000, 1e-10) << x;  // the motion is exact whatever the tolerance
    }
}

// Pressed on the wall by a stretched spring, y'' = -y - 1 (y from the wall): each flight of speed u lasts 2 atan(u). At
// the end of a step of a period and a bit the mass would be back above the wall, or rising below it.
TEST(ReboundWithinAStep, IsFoundHoweverFarTheFreeStepGoes) {
  for (const char* step : {"0.5", "2", "5.2", "6.2", "6.4", "7"}) {
    const Finished run =
        run_text(oscillator, {{"bodies.mass.position", "[0, 1]"},
                              {"bodies.mass.velocity", "[0, 1]"},
                              {"forces.spring.length", "0"},
                              {"contacts.wall.restitution", "0.8"},
                              {"simulate.until", "7"},
                              {"simulate.chatter_steps", "0"},
                              {"record.every", "7"},
                              {"integrator", fmt::format(R"({{"type": "dop853", "step": {}}})", step)}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    const std::vector<Event> impacts = run.of_kind("impact");
    double u = 1, t = 0;
    std::size_t n = 0;
    while (t + 2 * std::atan(u) < 7) {
      t += 2 * std::atan(u);
      ASSERT_LT(n, impacts.size()) << step;
      // One step a flight, of pi/2 at most: eighth order leaves d = 3e-6 of the first, whose rate, off by as much,
      // moves all that follow by 2 d (0.8 + 0.64 + ...).
      EXPECT_NEAR(impacts[n].t, t, 9 * 3e-6) << step;
      u *= 0.8, ++n;
    }
    EXPECT_EQ(n, 7u);
    EXPECT_EQ(impacts.size(), n) << step;
  }
}

// An exact step of a period and a bit less than a quarter, or more, ends above the wall. Where the mass falls there the
// cubic through both ends has no minimum: only its acceleration at the beginning shows that the flight ends.
TEST(ReboundWithinAStep, IsFoundWhereTheFreeStepEndsAboveTheWallAndFalls) {
  for (const char* step : {"7.1", "7.3", "7.6"}) {
    const Finished run = run_text(
        oscillator, {{"bodies.mass.position", "[0, 1]"},
                     {"bodies.mass.velocity", "[0, 1]"},
                     {"forces.spring.length", "0"},
                     {"contacts.wall.restitution", "0.8"},
                     {"simulate.until", step},
                     {"simulate.chatter_steps", "0"},
                     {"record.every", step},
                     {"integrator", fmt::format(R"({{"type": "exponential_collocation", "step": {}}})", step)}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    const std::vector<Event> impacts = run.of_kind("impact");
    ASSERT_FALSE(impacts.empty());
    EXPECT_NEAR(impacts[0].t, std::numbers::pi / 2, 1e-10) << step;  // the motion is exact
  }
}

TEST(BouncingBallSticks, WhereControlledStepsCannotTellItsRiseFromTheirError) {
  // Rises of e^(2n) m; the steps may be wrong by 1e-6 (1 + 1 m), three times that sticks.
  const Finished run = run_text(ball, {{"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-6}})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  int last = 0;
  while (std::pow(0.25, last + 1) >= 6e-6) ++last;
  EXPECT_EQ(run.result["counts"]["impacts"], last + 1);
  ASSERT_EQ(run.of_kind("contact_close").size(), 1u);
}

// The ball's scene with all lengths times s.
Finished scaled(double s, const char* contact) {
  return run_text(ball, {{"gravity", fmt::format("[0, {:.17g}]", -10 * s)},
                         {"bodies.ball.position", fmt::format("[0, {:.17g}]", s)},
                         {"bodies.ball.velocity", fmt::format("[{:.17g}, 0]", 0.5 * s)},
                         {"contacts.floor", contact},
                         {"integrator", R"({"type": "runge_kutta_4", "step": 1e-3})"}});
}

TEST(ScaledScene, HasTheSameEventsScaled) {
  for (const double s : {1e-6, 1e-3, 1e3, 1e6}) {
    const auto rigid = [](double scale) {
      return fmt::format(R"({{"type": "constraint_method", "restitution": 0.5, "capture_speed": {:.17g},
          "between": ["ball.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                         1e-6 * scale);
    };
    const Finished one = scaled(1, rigid(1).c_str()), run = scaled(s, rigid(s).c_str());
    ASSERT_TRUE(run.done()) << run.report.reason;
    ASSERT_EQ(run.events.size(), one.events.size()) << s;
    for (std::size_t i = 0; i < one.events.size(); ++i) {
      EXPECT_EQ(run.events[i].kind, one.events[i].kind);
      EXPECT_NEAR(run.events[i].t, one.events[i].t, 1e-11);  // round-off of 2000 steps
      if (one.events[i].kind != "impact") continue;
      EXPECT_NEAR(run.events[i].detail.at("impulse") / s, one.events[i].detail.at("impulse"), 1e-10);
    }
    EXPECT_NEAR(run.end("x") / s, one.end("x"), 1e-12);
  }
}

TEST(ScaledScene, OfACompliantContactHasTheSameEventsScaled) {
  const auto soft = [](double) {
    return R"({"type": "continuous_force", "stiffness": 1e3, "exponent": 1, "restitution": 0.8,
          "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})";
  };
  const Finished one = scaled(1, soft(1));
  for (const double s : {1e-6, 1e6}) {
    const Finished run = scaled(s, soft(s));
    ASSERT_TRUE(run.done()) << run.report.reason;
    ASSERT_EQ(run.events.size(), one.events.size()) << s;
    for (std::size_t i = 0; i < one.events.size(); ++i) EXPECT_NEAR(run.events[i].t, one.events[i].t, 1e-10);
  }
}

// A rod slides with its tip on a rough floor, and falls. Where steps have left a rate in its closed tip, an impact of
// the other end may still stop the slip of the tip at once.
TEST(FallingRod, RubsAndBouncesUntilItRests) {
  std::mt19937 random(1);
  const auto any = [&random](double from, double to) { return from + (to - from) * double(random()) / 4294967296.0; };
  constexpr double g = 9.81;
  for (int i = 0; i < 40; ++i) {
    const double length = std::pow(10, any(-3, 1)), mass = std::pow(10, any(-3, 2)), mu = any(0.5, 2),
                 angle = any(0.9, 1.2), speed = 0.3 * std::sqrt(g * length), height = length / 2 * std::sin(angle);
    const auto contact = [&](const char* marker) {
      return nlohmann::json{{"type", "constraint_method"},
                            {"restitution", any(0.1, 0.4)},
                            {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}},
                            {"between", {marker, {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}}}}}}};
    };
    const double until = 3 * std::sqrt(length / g), tolerance = std::pow(10, -4 - i % 4);
    const nlohmann::json scene = {{"trammel", 1},
                                  {"space", "planar"},
                                  {"gravity", {0, -g}},
                                  {"bodies",
                                   {{"rod",
                                     {{"type", "rigid_body"},
                                      {"mass", mass},
                                      {"inertia", mass * length * length / 12},
                                      {"position", {length / 2 * std::cos(angle), height}},
                                      {"angle", angle},
                                      {"velocity", {speed, 0}},
                                      {"markers", {{"tip", {-length / 2, 0}}, {"end", {length / 2, 0}}}}}}}},
                                  {"contacts", {{"tip", contact("rod.tip")}, {"end", contact("rod.end")}}},
                                  {"integrator", {{"type", "dop853"}, {"step", {{"tolerance", tolerance}}}}},
                                  {"record", {{"every", until}, {"observe", {{"y", "rod.com.y"}}}}},
                                  {"simulate", {{"until", until}}}};
    const Finished run = run_text(scene.dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_NEAR(run.end("y"), 0, tolerance * length) << i;
    const double before = mass * (speed * speed / 2 + g * height);
    EXPECT_NEAR(run.result["energy_end"]["total"], 0, tolerance * before) << i;
  }
}

}  // namespace
}  // namespace trammel::test
