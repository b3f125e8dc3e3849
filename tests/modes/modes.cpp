// `trammel modes`: against closed forms.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/modes_of.hpp"
#include "modes/krylov_modes.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

// A bar of mass 2 and inertia 0.3, hung 0.5 m above its centre; `side` -1 stands it on its hinge.
const std::string kBar = R"({
  "trammel": 1, "space": "planar", "gravity": [0, -9.81], "parameters": {"side": 1, "rate": 0},
  "bodies": {"bar": {"type": "rigid_body", "mass": 2, "inertia": 0.3, "position": [0, "=-0.5*side"],
                     "angular_velocity": "=rate", "velocity": ["=0.5*side*rate", 0], "markers": {"top": [0, "=0.5*side"]}}},
  "joints": {"hinge": {"type": "revolute", "between": ["ground", "bar.top"]}},
  "integrator": {"type": "dop853", "step": {"tolerance": 1e-10}}, "simulate": {"until": 1}})";
const double kBarFrequency = std::sqrt(2 * 9.81 * 0.5 / (0.3 + 2 * 0.25));
// Without exact derivatives K is found by central differences, which leave 1e-10 of it.
constexpr double differences = 1e-9;

TEST(Modes, OfAPendulum) {
  const Modes modes = modes_of(kBar);
  ASSERT_EQ(modes.count(), 1u);
  EXPECT_NEAR(modes.frequency(0), kBarFrequency, differences * kBarFrequency);
  EXPECT_EQ(modes.kind(0), "oscillation");
  EXPECT_EQ(modes.result["unstable"], 0);
}

TEST(Modes, OfAPendulumStoodOnItsHingeGrow) {
  const Modes modes = modes_of(kBar, {{"parameters.side", "-1"}});
  ASSERT_EQ(modes.count(), 1u);
  EXPECT_NEAR(modes.real(0), kBarFrequency, differences * kBarFrequency);
  EXPECT_EQ(modes.kind(0), "unstable");
  EXPECT_EQ(modes.result["unstable"], 1);
}

// Its own rotation must not stiffen it: psi'' = -omega^2 sin psi has the slope omega^2 at any rate.
TEST(Modes, OfAPendulumInItsLowestPlaceDoNotDependOnItsSpeed) {
  const Modes modes = modes_of(kBar, {{"parameters.rate", "7"}});
  ASSERT_EQ(modes.count(), 1u);
  EXPECT_NEAR(modes.frequency(0), kBarFrequency, 1e-8 * kBarFrequency);  // differences of differences
}

TEST(Modes, OfADoublePendulum) {
  const Modes modes = modes_of_file("benchmarks/double_pendulum.json",
                                    {{"bodies.bob1.position", "[0, -1]"}, {"bodies.bob2.position", "[0, -2]"}});
  ASSERT_EQ(modes.count(), 2u);
  EXPECT_NEAR(modes.frequency(0), std::sqrt(9.81 * (2 - std::sqrt(2))), differences * 10);
  EXPECT_NEAR(modes.frequency(1), std::sqrt(9.81 * (2 + std::sqrt(2))), differences * 10);
  EXPECT_THAT(modes.shapes, HasSubstr("1,bob1.point,0,-1,"));
}

TEST(Modes, RedundantRowsChangeNothing) {
  scene::Scene twice = scene::Scene::parse(
      kBar, "test.json", {{"joints.again", R"({"type": "revolute", "between": ["ground", "bar.top"]})"}});
  const Modes modes = modes_of(twice);
  ASSERT_EQ(modes.count(), 1u);
  EXPECT_EQ(modes.result["redundant_rows"], 2);
  EXPECT_NEAR(modes.frequency(0), kBarFrequency, differences * kBarFrequency);
}

TEST(Modes, ThereAreNoneWhereNothingCanMove) {
  const Modes modes = modes_of(kBar, {{"joints.hinge.type", "fixed"}});
  EXPECT_EQ(modes.count(), 0u);
  EXPECT_EQ(modes.result["degrees_of_freedom"], 0);
}

TEST(Modes, OfAFreeBodyAreItsRigidMotions) {
  const std::vector<std::string> six(6, "zero");
  const Modes modes = modes_of(R"({"trammel": 1, "space": "spatial",
    "bodies": {"body": {"type": "rigid_body", "mass": 1, "inertia": [1, 2, 2.5]}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-10}}, "simulate": {"until": 1}})");
  EXPECT_EQ(modes.kinds(), six);
}

// About the middle axis of inertia a free body leaves its rotation: rate sqrt((I2 - I1) (I3 - I2) / (I1 I3)) omega.
TEST(Modes, OfARotationAboutTheMiddleAxisGrow) {
  const Modes modes = modes_of(R"({"trammel": 1, "space": "spatial",
    "bodies": {"body": {"type": "rigid_body", "mass": 1, "inertia": [1, 2, 2.5], "angular_velocity": [0, 3, 0]}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-10}}, "simulate": {"until": 1}})");
  EXPECT_EQ(modes.result["unstable"], 1);
  double growth = 0;
  for (std::size_t i = 0; i < modes.count(); ++i) growth = std::max(growth, modes.real(i));
  EXPECT_NEAR(growth, 3 * std::sqrt(1 * 0.5 / 2.5), 1e-7);
}

