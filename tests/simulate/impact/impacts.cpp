// Laws of impact in whole runs: what they do alike, and which of them creates energy.
#include <cmath>

#include <gmock/gmock.h>

#include "../routh.hpp"
#include "simulate/impact/impact_warnings.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;

// Kane's paradox: a rod of mass 2 and inertia 1/6 strikes with its end, at 1 rad, 0.5 m/s along and 1 m/s down. Issue
// 27's scene.
const std::string rod = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"rod": {"type": "rigid_body", "mass": 2, "inertia": "=1/6", "position": [0, "=0.5*sin(1)+1e-4"], "angle": 1,
                     "velocity": [0.5, -1], "markers": {"end": [-0.5, 0]}}},
  "contacts": {"tip": {"type": "constraint_method", "restitution": 1, "impact_law": "newton",
                       "between": ["rod.end", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
                       "friction": {"type": "coulomb", "static": 0.5, "kinetic": 0.5}}},
  "integrator": {"type": "dop853", "step": 1e-3},
  "simulate": {"until": 0.002},
  "record": {"every": 0.002, "observe": {"vx": "rod.com.vx", "vy": "rod.com.vy", "omega": "rod.angular_velocity"}}
})";
const Struck rod_end = [] {
  const double x = -0.5 * std::cos(1), y = -0.5 * std::sin(1), m = 2, I = 1.0 / 6;
  return Struck{1 / m + x * x / I, -x * y / I, 1 / m + y * y / I, -1, 0.5};
}();

double energy_after(const Struck& c, const Eigen::Vector2d& P) {
  const Eigen::Vector2d u(c.u, c.s), after(c.u + c.a * P[0] + c.b * P[1], c.s + c.b * P[0] + c.c * P[1]);
  return 1.25 + 0.5 * P.dot(u + after);
}

// Round-off of the angle, 1e-4 s on: the rod turns no further before it strikes.
constexpr double round_off = 1e-12;

TEST(KanesRod, GainsEnergyByNewtonsLawAndTheRunSaysSoFirst) {
  const Finished run = run_text(rod);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("energy_total") / 1.25, 1.179, 5e-4);  // 17.9 %
  ASSERT_EQ(run.result["warnings"].size(), 1u);
  const std::string warning = run.result["warnings"][0];
  EXPECT_THAT(warning, HasSubstr("0.224 J, 17.9 % of the kinetic energy at t = 0.0001 s through tip"));
  EXPECT_THAT(warning, HasSubstr("\"impact_law\": \"energetic\""));
  EXPECT_LT(run.report.summary.find("created energy"), run.report.summary.find("simulated"));
}

// Two rods that nothing connects strike at the same instant.
TEST(KanesRod, StrikesByItsOwnLawBesideOneWithAnother) {
  for (const char* law : {"newton", "poisson", "energetic"}) {
    const Finished alone = run_text(rod, {{"contacts.tip.impact_law", law}});
    for (const char* other : {"newton", "poisson", "energetic"}) {
      nlohmann::json both = nlohmann::json::parse(rod);
      both["bodies"]["other"] = both["bodies"]["rod"];
      both["bodies"]["other"]["position"][0] = 10;
      both["contacts"]["other_tip"] = both["contacts"]["tip"];
      both["contacts"]["other_tip"]["between"][0] = "other.end";
      both["contacts"]["tip"]["impact_law"] = law, both["contacts"]["other_tip"]["impact_law"] = other;
      const Finished run = run_text(both.dump());
      for (const char* v : {"vx", "vy", "omega"}) EXPECT_NEAR(run.end(v), alone.end(v), round_off) << law << other;
    }
  }
}

