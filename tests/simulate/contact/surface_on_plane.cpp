// A whole sheet against a plane: closed forms of a sheet at rest, sliding and bouncing, the exact tangent, what is
// refused.
#include <gmock/gmock.h>

#include "posed_contact.hpp"
#include "sheets.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;

constexpr double weight = 160, depth = 200 / 1e7;  // [N], [m]: rho g t A and rho g t / k

const std::string floor_contact = R"("floor": {)" + on_floor + "}";
const std::string resting = sheets(R"("sheet": )" + sheet("[0, 0, 0.0099]", R"(, "held_axes": "xy")"), floor_contact,
                                   R"("force": "contacts.floor.force", "gap": "contacts.floor.gap")", 0.1);

TEST(SurfaceOnPlane, PressesAsMuchAsItWeighs) {
  const Finished run = run_static(resting);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("force"), weight, 1e-6 * weight);  // the solver's tolerance
}

TEST(SurfaceOnPlane, SinksInByItsPressureOverTheStiffness) {
  const Finished run = run_static(resting);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("gap"), -depth, 1e-6 * depth);  // everywhere the same, as Gauss points integrate cubics exactly
}

TEST(SurfaceOnPlane, ByPointsTheirNumberCounts) {
  // Elements of 1/3 m x 0.8/3 m have 4 x 3 points, the 3x3 of them 108, which stand for equal areas.
  const Finished points = run_static(
      resting,
      {{"contacts.floor.by", "\"points\""}, {"contacts.floor.stiffness", "1e5"}, {"contacts.floor.spacing", "0.1"}});
  const Finished area =
      run_static(resting, {{"contacts.floor.stiffness", "1.35e7"}, {"contacts.floor.spacing", "0.1"}});
  ASSERT_TRUE(points.done() && area.done()) << points.report.reason << area.report.reason;
  EXPECT_NEAR(points.end("gap"), area.end("gap"), 1e-9 * depth);
}

// Rigid in itself, as only its uniform fall meets the plane: y'' = -g - k y/(rho t) with damping c/(rho t).
TEST(SurfaceOnPlane, BouncesLikeAMassOnASpring) {
  const std::string falling =
      sheets(R"("sheet": )" + sheet("[0, 0, 0.01]", R"(, "velocity": [0, 0, -0.1])"), floor_contact,
             R"("v": "sheet.centre.vz", "gap": "contacts.floor.gap")", 0.006, "[0, 0, 0]");
  const Finished run = run_text(falling, {{"integrator.step", "2e-5"}, {"record.every", "1e-4"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("v"), 0.1, 1e-4 * 0.1);
  const auto opened = run.of_kind("contact_open");
  ASSERT_EQ(opened.size(), 1u);
  // Half a period of sqrt(k/(rho t)) = 707 1/s, which steps h make longer by (omega h)^2/12 = 2e-5.
  EXPECT_NEAR(opened[0].t, std::acos(-1) / std::sqrt(1e7 / 20), 1e-4 * opened[0].t);
}

TEST(SurfaceOnPlane, EnergyIsAccountedForWithDampingAndFriction) {
  const Finished run = run_text(
      sheets(
          R"("sheet": )" +
              sheet("[0, 0, 0.012]", R"(, "velocity": [0.3, 0.1, -0.4], "angular_velocity": [0.3, -0.2, 0])"),
          R"("floor": {)" + on_floor +
              R"(, "damping": 2e4, "friction": {"type": "regularized_coulomb", "coefficient": 0.3, "critical_velocity": 0.01}})",
          "\"v\": \"energy.kinetic\"", 0.04),
      {{"integrator.step", "5e-5"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double lost = run.result.at("energy_dissipated").at("contact_damping").get<double>() +
                      run.result.at("energy_dissipated").at("friction_total").get<double>();
  EXPECT_GT(lost, 0.1);
  EXPECT_NEAR(run.result.at("energy_drift").get<double>(), 0, 2e-3 * lost);  // second order in the step
}

// v^2 / (2 mu g), and creep below the critical velocity.
std::string sliding(const std::string& gravity, const std::string& velocity) {
  return sheets(
      R"("sheet": )" + sheet("[0, 0, 0.00998]", R"(, "velocity": )" + velocity),
      R"("floor": {)" + on_floor +
          R"(, "friction": {"type": "regularized_coulomb", "coefficient": 0.3, "critical_velocity": 1e-3}})",
      R"("x": "sheet.centre.x", "y": "sheet.centre.y", "z": "sheet.centre.z", "force": "contacts.floor.force")", 0.4,
      gravity);
}

TEST(SurfaceOnPlane, SlidesAsFarAsFrictionLetsIt) {
  const Finished run = run_text(sliding("[0, 0, -10]", "[0.8, 0.6, 0]"), {{"integrator.rho_inf", "0.8"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double path = std::hypot(run.end("x") - 0.5, run.end("y") - 0.4);
  EXPECT_NEAR(path, 1 / (2 * 0.3 * 10), 1e-3 * path);
}

TEST(SurfaceOnPlane, IsTheSameInATurnedFrame) {
  // Turned by 120 degrees about (1, 1, 1): x -> y -> z -> x.
  const Finished level = run_text(sliding("[0, 0, -10]", "[0.8, 0.6, 0]"), {{"simulate.until", "0.1"}});
  const Finished turned = run_text(
      sliding("[-10, 0, 0]", "[0, 0.8, 0.6]"),
      {{"simulate.until", "0.1"},
       {"bodies.sheet.geometry.origin", "[0.00998, 0, 0]"},
       {"bodies.sheet.geometry.along_u", "[0, 1, 0]"},
       {"bodies.sheet.geometry.along_v", "[0, 0, 0.8]"},
       {"contacts.floor.between", R"([{"surface": "sheet"}, {"plane": {"point": [0, 5, 7], "normal": [3, 0, 0]}}])"}});
  ASSERT_TRUE(level.done() && turned.done()) << turned.report.reason;
  EXPECT_NEAR(turned.end("y"), level.end("x"), 1e-10);
  EXPECT_NEAR(turned.end("z"), level.end("y"), 1e-10);
  EXPECT_NEAR(turned.end("x"), level.end("z"), 1e-10);
  EXPECT_NEAR(turned.end("force"), level.end("force"), 1e-7 * weight);
}

const std::string damped_with_friction =
    R"(, "damping": 1e5, "friction": {"type": "regularized_coulomb", "coefficient": 0.3,
      "critical_velocity": 2.5, "form": "quadratic"}})";

TEST(SurfaceOnPlane, TangentIsExactWithDampingAndFriction) {
  Posed posed(sheets(R"("sheet": )" + sheet("[0, 0, 0.0095]", R"(, "velocity": [1, 0.4, -0.3])"),
                     R"("floor": {)" + on_floor + damped_with_friction, "", 0.1));
  posed.shake(1e-4, 0.1);
  const Vec x = Vec::Ones(posed.v.size()) + posed.v;
  EXPECT_LT(posed.tangent_error(x, false, 1e-7), 1e-6);
  EXPECT_LT(posed.tangent_error(x, true, 1e-4), 1e-6);
}

const std::string on_table =
    sheets(R"("sheet": )" + sheet("[0, 0, 0.0095]") + R"(, "table": {"type": "rigid_body", "mass": 5,
      "inertia": [0.3, 0.5, 0.4], "position": [0.3, 0.1, -0.4], "axis": [1, 2, 0], "angle": 0.02})",
           R"("floor": {"type": "penalty", "stiffness": 1e7, "between": [{"surface": "sheet"},
      {"plane": {"point": [0, 0, 0.4], "normal": [0, 0, 1], "on": "table.com"}}]})",
           "", 0.1, "[0, 0, 0]");