// A top upright on its tip, spinning at w: I1 z'' - i I3 w z' - m g l z = 0, stable from I3^2 w^2 = 4 I1 m g l on.
std::string sleeping_top(double spin) {
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -10],
    "bodies": {{"top": {{"type": "rigid_body", "mass": 1, "inertia": [1, 1, 0.5], "position": [0, 0, 1],
                         "angular_velocity": [0, 0, {}], "markers": {{"tip": [0, 0, -1]}}}}}},
    "joints": {{"ball": {{"type": "spherical", "between": ["ground", "top.tip"]}}}},
    "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-10}}}}, "simulate": {{"until": 1}}}})",
                     spin);
}
TEST(Modes, OfASpinningTopTellWhenItFalls) {
  const double I1 = 2, limit = std::sqrt(4 * I1 * 10) / 0.5;
  EXPECT_EQ(modes_of(sleeping_top(1.1 * limit)).result["unstable"], 0);
  const Modes falls = modes_of(sleeping_top(0.6 * limit));
  EXPECT_EQ(falls.result["unstable"], 1);  // of one pair, whose partner decays
  double growth = 0;
  for (std::size_t i = 0; i < falls.count(); ++i) growth = std::max(growth, falls.real(i));
  EXPECT_NEAR(growth, std::sqrt(4 * I1 * 10 * (1 - 0.36)) / (2 * I1), 1e-6);
}

std::string oscillator(double damping) {
  return fmt::format(R"({{"trammel": 1, "space": "planar",
    "bodies": {{"mass": {{"type": "rigid_body", "mass": 2, "inertia": 1, "position": [1, 0]}}}},
    "joints": {{"rail": {{"type": "prismatic", "between": ["ground", "mass.com"]}}}},
    "forces": {{"spring": {{"type": "spring_damper", "between": ["ground", "mass.com"], "stiffness": 50, "damping": {},
                           "length": 1}}}},
    "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-10}}}}, "simulate": {{"until": 1}}}})",
                     damping);
}
TEST(Modes, OfADampedOscillator) {
  const Modes modes = modes_of(oscillator(4));  // omega = 5, D = 4/(2 2 5) = 0.2
  ASSERT_EQ(modes.count(), 1u);
  EXPECT_NEAR(modes.result["modes"][0]["damping_ratio"], 0.2, differences);
  EXPECT_NEAR(modes.frequency(0), 5 * std::sqrt(1 - 0.04), 5 * differences);
}
TEST(Modes, OverdampedOnesDecayByTwoRates) {
  const Modes modes = modes_of(oscillator(40));  // D = 2
  ASSERT_EQ(modes.kinds(), (std::vector<std::string>{"decay", "decay"}));
  EXPECT_NEAR(modes.real(0), -5 * (2 - std::sqrt(3)), 5 * differences);
  EXPECT_NEAR(modes.real(1), -5 * (2 + std::sqrt(3)), 5 * differences);
}

// On Hertz's spring the weight m g = k d^1.5 presses d deep, where the slope is 1.5 k sqrt(d).
TEST(Modes, AboutAnEquilibriumCountTheContactThere) {
  const Modes modes = modes_of(R"({"trammel": 1, "space": "planar", "gravity": [0, -10], "initial": "equilibrium",
    "bodies": {"ball": {"type": "point_mass", "mass": 1, "position": [0, 0.01]}},
    "contacts": {"floor": {"type": "continuous_force", "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
                           "stiffness": 1e4, "exponent": 1.5, "damping": "none"}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-10}}, "simulate": {"until": 1}})");
  ASSERT_EQ(modes.count(), 2u);
  EXPECT_EQ(modes.kind(0), "zero");  // it may roll away
  EXPECT_NEAR(modes.frequency(1), std::sqrt(1.5 * 1e4 * std::sqrt(std::pow(1e-3, 2.0 / 3))), 1e-6);
}

TEST(Modes, AtATimeAreThoseOfTheStateThatARunReaches) {
  const Overrides from_the_side = {{"bodies.bar.position", "[0.5, 0]"}, {"bodies.bar.angle", "=pi/2"}};
  simulate::ModesOptions options;
  options.at = 0.3;
  Overrides until = from_the_side;
  until.push_back({"simulate.until", "0.3"});
  const Modes modes = modes_of(kBar, until, options);
  const Finished run = run_text(kBar, [&] {
    Overrides observed = until;
    observed.push_back({"record", R"({"observe": {"angle": "bar.angle"}})"});
    return observed;
  }());
  ASSERT_TRUE(run.done());
  // psi'' = -omega^2 sin psi has the slope omega^2 cos psi.
  EXPECT_NEAR(modes.frequency(0), kBarFrequency * std::sqrt(std::cos(run.end("angle"))), 1e-6);
  EXPECT_NEAR(modes.result["t"], 0.3, 1e-12);
}