// A block that rocks to rest, and a body under a load of 1e6 N, whose contacts keep small rates, the round-off of that
// load. The impacts of the block leave it alone.
TEST(RockingBlock, ComesToRestAndNothingElseMoves) {
  const std::string scene = R"({
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {
      "block": {"type": "rigid_body", "mass": 1, "inertia": "=0.2/12", "position": [0, 0.21], "angle": 0.1,
                "markers": {"l": [-0.1, -0.2], "r": [0.1, -0.2]}},
      "loaded": {"type": "rigid_body", "mass": 1, "inertia": 0.004, "position": [30, 0.1],
                 "markers": {"l": [-0.1, -0.1], "r": [0.1, -0.1]}}},
    "contacts": {
      "l": {"type": "constraint_method", "restitution": 0.3,
            "between": ["block.l", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
            "friction": {"type": "coulomb", "static": 0.7, "kinetic": 0.7}},
      "r": {"type": "constraint_method", "restitution": 0.3,
            "between": ["block.r", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
            "friction": {"type": "coulomb", "static": 0.7, "kinetic": 0.7}},
      "loaded_l": {"type": "constraint_method", "restitution": 0,
                   "between": ["loaded.l", {"plane": {"point": [30, 0], "normal": [0, 1]}}]},
      "loaded_r": {"type": "constraint_method", "restitution": 0,
                   "between": ["loaded.r", {"plane": {"point": [30, 0], "normal": [0, 1]}}]}},
    "forces": {"load": {"type": "load", "on": "loaded.com", "force": {"y": -1e6}}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-8}},
    "simulate": {"until": 2}, "record": {"every": 0.1, "observe": {"angle": "block.com.angle"}}
  })";
  for (const char* height : {"0.209", "0.21", "0.22"})
    for (const char* load : {"-1e6", "-1e7"}) {
      SCOPED_TRACE(fmt::format("{} m, {} N", height, load));
      const Finished run =
          run_text(scene, {{"bodies.block.position", fmt::format("[0, {}]", height)}, {"forces.load.force.y", load}});
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_NEAR(run.end("angle"), 0, 1e-9);
      for (const Event& event : run.events)
        EXPECT_TRUE(event.t == 0 || event.contact.find("loaded") == std::string::npos) << event.kind << event.contact;
    }
}

TEST(KanesRod, SticksInCompressionByPoissonsLawAndLosesEnergy) {
  // Compression ends at u = s = 0; the expansion's impulse is as large, and the rod still sticks: T = -b/c N.
  const auto [a, b, c, u, s] = rod_end;
  const double det = a * c - b * b, N = (-u * c + s * b) / det, T = (-s * a + u * b) / det;
  ASSERT_LT(std::abs(T), 0.5 * N);
  ASSERT_LT(std::abs(b), 0.5 * c);
  const Finished run = run_text(rod, {{"contacts.tip.impact_law", "poisson"}});
  EXPECT_NEAR(run.end("energy_total"), energy_after(rod_end, {2 * N, T - b / c * N}), round_off);
  EXPECT_TRUE(run.result["warnings"].empty());
}

TEST(KanesRod, FollowsRouthByTheEnergeticLawForEveryRestitutionAndFriction) {
  for (const double e : {0.0, 0.4, 1.0})
    for (const double mu : {0.1, 0.5, 1.5}) {
      const Finished run = run_text(rod, {{"contacts.tip.impact_law", "energetic"},
                                          {"contacts.tip.restitution", fmt::format("{}", e)},
                                          {"contacts.tip.friction.static", fmt::format("{}", mu)},
                                          {"contacts.tip.friction.kinetic", fmt::format("{}", mu)}});
      ASSERT_TRUE(run.done()) << run.report.reason;
      const Eigen::Vector2d P = routh(rod_end, e, mu);
      const Event impact = run.of_kind("impact").at(0);
      EXPECT_NEAR(impact.detail.at("impulse"), P[0], 1e-10) << e << " " << mu;  // as spring_impact.cpp
      EXPECT_NEAR(impact.detail.at("energy_lost"), 1.25 - energy_after(rod_end, P), 1e-10) << e << " " << mu;
      EXPECT_TRUE(run.result["warnings"].empty()) << e << " " << mu;
    }
}

