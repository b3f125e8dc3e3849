// Blocks side by side in a channel without clearance, which push each other along it. The friction between two of them
// loads one and unloads the other; where their frictions with the floor differ, that decides the motion.
#include <cmath>
#include <random>
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

json contact(const std::string& marker, const json& plane, double mu) {
  return {{"type", "constraint_method"},
          {"restitution", 0},
          {"between", {marker, {{"plane", plane}}}},
          {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}}};
}

struct Block {
  double width, mass, mu, speed;  // [m], [kg], of floor and ceiling, [m/s]
};

json in_a_channel(const std::vector<Block>& blocks, double height, double mu_between, double gap) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"simulate", {{"until", 0.2}}},
            {"record", {{"every", 0.01}, {"observe", {{"v", "b0.com.vx"}}}}}};
  const json floor = {{"point", {0, 0}}, {"normal", {0, 1}}}, ceiling = {{"point", {0, height}}, {"normal", {0, -1}}};
  double x = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& [w, m, mu, speed] = blocks[i];
    const std::string b = fmt::format("b{}", i);
    s["bodies"][b] = {{"type", "rigid_body"},
                      {"mass", m},
                      {"inertia", m * (w * w + height * height) / 12},
                      {"position", {x + w / 2, height / 2}},
                      {"velocity", {speed, 0}},
                      {"markers",
                       {{"bl", {-w / 2, -height / 2}},
                        {"br", {w / 2, -height / 2}},
                        {"tl", {-w / 2, height / 2}},
                        {"tr", {w / 2, height / 2}},
                        {"right", {w / 2, 0}}}}};
    for (const char* corner : {"bl", "br"})
      s["contacts"][b + corner] = contact(fmt::format("{}.{}", b, corner), floor, mu);
    for (const char* corner : {"tl", "tr"})
      s["contacts"][b + corner] = contact(fmt::format("{}.{}", b, corner), ceiling, mu);
    if (i > 0)
      for (const char* corner : {"bl", "tl"})
        s["contacts"][fmt::format("push{}{}", i, corner)] =
            contact(fmt::format("{}.{}", b, corner),
                    {{"point", {0, 0}}, {"normal", {1, 0}}, {"on", fmt::format("b{}.right", i - 1)}}, mu_between);
    x += w + gap;
  }
  return s;
}

void expect_trusted(const Finished& run) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_THAT(run.report.summary, Not(HasSubstr("not to be trusted")));
}

// With N between the blocks, |T| <= mu N: m_0 g + T on the floor under the first and m_1 g - T under the second, so
// that both slow down by a = (mu_0 (m_0 g + T) + mu_1 (m_1 g - T))/(m_0 + m_1) and N = mu_1 (m_1 g - T) - m_1 a. What
// the ceiling adds slows them more.
TEST(TwoBlocksInTandem, SlowDownAsOneAndByNoLessThanTheirWeightsDo) {
  for (const double mu_between : {0.05, 0.2, 0.6})
    for (const double m_1 : {0.2, 1.0, 5.0}) {
      const double m_0 = 1, mu_0 = 0.1, mu_1 = 0.3, until = 0.1;
      json s = in_a_channel({{0.2, m_0, mu_0, 1}, {0.15, m_1, mu_1, 1}}, 0.1, mu_between, 0);
      s["simulate"]["until"] = until;
      s["record"]["observe"]["v_1"] = "b1.com.vx";
      const Finished run = run_text(s.dump());
      SCOPED_TRACE(fmt::format("mu {}, mass {}", mu_between, m_1));
      expect_trusted(run);
      const auto slows_by = [&](double T) { return (mu_0 * (m_0 * g + T) + mu_1 * (m_1 * g - T)) / (m_0 + m_1); };
      // N is linear in T, N(T) = N_0 + dN T, and T = mu N unloads the second block most.
      const double N_0 = mu_1 * m_1 * g - m_1 * slows_by(0), dN = -mu_1 - m_1 * (slows_by(1) - slows_by(0));
      const double most = mu_between * N_0 / (1 - mu_between * dN);
      EXPECT_GE((1 - run.end("v")) / until, slows_by(most) - 1e-8);
      EXPECT_NEAR(run.end("v_1"), run.end("v"), 1e-12);
    }
}

