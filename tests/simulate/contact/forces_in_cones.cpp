// Forces of contacts that share rows, or whose slips are too slow to have a direction, push and stay in their friction
// cones at every instant that a run looks at, in whatever order contacts are named.
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "block.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

struct Friction {
  double at_rest, sliding;
};

json contact(const std::string& marker, const json& plane, const Friction& mu) {
  json c = {{"type", "constraint_method"}, {"restitution", 0}, {"between", {marker, {{"plane", plane}}}}};
  if (mu.at_rest > 0) c["friction"] = {{"type", "coulomb"}, {"static", mu.at_rest}, {"kinetic", mu.sliding}};
  return c;
}

// The contacts are decided in the order of their names.
void expect_forces_in_cones(json scene, std::vector<json> contacts, unsigned orders) {
  for (unsigned order = 0; order < orders; ++order) {
    scene["contacts"] = json::object();
    for (std::size_t k = 0; k < contacts.size(); ++k) scene["contacts"][fmt::format("c{:02}", k)] = contacts[k];
    const Finished run = run_text(scene.dump());
    ASSERT_TRUE(run.done()) << order << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << order << ": " << run.result["warnings"].dump();
    std::mt19937 random(order);
    for (std::size_t k = contacts.size(); k > 1; --k) std::swap(contacts[k - 1], contacts[random() % k]);
  }
}

struct Box {
  double width, height, mass;
  Friction left, right;  // of its lower corners on the floor
  double before;         // on the ram or on the box before it
};

// A ram pushes boxes, which touch each other, along a floor against a spring. The corners of each touch the side of its
// neighbour; where lower corners meet, two contacts are at one place, or one of them is if not `twice`.
void push(const std::vector<Box>& boxes, const std::string& ram, double stiffness, bool twice = true) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -9.81}},
            {"simulate", {{"until", 1}}},
            {"record", {{"every", 0.01}, {"observe", {{"x", "b0.com.x"}}}}}};
  s["bodies"]["ram"] = {{"type", "moving_base"}, {"x", ram}, {"markers", {{"right", {0, 0.12}}}}};
  std::vector<json> contacts;
  const auto floor = json{{"point", {0, 0}}, {"normal", {0, 1}}};
  double x = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto& [w, h, m, left, right, before] = boxes[i];
    const std::string name = fmt::format("b{}", i), behind = i > 0 ? fmt::format("b{}.right", i - 1) : "ram.right";
    s["bodies"][name] = standing_block(x, w, h, m);
    contacts.push_back(contact(name + ".bl", floor, left));
    contacts.push_back(contact(name + ".br", floor, right));
    for (const char* corner : {".bl", ".tl"})
      contacts.push_back(
          contact(name + corner, {{"point", {0, 0}}, {"normal", {1, 0}}, {"on", behind}}, {before, before}));
    for (const char* corner : {"br", "tr"})
      if (i > 0 && (twice || corner[0] == 't'))
        contacts.push_back(contact(fmt::format("b{}.{}", i - 1, corner),
                                   {{"point", {0, 0}}, {"normal", {-1, 0}}, {"on", name + ".left"}}, {before, before}));
    x += w;
  }
  const double half = boxes.back().height / 2;
  s["bodies"]["wall"] = {{"type", "moving_base"}, {"markers", {{"w", {x + 0.3, half}}}}};
  s["forces"]["spring"] = {{"type", "spring_damper"},
                           {"between", {"wall.w", fmt::format("b{}.right", boxes.size() - 1)}},
                           {"stiffness", stiffness},
                           {"length", 0.3}};
  expect_forces_in_cones(s, contacts, 3);
}

// The load of a sliding corner passes 0 by the shares of springs while the friction of one at rest is at its bound.
TEST(BoxesPushedAgainstASpring, KeepTheirForcesInTheirCones) {
  push({{0.25, 0.21, 3.9, {0.5, 0.5}, {0.5, 0.5}, 0.2}, {0.27, 0.16, 1.2, {0.7, 0.56}, {0.7, 0.56}, 0}}, "=0.23*t^2",
       6649);
  push({{0.15, 0.15, 1.6, {0.2, 0.16}, {0.2, 0.16}, 0},
        {0.19, 0.16, 1.0, {0.8, 0.8}, {0.8, 0.64}, 0.6},
        {0.16, 0.39, 1.3, {0.6, 0.48}, {0.6, 0.48}, 0.6}},
       "=0.06*(t-sin(5*t)/5)", 7451, false);
  push({{0.13, 0.2, 3.8, {0.8, 0.8}, {0.8, 0.64}, 0.4},
        {0.1, 0.31, 1.8, {0.7, 0.56}, {0.7, 0.7}, 0},
        {0.18, 0.32, 0.6, {0.7, 0.7}, {0.7, 0.56}, 0.4},
        {0.12, 0.16, 0.6, {0.8, 0.8}, {0.8, 0.8}, 0.2}},
       "=0.06*(t-sin(5*t)/5)", 5979);
}

