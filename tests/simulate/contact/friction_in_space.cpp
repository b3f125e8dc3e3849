// Coulomb's friction in space, |T| <= mu_0 N a cone, against closed forms: paths on an incline, a ball that slides
// until it rolls, a turntable. With rigid and compliant contacts. Bodies on several feet: tables_in_space.cpp.
#include <cmath>
#include <numbers>
#include <random>

#include "support/run_in_pieces.hpp"

#include "contacts_in_space.hpp"

namespace trammel::test {
namespace {

// A point of 1 kg on the plane z = 0; gravity is tilted by alpha, so that x runs down the incline.
struct Point {
  double alpha = 0, mu_0 = 0, mu = 0, vx = 0, vy = 0;
  std::string law = rigid, integrator = accurate, more_friction = "";
};

std::string scene(const Point& p) {
  return fmt::format(R"({{
    "trammel": 1, "space": "spatial", "gravity": [{:.17g}, 0, {:.17g}],
    "bodies": {{"block": {{"type": "point_mass", "mass": 1, "velocity": [{:.17g}, {:.17g}, 0], "position": [0, 0, {:.17g}]}}}},
    "contacts": {{"foot": {{{}, "between": ["block.point", {{"plane": {{"point": [0, 0, 0], "normal": [0, 0, 1]}}}}],
                           "friction": {{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}{}}}}}}},
    "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"x": "block.point.x", "y": "block.point.y", "vx": "block.point.vx",
       "vy": "block.point.vy", "T": "contacts.foot.friction", "Tx": "contacts.foot.friction_x",
       "Ty": "contacts.foot.friction_y", "slip_y": "contacts.foot.slip_y"}}}}
  }})",
                     g * std::sin(p.alpha), -g * std::cos(p.alpha), p.vx, p.vy, sunk(p.law, g * std::cos(p.alpha)),
                     p.law, p.mu_0, p.mu, p.more_friction, p.integrator);
}

// A point that slides on an incline: with phi the angle of its velocity against the slope's direction and w =
// tan(phi/2), k = mu/tan(alpha), the equations v' = g (sin(alpha) cos(phi) - mu cos(alpha)), v phi' = -g sin(alpha)
// sin(phi) give
//     v = C/2 w^(k-1) (1 + w^2),  dt = -C/(2 g sin(alpha)) w^(k-2) (1 + w^2) dw.
struct Descent {
  double alpha, mu, v0;  // launched across, phi = pi/2
  double k() const { return mu / std::tan(alpha); }
  double speed(double w) const { return v0 / 2 * std::pow(w, k() - 1) * (1 + w * w); }
  double time(double w) const { return v0 / (2 * g * std::sin(alpha)) * (powers(k() - 1, w) + powers(k() + 1, w)); }
  double y(double w) const {
    return v0 * v0 / (2 * g * std::sin(alpha)) * (powers(2 * k() - 1, w) + powers(2 * k() + 1, w));
  }
  double x(double w) const {
    return v0 * v0 / (4 * g * std::sin(alpha)) * (powers(2 * k() - 2, w) - powers(2 * k() + 2, w));
  }

 private:
  // Integral of u^(n-1) from w to 1.
  static double powers(double n, double w) { return (1 - std::pow(w, n)) / n; }
};

class OnTheIncline : public testing::TestWithParam<std::string> {};