// A driven hand gives them their motion, and with the ceiling their forces are indeterminate: springs' shares would
// pull, so others are recorded. Friction takes the work of those.
TEST(BlocksInTandem, LoseToFrictionTheWorkOfTheForcesThatAreRecorded) {
  const double until = 0.2;
  json s = in_a_channel({{0.178, 4.939, 0.358, 0}, {0.113, 0.21, 0.366, 0}}, 0.214, 0.524, 0);
  s["bodies"]["hand"] = {{"type", "moving_base"}, {"x", "=0.872*t^2"}, {"markers", {{"o", {0, 0}}}}};
  for (const char* corner : {"bl", "tl"})
    s["contacts"][fmt::format("hand{}", corner)] =
        contact(fmt::format("b0.{}", corner), {{"point", {0, 0}}, {"normal", {1, 0}}, {"on", "hand.o"}}, 0.418);
  s["simulate"]["until"] = until;
  const auto corners = {"bl", "br", "tl", "tr"};
  for (const char* corner : corners) s["record"]["observe"][corner] = fmt::format("contacts.b1{}.force", corner);
  const Finished run = run_text(s.dump());
  expect_trusted(run);
  double lost = 0;
  for (const char* corner : corners) {
    const double own = run.result["energy_dissipated"]["friction"][fmt::format("b1{}", corner)];
    EXPECT_NEAR(own, 0.366 * run.end(corner) * 0.872 * until * until, 1e-8) << corner;  // constant, up to N
    lost += own;
  }
  EXPECT_GT(lost, 0.366 * 0.21 * g * 0.872 * until * until);
}

TEST(BlocksInTandem, PushEachOtherByForcesThatContactsHave) {
  std::mt19937 random(27);
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  for (int i = 0; i < 40; ++i) {
    std::vector<Block> blocks(std::size_t(2 + i % 3));
    for (Block& b : blocks) b = {any(0.1, 0.3), std::pow(10, any(-1, 1)), any(0.05, 0.6), any(0, 2)};
    const Finished run = run_text(in_a_channel(blocks, any(0.1, 0.2), any(0.05, 0.6), i % 2 == 0 ? 0 : 0.01).dump());
    SCOPED_TRACE(i);
    expect_trusted(run);
    const std::vector<double>& kinetic = run.series.at("energy_kinetic");
    for (std::size_t k = 1; k < kinetic.size(); ++k) EXPECT_LE(kinetic[k], kinetic[k - 1] + 1e-9 * kinetic[0]) << k;
  }
}

// On a floor, of different heights, one pushed against the other: it carries a part of the other's weight by friction,
// until that is at its bound.
TEST(BlocksInTandem, ArePushedByForcesThatContactsHave) {
  std::mt19937 random(2190);
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  int moved = 0;
  for (int i = 0; i < 200; ++i) {
    json s = {{"trammel", 1},
              {"space", "planar"},
              {"gravity", {0, -g}},
              {"simulate", {{"until", 0.02}}},
              {"record", {{"every", 0.01}, {"observe", {{"v", "b0.com.vx"}}}}}};
    const double h[] = {any(0.1, 0.3), any(0.1, 0.3)}, mu_between = any(0.2, 0.6);
    double x = 0;
    for (int b = 0; b < 2; ++b) {
      const double w = any(0.08, 0.15), m = std::pow(10, any(-1, 1)), mu = any(0.2, 0.6);
      const std::string name = fmt::format("b{}", b);
      s["bodies"][name] = {{"type", "rigid_body"},
                           {"mass", m},
                           {"inertia", m * (w * w + h[b] * h[b]) / 12},
                           {"position", {x + w / 2, h[b] / 2}},
                           {"markers",
                            {{"bl", {-w / 2, -h[b] / 2}},
                             {"br", {w / 2, -h[b] / 2}},
                             {"tl", {-w / 2, h[b] / 2}},
                             {"tr", {w / 2, h[b] / 2}}}}};
      for (const char* corner : {"bl", "br"})
        s["contacts"][name + corner] =
            contact(fmt::format("{}.{}", name, corner), {{"point", {0, 0}}, {"normal", {0, 1}}}, mu);
      x += w;
    }
    s["contacts"]["low"] = contact("b1.bl", {{"point", {0, 0}}, {"normal", {1, 0}}, {"on", "b0.br"}}, mu_between);
    s["contacts"]["high"] =
        h[1] < h[0] ? contact("b1.tl", {{"point", {0, 0}}, {"normal", {1, 0}}, {"on", "b0.br"}}, mu_between)
                    : contact("b0.tr", {{"point", {0, 0}}, {"normal", {-1, 0}}, {"on", "b1.bl"}}, mu_between);
    const double push = any(5, 100);
    s["forces"]["push"] = {{"type", "load"}, {"on", "b0.com"}, {"force", {{"x", fmt::format("={}", push)}}}};
    const Finished run = run_text(s.dump());
    SCOPED_TRACE(i);
    expect_trusted(run);
    moved += run.end("v") > 1e-3;
  }
  EXPECT_GT(moved, 60);
}

}  // namespace
}  // namespace trammel::test
