// Sliding contacts whose forces grow beyond all bounds: struts between a floor and a ceiling, of which the floor is
// driven, and stacks that become struts as they slide.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double g = 10;  // [m/s^2]

json rough_contact(const std::string& marker, const json& plane, double mu_0, double mu) {
  return {{"type", "constraint_method"},
          {"restitution", 0},
          {"between", {marker, {{"plane", plane}}}},
          {"friction", {{"type", "coulomb"}, {"static", mu_0}, {"kinetic", mu}}}};
}

// A rod that leans by 1 in 20, less than friction's angle, between a ceiling and a floor that moves.
json strut(const std::string& law) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"simulate", {{"until", 0.1}}},
            {"record", {{"every", 0.01}, {"observe", {{"v", "rod.com.vx"}}}}}};
  s["bodies"]["floor"] = {{"type", "moving_base"}, {"x", law}, {"markers", {{"o", {0, 0}}}}};
  s["bodies"]["rod"] = {{"type", "rigid_body"},
                        {"mass", 1},
                        {"inertia", 1.0 / 12},
                        {"position", {0.025, 0.5}},
                        {"markers", {{"a", {-0.025, -0.5}}, {"b", {0.025, 0.5}}}}};
  s["contacts"]["a"] = rough_contact("rod.a", {{"point", {0, 0}}, {"normal", {0, 1}}, {"on", "floor.o"}}, 0.5, 0.5);
  s["contacts"]["b"] = rough_contact("rod.b", {{"point", {0, 1}}, {"normal", {0, -1}}}, 0.5, 0.5);
  return s;
}

// The floor that rights it would lift the ceiling: neither end can slide, and no finite force stops a floor.
TEST(Strut, ThatADrivenFloorRightsHasNoForcesAndTheRunEndsThere) {
  for (const char* law : {"=0.3*t", "=0.3*t^2"}) {
    const Finished run = run_text(strut(law).dump());
    SCOPED_TRACE(law);
    EXPECT_EQ(run.report.status, simulate::Status::failed);
    EXPECT_THAT(run.report.reason, HasSubstr("at t = 0 s"));
    EXPECT_THAT(run.report.reason, HasSubstr("Painleve"));
  }
}

// The floor that lays it down lets go of the ceiling.
TEST(Strut, ThatADrivenFloorLaysDownFalls) {
  const Finished run = run_text(strut("=-0.3*t").dump());
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(run.end("energy_total"), 5);
}

struct Layer {
  double width, height, mass, x, mu_0, mu;  // [m], [kg], of its feet
};

// Boxes between floor and ceiling without clearance; the top one is pushed.
json below_a_ceiling(const std::vector<Layer>& layers, double mu_0, double mu, double speed) {
  json s = {{"trammel", 1}, {"space", "planar"}, {"gravity", {0, -g}}, {"simulate", {{"until", 0.3}}}};
  double y = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto& [w, h, m, x, mu_0_feet, mu_feet] = layers[i];
    const std::string b = fmt::format("b{}", i);
    s["bodies"][b] = {{"type", "rigid_body"},
                      {"mass", m},
                      {"inertia", m * (w * w + h * h) / 12},
                      {"position", {x, y + h / 2}},
                      {"velocity", {i + 1 == layers.size() ? speed : 0.0, 0}},
                      {"markers",
                       {{"bl", {-w / 2, -h / 2}},
                        {"br", {w / 2, -h / 2}},
                        {"tl", {-w / 2, h / 2}},
                        {"tr", {w / 2, h / 2}},
                        {"top", {0, h / 2}}}}};
    json under = {{"point", {0, 0}}, {"normal", {0, 1}}};
    if (i > 0) under["on"] = fmt::format("b{}.top", i - 1);
    for (const char* foot : {"bl", "br"})
      s["contacts"][b + foot] = rough_contact(b + "." + foot, under, mu_0_feet, mu_feet);
    y += h;
    s["record"]["observe"]["v" + std::to_string(i)] = b + ".com.vx";
  }
  const std::string top = fmt::format("b{}", layers.size() - 1);
  for (const char* corner : {"tl", "tr"})
    s["contacts"]["ceiling_" + std::string(corner)] =
        rough_contact(top + "." + corner, {{"point", {0, y}}, {"normal", {0, -1}}}, mu_0, mu);
  s["record"]["every"] = 0.01;
  return s;
}

