// Pads on a plate that can only turn: joints hold all of their tangents but one, which is nearly along an axis of the
// plate for some. Under their common load they carry equal parts at rest, whatever their angles and names.
#include <cmath>
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

struct Clutch {
  json scene;
  int pads = 0;
  double load = 0;  // [N]
};

// The plates turn together. The first pad is `off` [rad] from the x axis, to which a tangent of the plate is parallel.
Clutch random_clutch(std::mt19937& random, double off) {
  Clutch c{{}, 3 + int(random() % 5), between(random, 10, 100)};
  const double radius = between(random, 0.05, 0.5), speed = between(random, 1, 20);
  json& s = c.scene;
  s = {{"trammel", 1},
       {"space", "spatial"},
       {"gravity", {0, 0, 0}},
       {"simulate", {{"until", 0.2}}},
       {"record", {{"every", 0.02}, {"observe", json::object()}}}};
  for (const char* name : {"turned", "pressed"}) {
    const double mass = std::pow(10, between(random, -0.5, 0.5)), inertia = mass * radius * radius;
    s["bodies"][name] = {{"type", "rigid_body"},
                         {"mass", mass},
                         {"inertia", {inertia, inertia, inertia}},
                         {"angular_velocity", {0, 0, speed}}};
  }
  s["joints"]["axle"] = {{"type", "revolute"}, {"between", {"ground", "turned.com"}}};
  s["joints"]["guide"] = {{"type", "cylindrical"}, {"between", {"ground", "pressed.com"}}};
  s["forces"]["load"] = {{"type", "load"}, {"on", "pressed.com"}, {"force", {{"z", -c.load}}}};
  for (int i = 0; i < c.pads; ++i) {
    const double angle = i == 0 ? off : between(random, 0.1, 6);
    const std::string pad = fmt::format("p{:02}_{}", random() % 100, i);
    s["bodies"]["pressed"]["markers"][pad] = {radius * std::cos(angle), radius * std::sin(angle), 0};
    s["contacts"][pad] = {
        {"type", "constraint_method"},
        {"between",
         {"pressed." + pad, {{"plane", {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}, {"on", "turned.com"}}}}}},
        {"friction", {{"type", "coulomb"}, {"static", 0.8}, {"kinetic", 0.8}}}};
    s["record"]["observe"][fmt::format("N{}", i)] = "contacts." + pad + ".force";
    s["record"]["observe"][fmt::format("T{}", i)] = "contacts." + pad + ".friction";
  }
  return c;
}

TEST(PadsOfAClutchAtRest, CarryEqualPartsWithoutFrictionHoweverNearAnAxisOneOfThemIs) {
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const double off = std::pow(10, between(random, -6, -1));
    const Clutch clutch = random_clutch(random, off);
    const Finished run = run_text(clutch.scene.dump());
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
    for (int pad = 0; pad < clutch.pads; ++pad)
      for (std::size_t k = 0; k < run.series.at("t").size(); ++k) {
        EXPECT_NEAR(run.series.at(fmt::format("N{}", pad))[k], clutch.load / clutch.pads, 1e-9 * clutch.load) << off;
        EXPECT_NEAR(run.series.at(fmt::format("T{}", pad))[k], 0, 1e-9 * clutch.load) << off;
      }
  }
}

}  // namespace
}  // namespace trammel::test