TEST(ImpactLaws, AreAlikeForOneContactWithoutFriction) {
  const auto smooth = [](const char* law) {
    return fmt::format(R"({{"type": "constraint_method", "restitution": 0.6, "impact_law": "{}",
        "between": ["rod.end", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                       law);
  };
  const auto run_smooth = [&](const char* law) {
    return run_text(rod, {{"contacts", fmt::format(R"({{"tip": {}}})", smooth(law))}});
  };
  const Finished newton = run_smooth("newton");
  for (const char* law : {"poisson", "energetic"}) {
    const Finished run = run_smooth(law);
    for (const char* rate : {"vx", "vy", "omega"}) EXPECT_NEAR(run.end(rate), newton.end(rate), 1e-11) << law;
  }
}

TEST(ImpactLaws, AreAlikeWithoutRestitutionWhereTheSlipDoesNotTurn) {
  const Overrides slides = {{"contacts.tip.restitution", "0"},
                            {"contacts.tip.friction.static", "0.1"},
                            {"contacts.tip.friction.kinetic", "0.1"},
                            {"bodies.rod.velocity", "[5, -1]"}};
  const Finished newton = run_text(rod, slides);
  for (const char* law : {"poisson", "energetic"}) {
    Overrides overrides = slides;
    overrides.push_back({"contacts.tip.impact_law", law});
    const Finished run = run_text(rod, overrides);
    for (const char* rate : {"vx", "vy", "omega"}) EXPECT_NEAR(run.end(rate), newton.end(rate), 1e-10) << law;
  }
}

// A block that lands flat on its two lower corners.
const std::string block = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"block": {"type": "rigid_body", "mass": 3, "inertia": 0.5, "position": [0, 0.2], "velocity": [0, -1],
                       "markers": {"left": [-0.4, -0.1], "right": [0.4, -0.1]}}},
  "contacts": {
    "a": {"type": "constraint_method", "restitution": 0.5, "impact_law": "energetic",
          "between": ["block.left", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
          "friction": {"type": "coulomb", "static": 0.4, "kinetic": 0.3}},
    "b": {"type": "constraint_method", "restitution": 0.5, "impact_law": "energetic",
          "between": ["block.right", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
          "friction": {"type": "coulomb", "static": 0.4, "kinetic": 0.3}}},
  "integrator": {"type": "dop853", "step": 1e-2},
  "simulate": {"until": 0.15},
  "record": {"every": 0.15, "observe": {"vx": "block.com.vx", "vy": "block.com.vy", "omega": "block.angular_velocity"}}
})";

TEST(FlatBlock, ReboundsWithoutTurning) {
  for (const char* law : {"newton", "poisson", "energetic"}) {
    const std::string quoted = law;
    const Finished run = run_text(block, {{"contacts.a.impact_law", quoted}, {"contacts.b.impact_law", quoted}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.end("vx"), 0, 1e-11) << law;
    EXPECT_NEAR(run.end("vy"), 0.5, 1e-11) << law;
    EXPECT_NEAR(run.end("omega"), 0, 1e-11) << law;
  }
}

TEST(FlatBlock, DoesTheSameWhateverItsContactsAreCalled) {
  for (const char* velocity : {"[0.2, -1]", "[3, -1]"}) {
    const Finished one = run_text(block, {{"bodies.block.velocity", velocity}});
    const Finished other =
        run_text(block, {{"bodies.block.velocity", velocity},
                         {"bodies.block.markers", R"({"left": [0.4, -0.1], "right": [-0.4, -0.1]})"}});
    for (const char* rate : {"vx", "vy", "omega"}) EXPECT_NEAR(one.end(rate), other.end(rate), 1e-11) << velocity;
    EXPECT_TRUE(one.result["warnings"].empty());
  }
}

TEST(FlatBlock, ObeysTheEnergeticLawWhereOnlyOneCornerAsksForIt) {
  const Overrides moves = {{"bodies.block.velocity", "[0.5, -1]"}};
  const Finished both = run_text(block, moves);
  const Finished one = run_text(block, {moves[0], {"contacts.b.impact_law", "newton"}});
  for (const char* rate : {"vx", "vy", "omega"}) EXPECT_EQ(one.end(rate), both.end(rate));
}

TEST(ABallThatChatters, ComesToRestUnderEveryLaw) {
  for (const char* law : {"newton", "poisson", "energetic"}) {
    const Finished run = run_text(block, {{"gravity", "[0, -10]"},
                                          {"simulate.until", "2"},
                                          {"bodies.block.velocity", "[0.1, 0]"},
                                          {"contacts.a.impact_law", law},
                                          {"contacts.b.impact_law", law}});
    ASSERT_TRUE(run.done()) << law << ": " << run.report.reason;
    EXPECT_NEAR(run.end("vy"), 0, 1e-9) << law;
    EXPECT_NEAR(run.end("vx"), 0, 1e-9) << law;
  }
}

TEST(ImpactWarnings, CountManyGainsInOneLine) {
  model::Model model;
  model.contacts.resize(1);
  model.contacts[0].name = "tip";
  simulate::ImpactWarnings warnings;
  simulate::TouchingContact gains, loses;
  gains.impulse = loses.impulse = 2;
  gains.before = -1, gains.after = 1.25;
  loses.before = -1, loses.after = 1;
  for (int i = 1; i <= 10000; ++i) {
    gains.impulse = i == 7 ? 4 : 2;
    warnings.check(0.1 * i, 5, 1e-12, {gains}, false);
    warnings.check(0.1 * i, 5, 1e-12, {loses}, false);
  }
  const std::vector<std::string> lines = warnings.lines(model);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], HasSubstr("10000 impacts created energy: 2.5e+03 J in all"));
  EXPECT_THAT(lines[0], HasSubstr("the largest 0.5 J, 10 % of the kinetic energy at t = 0.7 s through tip"));
}