Finished run_with_tolerance(const json& s, double tolerance) {
  return run_text(s.dump(),
                  {{"integrator", fmt::format(R"({{"type": "dop853", "step": {{"tolerance": {}}}}})", tolerance)}});
}

// Its top slides until the stack is a strut, where all its forces grow without bounds.
json becoming_a_strut() {
  return below_a_ceiling({{0.12, 0.082, 3.3, 0, 0.649, 0.649},
                          {0.274, 0.126, 0.324, -0.0076, 0.485, 0.485},
                          {0.172, 0.057, 0.134, 0.0085, 0.251, 0.204},
                          {0.107, 0.163, 0.232, -0.0208, 0.169, 0.134}},
                         0.587, 0.479, 0.83);
}

// Steps that do not know of that place go on beyond it with a hundredth of the speed.
TEST(StackBelowACeiling, TakesNoStepOverThePoleOfItsForces) {
  const json s = becoming_a_strut();
  const Finished tight = run_with_tolerance(s, 1e-12), loose = run_with_tolerance(s, 1e-9);
  ASSERT_TRUE(tight.done()) << tight.report.reason;
  ASSERT_TRUE(loose.done()) << loose.report.reason;
  for (const char* v : {"v0", "v1", "v2", "v3"}) EXPECT_NEAR(loose.end(v), tight.end(v), 1e-4) << v;
  EXPECT_GT(tight.end("v3"), 0.3);
}

// The same bodies and contacts once more, at a distance [m].
json with_a_twin(json s, double distance) {
  const json alone = s;
  for (const auto& [name, body] : alone["bodies"].items()) {
    json& twin = s["bodies"]["twin_" + name] = body;
    twin["position"][0] = body["position"][0].get<double>() + distance;
  }
  for (const auto& [name, contact] : alone["contacts"].items()) {
    json& twin = s["contacts"]["twin_" + name] = contact;
    twin["between"][0] = "twin_" + contact["between"][0].get<std::string>();
    json& plane = twin["between"][1]["plane"];
    if (plane.contains("on")) plane["on"] = "twin_" + plane["on"].get<std::string>();
  }
  for (const auto& [name, observed] : alone["record"]["observe"].items())
    s["record"]["observe"]["twin_" + name] = "twin_" + observed.get<std::string>();
  return s;
}

// Both pass that place within the same steps.
TEST(StackBelowACeiling, TakesNoStepOverThePoleOfItsForcesBesideItsTwin) {
  const json s = becoming_a_strut(), both = with_a_twin(s, 10);
  const Finished alone = run_with_tolerance(s, 1e-12);
  ASSERT_TRUE(alone.done()) << alone.report.reason;
  for (const double tolerance : {1e-9, 1e-8, 1e-7, 1e-6}) {
    SCOPED_TRACE(tolerance);
    const Finished run = run_with_tolerance(both, tolerance);
    ASSERT_TRUE(run.done()) << run.report.reason;
    for (const std::string v : {"v0", "v1", "v2", "v3"}) {
      EXPECT_NEAR(run.end(v), alone.end(v), 1e-4) << v;
      EXPECT_NEAR(run.end("twin_" + v), alone.end(v), 1e-4) << v;
    }
  }
}

// Two blocks without friction below a ceiling. The upper one slides at 2 m/s^2 over the lower one, whose right foot and
// the ceiling hold its left corner as a strut: the forces grow without bounds until this corner has passed the foot,
// after 0.36 m. Then the lower block tips.
TEST(BlockBelowACeiling, WithoutFrictionPassesTheStateInWhichItStandsOnAStrut) {
  json s = below_a_ceiling({{0.22, 0.16, 1, 0, 0, 0}, {0.5, 0.1, 1, 0, 0, 0}}, 0, 0, 0);
  for (auto& [name, contact] : s["contacts"].items()) contact.erase("friction");
  s["gravity"] = {0, 0};
  s["forces"]["load"] = {{"type", "load"}, {"on", "b1.com"}, {"force", {{"x", "=2"}, {"y", "=-4"}}}};
  s["simulate"]["until"] = 0.65;
  s["record"]["observe"] = {{"x", "b1.com.x"}, {"angle", "b0.com.angle"}};
  for (const double tolerance : {1e-12, 1e-9, 1e-6, 1e-4}) {
    SCOPED_TRACE(tolerance);
    const Finished run = run_with_tolerance(s, tolerance);
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"];
    const auto opened = run.of_kind("contact_open");
    ASSERT_FALSE(opened.empty());
    for (const auto& event : opened) EXPECT_NEAR(event.t, 0.6, 1e-6);
    EXPECT_NEAR(run.end("x"), 0.65 * 0.65, 1e-4);
    EXPECT_NEAR(run.end("angle"), -0.01084988, 1e-7);
  }
}

