// Joints that rub, where something happens at an instant: blows on their bodies, loads that pass through 0, joints that
// lock themselves.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>

#include "support/run_in_pieces.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;

// Of the energetic law, whose impacts are followed to this; the others are exact.
constexpr double round_off = 1e-11;
const char* const laws[] = {"newton", "poisson", "energetic"};
const std::string dop853 = R"({"type": "dop853", "step": 1e-3})";

// --- a ball of 0.5 kg that strikes a block of 2 kg on a guide along x, at 3 m/s

struct Blow {
  const char* law = "newton";
  double e = 0.5, mu = 0.3, v = 2;  // of the block [m/s]
  double a = 0;                     // [m] beside the guide's middle, or the guide
  std::string length = {};          // of the guide
  bool along = false;               // the ball flies along the guide
};
constexpr double ball_mass = 0.5, block_mass = 2, speed = 3;

Finished run_blow(const Blow& b) {
  // Where it strikes after 0.01 s.
  const std::string point = b.along ? fmt::format("[-0.3, {:.17g}]", b.a) : fmt::format("[{:.17g}, 0.2]", b.a);
  const std::string ball =
      b.along ? fmt::format(R"("position": [{:.17g}, {:.17g}], "velocity": [3, 0])", -0.33 + 0.01 * b.v, b.a)
              : fmt::format(R"("position": [{:.17g}, 0.23], "velocity": [0, -3])", b.a + 0.01 * b.v);
  return run_text(fmt::format(R"({{
    "trammel": 1, "gravity": [0, 0],
    "bodies": {{"block": {{"type": "rigid_body", "mass": 2, "inertia": 0.1, "velocity": [{}, 0]}},
                "ball": {{"type": "rigid_body", "mass": 0.5, "inertia": 0.01, {}}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "block.com"]{},
                           "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
    "contacts": {{"blow": {{"type": "constraint_method", "restitution": {}, "impact_law": "{}",
                  "between": ["ball.com", {{"plane": {{"on": "block.com", "point": {}, "normal": {}}}}}]}}}},
    "integrator": {}, "simulate": {{"until": 0.02}},
    "record": {{"every": 0.01, "observe": {{"block": "block.com.vx", "ball_x": "ball.com.vx", "ball_y": "ball.com.vy"}}}}
  }})",
                              b.v, ball, b.length.empty() ? "" : ", \"length\": " + b.length, b.mu, b.mu, b.e, b.law,
                              point, b.along ? "[-1, 0]" : "[0, 1]", dop853));
}

// The friction lost, and nothing supplied without a cause.
void expect_books(const Finished& run, double kinetic_lost_in_the_joint) {
  EXPECT_NEAR(run.result["energy_dissipated"]["impact"]["joints.guide"], kinetic_lost_in_the_joint, round_off);
  EXPECT_NEAR(run.result["energy_supplied"]["constraints"], 0, round_off);
  EXPECT_NEAR(run.result["energy_drift"], 0, round_off);
  EXPECT_TRUE(run.result["warnings"].empty());
}

TEST(ABlowAcrossAGuide, BrakesWhatSlidesOnItByMuTimesItsImpulse) {
  for (const char* law : laws)
    for (const double v : {2.0, -2.0, 0.1}) {
      Blow blow{.law = law, .v = v};
      const Finished run = run_blow(blow);
      ASSERT_TRUE(run.done()) << run.report.reason;
      const double P = (1 + blow.e) * ball_mass * speed;
      const double after = std::copysign(std::max(0.0, std::abs(v) - blow.mu * P / block_mass), v);
      EXPECT_NEAR(run.end("block"), after, round_off) << law << " " << v;
      EXPECT_NEAR(run.end("ball_y"), blow.e * speed, round_off) << law;
      expect_books(run, block_mass * (v * v - after * after) / 2);
    }
}

TEST(ABlowAcrossAGuide, BeyondItsEndsPressesOnBothOfThem) {
  for (const char* law : laws) {
    Blow blow{.law = law, .a = 0.4, .length = "0.3"};
    const Finished run = run_blow(blow);
    ASSERT_TRUE(run.done()) << run.report.reason;
    const double N = (1 + blow.e) * ball_mass * speed * 2 * blow.a / 0.3;
    EXPECT_NEAR(run.end("block"), blow.v - blow.mu * N / block_mass, round_off) << law;
  }
}

