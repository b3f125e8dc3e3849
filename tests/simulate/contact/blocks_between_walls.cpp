// Blocks side by side on a floor, between two walls. Without clearance most of their forces are indeterminate.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "block.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double g = 10;  // [m/s^2]

struct Block {
  double width, height, mass;  // [m], [kg]
  double mu_floor, mu_left;
};

// Blocks b0, b1, ... from the left wall to the right, with this clearance [m] after each; without one their left faces
// touch the wall or the block before.
json between_walls(const std::vector<Block>& blocks, double mu_right, double clearance = 0) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"record", {{"every", 0.01}, {"observe", {{"vy", "b0.com.vy"}}}}}};
  const auto add = [&s](const std::string& name, const std::string& marker, const json& plane, double mu) {
    s["contacts"][name] = {{"type", "constraint_method"},
                           {"restitution", 0},
                           {"between", {marker, {{"plane", plane}}}},
                           {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}}};
  };
  double x = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& [w, h, m, mu_floor, mu_left] = blocks[i];
    const std::string b = fmt::format("b{}", i);
    x += i > 0 ? clearance : 0;
    s["bodies"][b] = standing_block(x, w, h, m);
    for (const char* corner : {"bl", "br"})
      add(b + corner, fmt::format("{}.{}", b, corner), {{"point", {0, 0}}, {"normal", {0, 1}}}, mu_floor);
    json left = {{"point", {0, 0}}, {"normal", {1, 0}}};
    if (i > 0) left["on"] = fmt::format("b{}.right", i - 1);
    for (const char* corner : {"bl", "tl"})
      add(fmt::format("{}{}_left", b, corner), fmt::format("{}.{}", b, corner), left, mu_left);
    x += w;
  }
  for (const char* corner : {"br", "tr"})
    add(fmt::format("wall_{}", corner), fmt::format("b{}.{}", blocks.size() - 1, corner),
        {{"point", {x + clearance, 0}}, {"normal", {-1, 0}}}, mu_right);
  return s;
}

