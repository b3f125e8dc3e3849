// Contacts that knock against each other come to rest in bounded numbers of events, by every impact law: the contacts
// of a body that lands on several of them, or between floor and walls.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "../contact/block.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

constexpr double g = 9.81;                 // [m/s^2]
constexpr std::size_t most_events = 1000;  // twice as many as the longest of these runs has

class Random {
 public:
  explicit Random(unsigned seed) : source_(seed) {}
  double in(double from, double to) { return from + (to - from) * double(source_()) / 4294967296.0; }

 private:
  std::mt19937 source_;
};

struct Surface {
  std::string law = "newton";
  double e = 0, mu = 0;
};

json contact(const std::string& marker, const json& point, const json& normal, const Surface& s) {
  return {{"type", "constraint_method"},
          {"restitution", s.e},
          {"impact_law", s.law},
          {"between", {marker, {{"plane", {{"point", point}, {"normal", normal}}}}}},
          {"friction", {{"type", "coulomb"}, {"static", s.mu}, {"kinetic", s.mu}}}};
}

json scene_of(const char* space, const json& gravity, double until) {
  return {{"trammel", 1},
          {"space", space},
          {"gravity", gravity},
          {"simulate", {{"until", until}, {"event_limit", most_events}}},
          {"record", {{"every", 0.02}}}};
}

void expect_an_end(const Finished& run, const std::string& which) {
  ASSERT_TRUE(run.done()) << which << ": " << run.report.reason;
  EXPECT_LT(run.events.size(), most_events) << which;
}

// Contacts only take energy, up to the error of controlled steps (1e-9) and of gaps.
void expect_no_gain(const Finished& run, double scale, const std::string& which) {
  const std::vector<double>& energy = run.series.at("energy_total");
  for (std::size_t i = 1; i < energy.size(); ++i) ASSERT_LE(energy[i], energy[i - 1] + 1e-7 * scale) << which;
}

// A box that falls on its corners, tilted and spinning, until it lies on a side.
TEST(Chatter, OfABoxOnTwoCornersEndsInBoundedNumbers) {
  Random random(1);
  for (const char* law : {"energetic", "poisson", "newton"})
    for (int i = 0; i < 10; ++i) {
      const double w = random.in(0.1, 0.4), h = random.in(0.1, 0.4), m = random.in(1, 5), y = w + h + 0.1;
      const Surface floor{law, random.in(0.1, 0.6), random.in(0.2, 0.8)};
      json s = scene_of("planar", {0, -g}, 8);
      s["bodies"]["box"] = {{"type", "rigid_body"},
                            {"mass", m},
                            {"inertia", m * (w * w + h * h) / 3},
                            {"position", {0, y}},
                            {"angle", random.in(-0.6, 0.6)},
                            {"velocity", {random.in(-0.5, 0.5), 0}},
                            {"angular_velocity", random.in(-1, 1)},
                            {"markers", {{"a", {-w, -h}}, {"b", {w, -h}}, {"c", {w, h}}, {"d", {-w, h}}}}};
      for (const char* corner : {"a", "b", "c", "d"})
        s["contacts"][corner] = contact(std::string("box.") + corner, {0, 0}, {0, 1}, floor);
      s["record"]["observe"] = {{"y", "box.com.y"}, {"v", "box.com.vx"}, {"omega", "box.angular_velocity"}};
      const std::string which = fmt::format("{} {}", law, i);
      const Finished run = run_text(s.dump());
      expect_an_end(run, which);
      EXPECT_LT(std::min(std::abs(run.end("y") - h), std::abs(run.end("y") - w)), 1e-7) << which;  // the steps' error
      EXPECT_LT(std::abs(run.end("v")) + std::abs(run.end("omega")), 1e-8) << which;
      if (std::string(law) != "newton") expect_no_gain(run, m * g * y, which);  // with friction it may (Kane)
    }
}