TEST(SurfaceOnPlane, TangentIsExactForAPlaneThatABodyCarries) {
  Posed posed(on_table);
  Vec x(posed.v.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = std::sin(1 + 2.7 * double(i));
  EXPECT_LT(posed.tangent_error(x, false, 1e-7), 1e-6);
}

TEST(SurfaceOnPlane, PushesTheBodyThatCarriesThePlaneBackAsMuch) {
  Posed posed(on_table);
  const Vec f = posed.contact_force();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i + 6 < f.size(); i += 3) sum += f.segment<3>(i);
  EXPECT_GT(sum.norm(), 1);
  EXPECT_LT((sum + f.segment<3>(f.size() - 6)).norm(), 1e-12 * sum.norm());
}

std::string refusal(const std::string& text, const Overrides& overrides) {
  try {
    simulate::validate(scene::Scene::parse(text, "test.json", overrides), registry());
  } catch (const scene::SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(SurfaceOnPlane, MustNotLieBehindThePlane) {
  EXPECT_THAT(
      refusal(resting, {{"contacts.floor.between",
                         R"([{"surface": "sheet"}, {"plane": {"point": [0, 0, -0.5], "normal": [0, 0, -1]}}])"}}),
      HasSubstr("face away"));
  EXPECT_EQ(refusal(resting, {}), "");
}

TEST(SurfaceOnPlane, RefusesWhatHasNoMeaningAndSaysWhatHas) {
  EXPECT_THAT(refusal(resting, {{"contacts.floor.radius", "0.1"}}), HasSubstr("belongs to a sphere"));
  EXPECT_THAT(refusal(resting, {{"contacts.floor.by", "points"}}), HasSubstr("say how far the points are apart"));
  EXPECT_EQ(refusal(resting, {{"contacts.floor.by", "points"}, {"contacts.floor.spacing", "0.01"}}), "");
  EXPECT_THAT(refusal(resting, {{"contacts.floor.between", R"([{"surface": "sheet"}, "ground"])"}}),
              HasSubstr("stands before"));
  EXPECT_THAT(refusal(resting, {{"contacts.floor.between",
                                 R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}, {"surface": "sheet"}])"}}),
              HasSubstr("plane"));
  EXPECT_THAT(refusal(resting, {{"contacts.floor.between", R"([{"surface": "sheet"}, {"plane": {"point": [0, 0, 0],
                                 "normal": [0, 0, 1], "on": "sheet.centre"}}])"}}),
              HasSubstr("carried by bodies.sheet"));
  const std::string one_point =
      R"("floor": {"type": "constraint_method", "restitution": 0.5, "between": [{"surface": "sheet"},
      {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})";
  EXPECT_THAT(refusal(sheets(R"("sheet": )" + sheet("[0, 0, 0.02]"), one_point, "", 1), {}),
              testing::AllOf(HasSubstr("BODY.MARKER"), HasSubstr("reaches")));
}

}  // namespace
}  // namespace trammel::test