// The first block is pressed against the left wall and lifted along it: m a = F_y - m g - mu |F_x|. The blocks beside
// it rest, and nothing presses them against each other: the forces of these contacts are round-off, which needs no
// short steps.
TEST(BlockBetweenWalls, RisesBesideBlocksThatNothingLoads) {
  std::mt19937 random(1);
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  for (int i = 0; i < 40; ++i) {
    std::vector<Block> blocks(std::size_t(2 + i % 3));
    for (Block& b : blocks)
      b = {any(0.1, 0.2), any(0.2, 0.3), std::pow(10, any(-1, 0.5)), any(0.1, 0.9), any(0.1, 0.9)};
    const Block& first = blocks[0];
    const double until = 0.05, F_x = -first.mass * any(1, 20), a = any(1, 20);
    json s = between_walls(blocks, any(0.1, 0.9));
    const double F_y = first.mass * (g + a) - first.mu_left * F_x;
    s["forces"]["lifts"] = {{"type", "load"},
                            {"on", "b0.centre"},
                            {"force", {{"x", fmt::format("={:.17g}", F_x)}, {"y", fmt::format("={:.17g}", F_y)}}}};
    s["simulate"]["until"] = until;
    s["integrator"] = {{"type", "dop853"}, {"step", {{"tolerance", std::pow(10, -6 - 2 * (i % 4))}}}};
    const Finished run = run_text(s.dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_NEAR(run.end("vy"), a * until, 1e-9) << i;
    EXPECT_THAT(run.report.summary, Not(HasSubstr("not to be trusted"))) << i;
  }
}

// A row of which a load lifts one block and presses it against others.
json lifted_row(std::mt19937& random, std::size_t n, double tolerance) {
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  std::vector<Block> blocks(n);
  double mass = 0;
  for (Block& b : blocks) {
    b = {any(0.08, 0.25), any(0.1, 0.3), std::pow(10, any(-1, 0.6)), any(0.1, 0.9), any(0.1, 0.9)};
    mass += b.mass;
  }
  json s = between_walls(blocks, any(0.1, 0.9));
  const std::string lifted = fmt::format("b{}.centre", int(any(0, double(n))));
  const double F_x = any(-20, 20) * mass, F_y = any(5, 40) * mass;
  s["forces"]["lifts"] = {{"type", "load"},
                          {"on", lifted},
                          {"force", {{"x", fmt::format("={:.17g}", F_x)}, {"y", fmt::format("={:.17g}", F_y)}}}};
  s["simulate"]["until"] = 0.05;
  s["integrator"] = {{"type", "dop853"}, {"step", {{"tolerance", tolerance}}}};
  return s;
}

// A load lifts one block and presses it against others. Its friction holds some of them and lifts others, and forces of
// equal springs would leave the cones: other forces with which the blocks that rest go on resting are taken.
TEST(BlocksBetweenWalls, ArePressedTogetherByForcesThatContactsHave) {
  std::mt19937 random(3);
  for (int i = 0; i < 12; ++i) {
    const Finished run = run_text(lifted_row(random, std::size_t(4 + i % 2), std::pow(10, -6 - 2 * (i % 4))).dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_THAT(run.report.summary, Not(HasSubstr("not to be trusted"))) << i;
  }
}

// The same contacts by other names, in another order.
json renamed(const json& scene, std::mt19937& random) {
  std::vector<std::string> names;
  for (const auto& [name, contact] : scene["contacts"].items()) names.push_back(name);
  std::shuffle(names.begin(), names.end(), random);
  json other = scene;
  other["contacts"] = json::object();
  for (std::size_t i = 0; i < names.size(); ++i)
    other["contacts"][fmt::format("c{:02}", i)] = scene["contacts"][names[i]];
  return other;
}

// Several motions are possible where a row is jammed. Which one follows is no matter of names.
TEST(BlocksBetweenWalls, MoveAlikeHoweverTheirContactsAreNamed) {
  std::mt19937 random(21);
  for (int i = 0; i < 12; ++i) {
    const std::size_t n = 5;
    json s = lifted_row(random, n, 1e-9);
    for (std::size_t k = 0; k < n; ++k) s["record"]["observe"][fmt::format("y{}", k)] = fmt::format("b{}.com.y", k);
    const Finished run = run_text(s.dump()), other = run_text(renamed(s, random).dump());
    ASSERT_TRUE(run.done() && other.done()) << i << ": " << run.report.reason << other.report.reason;
    EXPECT_THAT(run.report.summary, Not(HasSubstr("not to be trusted"))) << i;
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(other.end(fmt::format("y{}", k)), run.end(fmt::format("y{}", k)), 1e-7) << i << ": block " << k;
  }
}

// The last block is pushed to the left and lifted by a load that grows. Blocks turn about their corners by the
// clearance and jam: feet slip by tenths of a millimetre a second, corners by nanometres a second. Impacts without
// collision end the slow slips alone, and the motion goes on.
TEST(BlocksWithAClearance, JamByImpactsThatEndTheSlowestSlips) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const auto about = [&random](double x) { return x * std::uniform_real_distribution(0.8, 1.25)(random); };
    json s = between_walls({{0.15, 0.38, about(3.3), 1, 0.3},
                            {0.12, 0.27, about(4.4), 3, 0.3},
                            {0.06, 0.27, about(6.5), 1.5, 1.5},
                            {0.11, 0.27, about(6.7), 3, 0}},
                           0, 1e-6);
    for (const char* other : {"b0bl_left", "b1br", "b1bl_left", "b2br", "b2bl_left", "b3bl", "wall_br", "wall_tr"})
      s["contacts"].erase(other);
    s["contacts"]["b0br"]["friction"] = {{"type", "coulomb"}, {"static", 0.1}, {"kinetic", 0.1}};
    s["bodies"]["b3"]["markers"]["near_top"] = {-0.03, 0.12};
    const double F_x = -about(360), F_y = about(180);
    s["forces"]["pushes"] = {{"type", "load"},
                             {"on", "b3.near_top"},
                             {"force", {{"x", fmt::format("={:.17g}*t", F_x)}, {"y", fmt::format("={:.17g}*t", F_y)}}}};
    s["simulate"]["until"] = 0.38;
    s["integrator"] = {{"type", "dop853"}, {"step", {{"tolerance", std::pow(10, -8 - i % 4)}}}};
    const Finished run = run_text(s.dump());
    EXPECT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_THAT(run.report.summary, Not(HasSubstr("not to be trusted"))) << i;
  }
}

}  // namespace
}  // namespace trammel::test