TEST(ABlowAlongAGuide, MovesTheBlockWithinItsOverhangAndNotBeyond) {
  for (const double part : {0.675, 1.2}) {
    Blow blow{.v = 0, .a = part * 0.4 / (2 * 0.3), .length = "0.4", .along = true};
    const Finished run = run_blow(blow);
    ASSERT_TRUE(run.done()) << run.report.reason;
    const double moves = std::max(0.0, 1 - part);  // the part of the impulse that friction leaves
    const double P = (1 + blow.e) * speed / (1 / ball_mass + moves / block_mass);
    EXPECT_NEAR(run.end("block"), moves * P / block_mass, 1e-12) << part;
    EXPECT_NEAR(run.end("ball_x"), speed - P / ball_mass, 1e-12) << part;
  }
}

TEST(ABlowAlongAGuide, NeverGainsEnergyWhateverTheLaw) {
  std::mt19937 random(4);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 60; ++i) {
    Blow blow{
        .law = laws[i % 3], .e = between(0, 1), .mu = between(0.05, 1.5), .v = between(-2, 2), .a = between(-0.8, 0.8)};
    blow.along = random() % 2 == 0;
    if (random() % 3 != 0) blow.length = fmt::format("{:.17g}", between(0.1, 0.6));
    const Finished run = run_blow(blow);
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_GE(run.result["energy_dissipated"]["joint_friction"]["guide"], 0) << i;
    // Newton's law judges friction by the slip at the end alone; where the blow turns the slip its share may be
    // negative.
    if (i % 3 != 0) {
      EXPECT_GE(run.result["energy_dissipated"]["impact"]["joints.guide"], -round_off) << i;
    }
    EXPECT_NEAR(run.result["energy_supplied"]["constraints"], 0, round_off) << i;
    EXPECT_LE(run.end("energy_total"), run.series.at("energy_total")[0] + round_off) << i;
  }
}

TEST(ABlowOnAJournal, BrakesTheRotorByItsFrictionCircle) {
  const double r = 0.05, mu = 0.4, e = 0.5, J = 0.2, spin = 3;
  const Finished run = run_text(fmt::format(R"({{
    "trammel": 1, "space": "spatial",
    "bodies": {{"rotor": {{"type": "rigid_body", "mass": 3, "inertia": [0.15, 0.15, {}], "angular_velocity": [0, 0, {}]}},
                "ball": {{"type": "rigid_body", "mass": 0.5, "inertia": [0.01, 0.01, 0.01], "position": [0, 0.23, 0], "velocity": [0, -3, 0]}}}},
    "joints": {{"journal": {{"type": "revolute", "between": ["ground", "rotor.com"], "radius": {}, "length": 0.1,
                             "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
    "contacts": {{"blow": {{"type": "constraint_method", "restitution": {},
                            "between": ["rotor.com", {{"plane": {{"on": "ball.com", "point": [0, -0.2, 0], "normal": [0, -1, 0]}}}}]}}}},
    "integrator": {}, "simulate": {{"until": 0.02}},
    "record": {{"every": 0.01, "observe": {{"s": "joints.journal.slip"}}}}
  }})",
                                            J, spin, r, mu, mu, e, dop853));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double P = (1 + e) * ball_mass * speed;
  EXPECT_NEAR(run.end("s"), r * (spin - mu * r * P / J), round_off);
}

// --- loads that pass through 0

// A block of 2 kg is pulled along its guide with f, pressed across it with c (t - 0.503): where that is less than f/mu
// it slips.
std::string relieved(double f, double c, double mu, const std::string& integrator) {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, 0],
    "bodies": {{"block": {{"type": "rigid_body", "mass": 2, "inertia": 0.1}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "block.com"], "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
    "forces": {{"pull": {{"type": "load", "on": "block.com", "force": {{"x": {:.17g}, "y": "={:.17g}*t-{:.17g}"}}}}}},
    "integrator": {}, "simulate": {{"until": 1}}, "record": {{"every": 1, "observe": {{"x": "block.com.x"}}}}
  }})",
                     mu, mu, f, c, 0.503 * c, integrator);
}

