// Two corners that meet, each described as a contact with the other body's face, share one point and one normal. Where
// the bodies slide and turn against each other the corners part, and only one of these contacts carries.
#include <algorithm>
#include <array>
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

}  // namespace
}  // namespace trammel::test
