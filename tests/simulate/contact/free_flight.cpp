// Bodies that touch and fall together: nothing presses, so all forces of their contacts are round-off, which the steps
// do not follow.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "block.hpp"
#include "support/between.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

constexpr double g = 9.81;

// Blocks on each other, tilted by `angle`.
json tilted_stack(std::mt19937& random, int blocks, double angle, double mu) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"simulate", {{"until", 0.5}}},
            {"record", {{"every", 0.05}, {"observe", json::object()}}}};
  const double width = between(random, 0.2, 0.5);
  double along = 0;
  for (int i = 0; i < blocks; ++i) {
    const std::string name = fmt::format("b{}", i);
    const double height = between(random, 0.1, 0.3), mass = std::pow(10, between(random, -1, 1));
    along += height / 2;
    s["bodies"][name] = standing_block(-width / 2, width, height, mass);
    s["bodies"][name]["position"] = {-std::sin(angle) * along, std::cos(angle) * along};
    s["bodies"][name]["angle"] = angle;
    s["bodies"][name]["markers"]["top"] = {0, height / 2};
    s["record"]["observe"]["v" + name] = name + ".com.vy";
    along += height / 2;
    if (i == 0) continue;
    for (const char* corner : {"bl", "br"}) {
      json& c = s["contacts"][fmt::format("{}{}", corner, i)];
      c = {{"type", "constraint_method"},
           {"restitution", 0},
           {"between",
            {fmt::format("{}.{}", name, corner),
             {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}, {"on", fmt::format("b{}.top", i - 1)}}}}}}};
      if (mu > 0) c["friction"] = {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}};
    }
  }
  return s;
}

TEST(BodiesThatTouch, FallTogetherInFewSteps) {
  std::mt19937 random(1);
  for (int i = 0; i < 40; ++i) {
    const int blocks = 2 + i % 3;
    const Finished run = run_text(tilted_stack(random, blocks, between(random, -1, 1), i % 2 ? 0.3 : 0).dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << i << ": " << run.result["warnings"].dump();
    EXPECT_LT(run.result["counts"]["steps"].get<int>(), 20) << i;
    for (int k = 0; k < blocks; ++k) EXPECT_NEAR(run.end(fmt::format("vb{}", k)), -g * 0.5, 1e-9) << i;
  }
}

// Each disc touches one of those before it, in a direction drawn at random.
json cluster_of_discs(std::mt19937& random, int discs) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"simulate", {{"until", 0.06}}},
            {"record", {{"every", 0.06}, {"observe", json::object()}}}};
  std::vector<double> x{0}, y{0}, radius{0.1};
  for (int i = 0; i < discs; ++i) {
    const std::string name = fmt::format("d{}", i);
    if (i > 0) {
      const auto touched = std::size_t(between(random, 0, i));
      radius.push_back(between(random, 0.05, 0.12));
      const double angle = between(random, -3.1, 3.1), apart = radius.back() + radius[touched];
      x.push_back(x[touched] + apart * std::cos(angle)), y.push_back(y[touched] + apart * std::sin(angle));
      s["contacts"]["k" + name] = {{"type", "constraint_method"},
                                   {"restitution", 0},
                                   {"between", {name + ".com", fmt::format("d{}.com", touched)}},
                                   {"reaches", {{"type", "distance"}, {"length", apart}}}};
    }
    s["bodies"][name] = {
        {"type", "rigid_body"}, {"mass", between(random, 1, 5)}, {"inertia", 0.01}, {"position", {x.back(), y.back()}}};
    s["record"]["observe"]["v" + name] = name + ".com.vy";
  }
  return s;
}

TEST(DiscsThatTouch, FallTogetherInFewSteps) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const int discs = 2 + i % 6;
    const Finished run = run_text(cluster_of_discs(random, discs).dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << i << ": " << run.result["warnings"].dump();
    EXPECT_LT(run.result["counts"]["steps"].get<int>(), 20) << i;
    for (int k = 0; k < discs; ++k) EXPECT_NEAR(run.end(fmt::format("vd{}", k)), -g * 0.06, 1e-9) << i;
  }
}

}  // namespace
}  // namespace trammel::test
