// What each correction restores, what it keeps, and what a run gains by it.
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <trammel/correction.hpp>

#include "support/run_scene.hpp"
#include "system/assembled_system.hpp"
#include "simulate/start/setup.hpp"
#include "simulate/simulator.hpp"

namespace trammel::test {
namespace {

using Level = Correction::Level;

// Three masses, 1, 2 and 4 kg, in a triangle of distance joints; one joint is there twice, so the rows are redundant.
const std::string three_masses = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"a": {"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [0.3, -0.2]},
             "b": {"type": "point_mass", "mass": 2, "position": [3, 0], "velocity": [0.3, 0.7]},
             "c": {"type": "point_mass", "mass": 4, "position": [0, 4], "velocity": [-0.9, -0.2]}},
  "joints": {"ab": {"type": "distance", "between": ["a.point", "b.point"], "length": 3},
             "bc": {"type": "distance", "between": ["b.point", "c.point"], "length": 5},
             "ca": {"type": "distance", "between": ["c.point", "a.point"], "length": 4},
             "ca_again": {"type": "distance", "between": ["a.point", "c.point"], "length": 4}},
  "integrator": {"type": "runge_kutta_4", "step": 0.01}, "simulate": {"until": 1}, "record": {"every": 0.1}
})";

// The triangle as a step might leave it: positions 1e-3 and velocities 1e-2 off.
struct Perturbed {
  Perturbed()
      : setup(simulate::set_up(scene::Scene::parse(three_masses, "test.json"), registry())), system(setup.model) {
    uncorrected = setup.initial;
    uncorrected.q += 1e-3 * (Vec(6) << 0.3, -0.8, 0.5, 0.1, -0.6, 0.9).finished();
    uncorrected.v += 1e-2 * (Vec(6) << -0.4, 0.2, 0.9, -0.3, 0.5, 0.7).finished();
    state = uncorrected;
  }
  void apply(Correction& correction, Level level, double energy = 0) {
    const Outcome outcome = correction.apply(level, system, {setup.initial, uncorrected, energy}, state);
    ASSERT_TRUE(outcome.accepted()) << outcome.reason();
    system.move_to(state.t, state.q, state.v);
  }
  Vec mass() const { return (Vec(6) << 1, 1, 2, 2, 4, 4).finished(); }
  double kinetic(const State& at) const { return 0.5 * at.v.dot(mass().cwiseProduct(at.v)); }
  // m x, m v, and the angular momentum about the origin
  Eigen::Vector2d first_moment(const Vec& x) const {
    return x.segment<2>(0) + 2 * x.segment<2>(2) + 4 * x.segment<2>(4);
  }
  double spin(const State& at) const {
    double sum = 0;
    for (int i = 0; i < 6; i += 2) sum += mass()(i) * (at.q(i) * at.v(i + 1) - at.q(i + 1) * at.v(i));
    return sum;
  }

  simulate::Setup setup;
  model::AssembledSystem system;
  State uncorrected, state;
};

std::unique_ptr<Correction> correction(const std::string& json) {
  return made<Correction>(Kind::correction, json);
}

double largest(const Finished& run, const char* level) {
  return run.result.at("constraint_maxima").at(level).get<double>();
}

// Rows of metres, numbers of size 5: round-off of a row is a few 1e-16 times 5.
constexpr double round_off = 2e-15;

class RowCorrection : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Correction> method = correction(fmt::format(R"({{"type": "{}"}})", GetParam()));
  Perturbed triangle;
};

TEST_P(RowCorrection, RestoresPositionsToRoundOffThoughRowsAreRedundant) {
  triangle.apply(*method, Level::position);
  EXPECT_LT(triangle.system.g().lpNorm<Eigen::Infinity>(), round_off);
}

TEST_P(RowCorrection, RestoresVelocitiesToRoundOffThoughRowsAreRedundant) {
  triangle.apply(*method, Level::position);
  triangle.apply(*method, Level::velocity);
  EXPECT_LT(triangle.system.g_dot().lpNorm<Eigen::Infinity>(), round_off);
}