struct Pushed {
  Layer lower, upper;
  double mu_0, mu;      // of the ceiling
  double force, below;  // [N], [m] below the middle of the lower block
  double x, error;      // [m] where that block is at the end, and what tolerances change
};

const std::vector<Pushed> all_pushed = {{{0.244, 0.164, 0.247, 0, 0.209, 0.209},
                                         {0.274, 0.074, 0.888, 0.0252, 0.122, 0.102},
                                         0.23,
                                         0.23,
                                         11.51,
                                         0.0262,
                                         1.2876494,
                                         2e-5},
                                        {{0.12, 0.17, 1.193, 0, 0.392, 0.392},
                                         {0.238, 0.103, 0.338, -0.0169, 0.214, 0.18},
                                         0.615,
                                         0.597,
                                         99.45,
                                         0.032,
                                         0.1615768,
                                         1e-6},
                                        {{0.162, 0.183, 0.869, 0, 0.664, 0.664},
                                         {0.166, 0.154, 0.182, 0.0061, 0.162, 0.137},
                                         0.602,
                                         0.602,
                                         219.7,
                                         0.0348,
                                         10.456654,
                                         2e-6}};

json pushed_below_a_ceiling(const Pushed& p) {
  json s = below_a_ceiling({p.lower, p.upper}, p.mu_0, p.mu, 0);
  s["bodies"]["b0"]["markers"]["push"] = {0, -p.below};
  s["forces"]["push"] = {{"type", "load"}, {"on", "b0.push"}, {"force", {{"x", fmt::format("={}", p.force)}}}};
  s["record"]["observe"]["x"] = "b0.com.x";
  return s;
}

void expect_end_of(const Pushed& p, const json& s, double tolerance) {
  const Finished run = run_with_tolerance(s, tolerance);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_THAT(run.result["warnings"].dump(), Not(HasSubstr("not to be trusted"))) << tolerance;
  EXPECT_NEAR(run.end("x"), p.x, p.error) << tolerance;
}

// The lower block is pushed from under the upper one, until a force at the floor passes below one at the ceiling. The
// normals that carry depend on each other there, and the forces stay finite: then the ceiling lets go. (With stiff
// compliant contacts, which have no modes, the last block ends at 10.4724 m, 10.4642 m and 10.4602 m for 1e10, 1e11 and
// 1e12 N/m.)
TEST(StackBelowACeiling, PassesTheStateInWhichItsContactsThatCarryAreAStrut) {
  for (const Pushed& p : all_pushed) {
    SCOPED_TRACE(p.force);
    for (const double tolerance : {1e-12, 1e-11, 1e-10, 1e-9, 2e-9, 3e-9, 1e-8, 3e-8, 1e-7, 1e-6})
      expect_end_of(p, pushed_below_a_ceiling(p), tolerance);
  }
}

// A block at rest beside the stack, which does not touch it, is none of its forces, whatever it weighs.
TEST(StackBelowACeiling, MovesTheSameBesideABodyOfAnyWeight) {
  for (const Pushed& p : all_pushed) {
    SCOPED_TRACE(p.force);
    for (const double mass : {1e-3, 1.0, 1e3, 1e8}) {
      SCOPED_TRACE(mass);
      json s = pushed_below_a_ceiling(p);
      s["bodies"]["beside"] = {{"type", "rigid_body"},
                               {"mass", mass},
                               {"inertia", mass},
                               {"position", {10, 0.5}},
                               {"markers", {{"l", {-0.5, -0.5}}, {"r", {0.5, -0.5}}}}};
      for (const char* foot : {"l", "r"})
        s["contacts"]["beside_" + std::string(foot)] =
            rough_contact("beside." + std::string(foot), {{"point", {0, 0}}, {"normal", {0, 1}}}, 0.5, 0.5);
      for (const double tolerance : {3e-12, 3e-10, 1e-7}) expect_end_of(p, s, tolerance);
    }
  }
}

}  // namespace
}  // namespace trammel::test
