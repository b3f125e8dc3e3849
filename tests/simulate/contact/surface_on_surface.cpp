// Two sheets against each other: momentum, energy, closed forms of stacked and colliding sheets, the exact tangent.
#include <gmock/gmock.h>

#include "posed_contact.hpp"
#include "sheets.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;

std::string between(const std::string& A, const std::string& B, const std::string& more = "") {
  return R"("type": "penalty", "stiffness": 1e7, "between": [{"surface": ")" + A + R"("}, {"surface": ")" + B + "\"}]" +
         more;
}
const std::string damped_with_friction =
    R"(, "damping": 1e5, "friction": {"type": "regularized_coulomb", "coefficient": 0.3,
      "critical_velocity": 2.5, "form": "quadratic"})";

// The upper sheet hangs over two edges of the lower.
std::string crossed_pair(const std::string& more) {
  return sheets(R"("lower": )" + sheet("[0, 0, 0]", "", "4x2") + R"(, "upper": )" +
                    sheet("[0.31, -0.23, 0.019]", R"(, "velocity": [1, 0.4, -0.3])"),
                R"("pair": {)" + between("upper", "lower", more) + "}", "", 0.1, "[0, 0, 0]");
}

TEST(SurfaceOnSurface, TangentIsExactWithDampingAndFriction) {
  Posed posed(crossed_pair(damped_with_friction));
  posed.shake(3e-4, 0.1);
  Vec x(posed.v.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = std::sin(1 + 2.7 * double(i));
  EXPECT_LT(posed.tangent_error(x, false, 1e-7), 1e-6);
  EXPECT_LT(posed.tangent_error(x, true, 1e-4), 1e-6);
}

TEST(SurfaceOnSurface, ForcesOnBothSumToNothing) {
  Posed posed(crossed_pair(damped_with_friction));
  posed.shake(3e-4, 0.1);
  const Vec f = posed.contact_force();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double size = 0;
  for (Eigen::Index i = 0; i < f.size(); i += 3) sum += f.segment<3>(i), size += f.segment<3>(i).norm();
  EXPECT_GT(size, 1);
  EXPECT_LT(sum.norm(), 1e-13 * size);
}

// The power in a common rotation about the origin, which the sheets' own velocities are.
TEST(SurfaceOnSurface, FrictionlessForcesHaveNoMoment) {
  Posed posed(
      sheets(R"("lower": )" + sheet("[0, 0, 0]", R"(, "angular_velocity": [1, 2, 3])") + R"(, "upper": )" +
                 sheet("[0.31, -0.23, 0.019]", R"(, "angular_velocity": [1, 2, 3], "velocity": [0.728, 0.911, -0.85])"),
             R"("pair": {)" + between("upper", "lower") + "}", "", 0.1, "[0, 0, 0]"));
  const Vec f = posed.contact_force();
  EXPECT_GT(f.norm(), 1);
  EXPECT_LT(std::abs(f.dot(posed.v)), 1e-12 * f.norm() * posed.v.norm());
}

// Two equal sheets, face to face: elastic they swap their velocities after half a period of the reduced mass on the
// spring.
TEST(SurfaceOnSurface, EqualSheetsSwapTheirVelocities) {
  const Finished run = run_text(sheets(R"("lower": )" + sheet("[0, 0, 0]") + R"(, "upper": )" +
                                           sheet("[0, 0, 0.02]", R"(, "velocity": [0, 0, -0.1])"),
                                       R"("pair": {)" + between("upper", "lower") + "}",
                                       R"("a": "lower.centre.vz", "b": "upper.centre.vz")", 0.005, "[0, 0, 0]"),
                                {{"integrator.step", "1e-4"}, {"record.every", "1e-3"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto opened = run.of_kind("contact_open");
  ASSERT_EQ(opened.size(), 1u);
  EXPECT_NEAR(opened[0].t, std::acos(-1) / std::sqrt(1e7 / 10), 2e-3 * opened[0].t);  // (omega h)^2/12 = 8e-4
  EXPECT_NEAR(run.end("a"), -0.1, 1e-3 * 0.1);
  EXPECT_NEAR(run.end("b"), 0, 1e-3 * 0.1);
}

TEST(SurfaceOnSurface, StackedSheetsCarryWhatLiesOnThem) {
  const std::string held = R"(, "held_axes": "xy")";
  const Finished run = run_static(sheets(
      R"("sheet": )" + sheet("[0, 0, 0.0099]", held) + R"(, "upper": )" + sheet("[0, 0, 0.0298]", held),
      R"("floor": {)" + on_floor + R"(}, "pair": {)" + between("upper", "sheet") + "}",
      R"("floor": "contacts.floor.force", "pair": "contacts.pair.force", "gap": "contacts.pair.gap", "below": "contacts.floor.gap")",
      0.1));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("pair"), 160, 1e-5 * 160);
  EXPECT_NEAR(run.end("floor"), 320, 1e-5 * 320);
  EXPECT_NEAR(run.end("gap"), -2e-5, 1e-5 * 2e-5);
  EXPECT_NEAR(run.end("below"), -4e-5, 1e-5 * 4e-5);
}

TEST(SurfaceOnSurface, EnergyIsAccountedForWithDampingAndFriction) {
  const Finished run = run_text(
      sheets(
          R"("lower": )" + sheet("[0, 0, 0]", "", "2x2") + R"(, "upper": )" +
              sheet("[0.2, 0.1, 0.0201]", R"(, "velocity": [0.2, 0, -0.2], "angular_velocity": [0, 0.02, 0])", "2x2"),
          R"("pair": {)" +
              between(
                  "upper", "lower",
                  R"(, "damping": 2e3, "friction": {"type": "regularized_coulomb", "coefficient": 0.3, "critical_velocity": 0.01})") +
              "}",
          "\"v\": \"energy.kinetic\"", 0.01, "[0, 0, 0]"),
      {{"integrator.step", "5e-5"}, {"record.every", "1e-3"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double lost = run.result.at("energy_dissipated").at("contact_damping").get<double>() +
                      run.result.at("energy_dissipated").at("friction_total").get<double>();
  EXPECT_GT(lost, 0.01);
  EXPECT_NEAR(run.result.at("energy_drift").get<double>(), 0, 1e-2 * lost);  // second order in the step
}

TEST(SurfaceOnSurface, ASheetCannotTouchItself) {
  try {
    simulate::validate(scene::Scene::parse(sheets(R"("lower": )" + sheet("[0, 0, 0]"),
                                                  R"("pair": {)" + between("lower", "lower") + "}", "", 0.1),
                                           "test.json"),
                       registry());
    FAIL() << "accepted";
  } catch (const scene::SceneError& e) {
    EXPECT_THAT(e.what(), HasSubstr("against itself"));
  }
}

}  // namespace
}  // namespace trammel::test
