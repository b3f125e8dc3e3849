// Contact, stresses and refinement of plates of several patches: a joint has no effect.
#include <cmath>

#include <gmock/gmock.h>

#include "support/run_in_pieces.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

// A square plate of 1 m, clamped at three sides and hinged at the fourth; `surface` begins its parameters.
std::string plate(const std::string& surface) {
  return R"("plate": {"type": "tspline_plate", )" + surface + R"(,
    "thickness": 0.02, "density": 1000, "youngs_modulus": 1e8, "poissons_ratio": 0.3})";
}

// One patch, of the functions of two: where a knot stands twice they are C1 alone.
const std::string one_patch = R"("geometry": {"along_u": [1, 0, 0], "along_v": [0, 1, 0]},
    "mesh": {"u": [0, 0.25, 0.5, 0.5, 0.75, 1], "v": [0, 0.25, 0.5, 0.75, 1]},
    "edges": {"u0": "clamped", "u1": "clamped", "v0": "clamped", "v1": "hinged"},
    "markers": {"middle": [0.5, 0.5, 0.01]})";

std::string two_patches(const std::string& right, const std::string& joint, const std::string& continuity = "C1") {
  return R"("patches": {
      "left": {"geometry": {"along_u": [0.5, 0, 0], "along_v": [0, 1, 0]}, "mesh": {"elements": "2x4"},
               "edges": {"u0": "clamped", "v0": "clamped", "v1": "hinged"}, "markers": {"middle": [1, 0.5, 0.01]}},
      "right": )" +
         right + R"(},
    "joined": {"joint": {"from": "left.u1", "to": ")" +
         joint + R"(", "continuity": ")" + continuity + "\"}}";
}
const std::string right_half =
    R"({"geometry": {"origin": [0.5, 0, 0], "along_u": [0.5, 0, 0], "along_v": [0, 1, 0]}, "mesh": {"elements": "2x4"},
        "edges": {"u1": "clamped", "v0": "clamped", "v1": "hinged"}, "markers": {"middle": [0, 0.5, 0.01]}})";

// The same plate with its right half described in three ways.
struct Joint {
  std::string name, surface;
};
std::ostream& operator<<(std::ostream& out, const Joint& joint) {
  return out << joint.name;
}
const std::vector<Joint> joints = {
    {"along", two_patches(right_half, "right.u0")},
    {"against",
     two_patches(
         R"({"geometry": {"origin": [1, 1, 0], "along_u": [-0.5, 0, 0], "along_v": [0, -1, 0]}, "mesh": {"elements": "2x4"},
             "edges": {"u0": "clamped", "v1": "clamped", "v0": "hinged"}, "markers": {"middle": [1, 0.5, 0.01]}})",
         "right.u1")},
    {"across",
     two_patches(
         R"({"geometry": {"origin": [1, 0, 0], "along_u": [0, 1, 0], "along_v": [-0.5, 0, 0]}, "mesh": {"elements": "4x2"},
             "edges": {"v0": "clamped", "u0": "clamped", "u1": "hinged"}, "markers": {"middle": [0.5, 1, 0.01]}})",
         "right.v1")}};

class AcrossAJoint : public testing::TestWithParam<Joint> {};

std::string scene(const std::string& bodies, const std::string& contacts, const std::string& observe, double until) {
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -10],
    "bodies": {{{}}}, "contacts": {{{}}},
    "integrator": {{"type": "generalized_alpha", "rho_inf": 0.8, "step": 1e-3}}, "simulate": {{"until": {}}},
    "record": {{"every": 0.002, "observe": {{{}}}}}}})",
                     bodies, contacts, until, observe);
}

// What a run of the joined plate records is what one of the single patch does.
void expect_same(const Finished& run, const Finished& single, double tolerance) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_TRUE(single.done()) << single.report.reason;
  const auto largest = [](const std::vector<double>& values) {
    double size = 0;
    for (const double x : values) size = std::max(size, std::abs(x));
    return size;
  };
  double energy = 0;  // one scale for all of it: what is supplied may be round-off of what moves
  for (const auto& [name, values] : single.series)
    if (name.starts_with("energy_")) energy = std::max(energy, largest(values));
  for (const auto& [name, expected] : single.series) {
    if (name == "cpu_time") continue;
    const auto& found = run.series.at(name);
    ASSERT_EQ(found.size(), expected.size());
    // Smaller ones are round-off of constraints.
    const double size = std::max(name.starts_with("energy_") ? energy : 1e-9, largest(expected));
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_NEAR(found[i], expected[i], tolerance * size) << name << " at " << run.series.at("t")[i];
  }
  ASSERT_EQ(run.events.size(), single.events.size());
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    EXPECT_EQ(run.events[i].kind, single.events[i].kind);
    EXPECT_NEAR(run.events[i].t, single.events[i].t, tolerance);
  }
}