// Of contacts that all but rest: their rates, and the work of impulses along them, are round-off.
TEST(ImpactWarnings, AreSilentOnRatesThatAreRoundOff) {
  model::Model model;
  model.contacts.resize(1);
  simulate::ImpactWarnings warnings;
  simulate::TouchingContact knocks;
  knocks.impulse = 1e-11;
  knocks.before = -3e-13, knocks.after = 4e-13;
  warnings.check(0.1, 1e-24, 1e-12, {knocks}, false);
  EXPECT_TRUE(warnings.lines(model).empty());
}

// Of contacts that do not act on each other, one may lose more than the other gains.
TEST(ImpactWarnings, SumOverContactsThatActOnEachOtherOnly) {
  model::Model model;
  model.contacts.resize(2);
  model.contacts[0].name = "tip", model.contacts[1].name = "ball";
  simulate::TouchingContact gains, loses;
  gains.impulse = 1, gains.before = -1, gains.after = 1.25;
  loses.contact = 1, loses.impulse = 1, loses.before = -1, loses.after = 0;
  simulate::ImpactWarnings together, apart;
  together.check(0.1, 5, 1e-12, {gains, loses}, false);
  EXPECT_TRUE(together.lines(model).empty());
  loses.island = 1;
  apart.check(0.1, 5, 1e-12, {gains, loses}, false);
  ASSERT_EQ(apart.lines(model).size(), 1u);
  EXPECT_THAT(apart.lines(model)[0], HasSubstr("0.125 J, 2.5 % of the kinetic energy at t = 0.1 s through tip;"));
}