TEST(ALoadThatPassesThroughZero, LetsAGuideSlipHoweverShortly) {
  const double mu = 0.4, c = 10;
  for (const double tau : {0.05, 1e-3, 1e-5})
    for (const char* integrator : {R"({"type": "runge_kutta_4", "step": 0.05})", R"({"type": "newmark", "step": 0.05})",
                                   R"({"type": "dop853", "step": {"tolerance": 1e-10}})"}) {
      const Finished run = run_text(relieved(mu * c * tau, c, mu, integrator));
      ASSERT_TRUE(run.done()) << run.report.reason;
      const double k = mu * c / 2, sigma = 1 + std::sqrt(2.0);  // slips for tau until the load is 0, then for sigma tau
      const double x = k * tau * tau * tau * (1.0 / 6 + sigma / 2 + sigma * sigma / 2 - sigma * sigma * sigma / 6);
      ASSERT_EQ(run.of_kind("slip").size(), 1u) << tau << " " << integrator;
      EXPECT_NEAR(run.of_kind("slip")[0].t, 0.503 - tau, 1e-9) << tau << " " << integrator;
      if (std::string(integrator).find("newmark") != std::string::npos) continue;  // a phase is one or two of its steps
      EXPECT_NEAR(run.of_kind("stick").back().t, 0.503 + sigma * tau, 1e-7) << tau << " " << integrator;
      EXPECT_NEAR(run.end("x"), x, 1e-6 * x + 1e-15) << tau << " " << integrator;  // of degree 3 in each phase
    }
}

TEST(ALoadThatPassesThroughZero, ResumesToTheSameBits) {
  const scene::Scene scene =
      scene::Scene::parse(relieved(0.04, 10, 0.4, R"({"type": "runge_kutta_4", "step": 0.05})"), "test.json", {});
  const Logs whole = run_in_pieces(scene, 1000000), pieces = run_in_pieces(scene, 3);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
}

// --- joints that lock themselves as they slide

// A drawer of 2 kg, its centre of mass d beside its guide of length L, pulled along it at the distance h: friction
// holds the drawer back beside its centre, which loads the guide by kappa = 2 mu d / L times itself. With kappa > 1 and
// a pull that turns the same way there are no finite forces.
std::string leaning(const std::string& pull, const std::string& integrator, double d = 0.6) {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, 0],
    "bodies": {{"drawer": {{"type": "rigid_body", "mass": 2, "inertia": 0.1, "position": [0, {}], "velocity": [1, 0],
                            "markers": {{"slot": [0, {}], "handle": [0, {}]}}}}}},
    "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "drawer.slot"], "length": 0.4,
                           "friction": {{"type": "coulomb", "static": 0.5, "kinetic": 0.5}}}}}},
    "forces": {{"pull": {{"type": "load", "on": "drawer.handle", "force": {{"x": "{}"}}}}}},
    "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"v": "drawer.com.vx", "x": "drawer.com.x", "T": "joints.guide.friction"}}}}
  }})",
                     d, -d, 0.8 - d, pull, integrator);
}

TEST(ALeaningDrawer, JamsAtOnceWhereItsPullTurnsItTheSameWay) {
  for (const char* integrator : {R"({"type": "dop853", "step": 1e-2})", R"({"type": "hht_alpha", "step": 1e-3})"}) {
    const Finished run = run_text(leaning("=3", integrator));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.end("x"), 0, 1e-10);
    EXPECT_NEAR(run.end("T"), -3, 1e-9);
    const Event blow = run.of_kind("impact").at(0);
    EXPECT_EQ(blow.contact, "joints.guide");
    EXPECT_NEAR(blow.detail.at("energy_lost"), 1, 1e-12);  // all of 2 kg x 1 m^2/s^2 / 2
    EXPECT_NEAR(run.result["energy_dissipated"]["impact"]["joints.guide"], 1, 1e-12);
  }
}

// The pull passes through 0 at 0.5 s: until then it lessens the load. mu N = mu F'/(1 + kappa), F' = 2 |F| (h - d) / L.
TEST(ALeaningDrawer, SlidesUntilItsLoadHasPassedThroughZeroAndJamsThere) {
  const double kappa = 1.5, before = (1 + 0.5 * 2 * 0.2 / 0.4 / (1 + kappa)) / 2;  // deceleration over |F|
  const double v = 1 - before * 3 * 0.125;
  for (const char* integrator :
       {R"({"type": "dop853", "step": 1e-2})", R"({"type": "dop853", "step": {"tolerance": 1e-10}})",
        R"({"type": "runge_kutta_4", "step": 0.03})", R"({"type": "hht_alpha", "step": 1e-3})"}) {
    const Finished run = run_text(leaning("=3*(t-0.5)", integrator));
    ASSERT_TRUE(run.done()) << integrator << ": " << run.report.reason;
    const std::vector<Event> blows = run.of_kind("impact");
    ASSERT_EQ(blows.size(), 1u) << integrator;
    EXPECT_NEAR(blows[0].t, 0.5, 1e-6) << integrator;  // to the shortest step that is tried
    EXPECT_NEAR(blows[0].detail.at("energy_lost"), v * v, 1e-5) << integrator;
    EXPECT_NEAR(run.end("v"), 0, 1e-9) << integrator;
  }
}

