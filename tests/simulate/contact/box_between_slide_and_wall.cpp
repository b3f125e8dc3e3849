// A slide whose guide rubs presses a box that is lifted against a wall.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

json rubs(double mu) {
  return {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}};
}

struct Touch {
  double x, y;  // on the box
  json plane;
  double mu;
};

struct PressedBox {
  double width, height, mass, inertia;  // halves [m]; [kg], [kg m^2]
  double hand, lift;                    // where it is lifted [m], and by how much [N/s]
  double slide, at_x, at_y, push;       // of the slide: mass; where it is pushed, and by how much
  std::vector<double> axis;
  double length, guide;  // of the guide, and its friction
  double floor, face, wall;
  std::vector<double> on_face, on_wall;  // heights on the box

  std::vector<Touch> touches() const {
    const json ground = {{"point", {0, 0}}, {"normal", {0, 1}}};
    const json moving = {{"point", {0, 0}}, {"normal", {1, 0}}, {"on", "d.f"}};
    const json side = {{"point", {width, 0}}, {"normal", {-1, 0}}};
    std::vector<Touch> all = {{-width, -height, ground, floor}, {width, -height, ground, floor}};
    for (const double y : on_face) all.push_back({-width, y, moving, face});
    for (const double y : on_wall) all.push_back({width, y, side, wall});
    return all;
  }

  // Until `end` [s]; its contacts are named in this order.
  Finished run(const std::vector<std::size_t>& order, double end) const {
    const json where = {-width, height};
    json s = {{"trammel", 1}, {"space", "planar"}, {"gravity", {0, -9.81}}, {"simulate", {{"until", end}}}};
    s["record"] = {{"every", 0.05}, {"observe", {{"x", "b.com.x"}, {"y", "b.com.y"}}}};
    s["bodies"]["b"] = {{"type", "rigid_body"}, {"mass", mass}, {"inertia", inertia}, {"position", {0, height}}};
    s["bodies"]["b"]["markers"]["hand"] = {hand, height};
    s["bodies"]["d"] = {{"type", "rigid_body"}, {"mass", slide}, {"inertia", 0.1 * slide}, {"position", where}};
    s["bodies"]["d"]["markers"] = {{"f", {0, 0}}, {"k", {at_x, at_y}}};
    s["forces"]["k"] = {{"type", "load"}, {"on", "d.k"}, {"force", {{"x", fmt::format("={:.17g}*t", push)}}}};
    s["forces"]["h"] = {{"type", "load"}, {"on", "b.hand"}, {"force", {{"y", fmt::format("={:.17g}*t", lift)}}}};
    s["joints"]["g"] = {{"type", "prismatic"}, {"between", {{{"point", where}}, "d.com"}}, {"axis", axis}};
    s["joints"]["g"].update({{"length", length}, {"friction", rubs(guide)}});
    const std::vector<Touch> all = touches();
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Touch& touch = all[order[i]];
      const std::string name = fmt::format("c{}", i), marker = "b." + name;
      s["bodies"]["b"]["markers"][name] = {touch.x, touch.y};
      s["contacts"][name] = {{"type", "constraint_method"}, {"restitution", 0}, {"friction", rubs(touch.mu)}};
      s["contacts"][name]["between"] = json::array({marker, json{{"plane", touch.plane}}});
    }
    return run_text(s.dump());
  }
};

void expect_slips(const Finished& run, double t) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto slips = run.of_kind("slip");
  ASSERT_FALSE(slips.empty());
  EXPECT_NEAR(slips.front().t, t, 1e-7);
}

// The box is wedged in between slide, floor and wall if friction of the guide holds the slide, whose bound grows with
// the forces of the contacts. Contacts with springs of 1e7 N/m leave rest at these instants, too, but for 1e-3 s.
TEST(ABoxBetweenASlideAndAWall, LetsGoAtOneTimeHoweverItsContactsAreNamed) {
  const PressedBox slow{0.10746072359697344,
                        0.11101104220758984,
                        1.4962074043078897,
                        0.011905451293146225,
                        -0.03266542536512011,
                        38.0506106,
                        1.0644555300559508,
                        0.1777230879883684,
                        0.13330882721917137,
                        21.5683337,
                        {0.9971727044508542, 0.0751438453778448},
                        0.366503116703058,
                        0.15,
                        0.5,
                        0.6,
                        0.6,
                        {-0.11101104220758984, 0.11101104220758984},
                        {-0.029792098384793103}};
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1, 2, 3, 4}, {3, 4, 2, 1, 0}})
    expect_slips(slow.run(order, 0.88), 0.870006492);
  const PressedBox steep{0.16060086116615999,
                         0.1096139901950916,
                         1.2182696696440671,
                         0.01535339110660372,
                         0.0906065220499003,
                         31.9259522,
                         1.2562707583967647,
                         0.14145192212330182,
                         -0.07366670351379928,
                         38.5143687,
                         {0.9398701172537107, -0.34153208149966824},
                         0.3360096320301739,
                         0.3,
                         0.5,
                         0.2,
                         0.2,
                         {-0.1096139901950916, 0.1096139901950916, 0.013775982095388871},
                         {-0.009361199257800878}};
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1, 2, 3, 4, 5}, {5, 3, 0, 2, 4, 1}})
    expect_slips(steep.run(order, 0.65), 0.636339739);
}

}  // namespace
}  // namespace trammel::test