TEST_P(RowCorrection, LeavesWhatIsRightAlone) {
  triangle.apply(*method, Level::position);
  triangle.apply(*method, Level::velocity);
  const State once = triangle.state;
  triangle.apply(*method, Level::position);
  triangle.apply(*method, Level::velocity);
  EXPECT_LT((triangle.state.q - once.q).norm(), 4 * round_off);
  EXPECT_LT((triangle.state.v - once.v).norm(), 4 * round_off);
}

INSTANTIATE_TEST_SUITE_P(Of, RowCorrection, testing::Values("minimum_norm", "mass_weighted"),
                         [](const testing::TestParamInfo<const char*>& method) { return method.param; });

TEST(MinimumNorm, ChangesVelocitiesByTheLeastNormThatDoes) {
  Perturbed triangle;
  triangle.apply(*correction(R"({"type": "minimum_norm"})"), Level::velocity);
  // The least change has no part in the null space of G: it is orthogonal to the velocities that remain.
  const Vec dv = triangle.state.v - triangle.uncorrected.v;
  ASSERT_GT(dv.norm(), 1e-3);
  EXPECT_NEAR(dv.dot(triangle.state.v), 0, 1e-14);
}

TEST(MassWeighted, KeepsTheCentreOfMass) {
  Perturbed triangle;
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::position);
  const auto before = triangle.first_moment(triangle.uncorrected.q), after = triangle.first_moment(triangle.state.q);
  EXPECT_LT((after - before).norm(), 2e-14);  // 7 kg m times 16 eps
}

TEST(MassWeighted, KeepsLinearAndAngularMomentum) {
  Perturbed triangle;
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::velocity);
  const auto before = triangle.first_moment(triangle.uncorrected.v), after = triangle.first_moment(triangle.state.v);
  EXPECT_LT((after - before).norm(), 1e-14);
  EXPECT_NEAR(triangle.spin(triangle.state), triangle.spin(triangle.uncorrected), 1e-14);
}

TEST(MassWeighted, TakesKineticEnergyAsAnImpactDoes) {
  Perturbed triangle;
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::velocity);
  EXPECT_LT(triangle.kinetic(triangle.state), triangle.kinetic(triangle.uncorrected));
}

TEST(NullSpaceRotation, RestoresVelocitiesAndKeepsTheEnergyOfTheirFreePart) {
  Perturbed triangle;
  // What the rows of the uncorrected place forbid is dropped, the rest is turned: take a velocity that they allow.
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::velocity);
  triangle.uncorrected = triangle.state;
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::position);
  triangle.apply(*correction(R"({"type": "null_space_rotation"})"), Level::velocity);
  EXPECT_LT(triangle.system.g_dot().lpNorm<Eigen::Infinity>(), round_off);
  EXPECT_NEAR(triangle.kinetic(triangle.state), triangle.kinetic(triangle.uncorrected), 1e-14);
}

TEST(NullSpaceRotation, KeepsTheNormInTheMetricOfTheIdentity) {
  Perturbed triangle;
  triangle.apply(*correction(R"({"type": "minimum_norm"})"), Level::velocity);
  triangle.uncorrected = triangle.state;
  triangle.apply(*correction(R"({"type": "minimum_norm"})"), Level::position);
  triangle.apply(*correction(R"({"type": "null_space_rotation", "metric": "identity"})"), Level::velocity);
  EXPECT_NEAR(triangle.state.v.norm(), triangle.uncorrected.v.norm(), 1e-14);
}