TEST(KanesRod, GainsEnergyWhateverIsLostElsewhereAtThatInstant) {
  const Finished run = run_text(
      rod, {{"bodies.ball", R"({"type": "point_mass", "mass": 3, "position": [5, 1e-4], "velocity": [0, -1]})"},
            {"contacts.ball", R"({"type": "constraint_method", "restitution": 0,
                            "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("impact").size(), 2u);
  EXPECT_EQ(run.of_kind("impact")[0].t, run.of_kind("impact")[1].t);
  EXPECT_LT(run.end("energy_total"), run.series.at("energy_total")[0]);
  ASSERT_EQ(run.result["warnings"].size(), 1u);
  EXPECT_THAT(std::string(run.result["warnings"][0]),
              HasSubstr("created energy: 0.224 J, 8.14 % of the kinetic energy at t = 0.0001 s through tip;"));
}

// A slip stops, then friction holds what the impact presses back: T . s- > 0, by every law, and no energy is created.
TEST(KanesRod, LosesEnergyWhereFrictionHoldsAgainstTheSlipItBeganWith) {
  const Overrides plastic = {{"contacts.tip.restitution", "0"},
                             {"contacts.tip.friction.static", "1.5"},
                             {"contacts.tip.friction.kinetic", "1.5"},
                             {"bodies.rod.velocity", "[0.05, -1]"}};
  const Finished newton = run_text(rod, plastic);
  ASSERT_TRUE(newton.done()) << newton.report.reason;
  const auto [a, b, c, u, s] = rod_end;
  const double det = a * c - b * b, slip = 0.05, T = (-slip * a + u * b) / det;
  EXPECT_GT(T * slip, 0.01);
  EXPECT_NEAR(newton.of_kind("impact").at(0).detail.at("friction"), T, round_off);
  for (const char* law : {"newton", "poisson", "energetic"}) {
    Overrides overrides = plastic;
    overrides.push_back({"contacts.tip.impact_law", law});
    const Finished run = run_text(rod, overrides);
    for (const char* rate : {"vx", "vy", "omega"}) EXPECT_NEAR(run.end(rate), newton.end(rate), 1e-10) << law;
    EXPECT_TRUE(run.result["warnings"].empty()) << law;
  }
}

// A disc falls into a groove whose walls stand at `tilt` from the vertical: it leaves at e times its speed, or jams if
// friction holds it, tan(tilt) < mu. Another disc far away rebounds at the same instant.
TEST(ADiscInAGroove, ReboundsOrJamsAsItsFrictionHoldsItAndTheBooksBalance) {
  constexpr double e = 0.5, fall = 0.05, g = 10;
  for (const double tilt : {0.2, 0.4, 0.7})
    for (const double mu : {0.1, 0.3, 0.6, 1.0}) {
      const auto wall = [&](const char* disc, double x, double nx, double ny) {
        return fmt::format(R"({{"type": "constraint_method", "restitution": {}, "radius": 0.1,
                                "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}, "between": ["{}.com",
                                {{"plane": {{"point": [{}, 0], "normal": [{:.17g}, {:.17g}]}}}}]}})",
                           e, mu, mu, disc, x, nx, ny);
      };
      const auto disc = [](double x, double y) {
        return fmt::format(R"({{"type": "rigid_body", "mass": 1, "inertia": 0.005, "position": [{}, {:.17g}]}})", x, y);
      };
      const double time = std::sqrt(2 * fall / g), sine = std::sin(tilt), cosine = std::cos(tilt);
      const Finished run = run_text(fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, {}], "bodies": {{"in": {}, "free": {}}},
               "contacts": {{"left": {}, "right": {}, "floor": {}}},
               "simulate": {{"until": {:.17g}}},
               "record": {{"every": 0.05, "observe": {{"in": "in.com.vy", "free": "free.com.vy"}}}}}})",
          -g, disc(0, 0.1 / sine + fall), disc(5, 0.1 + fall), wall("in", 0, cosine, sine),
          wall("in", 0, -cosine, sine), wall("free", 5, 0, 1), time + 0.01));
      ASSERT_TRUE(run.done()) << tilt << " " << mu << ": " << run.report.reason;
      const double rebound = e * g * time - 0.01 * g;
      EXPECT_NEAR(run.end("in"), std::tan(tilt) < mu ? 0 : rebound, 1e-9) << tilt << " " << mu;
      EXPECT_NEAR(run.end("free"), rebound, 1e-9) << tilt << " " << mu;
      EXPECT_NEAR(run.result["energy_supplied"]["constraints"], 0, 1e-12) << tilt << " " << mu;
      EXPECT_NEAR(run.result["energy_drift"], 0, 1e-9) << tilt << " " << mu;
      for (const Event& impact : run.of_kind("impact")) EXPECT_NEAR(impact.t, time, 1e-9) << tilt << " " << mu;
    }
}

}  // namespace
}  // namespace trammel::test
