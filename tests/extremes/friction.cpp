// Set-valued friction at the edge: coefficients, stiffness, damping laws, starts, bases that jump or buzz, grazing
// touches, many feet at once, Painleve, Zeno. A block is a body of 1 kg whose feet, at the height of its centre of mass
// so that friction does not turn it, stand on a table; g = 9.81.
#include <cmath>
#include <numbers>

#include "outcome.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

constexpr double g = 9.81;

struct Block {
  std::string law = R"("type": "constraint_method")";
  double mu_0 = 0.6, mu = 0.48;
  double x_rate = 0, y_rate = 0, height = 0;  // of the feet at the start
  double tilt = 0;                            // of gravity: a slope that falls to -x
  int feet = 1;                               // evenly over 2 m
  std::string table = R"("x": 0)";
  std::string more = "";
  double until = 1, every = 0.1;
  std::string integrator = R"({"type": "dormand_prince", "step": {"tolerance": 1e-10}})";

  std::string scene() const {
    std::string markers, contacts;
    for (int i = 0; i < feet; ++i) {
      const double at = feet == 1 ? 0 : -1 + 2.0 * i / (feet - 1);
      markers += fmt::format(R"({}"f{}": [{:.17g}, 0])", i ? ", " : "", i, at);
      contacts += fmt::format(
          R"({}"f{}": {{{}, "between": ["block.f{}", {{"plane": {{"point": [0, 0], "normal": [0, 1], "on": "table.origin"}}}}],
              "friction": {{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}}}})",
          i ? ", " : "", i, law, i, mu_0, mu);
    }
    return fmt::format(
        R"({{"trammel": 1, "gravity": [{:.17g}, {:.17g}], "bodies": {{"table": {{"type": "moving_base", {}}},
        "block": {{"type": "rigid_body", "mass": 1, "inertia": 1, "position": [0, {:.17g}], "velocity": [{:.17g}, {:.17g}],
                  "markers": {{{}}}}}}}, "contacts": {{{}}}, {} "integrator": {},
        "simulate": {{"until": {:.17g}}},
        "record": {{"every": {:.17g}, "observe": {{"x": "block.com.x", "y": "block.com.y", "vx": "block.com.vx"}}}}}})",
        -g * std::sin(tilt), -g * std::cos(tilt), table, height, x_rate, y_rate, markers, contacts, more, integrator,
        until, every);
  }
  Finished run() const { return run_text(scene()); }
};

std::string compliant(double stiffness, const std::string& damping = R"("damping": "none")") {
  return fmt::format(R"("type": "continuous_force", "stiffness": {:.17g}, "exponent": 1.5, {})", stiffness, damping);
}

TEST(FrictionCoefficient, OfZeroSlidesOnForEverWithoutAnEvent) {
  const Finished run = Block{.mu_0 = 0, .mu = 0, .x_rate = 2, .until = 10}.run();
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("x"), 20, 1e-12);
  EXPECT_EQ(run.events.size(), 1u) << "the touch at the start";
}

TEST(FrictionCoefficient, OfTenHoldsOnASlopeOf84DegreesAndLetsGoOn85) {
  EXPECT_NEAR((Block{.mu_0 = 10, .mu = 8, .tilt = 84 * pi / 180}.run().end("x")), 0, 1e-14);
  const double phi = 85 * pi / 180;
  const Finished slides = Block{.mu_0 = 10, .mu = 8, .tilt = phi}.run();
  EXPECT_NEAR(slides.end("x"), -g * (std::sin(phi) - 8 * std::cos(phi)) / 2, 1e-11);
}

TEST(FrictionCoefficient, EqualInRestAndMotionGoesOverWithoutAJump) {
  // The pull reaches mu g = 5.886 N at 0.981 s: x = 6 (t - 0.981)^3 / 6.
  Block block{.mu_0 = 0.6, .mu = 0.6, .until = 1.5};
  block.more = R"("forces": {"pull": {"type": "load", "on": "block.f0", "force": {"x": "=6*t", "y": 0}}},)";
  const Finished run = block.run();
  ASSERT_EQ(run.of_kind("slip").size(), 1u) << run.report.reason;
  EXPECT_NEAR(run.of_kind("slip")[0].t, 0.981, 1e-8);
  EXPECT_NEAR(run.end("x"), std::pow(1.5 - 0.981, 3), 1e-8);
}

class FootStiffness : public testing::TestWithParam<double> {};