TEST(NullSpaceRotation, LeavesAnArchOfTwoBarsAtRest) {
  const Finished run = run_text(R"({
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {"a": {"type": "bar", "mass": 1, "from": [0, 0], "to": [1, 1]},
               "b": {"type": "bar", "mass": 1, "from": [1, 1], "to": [2, 0]}},
    "joints": {"left": {"type": "revolute", "between": ["ground", "a.from"]},
               "crown": {"type": "revolute", "between": ["a.to", "b.from"]},
               "right": {"type": "revolute", "between": [{"point": [2, 0]}, "b.to"]}},
    "corrections": {"velocity": "null_space_rotation"},
    "integrator": {"type": "runge_kutta_4", "step": 0.01}, "simulate": {"until": 1}, "record": {"every": 0.1}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(run.end("energy_kinetic"), 1e-25);
}

TEST(NullSpaceRotation, GivesAMechanismThatIsDrivenThroughoutTheVelocitiesItsRowsAskFor) {
  const Finished run = run_text(R"({
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {"crank": {"type": "rigid_body", "mass": 1, "inertia": 1, "position": [1, 0], "angular_velocity": 2,
                         "velocity": [0, 2], "markers": {"hub": [-1, 0]}}},
    "joints": {"drive": {"type": "revolute", "between": ["ground", "crank.hub"], "angle": "=2*t"}},
    "corrections": {"velocity": "null_space_rotation"},
    "integrator": {"type": "runge_kutta_4", "step": 0.01}, "simulate": {"until": 1}, "record": {"every": 0.1}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(largest(run, "velocity"), 1e-14);  // of speeds of 2 m/s
  EXPECT_NEAR(run.end("energy_kinetic"), 4, 1e-13);
}

TEST(EnergyCorrection, MeetsTheEnergyThatIsDueAndKeepsTheRows) {
  Perturbed triangle;
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::position);
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::velocity);
  triangle.apply(*correction(R"({"type": "energy"})"), Level::energy, 2.5);
  EXPECT_NEAR(triangle.system.energy().total(), 2.5, 1e-15 * 2.5 * 4);
  EXPECT_LT(triangle.system.g_dot().lpNorm<Eigen::Infinity>(), round_off);
}

TEST(EnergyCorrection, WaitsWhereThereIsNoEnergyToScale) {
  Perturbed triangle;
  const Vec v = triangle.state.v;
  triangle.apply(*correction(R"({"type": "energy"})"), Level::energy, -1);  // no velocity has this energy
  EXPECT_EQ(triangle.state.v, v);
}

// Scaled with the rest they would grow at every turning point: the mast S1o broke down within 1e5 steps.
TEST(EnergyCorrection, LeavesTheRatesOfTheRowsAsTheyAreWhereNothingCorrectsThem) {
  Perturbed triangle;
  triangle.system.move_to(triangle.state.t, triangle.state.q, triangle.state.v);
  const Vec before = triangle.system.g_dot();
  ASSERT_GT(before.norm(), 1e-3);
  triangle.apply(*correction(R"({"type": "energy"})"), Level::energy, 2.5);
  EXPECT_NEAR(triangle.system.energy().total(), 2.5, 1e-15 * 2.5 * 4);
  EXPECT_LT((triangle.system.g_dot() - before).lpNorm<Eigen::Infinity>(), round_off);
}

TEST(EnergyCorrection, KeepsMomentumIfAsked) {
  Perturbed triangle;
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::position);
  // Free: the triangle is rigid, so no part of its motion is left to scale.
  triangle.apply(*correction(R"({"type": "mass_weighted"})"), Level::velocity);
  const Vec rigid = triangle.state.v;
  const auto method = correction(R"({"type": "energy", "keeps": "momentum"})");
  triangle.apply(*method, Level::energy, 2.5);
  EXPECT_LT((triangle.state.v - rigid).norm(), 1e-12);
}

