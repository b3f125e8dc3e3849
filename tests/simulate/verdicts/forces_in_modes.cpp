// Forces in given modes, and contacts at their bounds, each without the rest of a decision.
#include "simulate/verdicts/forces_in_modes.hpp"

#include "simulate/verdicts/held_at_bounds.hpp"

#include "../point_at_event.hpp"

namespace trammel::test {
namespace {

// On the floor, whatever pulls.
struct Closed : PointAtEvent {
  explicit Closed(const std::string& gravity) : PointAtEvent(gravity) {
    mode().closed = true;
    problem.who = {{.contact = 0}};
    problem.prepare(system);
  }
  simulate::ContactProblem problem;
  simulate::ForcesInModes forces{scene, at, problem};
};

TEST(ForcesInModes, AreThoseOfTheRowsThatTheModesClose) {
  Closed point("[0, -10]");
  ASSERT_TRUE(point.forces.exist(point.state));
  EXPECT_NEAR(point.system.normal_force(0, point.forces.lambda()), 20, 1e-12);
  EXPECT_NEAR(point.system.acceleration({0, 0}, point.forces.a()), 0, 1e-12);
}

TEST(ForcesInModes, CanBeExertedIfTheyPush) {
  Closed pressed("[0, -10]"), pulled("[0, 10]");
  EXPECT_EQ(pressed.forces.can_be_exerted(pressed.state), std::vector<bool>{true});
  EXPECT_EQ(pulled.forces.can_be_exerted(pulled.state), std::vector<bool>{false});
}

TEST(ForcesInModes, CanBeExertedIfFrictionIsInItsCone) {
  for (const auto& [pull, exerted] : {std::pair{"[4.9, -10]", true}, std::pair{"[5.1, -10]", false}}) {
    Closed point(pull);
    point.mode().friction = model::ContactMode::Friction::stick;
    EXPECT_EQ(point.forces.can_be_exerted(point.state), std::vector<bool>{exerted}) << pull;
  }
}

TEST(HeldAtBounds, LetGoOnlyWhereSlidingFrictionIsLess) {
  simulate::Participant less, same;
  less.mu_0 = same.mu_0 = same.mu = 0.5, less.mu = 0.4;
  EXPECT_FALSE(simulate::HeldAtBounds::let_go({&same}));
  EXPECT_TRUE(simulate::HeldAtBounds::let_go({&same, &less}));
  EXPECT_TRUE(less.let_go);
  EXPECT_FALSE(same.let_go);
  EXPECT_FALSE(simulate::HeldAtBounds::let_go({&less}));  // it has
}

}  // namespace
}  // namespace trammel::test
