// Two corners that meet, each described as a contact with the other body's face, share one point and one normal. Where
// the bodies slide and turn against each other the corners part, and only one of these contacts carries.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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

constexpr double g = 10;

// [m, rad] Both carry while the distance of the corners counts as round-off, so the block does not turn for as long.
constexpr double as_one_point = 2e-9;

json contact(const json& marker, const json& plane, double mu) {
  return {{"type", "constraint_method"},
          {"restitution", 0},
          {"between", {marker, {{"plane", plane}}}},
          {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}}};
}

// A block on a base of the same width whose force lifts its right side while it slides. `described`: corners at its
// left, of the block on the base, and of the base under the block.
Finished lifted_block(std::mt19937 random, const std::vector<std::string>& described) {
  const double w = between(random, 0.2, 0.8), h = between(random, 0.2, 0.8), m = between(random, 0.5, 5);
  const double mu = between(random, 0.1, 0.5),
               drags = between(random, 2, 3) * mu * (between(random, 0, 1) < 0.5 ? -1 : 1);
  const double lifts = between(random, 0.55, 0.8);
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"bodies",
             {{"b", standing_block(0, w, h, m)},
              {"base", {{"type", "moving_base"}, {"x", 0}, {"markers", {{"corner", {0, 0}}}}}}}},
            {"simulate", {{"until", 0.2}}},
            {"record", {{"every", 0.05}, {"observe", {{"x", "b.com.x"}, {"y", "b.com.y"}, {"turn", "b.angle"}}}}}};
  s["bodies"]["b"]["markers"]["bottom"] = {0, -h / 2};
  s["forces"]["pull"] = {{"type", "load"}, {"on", "b.right"}, {"force", {{"x", drags * m * g}, {"y", lifts * m * g}}}};
  const json on_base = {{"point", {0, 0}}, {"normal", {0, 1}}, {"on", "base.corner"}};
  const json under_block = {{"point", {0, 0}}, {"normal", {0, -1}}, {"on", "b.bottom"}};
  s["contacts"]["right"] = contact("b.br", on_base, mu);
  for (const std::string& corner : described)
    s["contacts"][corner] = corner == "block" ? contact("b.bl", on_base, mu) : contact("base.corner", under_block, mu);
  return run_text(s.dump());
}

// It moves as on the corner that carries, alone: that of the block where it hangs over, that of the base otherwise.
TEST(CornersAtOnePoint, CarryABlockAsTheOneOfThemThatStaysClosed) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const std::vector<Finished> alone = {lifted_block(random, {"block"}), lifted_block(random, {"base"})};
    const Finished both = lifted_block(random, {"block", "base"});
    ASSERT_TRUE(both.done()) << i << ": " << both.report.reason;
    EXPECT_TRUE(both.result["warnings"].empty()) << i << ": " << both.result["warnings"].dump();
    std::array<double, 2> off{};
    for (std::size_t k = 0; k < 2; ++k)
      for (const char* value : {"x", "y", "turn"})
        off[k] = std::max(off[k], std::abs(both.end(value) - alone[k].end(value)));
    EXPECT_LT(std::min(off[0], off[1]), as_one_point) << i;
    random.discard(100);
  }
}

// Blocks of one width on a table that shakes, with all corners between them described.
json shaken_tower(std::mt19937& random) {
  const double w = between(random, 0.1, 0.4), mu = between(random, 0.3, 1.5), frequency = between(random, 2, 5);
  const double omega = 2 * std::numbers::pi * frequency, amplitude = between(random, 0.3, 0.8) * g / (omega * omega);
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -g}},
            {"simulate", {{"until", 0.8}}},
            {"record", {{"every", 0.004}}}};
  const std::string law = fmt::format("={:.17g}*(1-cos({:.17g}*t))", amplitude, omega);
  s["bodies"]["table"] = {{"type", "moving_base"}, {"x", law}, {"markers", {{"top", {0, 0}}}}};
  const int blocks = 2 + int(between(random, 0, 3));
  double y = 0;
  for (int i = 0; i < blocks; ++i) {
    const double h = between(random, 0.8, 1.5) * w;
    json block = standing_block(-w / 2, w, h, between(random, 0.5, 2));
    block["position"] = {0, y + h / 2};
    block["markers"]["top"] = {0, h / 2}, block["markers"]["bottom"] = {0, -h / 2};
    const std::string name = fmt::format("b{}", i), below = fmt::format("b{}", i - 1);
    s["bodies"][name] = block;
    y += h;
    for (const char* side : {"l", "r"}) {
      const json on = {{"point", {0, 0}}, {"normal", {0, 1}}, {"on", i == 0 ? "table.top" : below + ".top"}};
      const json under = {{"point", {0, 0}}, {"normal", {0, -1}}, {"on", name + ".bottom"}};
      s["contacts"][fmt::format("on_{}{}", i, side)] = contact(fmt::format("{}.b{}", name, side), on, mu);
      if (i > 0)
        s["contacts"][fmt::format("under_{}{}", i, side)] = contact(fmt::format("{}.t{}", below, side), under, mu);
    }
  }
  return s;
}

// The blocks rock and slide, and strike each other with corners that have moved apart by less than what shows. What
// such an impact cannot end in both contacts of a corner is a motion: one of them opens, and none drifts.
TEST(CornersAtOnePoint, OfAShakenTowerHaveNoRateWhereTheyAreClosed) {
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    const Finished run = run_text(shaken_tower(random).dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    const std::vector<double>& rates = run.series.at("constraint_velocity");
    EXPECT_LT(*std::max_element(rates.begin(), rates.end()), 1e-7) << i;  // of steps with a tolerance of 1e-9
  }
}

// Corners that were apart by less than shows close with 1e-9 m/s, and slip as slowly after that impact. Friction ends
// such a slip in a nanosecond, but opens others meanwhile, which close with 1e-9 m/s again.
TEST(CornersAtOnePoint, OfAShakenTowerKeepNoSlipOfAnImpactThatIsTooShortToFollow) {
  std::mt19937 random(125);
  for (int i = 0; i < 10; ++i) {
    json scene = shaken_tower(random);
    scene["simulate"]["event_limit"] = 300;
    const Finished run = run_text(scene.dump());
    EXPECT_TRUE(run.done()) << i << ": " << run.report.reason;
  }
}

}  // namespace
}  // namespace trammel::test