// Bars that unfold freely and spin, 1e4 steps of RK4; all corrections.
struct FreeMast {
  explicit FreeMast(const char* keeps)
      : setup(simulate::set_up(
            scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/truss/S1f.json",
                               {{"parameters.n", "2"},
                                {"integrator.step", "1e-4"},
                                {"simulate.until", "1"},
                                {"contacts", "{}"},
                                {"corrections.energy", fmt::format(R"({{"type": "energy", "keeps": "{}"}})", keeps)}}),
            registry())) {
    std::vector<simulate::Simulator::LevelCorrection> corrections;
    for (const auto& c : setup.corrections) corrections.push_back({c.level, c.correction.get(), &c.origin});
    simulator.emplace(setup.model, *setup.integrator, setup.settings, corrections);
    std::filesystem::create_directories(folder.path());
    recorder.emplace(folder.path(), *setup.model, setup.columns, std::nullopt);
    simulator->start(setup.initial);
  }
  // Linear and angular momentum at a state [kg m/s, kg m^2/s].
  Eigen::Vector3d momentum(const State& state) {
    Eigen::Vector3d all = Eigen::Vector3d::Zero();
    for (const model::BodyEntry& body : setup.model->bodies) {
      const Momentum one =
          body.momentum->momentum(state.t, state.q.segment(body.q0, body.nq), state.v.segment(body.v0, body.nv));
      all += Eigen::Vector3d(one.linear(0), one.linear(1), one.angular(0));
    }
    return all;
  }

  Folder folder;
  simulate::Setup setup;
  std::optional<simulate::Simulator> simulator;
  std::optional<simulate::Recorder> recorder;
};

TEST(EnergyCorrection, LeavesLinearAndAngularMomentumOfAFreeMastAloneFor10000Steps) {
  FreeMast mast("momentum");
  const Eigen::Vector3d start = mast.momentum(mast.simulator->state());
  ASSERT_GT(start(2), 0.1);
  for (int i = 0; i < 10000; ++i) mast.simulator->advance(*mast.recorder);
  // Round-off of 1e4 steps, adding up like a random walk: 1e2 eps of speeds and masses of order 1, ten times that for
  // luck.
  EXPECT_LT((mast.momentum(mast.simulator->state()) - start).norm(), 2e-13);
  EXPECT_LT(std::abs(mast.simulator->energy_drift()), 1e-13);
}

// A pendulum in natural coordinates, 1000 steps of RK4, a fortieth of a period each.
Finished swing(const std::string& corrections, const std::string& type = "runge_kutta_4") {
  return run_text(fmt::format(R"({{
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {{"bob": {{"type": "point_mass", "mass": 1, "position": [1, 0]}}}},
    "joints": {{"rod": {{"type": "distance", "between": ["ground", "bob.point"], "length": 1}}}},
    "integrator": {{"type": "{}", "step": 0.05}}, "corrections": {{{}}},
    "simulate": {{"until": 50}}, "record": {{"every": 1}}}})",
                              type, corrections));
}

TEST(Corrections, KeepTheRowsOfALongRunWhereNothingElseDoes) {
  const Finished none = swing(""), both = swing(R"("position": "minimum_norm", "velocity": "minimum_norm")");
  EXPECT_GT(largest(none, "position"), 1e-3);
  EXPECT_LT(largest(both, "position"), 1e-15);
  EXPECT_LT(largest(both, "velocity"), 2e-15);  // of speeds up to 4.4 m/s
}

TEST(Corrections, KeepTheEnergyOfALongRun) {
  const std::string rows = R"("position": "minimum_norm", "velocity": "minimum_norm")";
  const auto drift = [](const Finished& run) { return std::abs(run.result.at("energy_drift").get<double>()); };
  EXPECT_GT(drift(swing(rows)), 1e-4);
  EXPECT_LT(drift(swing(rows + R"(, "energy": {"type": "energy", "least": 0})")), 1e-13);
}

TEST(Corrections, WorkWithEveryIntegrator) {
  for (const char* type :
       {"hht_alpha", "newmark", "generalized_alpha", "adams_baumgarte", "runge_kutta_4", "dormand_prince", "dop853"}) {
    const Finished run = swing(R"("position": "mass_weighted", "velocity": "mass_weighted", "energy": true)", type);
    ASSERT_TRUE(run.done()) << type << ": " << run.report.reason;
    EXPECT_LT(largest(run, "position"), 1e-15) << type;
    EXPECT_LT(largest(run, "velocity"), 2e-15) << type;
  }
}

TEST(Corrections, OfALevelThatTheMethodDoesNotKnowAreRefusedWithThoseThatDo) {
  try {
    swing(R"("energy": "minimum_norm")");
    FAIL() << "accepted";
  } catch (const scene::SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("does not correct the energy; those that do: energy"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace trammel::test
