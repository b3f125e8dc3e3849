// The bar in natural coordinates, beyond the checks of tests/plugins/shipped_components.cpp: it moves as a rigid rod
// does.
#include <cmath>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// A pendulum that starts at rest at an angle to the vertical, as the rod named, on end at the origin.
std::string pendulum(const std::string& body, const std::string& end, const std::string& more = "") {
  return R"({"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {"rod": )" +
         body + R"(}, "joints": {"pin": {"type": "revolute", "between": ["ground", "rod.)" + end + R"("]}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-11}}, "simulate": {"until": 2},
    "record": {"every": 0.1, "observe": {"angle": "rod.angle", "pin": "joints.pin.reaction", "T": "energy.kinetic",
                                         "E": "energy.total"}})" +
         more + "}";
}

TEST(Bar, SwingsAsARigidRodWithAPointAtItsEnd) {
  // Both 1.2 m, 2 kg, with 0.5 kg at the free end: centre of mass and inertia of the rigid body put together from
  // these.
  const Finished bar = run_text(
      pendulum(R"({"type": "bar", "mass": 2, "from": [0, 0], "to": [1.2, 0], "end_masses": [0, 0.5]})", "from"));
  const Finished rigid = run_text(pendulum(
      R"({"type": "rigid_body", "mass": 2.5, "inertia": 0.384, "position": [0.72, 0], "markers": {"end": [-0.72, 0]}})",
      "end"));
  ASSERT_TRUE(bar.done()) << bar.report.reason;
  for (std::size_t i = 0; i < bar.series.at("t").size(); ++i) {
    EXPECT_NEAR(bar.series.at("angle")[i], rigid.series.at("angle")[i], 1e-9);
    EXPECT_NEAR(bar.series.at("pin")[i], rigid.series.at("pin")[i], 1e-6);
    EXPECT_NEAR(bar.series.at("T")[i], rigid.series.at("T")[i], 1e-7);
  }
}

TEST(Bar, SwingsAlikeWithAnImplicitMethodAndOwnRowsInItsIteration) {
  const std::string body = R"({"type": "bar", "mass": 2, "from": [0, 0], "to": [1.2, 0]})";
  const Finished exact = run_text(pendulum(body, "from"));
  const Finished alpha = run_text(pendulum(body, "from", R"(, "title": "hht")"),
                                  {{"integrator", R"({"type": "hht_alpha", "alpha": 0, "step": 1e-3})"}});
  ASSERT_TRUE(alpha.done()) << alpha.report.reason;
  EXPECT_NEAR(alpha.end("angle"), exact.end("angle"), 2e-5);  // second order: the phase of 6 rad/s over 2 s
  // Newton's method with the exact tangent: as many iterations as a rigid body takes, 6 with those of the velocity
  // rows, or one more.
  const auto& counts = alpha.result["counts"];
  EXPECT_LT(counts["newton_iterations"].get<double>(), 7 * counts["steps"].get<double>());
}

TEST(Bar, MovesItsEndsOntoALengthThatDiffersWhenAsked) {
  const std::string body = R"({"type": "bar", "mass": 2, "from": [0, 0], "to": [1.1, 0], "length": 1.2})";
  try {
    run_text(pendulum(body, "from"));
    FAIL() << "a bar that is too short was taken";
  } catch (const scene::SceneError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("bodies.rod: the initial state does not satisfy this body's own rows: off by "
                        "0.1 (m, rad) in position"),
              std::string::npos)
        << error.what();
  }
  const Finished run = run_text(pendulum(body, "from", R"(, "initial": {"consistent": "project"})"));
  ASSERT_TRUE(run.done()) << run.report.reason;
}

TEST(Bar, HasNoMeaningWithoutLengthOrMass) {
  const auto error = [](const std::string& entry) {
    try {
      run_text(pendulum(entry, "from"));
    } catch (const scene::SceneError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error(R"({"type": "bar", "mass": 2, "from": [1, 2], "to": [1, 2]})").find("the bar has length 0"),
            std::string::npos);
  for (const char* to : {"[0, 1e-300]", "[1e200, 1e200]"})
    EXPECT_NE(error(fmt::format(R"({{"type": "bar", "mass": 2, "from": [0, 0], "to": {}}})", to))
                  .find("too short or too long for its length to be squared"),
              std::string::npos)
        << to;
  EXPECT_NE(
      error(R"({"type": "bar", "mass": 0, "from": [0, 0], "to": [1, 2]})").find("a bar without mass needs a point"),
      std::string::npos);
  EXPECT_NE(error(R"({"type": "bar", "mass": 1, "from": [0, 0], "to": [1, 2], "end_masses": [1, 2, 3]})")
                .find("expected one number for both ends, or two"),
            std::string::npos);
}

}  // namespace
}  // namespace trammel::test