TEST(BoxesPushedAgainstASpring, KeepTheirForcesInTheirConesWhateverTheirSizesAre) {
  std::mt19937 random(226);
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  for (int i = 0; i < 6; ++i) {
    std::vector<Box> boxes(std::size_t(2 + i % 3));
    for (Box& b : boxes) {
      const double mu = any(0.2, 0.8);
      b = {any(0.1, 0.3), any(0.1, 0.4), any(0.5, 4), {mu, mu}, {mu, 0.8 * mu}, any(0.1, 0.6)};
    }
    SCOPED_TRACE(i);
    push(boxes, i % 2 ? "=0.23*t^2" : "=0.06*(t-sin(5*t)/5)", any(1e3, 1e4));
  }
}

struct Table {
  double height, mass;
  std::vector<double> inertia;
  std::vector<std::pair<double, double>> feet;
  std::string x, y;  // of the floor
};

// A table on a floor that shakes begins to slide and stops again and again.
void shake(const Table& table) {
  json s = {{"trammel", 1},
            {"space", "spatial"},
            {"gravity", {0, 0, -9.81}},
            {"simulate", {{"until", 0.5}}},
            {"record", {{"every", 0.005}, {"observe", {{"x", "t.com.x"}}}}}};
  s["bodies"]["floor"] = {{"type", "moving_base"}, {"markers", {{"p", {0, 0, 0}}}}, {"x", table.x}, {"y", table.y}};
  s["bodies"]["t"] = {
      {"type", "rigid_body"}, {"mass", table.mass}, {"inertia", table.inertia}, {"position", {0, 0, table.height}}};
  std::vector<json> contacts;
  for (const auto& [x, y] : table.feet) {
    const std::string name = fmt::format("f{}", contacts.size());
    s["bodies"]["t"]["markers"][name] = {x, y, -table.height};
    contacts.push_back(
        contact("t." + name, {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}, {"on", "floor.p"}}, {0.4, 0.4}));
  }
  expect_forces_in_cones(s, contacts, 3);
}

// A foot comes to rest while another one slides more slowly than a slip has a direction.
TEST(TableOnAShakenFloor, HasForcesInTheirConesWhereItTurnsAboutAFoot) {
  shake({0.55,
         17.2,
         {0.52838, 0.61645, 0.88064},
         {{0.28143, -0.061163},
          {0.12274, 0.2395},
          {-0.094434, 0.21226},
          {-0.30492, 0.0051841},
          {-0.14079, -0.19948},
          {0.15467, -0.19221}},
         "=0.02964*(1-cos(2*pi*2.3*t))",
         "=0.0040581*(1-cos(2*pi*2.99*t))"});
}

// All feet begin to slide at once, and one that is found idle presses as a spring.
TEST(TableOnAShakenFloor, HasForcesInTheirConesWhereAllFeetBeginToSlide) {
  shake({0.54,
         18,
         {1.817, 2.119, 3.028},
         {{0.5233, -0.1308},
          {0.2244, 0.3508},
          {-0.1885, 0.4284},
          {-0.4603, 0.1596},
          {-0.3199, -0.2528},
          {-0.0579, -0.5526},
          {0.2358, -0.4929}},
         "=0.00432*(1-cos(2*pi*3.7*t))",
         "=0.00508*(1-cos(2*pi*4.81*t))"});
}