TEST(Modes, OfARotatingCantilever) {
  const json data =
      json::parse(read_text(TRAMMEL_SOURCE_DIR "/tests/data/benchmarks/rotating_cantilever_frequencies.json"));
  simulate::ModesOptions options;
  options.steady = true;
  for (const int delta : {0, 1, 5})
    for (const int eta : {0, 1, 2, 5, 10}) {
      const Modes modes = modes_of_file(
          "benchmarks/rotating_cantilever.json",
          {{"parameters.eta", std::to_string(eta)}, {"parameters.delta", std::to_string(delta)}}, options);
      const auto& flapwise = data["reference"]["flapwise"][fmt::format("delta={}", delta)][fmt::format("eta={}", eta)];
      EXPECT_EQ(modes.kind(0), "zero");  // the hub
      for (std::size_t i = 0; i < 3; ++i) {
        // The data's own tolerances are 5e-4 of the value. Ritz' method comes from above, with the third power of the
        // number of modes: 20 of them leave 3.5e-5 of the third frequency at eta = 10, delta = 5, 30 leave 6e-6.
        const double mu = std::stod(flapwise[i].get<std::string>()), chordwise = std::sqrt(mu * mu - eta * eta);
        EXPECT_NEAR(modes.oscillations().at(i), chordwise, 5e-5 * chordwise) << delta << " " << eta << " " << i;
      }
    }
}

TEST(Modes, OfAClampedAndAFreePlateAreTheReferenceMeshs) {
  const json data =
      json::parse(read_text(TRAMMEL_SOURCE_DIR "/tests/data/plate/plate.json"))["classical"]["frequencies"]["kl"]["8"];
  simulate::ModesOptions options;
  options.count = 12;
  const Modes clamped = modes_of_file("plate/classical/clamped_square.json", {}, options);
  const Modes free = modes_of_file("plate/classical/free_square.json", {}, options);
  for (std::size_t i = 0; i < 6; ++i) {
    // The same discrete problem except for the quadrature's order.
    EXPECT_NEAR(clamped.oscillations().at(i) / data["clamped"][i].get<double>(), 1, 1e-6) << i;
    EXPECT_NEAR(free.oscillations().at(i) / data["free"][i].get<double>(), 1, 1e-6) << i;
    EXPECT_EQ(free.kind(i), "zero");
  }
}

// The two ways to the same modes.
TEST(Modes, OfAPlateByAKrylovSubspaceAreThoseOfTheWholeSpectrum) {
  for (const char* file : {"clamped_square", "free_square"}) {
    const scene::Scene scene = scene::Scene::load(
        fmt::format("{}/scenes/plate/classical/{}.json", TRAMMEL_SOURCE_DIR, file), {{"parameters.mesh", "4x4"}});
    simulate::Setup setup = simulate::set_up(scene, registry(), simulate::purpose_of(scene.root()));
    model::AssembledSystem system(setup.model);
    State s = setup.initial;
    system.move_to(s.t, s.q, s.v);
    system.accelerate({}, s.a, s.lambda);
    const simulate::Spectrum all = simulate::dense_modes(simulate::linearise(system, s), 16);
    const simulate::Spectrum lowest = simulate::krylov_modes(system, s, 16);
    ASSERT_EQ(lowest.modes.size(), 16u);
    for (std::size_t i = 0; i < 16; ++i) {
      EXPECT_EQ(lowest.modes[i].kind, all.modes[i].kind) << file << i;
      EXPECT_NEAR(lowest.modes[i].lambda.imag(), all.modes[i].lambda.imag(), 1e-7 * all.modes[15].lambda.imag());
    }
  }
}

TEST(Modes, OfADampedPlateByAKrylovSubspaceAreThoseOfTheWholeSpectrum) {
  const scene::Scene scene =
      scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/plate/classical/clamped_square.json",
                         {{"parameters.mesh", "4x4"}, {"bodies.plate.damping", R"({"mass": 3, "stiffness": 1e-3})"}});
  simulate::Setup setup = simulate::set_up(scene, registry(), simulate::purpose_of(scene.root()));
  model::AssembledSystem system(setup.model);
  State s = setup.initial;
  system.move_to(s.t, s.q, s.v);
  system.accelerate({}, s.a, s.lambda);
  const simulate::Spectrum all = simulate::dense_modes(simulate::linearise(system, s), 8);
  const simulate::Spectrum lowest = simulate::krylov_modes(system, s, 8);
  ASSERT_EQ(lowest.modes.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(std::abs(lowest.modes[i].lambda - all.modes[i].lambda), 0, 1e-6 * std::abs(all.modes[i].lambda)) << i;
    const double omega = std::abs(lowest.modes[i].lambda);
    EXPECT_NEAR(lowest.modes[i].damping_ratio(), 3 / (2 * omega) + 1e-3 * omega / 2, 1e-4) << i;  // Rayleigh's damping
  }
}

}  // namespace
}  // namespace trammel::test