TEST(ALeaningDrawer, GoesOnWhereItsFrictionDoesNotRaiseItself) {
  const Finished run = run_text(leaning("=3", R"({"type": "dop853", "step": 1e-2})", 0.3));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.of_kind("impact").empty());
}

// --- the same guide built of contacts: two pins of the body in a channel

struct Guided {
  double vx, F_x, F_y, moment, mu, d;
};

std::string body_of(const Guided& g, const std::string& rest) {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, 0],
    "bodies": {{"slide": {{"type": "rigid_body", "mass": 2, "inertia": 0.1, "position": [0, {:.17g}], "velocity": [{:.17g}, 0],
                           "markers": {{"left": [-0.2, {:.17g}], "right": [0.2, {:.17g}], "middle": [0, {:.17g}]}}}}}},
    "forces": {{"load": {{"type": "load", "on": "slide.com", "force": {{"x": {:.17g}, "y": {:.17g}}}, "moment": {:.17g}}}}},
    {},
    "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-10}}}}, "simulate": {{"until": 0.5}},
    "record": {{"every": 0.1, "observe": {{"x": "slide.com.x", "v": "slide.com.vx"}}}}
  }})",
                     g.d, g.vx, -g.d, -g.d, -g.d, g.F_x, g.F_y, g.moment, rest);
}

TEST(AGuide, IsTheLimitOfTwoPinsInAChannelAsItsClearanceVanishes) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 12; ++i) {
    const double mu = between(0.1, 0.6);
    const Guided g{between(-1, 1), between(-8, 8), between(-20, 20), between(-4, 4), mu, between(-0.15, 0.15)};
    const std::string friction =
        fmt::format(R"("friction": {{"type": "coulomb", "static": {0:.17g}, "kinetic": {0:.17g}}})", mu);
    const Finished joint = run_text(body_of(
        g, R"("joints": {"guide": {"type": "prismatic", "between": ["ground", "slide.middle"], "length": 0.4, )" +
               friction + "}}"));
    std::string contacts;
    for (const char* end : {"left", "right"})
      for (const int side : {1, -1})
        contacts += fmt::format(
            R"({}"{}{}": {{"type": "constraint_method", "restitution": 0, "between": ["slide.{}", {{"plane": {{"point": [0, {}], "normal": [0, {}]}}}}], {}}})",
            contacts.empty() ? "" : ", ", end, side > 0 ? "_floor" : "_ceiling", end, -side * 1e-9, side, friction);
    const Finished channel = run_text(body_of(g, "\"contacts\": {" + contacts + "}"));
    ASSERT_TRUE(joint.done()) << i << ": " << joint.report.reason;
    ASSERT_TRUE(channel.done()) << i << ": " << channel.report.reason;
    // The pins meet their walls with rates of sqrt(clearance), 1e-4 m/s, whose impulses rub.
    EXPECT_NEAR(joint.end("x"), channel.end("x"), 3e-4) << i;
    EXPECT_NEAR(joint.end("v"), channel.end("v"), 3e-4) << i;
    EXPECT_GE(joint.result["energy_dissipated"]["joint_friction"]["guide"], 0) << i;
  }
}

