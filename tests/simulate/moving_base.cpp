// Systems on a base that moves by a law: joints, forces and contacts take its velocity and acceleration, the ledger its
// work.
#include <cmath>
#include <fstream>
#include <numbers>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

// A pendulum whose hinge moves as x = 0.3 sin 3t, y = 0.1 t^2: in its own frame gravity is (-x'', -g - y'').
const std::string carried_pendulum = R"json({
  "trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {"base": {"type": "moving_base", "x": "=0.3*sin(3*t)", "y": "=0.1*t^2"},
             "rod": {"type": "rigid_body", "mass": 2, "inertia": 0.3, "position": ["=sin(0.5)", "=-cos(0.5)"],
                     "angle": "=0.5 - pi/2", "velocity": [0.9, 0], "markers": {"hinge": [-1, 0]}}},
  "joints": {"hinge": {"type": "revolute", "between": ["base.origin", "rod.hinge"]}},
  "integrator": {"type": "dop853", "step": {"tolerance": 1e-12}},
  "simulate": {"until": 3},
  "record": {"every": 0.5, "observe": {"angle": "rod.angle",
    "x": {"of": "rod.com.x", "relative_to": "base.origin"}, "vx": {"of": "rod.com.vx", "relative_to": "base.origin"},
    "ax": {"of": "rod.com.ax", "relative_to": "base.origin"},
    "moved": {"of": "rod.com.x", "relative_to": "base.origin", "since_start": true}}}
})json";

// The relative angle by the equation of motion in the base's frame, (I + m l^2) phi'' = -m l ((g + y'') sin phi + x''
// cos phi), with RK4 in small steps.
double angle_in_the_bases_frame(double until) {
  const auto acceleration = [](double t, double phi) {
    const double x_second = -2.7 * std::sin(3 * t), y_second = 0.2;
    return -2 / 2.3 * ((9.81 + y_second) * std::sin(phi) + x_second * std::cos(phi));
  };
  double phi = 0.5, omega = 0;
  const int steps = 30000;
  const double h = until / steps;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const double k1 = acceleration(t, phi), k2 = acceleration(t + h / 2, phi + h / 2 * omega),
                 k3 = acceleration(t + h / 2, phi + h / 2 * omega + h * h / 4 * k1),
                 k4 = acceleration(t + h, phi + h * omega + h * h / 2 * k2);
    phi += h * omega + h * h / 6 * (k1 + k2 + k3);
    omega += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return phi;
}

TEST(MovingBase, CarriesAPendulumAsItsOwnFrameSays) {
  const Finished run = run_text(carried_pendulum);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.result["sizes"][0]["nv"], 3);                                 // the base has none
  EXPECT_NEAR(run.end("angle") + pi / 2, angle_in_the_bases_frame(3), 1e-9);  // tolerance 1e-12 a step, 3 s
}

TEST(MovingBase, WorkIsInTheLedger) {
  const Finished run = run_text(carried_pendulum);
  EXPECT_GT(std::abs(run.result["energy_supplied"]["total"].get<double>()), 0.1);
  // Simpson's rule over the steps of the method.
  EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-6);
}

TEST(MovingBase, WorkThroughASpringIsInTheLedger) {
  const Finished run = run_text(
      carried_pendulum,
      {{"joints", "{}"}, {"forces", R"({"spring": {"type": "spring_damper", "between": ["base.origin", "rod.hinge"],
                                   "stiffness": 200, "damping": 2, "length": 0}})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GT(std::abs(run.result["energy_supplied"]["total"].get<double>()), 0.1);
  EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-5);
}

TEST(MovingBase, RelativeMotionIsThatOfTheFrame) {
  const Finished run = run_text(carried_pendulum, {{"record.every", "0.01"}, {"simulate.until", "1"}});
  const auto &x = run.series.at("x"), &vx = run.series.at("vx"), &ax = run.series.at("ax");
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    EXPECT_NEAR(vx[i], (x[i + 1] - x[i - 1]) / 0.02, 1e-3);  // h^2/6 of x'''
    EXPECT_NEAR(ax[i], (vx[i + 1] - vx[i - 1]) / 0.02, 3e-3);
    EXPECT_NEAR(run.series.at("moved")[i], x[i] - x[0], 1e-15);
    EXPECT_NEAR(x[i], std::sin(run.series.at("angle")[i] + pi / 2), 1e-9);
  }
}

TEST(RelativeMotion, IsThatOfBothBodiesWhicheverComesFirst) {
  const Finished run = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {"a": {"type": "point_mass", "mass": 1, "position": [0, 0]},
               "b": {"type": "point_mass", "mass": 2, "position": [1, 0]}},
    "forces": {"on_a": {"type": "load", "on": "a.point", "force": {"x": 3, "y": 0}},
               "on_b": {"type": "load", "on": "b.point", "force": {"x": 2, "y": 0}}},
    "simulate": {"until": 1}, "record": {"every": 1, "observe": {
      "b_from_a": {"of": "b.point.ax", "relative_to": "a.point"},
      "a_from_b": {"of": "a.point.ax", "relative_to": "b.point"}}}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_DOUBLE_EQ(run.end("b_from_a"), 1 - 3);
  EXPECT_DOUBLE_EQ(run.end("a_from_b"), 3 - 1);
}