TEST_P(FootStiffness, DoesNotChangeWhereABlockStops) {
  const Finished run =
      Block{.law = compliant(GetParam()), .x_rate = 1, .height = -std::pow(g / GetParam(), 1 / 1.5)}.run();
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  // The integrator may let the foot ring by its tolerance, 1e-10 m, with the frequency of K: an impulse of omega 1e-10
  // N s.
  const double depth = std::pow(g / GetParam(), 1 / 1.5), omega = std::sqrt(1.5 * GetParam() * std::sqrt(depth));
  const double bound = std::max(1e-9, 1e-10 * omega / g);
  EXPECT_NEAR(run.of_kind("stick")[0].t, 1 / (0.48 * g), bound);
  EXPECT_NEAR(run.end("x"), 1 / (2 * 0.48 * g), bound);
}

INSTANTIATE_TEST_SUITE_P(K, FootStiffness, testing::Values(1e3, 1e5, 1e7, 1e9, 1e11, 1e13),
                         [](const auto& K) { return fmt::format("n{:.0f}", std::log10(K.param)); });

class FootDamping : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(FootDamping, OfEachExponentLetsAFallingBlockComeToRest) {
  const auto [exponent, coefficient] = GetParam();
  Block block{.x_rate = 0.5, .height = 0.001, .feet = 2, .until = 2};
  block.law =
      compliant(1e6, fmt::format(R"("damping": "coefficient", "damping_coefficient": {}, "damping_exponent": {})",
                                 coefficient, exponent));
  const Finished run = block.run();
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("vx"), 0, 1e-12);
  EXPECT_NEAR(run.end("y"), -std::pow(g / 2e6, 1 / 1.5), 1e-6);
  EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Exponent, FootDamping,
                         testing::Values(std::pair{0., 60.}, std::pair{1., 2e5}, std::pair{1.5, 1e7}),
                         [](const auto& p) { return fmt::format("n{:.0f}", 10 * p.param.first); });

TEST(FeetAtTheStart, TouchingWithoutForceStickWithoutMoving) {
  for (const std::string& law : {Block{}.law, compliant(1e6), compliant(1e6, R"("restitution": 0.5)")}) {
    const Finished run = Block{.law = law, .feet = 2}.run();
    ASSERT_TRUE(run.done()) << law << run.report.reason;
    EXPECT_EQ(run.of_kind("slip").size(), 0u) << law;
    EXPECT_NEAR(run.end("x"), 0, 1e-13) << law;
  }
}

TEST(SymmetricMotion, OfAThousandSecondsHasNoEventOfItsOwn) {
  // A block that a table shakes up and down, its two feet always loaded: 0.01 (2 pi)^2 < g.
  const Finished run =
      Block{.law = R"("type": "continuous_force", "stiffness": 100, "exponent": 1, "damping": "coefficient",
                               "damping_coefficient": 100, "damping_exponent": 1)",
            .height = -g / 200,
            .feet = 2,
            .table = R"json("x": 0, "y": "=0.01*(1 - cos(2*pi*t))")json",
            .until = 1000,
            .every = 1}
          .run();
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.events.size(), 4u) << "two feet touch and stick at the start";
  EXPECT_NEAR(run.end("x"), 0, 1e-13);
}

TEST(BaseWhoseAccelerationJumps, HoldsWhatItCanAndSlipsAtTheInstantOfTheJump) {
  for (const auto& [a, slides] : {std::pair{5.0, false}, std::pair{8.0, true}}) {
    Block block{.until = 1};
    block.table = fmt::format(R"json("x": "=step(t - 0.5)*{}*(t - 0.5)^2/2")json", a);
    const Finished run = block.run();
    ASSERT_TRUE(run.done()) << run.report.reason;
    const std::vector<Event> slips = run.of_kind("slip");
    ASSERT_EQ(slips.size(), slides ? 1u : 0u);
    EXPECT_NEAR(run.end("x"), (slides ? 0.48 * g : a) / 8, 1e-8);
    for (const Event& slip : slips) EXPECT_NEAR(slip.t, 0.5, 1e-8);
  }
}

TEST(BaseOfTenKilohertz, SlidesToAndFroUnderABlockThatHardlyMoves) {
  // 1e-6 (2e4 pi)^2 = 3948 m/s^2 against 0.48 g: the block's own swing is 1e-3 of the table's.
  Block block{.until = 0.01, .every = 1e-4};
  block.table = R"json("x": "=1e-6*cos(2e4*pi*t)")json";
  const Finished run = block.run();
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("stick").size(), 0u);
  EXPECT_NEAR(double(run.of_kind("reversal").size()), 200, 2) << "twice a period";
  for (const double x : run.series.at("x")) EXPECT_NEAR(x, 0, 1e-6);
}