// Three bars with journals that rub; the end of the last one slides over a rough floor until the chain locks itself.
// Where it does, friction as it is has no impact yet that stops it, and a little more has one.
TEST(AChainOfJournals, ThatLocksItselfOnAFloorGoesOnAfterAnImpact) {
  const auto bar = [](double mass, double length, double x, double y, double angle) {
    return fmt::format(R"({{"type": "rigid_body", "mass": {}, "inertia": {}, "position": [{}, {}], "angle": {},
                            "markers": {{"a": [0, {}], "b": [0, {}]}}}})",
                       mass, mass * length * length / 12, x, y, angle, length / 2, -length / 2);
  };
  struct Bar {
    double mass, length, angle;
  };
  for (const double mu : {0.4958483209149854, 0.5}) {
    std::string bodies;
    double x = 0, y = 0;
    int i = 0;
    for (const Bar& b : {Bar{1.166, 0.423, -0.962}, Bar{2.486, 0.551, -1.313}, Bar{1.2136, 0.318, 1.3316}}) {
      const double dx = b.length * std::sin(b.angle), dy = -b.length * std::cos(b.angle);
      bodies +=
          fmt::format("{}\"p{}\": {}", i > 0 ? ", " : "", i, bar(b.mass, b.length, x + dx / 2, y + dy / 2, b.angle));
      x += dx, y += dy, ++i;
    }
    const auto journal = [](const char* a, const char* b, double mu_kinetic) {
      return fmt::format(R"({{"type": "revolute", "between": ["{}", "{}"], "radius": 0.03,
                              "friction": {{"type": "coulomb", "static": 0.29, "kinetic": {}}}}})",
                         a, b, mu_kinetic);
    };
    const Finished run = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81], "bodies": {{{}}},
             "joints": {{"j0": {}, "j1": {}, "j2": {}}},
             "contacts": {{"floor": {{"type": "constraint_method", "restitution": 0.4,
                           "friction": {{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}},
                           "between": ["p2.b", {{"plane": {{"point": [0, {:.17g}], "normal": [0, 1]}}}}]}}}},
             "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"x": "p2.com.x"}}}}}})",
        bodies, journal("ground", "p0.a", 0.29), journal("p0.b", "p1.a", 0.232), journal("p1.b", "p2.a", 0.29), mu, mu,
        y - 0.046));
    ASSERT_TRUE(run.done()) << mu << ": " << run.report.reason;
    EXPECT_THAT(run.result["warnings"].dump(), testing::Not(testing::HasSubstr("not to be trusted"))) << mu;
    const std::vector<Event> impacts = run.of_kind("impact");
    const auto without_collision = [](const Event& event) {
      return event.contact.find("floor") != std::string::npos && std::abs(event.detail.at("approach")) < 1e-9 &&
             event.detail.at("impulse") > 0;
    };
    EXPECT_TRUE(std::any_of(impacts.begin(), impacts.end(), without_collision)) << mu;
    const nlohmann::json rubbed = run.result["energy_dissipated"].value("joint_friction", nlohmann::json::object());
    EXPECT_EQ(rubbed.size(), 3u) << mu;
    for (const auto& [joint, lost] : rubbed.items()) EXPECT_GE(lost.get<double>(), -round_off) << mu << joint;
  }
}

// A box slides on three feet, which share its weight, and carries a rod on a dry journal. A ball that falls on its
// overhang lifts two of the feet off at once: those no longer share.
TEST(ADryJournal, IsLoadedByWhatStillPressesAfterABlowThatLiftsFeetOff) {
  const auto on_plane = [](const std::string& marker, double mu, const std::string& more) {
    return fmt::format(R"({{"type": "constraint_method", "restitution": 0,
                            "between": ["{}", {{"plane": {{"point": [0, 0], "normal": [0, 1]{}}}}}],
                            "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}})",
                       marker, more, mu, mu);
  };
  for (const double x : {-0.6, -0.5, 0.5, 0.6}) {
    const Finished run = run_text(fmt::format(
        R"json({{"trammel": 1, "space": "planar", "gravity": [0, -10],
             "bodies": {{
               "box": {{"type": "rigid_body", "mass": 1, "inertia": 0.06, "position": [0, 0.1], "velocity": [1, 0],
                        "markers": {{"l": [-0.4, -0.1], "m": [0, -0.1], "r": [0.4, -0.1], "pin": [0, 0.1]}}}},
               "rod": {{"type": "rigid_body", "mass": 1, "inertia": 0.03, "angle": "=pi-0.9", "velocity": [1, 0],
                        "position": ["=0.3*sin(0.9)", "=0.2+0.3*cos(0.9)"], "markers": {{"a": [0, 0.3]}}}},
               "ball": {{"type": "point_mass", "mass": 1, "position": [{}, 0.25], "velocity": [1, 0]}}}},
             "joints": {{"pin": {{"type": "revolute", "between": ["box.pin", "rod.a"], "radius": 0.05,
                                 "friction": {{"type": "coulomb", "static": 0.5, "kinetic": 0.5}}}}}},
             "contacts": {{"l": {}, "m": {}, "r": {}, "ball": {}}},
             "simulate": {{"until": 0.15}}, "record": {{"every": 0.05, "observe": {{"x": "box.com.x"}}}}}})json",
        x, on_plane("box.l", 0.2, ""), on_plane("box.m", 0.2, ""), on_plane("box.r", 0.2, ""),
        on_plane("ball.point", 1, R"(, "on": "box.pin")")));
    ASSERT_TRUE(run.done()) << x << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << x << run.result["warnings"].dump();
    std::vector<std::string> lifted;
    for (const Event& event : run.of_kind("contact_open"))
      if (std::abs(event.t - 0.1) < 1e-9) lifted.push_back(event.contact);
    EXPECT_THAT(lifted, testing::UnorderedElementsAre(x < 0 ? "contacts.r" : "contacts.l", "contacts.m")) << x;
    EXPECT_NEAR(run.result["energy_drift"], 0, 1e-9) << x;
  }
}

}  // namespace
}  // namespace trammel::test
