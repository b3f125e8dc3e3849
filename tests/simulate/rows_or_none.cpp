// Integrators that take no rows (Traits::rows): scenes that have some, or make some, are refused before the run.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string scene(const std::string& more) {
  return fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -10], "plugins": ["{}/tests/plugins/free_euler.so"],
    "bodies": {{"ball": {{"type": "rigid_body", "mass": 1, "inertia": 1, "position": [0, 1], "markers": {{"top": [0, 1]}}}}}}, {}
    "integrator": {{"type": "free_euler", "step": 1e-3}}, "simulate": {{"until": 0.2}},
    "record": {{"every": 0.1, "observe": {{"y": "ball.com.y"}}}}}})",
      TRAMMEL_BUILD_DIR, more);
}

std::string refusal(const std::string& more) {
  try {
    simulate::validate(scene::Scene::parse(scene(more), "test.json"), registry());
  } catch (const scene::SceneError& e) {
    return e.what();
  }
  return "accepted";
}

const std::string plane = R"("between": ["ball.com", {"plane": {"point": [0, 0], "normal": [0, 1]}}])";

TEST(IntegratorWithoutRows, RunsWhatHasNone) {
  const Finished run = run_text(scene(""));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("y"), 1 - 10 * 0.2 * 0.2 / 2, 1e-3 * 10 * 0.2);  // of first order
  EXPECT_EQ(refusal(R"("contacts": {"floor": {"type": "continuous_force", "stiffness": 1e5, )" + plane + "}},"),
            "accepted");
}

TEST(IntegratorWithoutRows, IsRefusedByNameWhereAJointOrAContactHasRows) {
  EXPECT_THAT(refusal(R"("joints": {"pin": {"type": "revolute", "between": ["ground", "ball.top"]}},)"),
              AllOf(HasSubstr("joints.pin has rows"), HasSubstr("integrators that do: "), HasSubstr("dop853")));
  EXPECT_THAT(refusal(R"("contacts": {"floor": {"type": "constraint_method", )" + plane + "}},"),
              AllOf(HasSubstr("contacts.floor is a row while it is closed"), HasSubstr("generalized_alpha")));
  EXPECT_THAT(refusal(R"("contacts": {"floor": {"type": "continuous_force", "stiffness": 1e5, "friction":
                {"type": "coulomb", "static": 0.3, "kinetic": 0.3}, )" +
                      plane + "}},"),
              HasSubstr("the friction of contacts.floor sticks in a row"));
  EXPECT_THAT(refusal(R"("joints": {"pin": {"type": "revolute", "between": ["ground", "ball.top"]}},)"),
              testing::Not(HasSubstr("free_euler,")));  // it does not recommend itself
}

}  // namespace
}  // namespace trammel::test
