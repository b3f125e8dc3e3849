// Joints all of whose markers are fixed already: rows of rank 0, alone or beside a rank of others. They are redundant,
// and the motion is that without them.
#include <filesystem>
#include <ostream>

#include <fmt/format.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

struct Case {
  const char *name, *bodies, *joints, *observed;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

const char* const beam = R"("b": {"type": "assumed_mode_beam", "length": 1, "area": 1e-4, "second_moment": 1e-9,
    "density": 2700, "youngs_modulus": 7e10, "modes": {"transverse": 2})";

const std::string clamped = std::string(beam) + R"(, "mount": {"clamped": [0, 0]}})";
const std::string hinged = std::string(beam) + R"(, "mount": {"hinge": [0, 0]}})";

const Case cases[] = {
    {"ClampedBeam", clamped.c_str(), R"("j": {"type": "fixed", "between": ["ground", "b.root"]})", "b.tip.y"},
    {"HingedBeam", hinged.c_str(), R"("j": {"type": "revolute", "between": ["ground", "b.root"]})", "b.tip.y"},
    {"FreeBodyBesideABase", R"("base": {"type": "moving_base"},
        "ball": {"type": "rigid_body", "mass": 1, "inertia": 1})",
     R"("j": {"type": "revolute", "between": ["ground", "base.origin"]})", "ball.com.y"},
    {"BaseAlone", R"("base": {"type": "moving_base"})",
     R"("j": {"type": "revolute", "between": ["ground", "base.origin"]})", "base.origin.x"},
    {"BesideAJointThatHolds", R"("base": {"type": "moving_base"},
        "ball": {"type": "rigid_body", "mass": 1, "inertia": 1, "position": [-0.1, 0], "markers": {"top": [0.1, 0]}})",
     R"("j": {"type": "fixed", "between": ["ground", "base.origin"]})", "ball.com.y"},
};

std::string scene(const Case& c, const std::string& joints, const std::string& integrator) {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81], "bodies": {{{}}}, "joints": {{{}}},
    "integrator": {{"type": "{}", "step": 1e-3}}, "simulate": {{"until": 0.05}},
    "record": {{"every": 0.01, "observe": {{"at": "{}"}}}}}})",
                     c.bodies, joints, integrator, c.observed);
}

class JointsThatHoldNothing : public testing::TestWithParam<Case> {};

TEST_P(JointsThatHoldNothing, LeaveTheMotionAsItIs) {
  const Case& c = GetParam();
  const bool holds = std::string(c.name) == "BesideAJointThatHolds";
  const std::string pin = holds ? R"("pin": {"type": "revolute", "between": ["ground", "ball.top"]})" : "";
  for (const char* integrator :
       {"dop853", "runge_kutta_4", "newmark", "hht_alpha", "generalized_alpha", "sundials_ida"}) {
    SCOPED_TRACE(integrator);
    if (!std::filesystem::exists(fmt::format("{}/lib/trammel/{}.so", TRAMMEL_BUILD_DIR, integrator)))
      continue;  // sundials_ida is built where SUNDIALS is installed
    const Finished with = run_text(scene(c, pin + (holds ? ", " : "") + c.joints, integrator)),
                   without = run_text(scene(c, pin, integrator));
    ASSERT_TRUE(with.done()) << with.report.reason;
    ASSERT_TRUE(without.done()) << without.report.reason;
    for (std::size_t k = 0; k < with.series.at("at").size(); ++k)
      EXPECT_NEAR(with.series.at("at")[k], without.series.at("at")[k], 1e-12);  // round-off of 50 steps
  }
}

INSTANTIATE_TEST_SUITE_P(Of, JointsThatHoldNothing, testing::ValuesIn(cases),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace trammel::test