// A ball of 3 kg and 0.1 m that stands on the plate at x.
std::string ball(double x, const std::string& velocity, const std::string& spin) {
  return fmt::format(
      R"("ball": {{"type": "rigid_body", "mass": 3, "sphere": {{"radius": 0.1}}, "position": [{}, 0.4, 0.11],
    "velocity": {}, "angular_velocity": {}}})",
      x, velocity, spin);
}
const std::string rough = R"("ball": {"type": "penalty", "between": ["ball.com", {"surface": "plate"}], "radius": 0.1,
  "stiffness": 1e7, "friction": {"type": "regularized_coulomb", "coefficient": 0.3, "critical_velocity": 1e-3}})";
const std::string of_ball = R"("x": "ball.com.x", "y": "ball.com.y", "z": "ball.com.z", "vx": "ball.com.vx",
  "force": "contacts.ball.force", "gap": "contacts.ball.gap")";

constexpr double iteration = 1e-6;  // Newton's method stops by coordinates, of which one mesh has others than the other

TEST_P(AcrossAJoint, ABallRollsAsOverOnePlate) {
  const auto roll = [](const std::string& surface) {
    return run_text(scene(plate(surface) + ", " + ball(0.44, "[4, 0, -0.3]", "[0, 40, 0]"), rough, of_ball, 0.03));
  };
  const Finished run = roll(GetParam().surface);
  expect_same(run, roll(one_patch), iteration);
  EXPECT_GT(run.end("x"), 0.54);
  EXPECT_GT(run.end("force"), 1);
}

TEST_P(AcrossAJoint, ABallLandsAsOnOnePlate) {
  const auto land = [](const std::string& surface) {
    return run_text(scene(plate(surface) + ", " + ball(0.5, "[0, 0, -1]", "[3, 2, 1]"), rough, of_ball, 0.02));
  };
  const Finished run = land(GetParam().surface);
  expect_same(run, land(one_patch), iteration);
  EXPECT_GT(run.end("force"), 1);
}

TEST_P(AcrossAJoint, AMarkerIsStruckAsOnOnePlate) {
  const auto strike = [](const std::string& surface, const std::string& marker) {
    return run_text(
        scene(plate(surface) + ", " + ball(0.5, "[0, 0, -1]", "[0, 0, 0]"),
              R"("ball": {"type": "constraint_method", "restitution": 0.5, "between": ["ball.com", "plate.)" + marker +
                  R"("], "reaches": {"type": "distance", "length": 0.13}})",
              R"("z": "ball.com.z", "vz": "ball.com.vz")", 0.04),
        {{"bodies.ball.position", "[0.5, 0.5, 0.141]"}});
  };
  const Finished single = strike(one_patch, "middle");
  for (const char* side : {"left_middle", "right_middle"}) {
    const Finished run = strike(GetParam().surface, side);
    expect_same(run, single, iteration);
    EXPECT_FALSE(run.of_kind("impact").empty());
  }
}