// Balls that spin fall on each other in a tray, into its corners. The one that strikes the floor throws itself off the
// walls that it touches.
TEST(Chatter, OfBallsInATrayEndsInBoundedNumbers) {
  constexpr double R = 0.05, wall = 0.12, m = 0.5;
  const Surface surface{"newton", 0, 0.7};
  struct Ball {
    double x, y, vx, vy;
    std::vector<double> omega;
  };
  Random random(2);
  for (int i = 0; i < 2; ++i) {
    json s = scene_of("spatial", {0, 0, -g}, 0.6);
    const auto name = [](int k) { return fmt::format("k{}", k); };
    int k = 0;
    for (const Ball& ball : {Ball{-0.029, 0.001, -0.1, 0.3, {-4, 0, 2}}, Ball{0.049, 0.001, -0.2, 0.3, {2, -5, 8}},
                             Ball{0.058, 0.037, 0.4, -0.2, {5, 8, 4}}, Ball{-0.003, -0.048, -0.1, 0.1, {8, 9, 0}},
                             Ball{0.044, -0.029, 0.3, 0, {-10, 4, -2}}}) {
      const std::string centre = name(k) + ".com";
      s["bodies"][name(k)] = {{"type", "rigid_body"},
                              {"mass", m},
                              {"inertia", {5e-4, 5e-4, 5e-4}},
                              {"position", {ball.x, ball.y, 0.06 + 0.11 * k}},
                              {"velocity", {ball.vx + random.in(-1e-3, 1e-3), ball.vy, 0}},
                              {"angular_velocity", ball.omega}};
      const auto in_tray = [&](const char* side, const json& point, const json& normal) {
        s["contacts"][name(k) + side] = contact(centre, point, normal, surface);
        s["contacts"][name(k) + side]["radius"] = R;
      };
      in_tray("f", {0, 0, 0}, {0, 0, 1});
      in_tray("x-", {-wall, 0, 0}, {1, 0, 0}), in_tray("x+", {wall, 0, 0}, {-1, 0, 0});
      in_tray("y-", {0, -wall, 0}, {0, 1, 0}), in_tray("y+", {0, wall, 0}, {0, -1, 0});
      for (int other = 0; other < k; ++other)
        s["contacts"][name(other) + name(k)] = {{"type", "constraint_method"},
                                                {"restitution", 0},
                                                {"between", {name(other) + ".com", centre}},
                                                {"reaches", {{"type", "distance"}, {"length", 2 * R}}}};
      ++k;
    }
    const Finished run = run_text(s.dump());
    expect_an_end(run, std::to_string(i));
    expect_no_gain(run, k * m * g * 0.3, std::to_string(i));
  }
}

struct Walls {
  double a, b, c, m, mu;  // half of the box, its mass, friction of the floor
  double vx, vy;
  struct Wall {
    int x, y, z;  // the corner that it stops
    bool in_x;
    double at, mu;
  };
  std::vector<Wall> all;
};

json box_between(const Walls& walls, double more_speed) {
  const auto& [a, b, c, m, mu, vx, vy, all] = walls;
  json s = scene_of("spatial", {0, 0, -g}, 0.8);
  json& box = s["bodies"]["box"];
  box = {{"type", "rigid_body"},
         {"mass", m},
         {"inertia", {m * (b * b + c * c) / 3, m * (a * a + c * c) / 3, m * (a * a + b * b) / 3}},
         {"position", {0, 0, c}},
         {"velocity", {vx + more_speed, vy, 0}}};
  const auto corner = [](int x, int y, int z) { return fmt::format("c{}{}{}", x, y, z); };
  for (const int x : {0, 1})
    for (const int y : {0, 1})
      for (const int z : {0, 1}) {
        box["markers"][corner(x, y, z)] = {(2 * x - 1) * a, (2 * y - 1) * b, (2 * z - 1) * c};
        if (z > 0) continue;
        s["contacts"]["f" + corner(x, y, z)] =
            contact("box." + corner(x, y, z), {0, 0, 0}, {0, 0, 1}, {"newton", 0, mu});
      }
  for (const Walls::Wall& w : all) {
    const std::string at = corner(w.x, w.y, w.z);
    const json point = w.in_x ? json{w.at, 0, 0} : json{0, w.at, 0}, normal = w.in_x ? json{-1, 0, 0} : json{0, -1, 0};
    s["contacts"][(w.in_x ? "x" : "y") + at] = contact("box." + at, point, normal, {"newton", 0, w.mu});
  }
  return s;
}

void expect_ends_between(const Walls& walls) {
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    const double more_speed = random.in(-0.01, 0.01), v = walls.vx + more_speed;
    const Finished run = run_text(box_between(walls, more_speed).dump());
    expect_an_end(run, std::to_string(i));
    expect_no_gain(run, walls.m * (g * walls.c + (v * v + walls.vy * walls.vy) / 2), std::to_string(i));
  }
}

