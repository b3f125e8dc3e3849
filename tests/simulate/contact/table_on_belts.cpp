// A table in the plane, some of whose feet stand on belts that slip below them while the others stick. The feet are
// equal springs, so their normal forces follow from the weight alone. Friction that could hold longer with other normal
// forces does not: the table starts when that of the springs is used up.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <trammel/decompositions.hpp>

#include "support/between.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

constexpr double g = 9.81;

struct Foot {
  double x, mu;
  int belt;  // the sense in which its belt moves; 0: it stands on the floor
};

// N of equal springs below a body of 1 kg.
Vec normal_forces(const std::vector<Foot>& feet) {
  Mat E(2, Eigen::Index(feet.size()));
  for (Eigen::Index i = 0; i < E.cols(); ++i) E.col(i) << 1, feet[std::size_t(i)].x;
  const Vec weight{{g, 0}};
  return Eigen::CompleteOrthogonalDecomposition<Mat>(E).solve(weight);
}

// The load is 9.81 t [N]. It acts at the height of the feet, as all forces along the floor do and as the centre of mass
// lies, so nothing turns the table.
// Negative if the belts alone drag the table.
double start(const std::vector<Foot>& feet) {
  const Vec N = normal_forces(feet);
  double held = 0, dragged = 0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const double T = feet[i].mu * N[Eigen::Index(i)];
    feet[i].belt == 0 ? held += T : dragged += feet[i].belt * T;
  }
  return std::abs(dragged) < held ? (held - dragged) / g : -1;
}

// Feet that all press.
std::vector<Foot> random_feet(std::mt19937& random) {
  for (;;) {
    const int n = 3 + int(random() % 4);
    std::vector<Foot> feet;
    for (int i = 0; i < n; ++i)
      feet.push_back(
          {between(random, -0.5, 0.5), between(random, 0.05, 0.9), i % 3 == 1 ? (random() % 2 ? 1 : -1) : 0});
    if (!(normal_forces(feet).minCoeff() > 0.05 * g)) continue;
    if (const double t = start(feet); t > 0.05 && t < 0.9) return feet;
  }
}

json table(const std::vector<Foot>& feet, std::mt19937& random) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"simulate", {{"until", 1}}},
            {"record", {{"every", 0.05}, {"observe", {{"x", "table.com.x"}}}}}};
  s["bodies"]["table"] = {{"type", "rigid_body"}, {"mass", 1}, {"inertia", 0.1}, {"position", {0, 0}}};
  json& markers = s["bodies"]["table"]["markers"];
  for (const int sense : {1, -1})
    s["bodies"][sense > 0 ? "forth" : "back"] = {
        {"type", "moving_base"}, {"x", fmt::format("={}*10*t", sense)}, {"markers", {{"top", {0, 0}}}}};
  markers["pulled"] = {feet.front().x, 0};
  s["forces"]["pull"] = {
      {"type", "load"}, {"on", "table.pulled"}, {"force", {{"x", fmt::format("={}*t", g)}, {"y", 0}}}};
  std::vector<std::size_t> name(feet.size());
  for (std::size_t i = 0; i < name.size(); ++i) name[i] = i;
  std::shuffle(name.begin(), name.end(), random);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const std::string marker = fmt::format("f{}", i);
    markers[marker] = {feet[i].x, 0};
    json plane = {{"point", {0, 0}}, {"normal", {0, 1}}};
    if (feet[i].belt != 0) plane["on"] = feet[i].belt > 0 ? "forth.top" : "back.top";
    s["contacts"][fmt::format("c{}", name[i])] = {
        {"type", "constraint_method"},
        {"restitution", 0},
        {"between", {"table." + marker, {{"plane", plane}}}},
        {"friction", {{"type", "coulomb"}, {"static", feet[i].mu}, {"kinetic", feet[i].mu}}}};
  }
  return s;
}

double first_slip_on_the_floor(const Finished& run, double after) {
  for (const Event& event : run.of_kind("slip"))
    if (event.t > after) return event.t;
  return INFINITY;
}

TEST(TableOnBelts, StartsWhenTheFrictionOfItsSpringsIsUsedUp) {
  std::mt19937 random(11);
  for (int i = 0; i < 60; ++i) {
    const std::vector<Foot> feet = random_feet(random);
    const Finished run = run_text(table(feet, random).dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << i << ": " << run.result["warnings"].dump();
    EXPECT_NEAR(first_slip_on_the_floor(run, 0), start(feet), 1e-8) << i;
    // From then on all feet slide: x'' = 9.81 t - 9.81 start, since the friction stays as it is.
    const double t = 1 - start(feet);
    EXPECT_NEAR(run.end("x"), g * t * t * t / 6, 1e-7) << i;
  }
}

}  // namespace
}  // namespace trammel::test