TEST_P(OnTheIncline, APointLaunchedAcrossFollowsTheCurvedPath) {
  for (const double mu : {0.1, 0.4}) {
    const Descent d{.alpha = 30 * pi / 180, .mu = mu, .v0 = 2};
    const double w = 0.3, phi = 2 * std::atan(w);
    const Finished run = run_text(scene({.alpha = d.alpha, .mu_0 = mu, .mu = mu, .vy = d.v0, .law = GetParam()}),
                                  {{"simulate.until", fmt::format("{:.17g}", d.time(w))}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.end("x"), d.x(w), 1e-10);
    EXPECT_NEAR(run.end("y"), d.y(w), 1e-10);
    EXPECT_NEAR(run.end("vx"), d.speed(w) * std::cos(phi), 1e-10);
    EXPECT_NEAR(run.end("slip_y"), d.speed(w) * std::sin(phi), 1e-10);
    EXPECT_NEAR(run.end("Ty"), -mu * g * std::cos(d.alpha) * std::sin(phi), 1e-9);
    EXPECT_NEAR(run.result["energy_drift"], 0, 1e-6);  // the ledger's Simpson rule, over some 20 steps
  }
}

// With more friction than slope it stops, its last direction downhill. Near the stop phi falls like |v|^(1/(k-1)): at k
// = 4 a cube root, which no method follows with its full order.
TEST_P(OnTheIncline, APointLaunchedAcrossStopsAtTheClosedFormsTimeAndPlace) {
  for (const auto& [k, error] : {std::pair{1.4, 1e-9}, std::pair{2.0, 1e-9}, std::pair{4.0, 1e-8}}) {
    const double alpha = 10 * pi / 180, mu = k * std::tan(alpha);
    const Descent d{.alpha = alpha, .mu = mu, .v0 = 2};
    const Finished run = run_text(scene({.alpha = alpha, .mu_0 = mu, .mu = mu, .vy = d.v0, .law = GetParam()}),
                                  {{"simulate.until", fmt::format("{:.17g}", 1.5 * d.time(0))}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    ASSERT_EQ(run.of_kind("stick").size(), 1u) << k;
    EXPECT_NEAR(run.of_kind("stick")[0].t, d.time(0), error) << k;
    EXPECT_NEAR(run.end("x"), d.x(0), error) << k;
    EXPECT_NEAR(run.end("y"), d.y(0), error) << k;
    EXPECT_LT(std::hypot(run.end("vx"), run.end("vy")), 1e-12) << k;
    EXPECT_NEAR(run.end("Tx"), -g * std::sin(alpha), 1e-9) << k;
  }
}

// Launched straight up it is the planar case: it stops and comes back, or stays.
TEST_P(OnTheIncline, LaunchedStraightUpItDoesAsInThePlane) {
  const double mu = 0.4, v = 2, alpha = 35 * pi / 180, s = std::sin(alpha), c = std::cos(alpha);
  const double up = g * (s + mu * c), down = g * (s - mu * c), length = v * v / (2 * up);
  // In any direction of the tangents: the plane's axes are turned by the launch.
  const Finished run = run_text(scene({.alpha = alpha, .mu_0 = 0.5, .mu = mu, .vx = -v, .law = GetParam()}),
                                {{"simulate.until", fmt::format("{:.17g}", v / up + std::sqrt(2 * length / down))}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("stick").size(), 0u);
  ASSERT_EQ(run.of_kind("reversal").size(), 1u);
  const Event reversal = run.of_kind("reversal")[0];
  EXPECT_NEAR(reversal.t, v / up, 1e-11);
  EXPECT_NEAR(reversal.detail.at("direction_x"), 1, 1e-14);
  EXPECT_NEAR(reversal.detail.at("friction_x"), -mu * g * c, 1e-9);
  EXPECT_NEAR(run.end("x"), 0, 1e-11);
  EXPECT_NEAR(run.end("vx"), std::sqrt(2 * length * down), 1e-11);
}

// It slides across a slope that pulls it harder than friction holds: its speed has a minimum and never a zero.
TEST_P(OnTheIncline, ASlipThatOnlyTurnsIsNoStop) {
  const double alpha = 35 * pi / 180;
  for (const double across : {1e-1, 1e-3}) {
    const Finished run =
        run_text(scene({.alpha = alpha, .mu_0 = 0.4, .mu = 0.4, .vx = -1, .vy = across, .law = GetParam()}));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_EQ(run.of_kind("stick").size() + run.of_kind("reversal").size(), 0u) << across;
    EXPECT_GT(run.end("vx"), 1);
    EXPECT_NEAR(run.result["energy_drift"], 0, 1e-8) << across;
  }
}

// Its least speed would be 1e-8 m/s: it is taken through rest.
TEST_P(OnTheIncline, ADipThatHasNoDirectionIsTakenThroughRest) {
  const double alpha = 35 * pi / 180;
  const auto launched = [&](double across) {
    return run_text(scene({.alpha = alpha, .mu_0 = 0.4, .mu = 0.4, .vx = -1, .vy = across, .law = GetParam()}));
  };
  const Finished run = launched(1e-5), straight = launched(0);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("reversal").size(), 1u);
  EXPECT_EQ(run.of_kind("stick").size(), 0u);
  EXPECT_NEAR(run.end("vx"), straight.end("vx"), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Contacts, OnTheIncline, testing::Values(rigid, compliant),
                         [](const auto& law) { return law.param == rigid ? "rigid" : "compliant"; });

// A ball of 1 kg and radius R on the floor, slipping with s0 = v0 + omega x (-R e_z): its slip keeps its direction and
// falls at 7/2 mu g, so after T = 2 |s0|/(7 mu g) it rolls with v0 - 2/7 s0; until then its centre runs along a
// parabola.
class Ball : public testing::TestWithParam<std::tuple<const char*, std::string>> {
 protected:
  static constexpr double R = 0.1, mu = 0.2;
  static std::string scene(const std::string& law, const std::string& integrator, const std::string& omega,
                           const std::string& on = "") {
    return fmt::format(
        R"({{
      "trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
      "bodies": {{"ball": {{"type": "rigid_body", "mass": 1, "sphere": {{"radius": {}}}, "position": [0, 0, {:.17g}],
                           "velocity": [1, 0, 0], "angular_velocity": {}}}{}}},
      "contacts": {{"foot": {{{}, "radius": {},
         "between": ["ball.com", {{"plane": {{"point": [0, 0, 0], "normal": [0, 0, 1]{}}}}}],
         "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
      "integrator": {}, "simulate": {{"until": 1}},
      "record": {{"every": 0.1, "observe": {{"x": "ball.com.x", "y": "ball.com.y", "vx": "ball.com.vx", "vy": "ball.com.vy",
         "slip": "contacts.foot.slip", "rolls": "contacts.foot.sticks"}}}}
    }})",
        R, R + sunk(law, g), omega,
        on.empty() ? "" : R"(, "table": {"type": "moving_base", "axis": [0, 0, 1], "angle": ")" + on + R"("})", law, R,
        on.empty() ? "" : R"(, "on": "table.origin")", mu, mu, integrator);
  }
};

TEST_P(Ball, SlidesOnAParabolaUntilItRolls) {
  const auto& [integrator, law] = GetParam();
  const bool controlled = std::string(integrator) == "dop853";
  // omega = (20, 30, 5) rad/s: s0 = v0 + omega x (-R e_z) = (1 - 30 R, 20 R).
  const double sx = 1 - 30 * R, sy = 20 * R, s0 = std::hypot(sx, sy), T = 2 * s0 / (7 * mu * g);
  const Finished run = run_text(scene(
      law, fmt::format(R"({{"type": "{}", "step": {}}})", integrator, controlled ? R"({"tolerance": 1e-12})" : "1e-3"),
      "[20, 30, 5]"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  // With fixed steps the last slip that a tenth of a step takes away counts as rest. Those of second order turn the
  // ball, by 0.036 rad a step, with an error of its square over 12.
  const bool second = std::string(integrator) == "hht_alpha" || std::string(integrator) == "newmark" ||
                      std::string(integrator) == "generalized_alpha";
  const double error = controlled ? 1e-10 : second ? 1e-4 : 1e-7;
  EXPECT_NEAR(run.of_kind("stick")[0].t, T, controlled ? 1e-10 : 1e-4);
  const double vx = 1 - sx * 2 / 7, vy = -sy * 2 / 7;
  EXPECT_NEAR(run.end("vx"), vx, error);
  EXPECT_NEAR(run.end("vy"), vy, error);
  EXPECT_NEAR(run.end("x"), T - mu * g * sx / s0 * T * T / 2 + vx * (1 - T), error);
  EXPECT_NEAR(run.end("y"), -mu * g * sy / s0 * T * T / 2 + vy * (1 - T), error);
  EXPECT_LT(run.end("slip"), 1e-8);
  EXPECT_EQ(run.end("rolls"), 1);
}

// A ball that rolls on a table turning at Omega runs in circles at 2/7 Omega, wherever it is (Earnshaw 1844).
TEST_P(Ball, RollsInCirclesOnATurntable) {
  const auto& [integrator, law] = GetParam();
  const bool controlled = std::string(integrator) == "dop853";
  const double Omega = 2, omega = 2 * Omega / 7, radius = 1 / omega;
  // At the origin the table is at rest: rolling there with v = (1, 0, 0) is omega = (0, 1/R, .).
  const Finished run = run_text(
      scene(law,
            fmt::format(R"({{"type": "{}", "step": {}}})", integrator, controlled ? R"({"tolerance": 1e-12})" : "1e-3"),
            fmt::format("[0, {:.17g}, 0]", 1 / R), "=2*t"),
      {{"contacts.foot.friction.static", "1"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("slip").size(), 0u);
  // Of second order or more: (omega_ball h)^2 = 1e-4 of the turn within a step, which the ball's symmetry makes
  // harmless.
  const double error = controlled ? 1e-8 : 2e-5;
  EXPECT_NEAR(run.end("x"), radius * std::sin(omega), error);
  EXPECT_NEAR(run.end("y"), radius * (1 - std::cos(omega)), error);
  EXPECT_NEAR(std::hypot(run.end("vx"), run.end("vy")), 1, error);
}

INSTANTIATE_TEST_SUITE_P(All, Ball,
                         testing::Combine(testing::Values("hht_alpha", "newmark", "generalized_alpha",
                                                          "adams_baumgarte", "runge_kutta_4", "dormand_prince",
                                                          "dop853"),
                                          testing::Values(rigid, compliant)),
                         [](const auto& of) {
                           return std::string(std::get<0>(of.param)) +
                                  (std::get<1>(of.param) == rigid ? "_rigid" : "_compliant");
                         });

// A point at r on a table whose angle is alpha t^2/2: it lets go where r sqrt(alpha^2 + alpha^4 t^4) = mu_0 g, and
// slides against the acceleration it had, (alpha^2 t^2, -alpha) of r in the table's radial and circular directions.
TEST(Turntable, LetsGoAtItsInstantInItsDirection) {
  const double r = 0.5, alpha = 3, mu_0 = 0.5;
  const double t = std::pow((std::pow(mu_0 * g / r, 2) - alpha * alpha) / std::pow(alpha, 4), 0.25);
  for (const double mu : {0.4, 0.5}) {
    const Finished run =
        run_text(scene({.mu_0 = mu_0, .mu = mu}),
                 {{"simulate.until", "1.1"},
                  {"bodies.block.position", "[0.5, 0, 0]"},
                  {"bodies.table", R"json({"type": "moving_base", "axis": [0, 0, 1], "angle": "=1.5*t^2"})json"},
                  {"contacts.foot.between",
                   R"(["block.point", {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1], "on": "table.origin"}}])"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    ASSERT_GE(run.of_kind("slip").size(), 1u);
    const Event slip = run.of_kind("slip")[0];
    EXPECT_NEAR(slip.t, t, 1e-9);
    const double turned = alpha * t * t / 2, size = std::hypot(alpha * t * t, 1), out = alpha * t * t / size,
                 back = -1 / size;
    EXPECT_NEAR(slip.detail.at("direction_x"), out * std::cos(turned) - back * std::sin(turned), 1e-8);
    EXPECT_NEAR(slip.detail.at("direction_y"), out * std::sin(turned) + back * std::cos(turned), 1e-8);
    EXPECT_NEAR(run.result["energy_drift"], 0, 1e-8);
  }
}

TEST(EveryStep, StopsThePointOnTheInclineInSpaceToo) {
  const double alpha = 10 * pi / 180, mu = 2 * std::tan(alpha);
  const Descent d{.alpha = alpha, .mu = mu, .v0 = 1};
  const Finished run = run_text(scene({.alpha = alpha,
                                       .mu_0 = mu,
                                       .mu = mu,
                                       .vy = d.v0,
                                       .law = compliant,
                                       .integrator = R"({"type": "runge_kutta_4", "step": 1e-4})",
                                       .more_friction = R"(, "method": "lcp_every_step")"}));
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  EXPECT_NEAR(run.of_kind("stick")[0].t, d.time(0), 1e-5);  // feet slower than its stick_speed, 1e-6 m/s, stick
  EXPECT_NEAR(run.end("x"), d.x(0), 1e-6);
  EXPECT_NEAR(run.end("y"), d.y(0), 1e-6);
}

// The same block as in the plane, its plane at any angle about the normal: bitwise the same is not to be had, the same
// to round-off is.
TEST(InThePlaneAndInSpace, AShakenBlockDoesTheSame) {
  const auto in_space = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return run_text(scene({.mu_0 = 0.3, .mu = 0.25}),
                    {{"forces.shake", fmt::format(R"json({{"type": "load", "on": "block.point",
                       "force": {{"x": "={:.17g}*sin(5*t)", "y": "={:.17g}*sin(5*t)", "z": 0}}}})json",
                                                  6 * c, 6 * s)},
                     {"simulate.until", "3"}});
  };
  const Finished planar = run_text(
      R"json({"trammel": 1, "gravity": [0, -9.81],
        "bodies": {"block": {"type": "point_mass", "mass": 1, "position": [0, 0]}},
        "contacts": {"foot": {"type": "constraint_method", "between": ["block.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
          "friction": {"type": "coulomb", "static": 0.3, "kinetic": 0.25}}},
        "forces": {"shake": {"type": "load", "on": "block.point", "force": {"x": "=6*sin(5*t)", "y": 0}}},
        "integrator": {"type": "dop853", "step": {"tolerance": 1e-12}}, "simulate": {"until": 3},
        "record": {"every": 0.1, "observe": {"x": "block.point.x"}}})json");
  ASSERT_TRUE(planar.done()) << planar.report.reason;
  for (const double angle : {0.0, 0.9}) {
    const Finished run = in_space(angle);
    ASSERT_TRUE(run.done()) << run.report.reason;
    ASSERT_EQ(run.events.size(), planar.events.size()) << angle;
    for (std::size_t i = 0; i < run.events.size(); ++i) {
      EXPECT_EQ(run.events[i].kind, planar.events[i].kind) << angle;
      EXPECT_NEAR(run.events[i].t, planar.events[i].t, 1e-9) << angle;
    }
    EXPECT_NEAR(run.end("x") * std::cos(angle) + run.end("y") * std::sin(angle), planar.end("x"), 1e-9) << angle;
    EXPECT_NEAR(-run.end("x") * std::sin(angle) + run.end("y") * std::cos(angle), 0, 1e-9) << angle;
  }
}

// A point thrown obliquely: it strikes, rebounds where e > 0, slides and stops; in the plane, or in space 30 degrees
// off x.
std::string thrown(bool in_space, const std::string& contact) {
  const double c = std::cos(pi / 6), s = std::sin(pi / 6);
  return fmt::format(
      R"({{"trammel": 1, "space": "{}", "gravity": {}, "integrator": {},
           "bodies": {{"block": {{"type": "point_mass", "mass": 2, "position": {}, "velocity": {}}}}},
           "contacts": {{"floor": {{{}, "between": ["block.point", {{"plane": {{"point": {}, "normal": {}}}}}]}}}},
           "simulate": {{"until": 1}},
           "record": {{"every": 0.05, "observe": {{"x": "block.point.x", "y": "block.point.y", "T": "contacts.floor.friction"}}}}}})",
      in_space ? "spatial" : "planar", in_space ? "[0, 0, -9.81]" : "[0, -9.81]", accurate,
      in_space ? "[0, 0, 0.3]" : "[0, 0.3]", in_space ? fmt::format("[{:.17g}, {:.17g}, -1]", 2 * c, 2 * s) : "[2, -1]",
      contact, in_space ? "[0, 0, 0]" : "[0, 0]", in_space ? "[0, 0, 1]" : "[0, 1]");
}

class Thrown : public testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(Thrown, APointDoesInAnyDirectionWhatItDoesInThePlane) {
  const std::string contact = GetParam().first + ", " + GetParam().second;
  const Finished planar = run_text(thrown(false, contact)), spatial = run_text(thrown(true, contact));
  ASSERT_TRUE(planar.done()) << planar.report.reason;
  ASSERT_TRUE(spatial.done()) << spatial.report.reason;
  EXPECT_LT(planar.end("x"), 1);  // 2 m/s for 1 s less what friction takes
  const double c = std::cos(pi / 6), s = std::sin(pi / 6);
  for (std::size_t i = 0; i < planar.series.at("x").size(); ++i) {
    const double x = spatial.series.at("x")[i], y = spatial.series.at("y")[i];
    EXPECT_NEAR(c * x + s * y, planar.series.at("x")[i], 1e-9) << i;
    EXPECT_NEAR(c * y - s * x, 0, 1e-12) << i;
    EXPECT_NEAR(spatial.series.at("T")[i], std::abs(planar.series.at("T")[i]), 1e-6) << i;
  }
}

const std::string coulomb = R"("friction": {"type": "coulomb", "static": 0.4, "kinetic": 0.3})";
const std::string smooth =
    R"("friction": {"type": "regularized_coulomb", "coefficient": 0.3, "critical_velocity": 0.01})";
INSTANTIATE_TEST_SUITE_P(Contacts, Thrown,
                         testing::Values(std::pair(rigid + R"(, "restitution": 0.5)", coulomb),
                                         std::pair(rigid, coulomb), std::pair(compliant, coulomb),
                                         std::pair(rigid, smooth), std::pair(compliant, smooth)));

// Cut after every third step, while it slides, turns, and rolls on a floor that turns.
TEST(InSpace, AResumedRunEndsWithTheSameBytes) {
  for (const char* integrator :
       {R"({"type": "dop853", "step": {"tolerance": 1e-9}})", R"({"type": "hht_alpha", "step": 5e-3})"}) {
    const scene::Scene ball = scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/friction/billiard_ball.json",
                                                 {{"parameters.Omega", "2"}, {"integrator", integrator}});
    const Logs whole = run_in_pieces(ball, 1LL << 60), pieces = run_in_pieces(ball, 3);
    EXPECT_NE(whole.events.find("stick"), std::string::npos);
    EXPECT_TRUE(pieces.series == whole.series) << integrator;
    EXPECT_TRUE(pieces.events == whole.events) << integrator;
    EXPECT_EQ(nlohmann::json::diff(whole.data, pieces.data).dump(), "[]") << integrator;
  }
}

}  // namespace
}  // namespace trammel::test