// A box slides into a corner of two walls and knocks between them and the floor.
TEST(Chatter, OfABoxInACornerEndsInBoundedNumbers) {
  expect_ends_between({0.25,
                       0.15,
                       0.35,
                       5,
                       0.4,
                       1.0,
                       0.4,
                       {{1, 0, 0, true, 0.25, 0.4},
                        {1, 1, 0, true, 0.35, 0},
                        {1, 0, 1, true, 0.3, 0.4},
                        {1, 1, 1, true, 0.3, 0.4},
                        {0, 1, 0, false, 0.2, 0},
                        {1, 1, 0, false, 0.15, 0.4},
                        {0, 1, 1, false, 0.15, 0},
                        {1, 1, 1, false, 0.2, 0.4}}});
}

// A box tips back on two feet, and its lowest corner comes to a wall just as it lands: until then it moves against the
// wall, at a rate that falls to 0 within a gap that counts as none.
TEST(Chatter, OfABoxThatLandsBesideAWallEndsInBoundedNumbers) {
  expect_ends_between(
      {0.15,
       0.25,
       0.3,
       10,
       0.8,
       1.1,
       0,
       {{1, 0, 0, true, 0.25, 0}, {1, 1, 0, true, 0.15, 0}, {1, 0, 1, true, 0.2, 0}, {1, 1, 1, true, 0.25, 0.8}}});
}

struct Shake {
  double amplitude, frequency;  // [m], [Hz]
};

// Blocks of w by h on each other on a table that shakes, each described by its lower corners on the block below and by
// the upper corners of that block under it.
json shaken_tower(int blocks, double w, double h, double mu, const Shake& shake) {
  json s = scene_of("planar", {0, -g}, 0.8);
  s["bodies"]["table"] = {{"type", "moving_base"},
                          {"markers", {{"top", {0, 0}}}},
                          {"x", fmt::format("={:.17g}*(1-cos(2*pi*{:.17g}*t))", shake.amplitude, shake.frequency)}};
  for (int k = 0; k < blocks; ++k) {
    const std::string block = fmt::format("b{}", k), below = k == 0 ? "table" : fmt::format("b{}", k - 1);
    s["bodies"][block] = standing_block(-w / 2, w, h, 2);
    s["bodies"][block]["position"] = {0, (k + 0.5) * h};
    const auto touches = [&](const std::string& marker, const std::string& other, double y, double normal) {
      json c = contact(marker, {0, y}, {0, normal}, {"newton", 0, mu});
      c["between"][1]["plane"]["on"] = other;
      s["contacts"][marker.substr(0, 2) + marker.substr(3) + (normal > 0 ? "" : "_u")] = c;
    };
    for (const char* corner : {".bl", ".br"})
      touches(block + corner, below + (k == 0 ? ".top" : ".centre"), k == 0 ? 0 : h / 2, 1);
    if (k == 0) continue;
    for (const char* corner : {".tl", ".tr"}) touches(below + corner, block + ".centre", -h / 2, -1);
  }
  return s;
}

// As they slip, two contacts at one edge are a little apart: a block that turns about one of them leaves the other one
// as slowly as nothing can follow, although it turns fast.
TEST(Chatter, OfAShakenTowerWhoseCornersNearlyMeetEndsInBoundedNumbers) {
  Random random(6);
  for (int i = 0; i < 12; ++i) {
    const double w = random.in(0.15, 0.4), h = random.in(0.12, 0.3), frequency = random.in(1.5, 3);
    const double amplitude = random.in(4, 8) / std::pow(2 * std::numbers::pi * frequency, 2);
    const std::string which = fmt::format("tower {}", i);
    const Finished run = run_text(shaken_tower(4, w, h, random.in(0.6, 0.8), {amplitude, frequency}).dump());
    expect_an_end(run, which);
    EXPECT_TRUE(run.result["warnings"].empty()) << which << run.result["warnings"].dump();
    EXPECT_LT(run.result["counts"]["locating_steps"].get<int>(), 4000) << which;
  }
}

// The top block turns fast about one corner, and below it blocks knock at 1e-9 m/s: the rate of the first one cannot
// end, those of the others can.
TEST(Chatter, OfBlocksBelowOneThatTurnsEndsInBoundedNumbers) {
  for (const double amplitude : {0.01623, 0.01624, 0.01632, 0.01637, 0.01638}) {
    const Finished run = run_text(shaken_tower(4, 0.28, 0.28, 0.8, {amplitude, 2.7}).dump());
    const std::string which = fmt::format("amplitude {} m", amplitude);
    expect_an_end(run, which);
    EXPECT_LT(run.result["counts"]["locating_steps"].get<int>(), 1000) << which;
  }
}

}  // namespace
}  // namespace trammel::test
