// The Simulator meets the closed forms of the impact problems.
#include <trammel/testing/problems.hpp>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

const std::string rk4 = R"({"type": "runge_kutta_4", "step": 1e-3})";

TEST(BouncingBallProblem, StrikesWhenItsClosedFormSays) {
  const problems::BouncingBall ball;
  const Finished run = run_text(ball.scene(rk4, 2.0));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> impacts = run.of_kind("impact");
  ASSERT_EQ(impacts.size(), 3u);  // at 0.452, 1.174, 1.752; the fourth at 2.21
  for (int n = 0; n < 3; ++n) {
    EXPECT_NEAR(impacts[std::size_t(n)].t, ball.impact_time(n + 1), 1e-11);  // parabolas are exact for the method
    EXPECT_NEAR(impacts[std::size_t(n)].detail.at("approach"), ball.speed_before(n + 1), 1e-10);
  }
}

TEST(StrikingBarProblem, GivesTheImpulseAndSpeedOfItsClosedForm) {
  const problems::StrikingBar bar;
  const Finished run = run_text(bar.scene(rk4));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> impacts = run.of_kind("impact");
  ASSERT_EQ(impacts.size(), 1u);
  EXPECT_NEAR(impacts[0].detail.at("impulse"), bar.impulse(), 1e-11);
  EXPECT_NEAR(run.end("vy"), bar.centre_velocity(), 1e-11);
}

}  // namespace
}  // namespace trammel::test