// It slides away from the walls, and a load that grows turns it into their corner.
TEST(BoxInACornerOfWalls, HasForcesInTheirCones) {
  for (const double mass : {3.0, 5.0, 12.0}) {
    const double w = 0.3, d = 0.4, h = 0.7, mu = 0.8;
    json s = {{"trammel", 1},
              {"space", "spatial"},
              {"gravity", {0, 0, -9.81}},
              {"simulate", {{"until", 0.8}}},
              {"record", {{"every", 0.02}, {"observe", {{"x", "b.com.x"}}}}}};
    s["bodies"]["b"] = {
        {"type", "rigid_body"},
        {"mass", mass},
        {"inertia", {mass * (d * d + h * h) / 12, mass * (w * w + h * h) / 12, mass * (w * w + d * d) / 12}},
        {"position", {0, 0, h / 2}},
        {"velocity", {0.2, -0.9, 0}},
        {"markers", {{"p", {-0.15, 0.17, 0.16}}}}};
    for (int i = 0; i < 8; ++i)
      s["bodies"]["b"]["markers"][fmt::format("v{}", i)] = {(i & 1 ? 0.5 : -0.5) * w, (i & 2 ? 0.5 : -0.5) * d,
                                                            (i & 4 ? 0.5 : -0.5) * h};
    s["forces"]["load"] = {
        {"type", "load"},
        {"on", "b.p"},
        {"force",
         {{"x", fmt::format("={}*t", 5.47398 * mass)}, {"y", fmt::format("={}*t", -4.27716 * mass)}, {"z", 0}}}};
    std::vector<json> contacts;
    for (int i = 0; i < 4; ++i)
      contacts.push_back(contact(fmt::format("b.v{}", i), {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}}, {mu, mu}));
    const auto on_walls = [&](const char* vertex, int axis, double at, double rubs) {
      json point = {0, 0, 0}, normal = {0, 0, 0};
      point[std::size_t(axis)] = at, normal[std::size_t(axis)] = -1;
      contacts.push_back(contact(vertex, {{"point", point}, {"normal", normal}}, {rubs, rubs}));
    };
    on_walls("b.v1", 0, 0.25, mu), on_walls("b.v3", 0, 0.25, 0);
    on_walls("b.v5", 0, 0.15, mu), on_walls("b.v7", 0, 0.2, 0);
    on_walls("b.v2", 1, 0.25, 0), on_walls("b.v3", 1, 0.2, mu);
    on_walls("b.v6", 1, 0.2, mu), on_walls("b.v7", 1, 0.2, 0);
    SCOPED_TRACE(mass);
    expect_forces_in_cones(s, contacts, 3);
  }
}

// Bricks in three courses, each of which bears on two, on ground that tilts. The corners of both touch the side of the
// other one; corners that met move apart, and then rows that others held do not follow from these any more.
TEST(BricksOnTiltingGround, HaveForcesInTheirConesWhereTheirCornersPart) {
  constexpr double w = 0.4, h = 0.2, m = 10;
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -9.81}},
            {"simulate", {{"until", 0.6}}},
            {"record", {{"every", 0.015}, {"observe", {{"x", "b00.com.x"}}}}}};
  s["bodies"]["ground_"] = {{"type", "moving_base"}, {"angle", "=0.831*t^2"}, {"markers", {{"top", {0, 0}}}}};
  const std::vector<std::vector<double>> courses = {{0, 0.4, 0.8}, {0.2, 0.6}, {0, 0.4, 0.8}};
  std::vector<json> contacts;
  const auto touch = [&contacts](const std::string& corner, const std::string& side, const json& normal) {
    contacts.push_back(contact(corner, {{"point", {0, 0}}, {"normal", normal}, {"on", side}}, {0.2, 0.2}));
  };
  const auto name = [](std::size_t course, std::size_t i) { return fmt::format("b{}{}", course, i); };
  for (std::size_t k = 0; k < courses.size(); ++k)
    for (std::size_t i = 0; i < courses[k].size(); ++i) {
      const double x = courses[k][i];
      const std::string b = name(k, i);
      s["bodies"][b] = {{"type", "rigid_body"},
                        {"mass", m},
                        {"inertia", m * (w * w + h * h) / 12},
                        {"position", {x, h * (double(k) + 0.5)}},
                        {"markers",
                         {{"bl", {-w / 2, -h / 2}},
                          {"br", {w / 2, -h / 2}},
                          {"tl", {-w / 2, h / 2}},
                          {"tr", {w / 2, h / 2}},
                          {"bottom", {0, -h / 2}},
                          {"top", {0, h / 2}},
                          {"right", {w / 2, 0}}}}};
      for (const char* corner : {".bl", ".br"})
        if (k == 0) touch(b + corner, "ground_.top", {0, 1});
      for (const char* corner : {".bl", ".tl"})
        if (i > 0) touch(b + corner, name(k, i - 1) + ".right", {1, 0});
      for (std::size_t j = 0; k > 0 && j < courses[k - 1].size(); ++j) {
        const std::string below = name(k - 1, j);
        const double right_of = x - courses[k - 1][j];
        if (!(right_of > -w && right_of < w)) continue;
        touch(b + (right_of > 0 ? ".bl" : ".br"), below + ".top", {0, 1});
        touch(below + (right_of > 0 ? ".tr" : ".tl"), b + ".bottom", {0, -1});
      }
    }
  expect_forces_in_cones(s, contacts, 2);
}

}  // namespace
}  // namespace trammel::test