TEST_P(AcrossAJoint, ASheetLandsAsOnOnePlate) {
  const std::string sheet = R"("sheet": {"type": "tspline_plate", "geometry": {"origin": [0.3, 0.35, 0.0201],
    "along_u": [0.4, 0, 0], "along_v": [0, 0.3, 0]}, "mesh": {"elements": "2x2"}, "thickness": 0.02, "density": 1000,
    "youngs_modulus": 1e8, "poissons_ratio": 0.3, "velocity": [0, 0, -0.3]})";
  const auto land = [&](const std::string& surface, const char* first, const char* second) {
    return run_text(scene(plate(surface) + ", " + sheet,
                          fmt::format(R"("pair": {{"type": "penalty", "stiffness": 1e7, "spacing": 0.04,
                            "between": [{{"surface": "{}"}}, {{"surface": "{}"}}]}})",
                                      first, second),
                          R"("z": "sheet.centre.z", "force": "contacts.pair.force")", 0.003),
                    {{"integrator.step", "2e-4"}});
  };
  for (const auto& [first, second] : {std::pair{"sheet", "plate"}, std::pair{"plate", "sheet"}}) {
    const Finished run = land(GetParam().surface, first, second);
    expect_same(run, land(one_patch, first, second), iteration);
    EXPECT_FALSE(run.of_kind("contact_close").empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Joined, AcrossAJoint, testing::ValuesIn(joints),
                         [](const auto& joint) { return joint.param.name; });

// On a hinge, which bends into a groove under the ball, nothing is lost either.
TEST(OnAHinge, ABallKeepsTheEnergy) {
  const Finished run =
      run_text(scene(plate(two_patches(right_half, "right.u0", "C0")) + ", " + ball(0.5, "[0, 0, -1]", "[0, 0, 0]"),
                     R"("ball": {"type": "penalty", "between": ["ball.com", {"surface": "plate"}], "radius": 0.1,
                       "stiffness": 1e7})",
                     of_ball, 0.01),
               {{"integrator.step", "1e-4"}, {"integrator.rho_inf", "1"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_FALSE(run.of_kind("contact_close").empty());
  EXPECT_NEAR(double(run.result["energy_drift"]), 0, 1e-3);  // of 1.5 J
}

// Four quarters of a dome meet at its top, a point that is an edge of each; the ball strikes beside it and bounces off.
TEST(OnThePoleOfADome, ABallKeepsTheEnergy) {
  std::string quarters, seams;
  for (int k = 0; k < 4; ++k) {
    quarters +=
        fmt::format(R"({}"n{}": {{"geometry": {{"shape": "sphere", "radius": 0.5, "from": "={}*pi/2", "to": "={}*pi/2",
      "south": 0.3, "north": "=pi/2"}}, "mesh": {{"elements": "3x4"}}, "edges": {{"v0": "hinged", "v1": "pole"}}}})",
                    k ? "," : "", k, k, k + 1);
    seams += fmt::format(R"({}"j{}": {{"from": "n{}.u1", "to": "n{}.u0"}})", k ? "," : "", k, k, (k + 1) % 4);
  }
  const Finished run = run_text(
      scene(
          R"("plate": {"type": "tspline_plate", "patches": {)" + quarters + R"(}, "joined": {)" + seams +
              R"(}, "thickness": 0.01, "density": 1000, "youngs_modulus": 1e8, "poissons_ratio": 0.3}, )" +
              ball(0, "[0, 0, -1]", "[0, 0, 0]"),
          R"("ball": {"type": "penalty", "between": ["ball.com", {"surface": "plate"}], "radius": 0.1, "stiffness": 1e8})",
          of_ball, 0.03),
      {{"bodies.ball.position", "[0.0005, 0.0003, 0.6052]"},
       {"bodies.ball.mass", "1"},
       {"integrator.step", "1e-4"},
       {"integrator.rho_inf", "1"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_FALSE(run.of_kind("contact_open").empty());
  EXPECT_NEAR(double(run.result["energy_drift"]), 0, 1e-4);  // of 0.5 J
}

// The ball comes down on the joint, and both sides are split there.
std::string refined(const std::string& surface) {
  return scene(plate(surface + R"(, "quadrature": 6, "refine": {"on_contact": "ball", "near": 0.02, "levels": 2})") +
                   ", " + ball(0.5, "[0, 0, -1]", "[0, 0, 0]"),
               rough, of_ball + R"(, "elements": "plate.elements")", 0.016);
}

TEST_P(AcrossAJoint, ARefinementKeepsMassMomentumAndEnergies) {
  const Finished run = run_text(refined(GetParam().surface), {{"bodies.ball.position", "[0.5, 0.4, 0.115]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto refinements = run.of_kind("refine");
  ASSERT_FALSE(refinements.empty());
  for (const Event& event : refinements) {
    const double momentum = std::abs(event.detail.at("momentum_z_before"));
    for (const char* what : {"mass", "kinetic", "elastic"}) {
      const double before = event.detail.at(std::string(what) + "_before");
      EXPECT_NEAR(event.detail.at(std::string(what) + "_after"), before, 1e-11 * before) << what;
    }
    for (const char* what : {"momentum_x", "momentum_y", "momentum_z", "spin_x", "spin_y", "spin_z"})
      EXPECT_NEAR(event.detail.at(std::string(what) + "_after"), event.detail.at(std::string(what) + "_before"),
                  1e-12 * momentum)
          << what;
  }
  EXPECT_GE(run.end("elements"), 16 + 4 * 3);
}

// From the file that a run leaves behind, before, between and after its refinements.
TEST_P(AcrossAJoint, ARefinedPlateIsResumedToTheSameBytes) {
  const auto until = [&](const std::string& end) {
    return scene::Scene::parse(refined(GetParam().surface), "test.json",
                               {{"simulate.until", end}, {"record.fields", "0.002"}});
  };
  const Folder whole, pieces;
  simulate::RunOptions options;
  options.out = whole.path();
  ASSERT_EQ(simulate::run(until("0.02"), registry(), options).status, simulate::Status::done);
  options.out = pieces.path();
  for (const char* end : {"0.002", "0.004", "0.012", "0.02"}) {
    ASSERT_EQ(simulate::run(until(end), registry(), options).status, simulate::Status::done);
    options.resume = true;
  }
  for (const char* log : {"series.csv", "events.csv", "fields.ndjson"}) {
    EXPECT_EQ(read_text(whole.path() / log), read_text(pieces.path() / log)) << log;
    EXPECT_NE(read_text(whole.path() / log), "") << log;
  }
  EXPECT_THAT(read_text(whole.path() / "events.csv"), testing::HasSubstr(",refine,"));
}

TEST_P(AcrossAJoint, ARefinedPlateIsResumedAfterEveryThirdStep) {
  const auto text = scene::Scene::parse(refined(GetParam().surface), "test.json");
  const Logs whole = run_in_pieces(text, 1LL << 60), pieces = run_in_pieces(text, 3);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
  EXPECT_EQ(nlohmann::json::diff(whole.data, pieces.data).dump(), "[]");
}

}  // namespace
}  // namespace trammel::test
