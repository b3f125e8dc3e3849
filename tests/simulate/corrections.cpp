// The contract that a correction may rely on, checked by one that records its arguments and changes v.
#include <cmath>

#include <trammel/correction.hpp>

#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

class Nudge final : public Correction {
 public:
  explicit Nudge(double factor) : factor_(factor) {}
  bool corrects(Level level) const override { return level == Level::velocity; }
  Outcome apply(Level, System&, const Step& step, State& state) override {
    h = state.t - step.now.t;
    energy = step.energy;
    uncorrected_v = step.uncorrected.v;
    state.v *= factor_;
    return Outcome::accept();
  }
  void restart(System&, const State&) override { ++restarts; }

  double h = 0, energy = 0;
  Vec uncorrected_v;
  int restarts = 0;

 private:
  double factor_;
};

// 1 kg at 2 m/s along a damper of 3 N s/m: v = 2 exp(-3 t).
const std::string damped = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"mass": {"type": "point_mass", "mass": 1, "position": [1, 0], "velocity": [2, 0]}},
  "forces": {"damper": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 0, "damping": 3,
                        "length": 1}},
  "integrator": {"type": "runge_kutta_4", "step": 1e-3},
  "simulate": {"until": 1}, "record": {"every": 0.1}
})";

const std::string swinging = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"bar": {"type": "rigid_body", "mass": 3, "inertia": 1, "position": [0.5, 0], "velocity": [0, 1],
                     "angular_velocity": 2, "markers": {"end": [-0.5, 0]}}},
  "joints": {"hinge": {"type": "revolute", "between": ["ground", "bar.end"]}},
  "integrator": {"type": "hht_alpha", "step": 1e-3},
  "simulate": {"until": 1}, "record": {"every": 0.1}
})";

struct OneStep {
  OneStep(const std::string& text, Correction& correction)
      : setup(simulate::set_up(scene::Scene::parse(text, "test.json"), registry())),
        simulator(setup.model, *setup.integrator, setup.settings,
                  {{Correction::Level::velocity, &correction, nullptr}}),
        recorder(made(folder.path()), *setup.model, setup.columns, std::nullopt) {
    simulator.start(setup.initial);
    simulator.advance(recorder);
  }
  static const std::filesystem::path& made(const std::filesystem::path& path) {
    std::filesystem::create_directories(path);
    return path;
  }
  const State& state() const { return simulator.state(); }

  Folder folder;
  simulate::Setup setup;
  simulate::Simulator simulator;
  simulate::Recorder recorder;
};

TEST(Correction, SeesTheStepAsTheIntegratorLeftIt) {
  Nudge nudge(1.5);
  const OneStep one(damped, nudge);
  EXPECT_DOUBLE_EQ(nudge.h, 1e-3);
  EXPECT_NEAR(nudge.uncorrected_v(0), 2 * std::exp(-3e-3), 1e-14);  // RK4: (c h)^5/120 = 2e-15
  EXPECT_DOUBLE_EQ(one.state().v(0), 1.5 * nudge.uncorrected_v(0));
}

TEST(Correction, IsGivenTheEnergyThatIsDueAtTheStepsEnd) {
  Nudge nudge(1.5);
  const OneStep one(damped, nudge);
  EXPECT_NEAR(nudge.energy, 2 * std::exp(-6e-3), 1e-13);  // Simpson: (2 c h)^5/2880 = 3e-15
}

TEST(Correction, OfTheVelocityChangesTheForcesOfTheNextStep) {
  Nudge nudge(1.5);
  const OneStep one(damped, nudge);
  EXPECT_DOUBLE_EQ(one.state().a(0), -3 * one.state().v(0));
}

TEST(Correction, OfTheVelocityChangesTheReactions) {
  // The hinge holds the bar with m w^2 L/2: 6 N at w = 2 rad/s, 13.5 N at the new w.
  Nudge nudge(1.5);
  const OneStep one(swinging, nudge);
  const double w = one.state().v(2);
  ASSERT_NEAR(w, 3, 1e-5);  // the method's error
  EXPECT_NEAR(one.state().lambda.norm(), 3 * w * w * 0.5, 1e-12);
}

TEST(Correction, IsNobodysSupply) {
  Nudge nudge(1.5);
  OneStep one(damped, nudge);
  const double added = 0.5 * (1.5 * 1.5 - 1) * nudge.uncorrected_v.squaredNorm();
  EXPECT_NEAR(one.simulator.energy_drift(), added, 1e-13);
}

TEST(Correction, IsRestartedBeforeTheFirstStep) {
  Nudge nudge(1);
  const OneStep one(damped, nudge);
  EXPECT_EQ(nudge.restarts, 1);
}

}  // namespace
}  // namespace trammel::test