TEST(MovingBase, LaunchesABallWhenItFallsFasterThanGravity) {
  // y = 0.2 cos 10 t: the ball leaves where y'' = -g, at cos 10 t = g / 20, and flies on a parabola.
  const Finished run = run_text(R"json({
    "trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {"table": {"type": "moving_base", "y": "=-0.2*cos(10*t)"},
               "ball": {"type": "point_mass", "mass": 0.1, "position": [0, -0.2]}},
    "contacts": {"floor": {"type": "constraint_method", "restitution": 0,
                           "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1], "on": "table.origin"}}]}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-11}},
    "simulate": {"until": 0.3},
    "record": {"every": 0.01, "observe": {"y": "ball.point.y"}}
  })json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_FALSE(run.of_kind("contact_open").empty());
  const double leaves = std::acos(-0.5) / 10;
  EXPECT_NEAR(run.of_kind("contact_open")[0].t, leaves, 1e-10);
  const double flown = 0.3 - leaves, v = 2 * std::sin(10 * leaves);
  EXPECT_NEAR(run.end("y"), 0.1 + v * flown - 5 * flown * flown, 1e-9);
}

TEST(MovingBase, OfAnAccelerogramShakesAnOscillatorAsItsTableSays) {
  const Folder folder;
  std::filesystem::create_directories(folder.path());
  {
    std::ofstream table(folder.path() / "quake.csv");
    table << "t, a [g]\n";
    for (int i = 0; i <= 400; ++i)
      table << fmt::format("{:.17g}, {:.17g}\n", 0.01 * i, std::sin(0.5 * pi * 0.01 * i) / 9.81);
    std::ofstream scene(folder.path() / "scene.json");
    scene << R"json({
      "trammel": 1, "space": "planar",
      "bodies": {"base": {"type": "moving_base", "x": {"table": "quake.csv", "holds": "accelerations", "scale": 9.81}},
                 "mass": {"type": "point_mass", "mass": 1, "position": [1, 0]}},
      "forces": {"spring": {"type": "spring_damper", "between": ["base.origin", "mass.point"], "stiffness": 25, "length": 1}},
      "integrator": {"type": "dop853", "step": {"tolerance": 1e-11}},
      "simulate": {"until": 4},
      "record": {"every": 0.1, "observe": {"u": {"of": "mass.point.x", "relative_to": "base.origin", "since_start": true}}}
    })json";
  }
  const Finished run = run_scene(scene::Scene::load((folder.path() / "scene.json").string()));
  ASSERT_TRUE(run.done()) << run.report.reason;
  // u'' + 25 u = -sin(w t), from rest. The spline of 100 rows a quarter period is good to 1e-8.
  const double w = pi / 2, t = 4;
  EXPECT_NEAR(run.end("u"), -(std::sin(w * t) - w / 5 * std::sin(5 * t)) / (25 - w * w), 1e-8);
}

TEST(MovingBase, WithACornerInItsLawIsRefusedWithTheTime) {
  try {
    run_text(carried_pendulum, {{"bodies.base.x", "=abs(t - 0.7)"}});
    FAIL() << "a corner is an infinite force";
  } catch (const scene::SceneError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("bodies.base.x: this law must be differentiable, but at t = 0.7 s its velocity "
                        "jumps by 2"),
              std::string::npos)
        << error.what();
  }
}

TEST(MovingBase, MayAccelerateAtOnce) {
  const Finished run = run_text(carried_pendulum, {{"bodies.base.x", "=0.3*sin(3*t) + 2*max(0, t - 1)^2"}});
  EXPECT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-6);
}

TEST(MovingBase, WhoseLawEndsWithinTheRunIsRefusedBeforeIt) {
  try {
    run_text(carried_pendulum, {{"bodies.base.y", "=0*sqrt(1 - t)"}});
    FAIL() << "a law without a value";
  } catch (const scene::SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("bodies.base.y: at t = 1.0"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("of this law is not finite"), std::string::npos) << error.what();
  }
}

TEST(Observables, OfAMotionSeenFromAMarkerAreCheckedByName) {
  const auto refused = [](const char* entry, const char* reason) {
    try {
      run_text(carried_pendulum, {{"record.observe", fmt::format("{{\"x\": {}}}", entry)}});
      ADD_FAILURE() << entry;
    } catch (const scene::SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  refused(R"({"of": "rod.com.xx"})", "no motion \"rod.com.xx\" of a marker");
  refused(R"({"of": "rod.com.x", "relative_to": "base.orign"})", "no marker \"base.orign\"");
  refused(R"({"of": "rod.com.vx", "since_start": true})", "only a place or an angle is taken since the start");
  refused(R"({"relative_to": "base.origin"})", "\"of\" is missing");
  refused(R"({"of": "rod.com.x", "relativeto": "base.origin"})", "unknown key \"relativeto\"");
}

}  // namespace
}  // namespace trammel::test
