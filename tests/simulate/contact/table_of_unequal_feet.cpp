// A table whose feet in a row have different friction is dragged and lifted by a load that grows. The feet share their
// forces and let go one after another; how they are named makes no difference.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/between.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

constexpr double g = 9.81;

struct Table {
  json scene;  // without contacts
  std::vector<json> feet;
};

// The load lifts one side, and drags to either side, more and more.
Table random_table(std::mt19937& random) {
  const double m = between(random, 1, 10), half_width = between(random, 0.2, 0.4), h = between(random, 0.2, 0.6);
  Table table;
  json& s = table.scene;
  s = {{"trammel", 1},
       {"space", "planar"},
       {"gravity", {0, -g}},
       {"simulate", {{"until", 1}}},
       {"record",
        {{"every", 0.02}, {"observe", {{"x", "table.com.x"}, {"y", "table.com.y"}, {"turn", "table.angle"}}}}}};
  s["bodies"]["table"] = {{"type", "rigid_body"}, {"mass", m}, {"inertia", m * h * h / 3}, {"position", {0, h}}};
  const double drag = between(random, -0.6, 0.6) * m * g, lift = between(random, 0.3, 1.2) * m * g;
  s["bodies"]["table"]["markers"]["p"] = {between(random, -0.7, 0.7) * half_width, between(random, -0.2, 0.2)};
  s["forces"]["load"] = {{"type", "load"},
                         {"on", "table.p"},
                         {"force", {{"x", fmt::format("={:.17g}*t", drag)}, {"y", fmt::format("={:.17g}*t", lift)}}}};
  const int feet = 4 + int(random() % 3);
  for (int i = 0; i < feet; ++i) {
    const double mu = i % 2 == 0 ? between(random, 0.1, 0.6) : 0;
    const std::string marker = fmt::format("f{}", i);
    s["bodies"]["table"]["markers"][marker] = {half_width * between(random, -1, 1), -h};
    table.feet.push_back({{"type", "constraint_method"},
                          {"restitution", 0},
                          {"between", {"table." + marker, {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}}}}}}});
    if (mu > 0) table.feet.back()["friction"] = {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}};
  }
  return table;
}

Finished run_in_order(const Table& table, std::vector<json> feet) {
  json s = table.scene;
  for (std::size_t i = 0; i < feet.size(); ++i) s["contacts"][fmt::format("c{}", i)] = feet[i];
  return run_text(s.dump());
}

TEST(TableOfUnequalFeet, MovesAlikeHoweverItsContactsAreNamed) {
  std::mt19937 random(5);
  for (int i = 0; i < 12; ++i) {
    const Table table = random_table(random);
    std::vector<json> feet = table.feet;
    const Finished first = run_in_order(table, feet);
    ASSERT_TRUE(first.done()) << i << ": " << first.report.reason;
    EXPECT_TRUE(first.result["warnings"].empty()) << i << ": " << first.result["warnings"].dump();
    for (int order = 0; order < 3; ++order) {
      std::shuffle(feet.begin(), feet.end(), random);
      const Finished run = run_in_order(table, feet);
      ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << i << ": " << run.result["warnings"].dump();
      for (const char* what : {"x", "y", "turn"}) EXPECT_NEAR(run.end(what), first.end(what), 1e-8) << i << ' ' << what;
    }
  }
}

}  // namespace
}  // namespace trammel::test
