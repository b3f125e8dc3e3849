// A sphere against the surface of a plate: balance of forces, exact tangent, friction.
#include <cmath>

#include <gmock/gmock.h>

#include "posed_contact.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;

// A ball of 3 kg over a clamped plate of 1 m, touching it.
std::string resting(const std::string& contact) {
  return R"({
  "trammel": 1, "space": "spatial", "gravity": [0, 0, -10],
  "bodies": {
    "plate": {"type": "tspline_plate", "geometry": {"shape": "rectangle", "along_u": [1, 0, 0], "along_v": [0, 1, 0]},
              "mesh": {"elements": "4x4"}, "thickness": 0.02, "density": 1000, "youngs_modulus": 1e8, "poissons_ratio": 0.3,
              "edges": {"u0": "clamped", "u1": "clamped", "v0": "clamped", "v1": "hinged"}},
    "ball": {"type": "point_mass", "mass": 3, "position": [0.45, 0.4, 0.1099]}},
  "contacts": {"ball": {"type": "penalty", "between": ["ball.com", {"surface": "plate"}], "radius": 0.1, "stiffness": 1e7)" +
         contact + R"(}},
  "integrator": {"type": "generalized_alpha", "rho_inf": 0.8, "step": 1e-3},
  "simulate": {"until": 0.1},
  "static": {"steps": 1},
  "record": {"every": 0.01, "observe": {"x": "ball.com.x", "z": "ball.com.z", "vx": "ball.com.vx",
                                        "force": "contacts.ball.force", "gap": "contacts.ball.gap"}}
})";
}

// The ball is held sideways by the bowl it makes alone, so it rests at the centre only by symmetry.
TEST(SurfaceContact, CarriesTheWeightOfABall) {
  const Finished run = run_static(resting(""), {{"bodies.ball.position", "[0.5, 0.45, 0.1099]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  // The law pushes along the normals of its points, which are not quite vertical: their sum is a little more.
  EXPECT_NEAR(run.end("force"), 30, 0.05 * 30);
  EXPECT_GE(run.end("force"), 30 - 1e-6);
  EXPECT_LT(run.end("gap"), 0);
}

TEST(SurfaceContact, TangentIsExactWithDampingAndFriction) {
  Posed posed(resting(R"(, "damping": 1e4, "spacing": 0.01,
      "friction": {"type": "regularized_coulomb", "coefficient": 0.3, "critical_velocity": 2.5, "form": "quadratic"})"));
  posed.shake(1e-4, 1);
  posed.q(posed.q.size() - 1) -= 0.008;  // the ball: deep enough for a hundred points
  posed.v.tail<3>() << 1.5, -0.7, -2;
  Vec x(posed.v.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = std::sin(1 + 2.7 * double(i));
  EXPECT_LT(posed.tangent_error(x, false, 1e-7), 1e-6);
  EXPECT_LT(posed.tangent_error(x, true, 1e-4), 1e-6);
}

TEST(SurfaceContact, FrictionSlowsASlidingBallByMuG) {
  const Finished run = run_text(resting(R"(, "friction": {"type": "regularized_coulomb", "coefficient": 0.2,
      "critical_velocity": 1e-3, "form": "quadratic"})"),
                                {{"bodies.ball.velocity", "[1, 0, 0]"},
                                 {"bodies.plate.youngs_modulus", "1e11"},  // as good as rigid
                                 {"bodies.ball.position", "[0.45, 0.5, 0.1099]"},
                                 {"record.every", "1e-3"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto &t = run.series.at("t"), &v = run.series.at("vx"), &force = run.series.at("force");
  double impulse = 0;  // trapezoidal, of the recorded force
  for (std::size_t i = 1; i < t.size(); ++i) impulse += (t[i] - t[i - 1]) * (force[i] + force[i - 1]) / 2;
  // Undamped: damping presses more on the points in front than behind, which slows it too. The normals of the points
  // are tilted by some per cent, and their tangents with them.
  EXPECT_NEAR(3 * (1 - v.back()) / (0.2 * impulse), 1, 0.02);
}

TEST(SurfaceContact, NeedsASphereAndALawByPoints) {
  const auto reason = [](const Overrides& overrides) -> std::string {
    try {
      simulate::validate(scene::Scene::parse(resting(""), "test.json", overrides), registry());
    } catch (const scene::SceneError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(reason({{"contacts.ball.radius", "0"}}), HasSubstr("touched by a sphere"));
  EXPECT_THAT(reason({{"contacts.ball.type", "\"continuous_force\""}}), HasSubstr("such as \"penalty\""));
  EXPECT_THAT(reason({{"contacts.ball.between", "[\"ball.com\", {\"surface\": \"plat\"}]"}}), HasSubstr("plate"));
}

}  // namespace
}  // namespace trammel::test