TEST(GrazingTouch, WithFrictionEndsInTheSameMotionToItsDepth) {
  // y = g (t - 0.5)^2 / 2 + gap under a gravity upwards.
  for (const std::string& law : {Block{}.law, compliant(1e7)})
    for (const double gap : {-1e-9, 0.0, 1e-9}) {
      std::string scene =
          Block{.law = law, .x_rate = 1, .y_rate = -g / 2, .height = g / 8 + gap, .feet = 2, .until = 1}.scene();
      const Finished run = run_text(scene, {{"gravity", "[0, 9.81]"}});
      ASSERT_TRUE(run.done()) << law << run.report.reason;
      // The speed at the depth d is sqrt(2 g d) = 1.4e-4; friction takes at most 0.48 of twice that.
      EXPECT_NEAR(run.end("vx"), 1, 3e-4) << law << gap;
      EXPECT_NEAR(run.end("y"), g / 8, 3e-4) << law << gap;
    }
}

TEST(TwentyFeet, TouchSlideAndStickAtOneInstantEach) {
  const Finished run =
      Block{.law = compliant(1e5, R"("restitution": 0.1)"), .x_rate = 1, .height = 0.01, .feet = 20, .until = 2}.run();
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> touches = run.of_kind("contact_close");
  ASSERT_GE(touches.size(), 20u);
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(touches[std::size_t(i)].t, std::sqrt(0.02 / g), 1e-9);
  EXPECT_NEAR(run.end("vx"), 0, 1e-12);
  const std::vector<Event> sticks = run.of_kind("stick");
  ASSERT_GE(sticks.size(), 20u);
  EXPECT_NEAR(sticks.back().t, sticks[sticks.size() - 20].t, 1e-6);
}

TEST(TwentyRigidFeet, SlideAndStopAsOneBlock) {
  const Finished run = Block{.x_rate = 1, .feet = 20}.run();
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("x"), 1 / (2 * 0.48 * g), 1e-9);
  EXPECT_NEAR(run.end("vx"), 0, 1e-12);
}

class PainlevesRod : public testing::TestWithParam<double> {};

TEST_P(PainlevesRod, OfAnyFrictionEndsInAResultOrAClearError) {
  const Finished run = run_file("friction/painleve_rod.json",
                                {{"parameters.mu", fmt::format("{}", GetParam())}, {"simulate.until", "0.05"}});
  if (!run.done()) return expect_clear_failure(run);
  expect_finite(run);
}

INSTANTIATE_TEST_SUITE_P(Mu, PainlevesRod, testing::Values(0, 0.5, 1, 4.0 / 3, 1.5, 2, 5, 100),
                         [](const auto& mu) { return fmt::format("n{}", mu.index); });

TEST(RockingBlock, ComesToRestThroughEverFasterImpacts) {
  // Let go with one foot 0.01 m up; it rocks from foot to foot, each impact a share of the rate before: Zeno.
  const Finished run = run_text(R"json({
    "trammel": 1, "gravity": [0, -9.81],
    "bodies": {"block": {"type": "rigid_body", "mass": 1, "inertia": "=(0.09 + 1)/3", "angle": 0.02,
                         "position": ["=0.3*cos(0.02) - sin(0.02)", "=0.3*sin(0.02) + cos(0.02)"],
                         "markers": {
    "left" : [ -0.3, -1 ], "right" : [ 0.3, -1 ]}
}
}
, "contacts" : {
  "left" : {
    "type" : "constraint_method",
    "between" : [ "block.left", {"plane" : {"point" : [ 0, 0 ], "normal" : [ 0, 1 ]}} ],
    "friction" : {"type" : "coulomb", "static" : 2, "kinetic" : 2}
  },
  "right" : {
    "type" : "constraint_method",
    "between" : [ "block.right", {"plane" : {"point" : [ 0, 0 ], "normal" : [ 0, 1 ]}} ],
    "friction" : {"type" : "coulomb", "static" : 2, "kinetic" : 2}
  }
},
               "integrator" : {"type" : "dop853", "step" : {"tolerance" : 1e-10}},
                              "simulate" : {"until" : 20},
                                           "record" : {
  "every" : 0.1, "observe" : {
    "angle" : "block.angle", "rate" : "block.angular_velocity"
  }
}
})json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("angle"), 0, 1e-9);
  EXPECT_NEAR(run.end("rate"), 0, 1e-9);
  EXPECT_GT(run.of_kind("impact").size(), 5u);
}

}  // namespace
}  // namespace trammel::test
