// Contacts whose rows depend on each other, while time passes: supports that move, bodies that turn, a slip that ends.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

void expect_trusted(const Finished& run) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
}

json contact(const std::string& marker, const json& plane, double mu) {
  json c = {{"type", "constraint_method"}, {"between", {marker, {{"plane", plane}}}}};
  if (mu > 0) c["friction"] = {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}};
  return c;
}

// A bar of mass 1 and length 2 on feet at -1, 0 and 1; foot `moved` stands on a base whose height follows `law`.
json bar_on_supports(const std::string& law, int moved, double mu) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -9.81}},
            {"simulate", {{"until", 0.5}}},
            {"record", {{"every", 0.05}, {"observe", {{"y", "bar.com.y"}}}}}};
  s["bodies"]["base"] = {{"type", "moving_base"}, {"y", law}};
  s["bodies"]["bar"] = {{"type", "rigid_body"},
                        {"mass", 1},
                        {"inertia", 1.0 / 3},
                        {"markers", {{"f0", {-1, 0}}, {"f1", {0, 0}}, {"f2", {1, 0}}}}};
  for (int i = 0; i < 3; ++i) {
    json plane = {{"point", {0, 0}}, {"normal", {0, 1}}};
    if (i == moved) plane["on"] = "base.origin";
    s["contacts"][fmt::format("c{}", i)] = contact(fmt::format("bar.f{}", i), plane, mu);
    for (const char* what : {"gap", "force"})
      s["record"]["observe"][fmt::format("{}{}", what, i)] = fmt::format("contacts.c{}.{}", i, what);
  }
  return s;
}

// What is round-off of accelerations follows from the bar's own size and speed, not from those of a body of 2 mm that
// slides by at 10 km/s, to which nothing ties it.
TEST(BarOnThreeSupports, IsLiftedInTimeBesideAMuchFasterBody) {
  json s = bar_on_supports("=0", 1, 0);
  s["forces"]["lift"] = {{"type", "load"}, {"on", "bar.com"}, {"force", {{"y", "=9.81+1e-4*(t-0.1)"}}}};
  s["bodies"]["fast"] = {{"type", "rigid_body"}, {"mass", 1},
                         {"inertia", 1e-6},      {"position", {100, 1e-3}},
                         {"velocity", {1e4, 0}}, {"markers", {{"l", {-1e-3, -1e-3}}, {"r", {1e-3, -1e-3}}}}};
  for (const char* foot : {"l", "r"})
    s["contacts"]["fast_" + std::string(foot)] =
        contact("fast." + std::string(foot), {{"point", {100, 0}}, {"normal", {0, 1}}}, 0);
  const Finished run = run_text(s.dump());
  expect_trusted(run);
  const std::vector<Event> opened = run.of_kind("contact_open");
  ASSERT_EQ(opened.size(), 3u);
  for (const Event& event : opened) EXPECT_NEAR(event.t, 0.1, 1e-5) << event.contact;
}

// Where a support leaves with no speed and no acceleration, no rate of its contact shows it, and its row is not in g.
TEST(BarOnThreeSupports, IsLiftedByTheMiddleOneHoweverGentlyItBegins) {
  for (const char* law : {"=t^3", "=t^4", "=t^5"})
    for (const double mu : {0.0, 0.3}) {
      const Finished run = run_text(bar_on_supports(law, 1, mu).dump());
      expect_trusted(run);
      const double n = law[3] - '0', y = std::pow(0.5, n), a = n * (n - 1) * std::pow(0.5, n - 2);
      EXPECT_NEAR(run.end("y"), y, 1e-9) << law;
      EXPECT_NEAR(run.end("force1"), 9.81 + a, 1e-8) << law;
      EXPECT_EQ(run.end("force0"), 0) << law;
      EXPECT_EQ(run.end("force2"), 0) << law;
      EXPECT_NEAR(run.end("gap0"), y, 1e-9) << law;
    }
}

TEST(BarOnThreeSupports, RestsOnTheOuterOnesWhereTheMiddleOneSinks) {
  for (const char* law : {"=-t^3", "=-t^4", "=-1e-3*t^5"}) {
    const Finished run = run_text(bar_on_supports(law, 1, 0.3).dump());
    expect_trusted(run);
    EXPECT_NEAR(run.end("y"), 0, 1e-12) << law;
    EXPECT_NEAR(run.end("force0"), 9.81 / 2, 1e-9) << law;
    EXPECT_EQ(run.end("force1"), 0) << law;
    EXPECT_GT(run.end("gap1"), 1e-5) << law;
  }
}

TEST(BarOnThreeSupports, LeavesNoGapBehindItWhereAnOuterOneMoves) {
  for (const char* law : {"=t^3", "=-t^3", "=1e-3*sin(5*t)^3", "=-1e-3*sin(5*t)^3"}) {
    const Finished run = run_text(bar_on_supports(law, 0, 0).dump());
    expect_trusted(run);
    for (std::size_t i = 0; i < run.series.at("t").size(); ++i)
      for (int foot = 0; foot < 3; ++foot) {
        const double gap = run.series.at(fmt::format("gap{}", foot))[i],
                     force = run.series.at(fmt::format("force{}", foot))[i];
        EXPECT_GT(gap, -1e-8) << law;  // the method's tolerance
        EXPECT_GE(force, 0) << law;
        EXPECT_TRUE(force == 0 || gap < 1e-8) << law;
      }
  }
}

// Two cards lean on each other at one point and carry a roof there: three contacts, of which each pair implies the
// third. The feet slip, the cards turn, and how the normal of one follows from the others turns with them. Two cards of
// mass 1 and length 1 that lean against each other, a roof on their tips; `push` along x at their centres.
struct Cards {
  double angle = 1.3, mu = 0.1, roof = 5, roof_inertia = 1, push_l = 0, push_r = 0, until = 0.24;
  double turned() const { return angle - std::numbers::pi; }  // (-1, 0) in the axes of the right card
};

json under_a_roof(const Cards& cards) {
  const double c = std::cos(cards.angle), h = std::sin(cards.angle);
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -9.81}},
            {"simulate", {{"until", cards.until}}},
            {"record", {{"every", cards.until / 12}, {"observe", json::object()}}}};
  json& observe = s["record"]["observe"];
  const auto card = [&](double side) {
    return json{{"type", "rigid_body"},
                {"mass", 1},
                {"inertia", 1.0 / 12},
                {"position", {side * c / 2, h / 2}},
                {"angle", side < 0 ? cards.angle : std::numbers::pi - cards.angle},
                {"markers", {{"foot", {-0.5, 0}}, {"tip", {0.5, 0}}}}};
  };
  s["bodies"] = {{"l", card(-1)}, {"r", card(1)}};
  s["bodies"]["roof"] = {
      {"type", "rigid_body"}, {"mass", cards.roof}, {"inertia", cards.roof_inertia}, {"position", {0, h + 0.05}}};
  for (const auto& [name, push] : {std::pair("l", cards.push_l), std::pair("r", cards.push_r)})
    if (push != 0)
      s["forces"][fmt::format("push_{}", name)] = {
          {"type", "load"}, {"on", fmt::format("{}.com", name)}, {"force", {{"x", push}, {"y", 0}}}};
  const json ground = {{"point", {0, 0}}, {"normal", {0, 1}}},
             on_roof = {{"point", {0, -0.05}}, {"normal", {0, -1}}, {"on", "roof.com"}};
  const double mu = cards.mu, turned = cards.turned();
  s["contacts"] = {
      {"foot_l", contact("l.foot", ground, mu)},
      {"foot_r", contact("r.foot", ground, mu)},
      {"roof_l", contact("l.tip", on_roof, mu)},
      {"roof_r", contact("r.tip", on_roof, mu)},
      {"apex",
       contact("l.tip", {{"point", {0.5, 0}}, {"normal", {-std::cos(turned), -std::sin(turned)}}, {"on", "r.com"}},
               mu)}};
  for (const char* name : {"foot_l", "foot_r", "roof_l", "roof_r", "apex"})
    for (const char* what : {"force", "friction"})
      observe[fmt::format("{} {}", name, what)] = fmt::format("contacts.{}.{}", name, what);
  observe["ax"] = "l.com.ax", observe["ay"] = "l.com.ay", observe["angle_r"] = "r.com.angle";
  observe["angle_roof"] = "roof.com.angle";
  return s;
}

// Newton's law of the left card.
void expect_forces_to_accelerate(const Finished& run, const Cards& cards) {
  const auto& series = run.series;
  for (std::size_t i = 0; i < series.at("t").size(); ++i) {
    const double N = series.at("apex force")[i], T = series.at("apex friction")[i],
                 by = cards.turned() + series.at("angle_r")[i], nx = -std::cos(by), ny = -std::sin(by);
    const double N_roof = series.at("roof_l force")[i], T_roof = series.at("roof_l friction")[i],
                 roof = series.at("angle_roof")[i], c = std::cos(roof), sn = std::sin(roof);
    const double fx = series.at("foot_l friction")[i] + N_roof * sn - T_roof * c + N * nx + T * ny + cards.push_l,
                 fy = series.at("foot_l force")[i] - N_roof * c - T_roof * sn + N * ny - T * nx - 9.81;
    EXPECT_NEAR(fx, series.at("ax")[i], 1e-6) << i;  // the dependence is kept to 1e-8 of forces of 20 N
    EXPECT_NEAR(fy, series.at("ay")[i], 1e-6) << i;
  }
}

TEST(CardsUnderARoof, HaveForcesThatAccelerateThem) {
  const Cards cards;
  const Finished run = run_text(under_a_roof(cards).dump());
  expect_trusted(run);
  EXPECT_GT(std::abs(run.series.at("angle_r").back() - run.series.at("angle_r").front()), 0.1);
  expect_forces_to_accelerate(run, cards);
}

// Where the roof slides over both tips its two forces are parallel. Moved from one tip to the other, and back between
// the tips, they change what sticks there and no motion: springs' share may leave the cone there, and another one does
// not.
TEST(CardsUnderARoof, StayInTheirConesWhereTheRoofSlides) {
  std::vector<Cards> houses = {
      {1.1193117950742884, 0.1, 3.1705766252473397, 0.5971252644215822, -0.5660261175337253},
      {1.2032522241888264, 0.1, 1.0671857964992553, 0.20098665834069307, -0.8460585905891762},
      {1.1611405923196925, 0.1, 4.292122450525944, 0.808349728182386, -0.35606803075747107, 0.6670777831146175},
      {1.13131688704964, 0.1, 2.7517479146460473, 0.5182458572583388, -0.675828616027885}};
  std::mt19937 random(4);
  const auto u = [&random](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 12; ++i) {
    Cards& house = houses.emplace_back();
    house.angle = u(1.05, 1.3), house.mu = u(0.05, 0.15), house.roof = u(1, 5);
    house.roof_inertia = 0.19 * house.roof, house.push_l = u(-1, 1), house.push_r = u(-1, 1);
  }
  for (Cards& house : houses) {
    house.until = 0.3;
    const Finished run = run_text(under_a_roof(house).dump());
    expect_trusted(run);
    expect_forces_to_accelerate(run, house);
    for (const char* name : {"foot_l", "foot_r", "roof_l", "roof_r", "apex"})
      for (std::size_t i = 0; i < run.series.at("t").size(); ++i) {
        const double N = run.series.at(fmt::format("{} force", name))[i],
                     T = run.series.at(fmt::format("{} friction", name))[i];
        EXPECT_GE(N, -1e-9) << name << " " << i;
        EXPECT_LE(std::abs(T), house.mu * N + 1e-7) << name << " " << i;
      }
  }
}

// A block of lengths 2 x and 2 y and mass m that slides at `v`, pushed by `load` at `at`.
json block_in_a_channel(double x, double y, double m, double inertia, double v, const json& load, const json& at,
                        double mu) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -9.81}},
            {"simulate", {{"until", 0.3}}},
            {"record", {{"every", 0.015}, {"observe", {{"v", "b.com.vx"}}}}}};
  s["bodies"]["b"] = {{"type", "rigid_body"},
                      {"mass", m},
                      {"inertia", inertia},
                      {"position", {0, y}},
                      {"velocity", {v, 0}},
                      {"markers", {{"l", {-x, -y}}, {"r", {x, -y}}, {"tl", {-x, y}}, {"tr", {x, y}}, {"load", at}}}};
  s["forces"]["load"] = {{"type", "load"}, {"on", "b.load"}, {"force", load}};
  char name = 'a';
  for (const char* corner : {"l", "tl", "r", "tr"}) {
    const bool above = corner[0] == 't';
    s["contacts"][std::string(1, name++)] =
        contact(fmt::format("b.{}", corner), {{"point", {0, above ? 2 * y : 0}}, {"normal", {0, above ? -1 : 1}}}, mu);
  }
  return s;
}

// All four corners stop at once, though the steps leave their slips 1e-8 m/s apart.
TEST(BlockInAChannel, StopsAtAllCornersTogether) {
  std::mt19937 random(7);
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  int stopped = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = any(0.05, 1), y = any(0.05, 1), m = std::pow(10, any(-2, 2));
    const json load = {{"x", m * any(-20, 20)}, {"y", m * any(-20, 20)}}, at = {any(-0.5, 0.5) * x, any(-0.5, 0.5) * y};
    const Finished run =
        run_text(block_in_a_channel(x, y, m, m * (x * x + y * y) / 3, any(-2, 2), load, at, i % 2 ? 5 : 1).dump());
    expect_trusted(run);
    const std::size_t sticks = run.of_kind("stick").size();
    EXPECT_EQ(sticks % 4, 0u) << i;
    stopped += sticks > 0;
  }
  EXPECT_GT(stopped, 50);
}

// With mu = 5 the force of a corner drives its gap apart, so its gap does not close without it either.
TEST(BlockInAChannel, WithMuchFrictionStopsInFewEvents) {
  const double x = 0.941, y = 0.476, m = 0.346;
  const Finished run = run_text(
      block_in_a_channel(x, y, m, m * (x * x + y * y) / 3, 0.455, {{"x", -1.97}, {"y", -4.24}}, {-0.376, -0.00827}, 5)
          .dump());
  expect_trusted(run);
  EXPECT_EQ(run.of_kind("stick").size(), 4u);
  EXPECT_LT(run.result["counts"]["events"], 50);
}

// Legs at random places on a floor. Three would carry; the others share, and a leg is closed without a force where a
// spring in its place would pull.
json sliding_table(int legs, double mu, std::mt19937& random) {
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  const double m = any(0.5, 5), h = any(0.1, 0.8);
  json s = {{"trammel", 1},
            {"space", "spatial"},
            {"gravity", {0, 0, -9.81}},
            {"simulate", {{"until", 1.5}}},
            {"record", {{"every", 0.05}}}};
  json markers;
  for (int i = 0; i < legs; ++i) {
    const double angle = 2 * std::numbers::pi * i / legs + any(-0.2, 0.2), radius = any(0.5, 1);
    const std::string foot = fmt::format("f{}", i);
    markers[foot] = {radius * std::cos(angle), radius * std::sin(angle), -h};
    s["contacts"][foot] = contact("table." + foot, {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}}, mu);
  }
  s["bodies"]["table"] = {{"type", "rigid_body"},
                          {"mass", m},
                          {"inertia", {0.3 * m, 0.3 * m, 0.5 * m}},
                          {"position", {0, 0, h}},
                          {"velocity", {any(-2, 2), any(-2, 2), 0}},
                          {"angular_velocity", {0, 0, any(-4, 4)}},
                          {"markers", markers}};
  return s;
}

TEST(TableOfManyLegs, SlidesAndSpinsByForcesThatContactsHave) {
  std::mt19937 random(28);
  for (int i = 0; i < 45; ++i) {
    const Finished run =
        run_text(sliding_table(std::vector{4, 6, 8}[i % 3], std::vector{0.1, 0.3, 0.6}[i / 3 % 3], random).dump());
    SCOPED_TRACE(i);
    expect_trusted(run);
  }
}

// Blocks on each other that slide apart below a ceiling without clearance. One that slides off the middle of those
// below makes them tip: the ceiling holds the stack, whose friction then slows it more and more, or locks it at once.
// `length` [m] of its unit; gravity stays, so speeds and times go with its root.
json stack_in_a_channel(int blocks, double mu, std::mt19937& random, double length = 1) {
  const auto any = [&random](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  const double w = any(0.3, 1) * length, h = any(0.2, 0.5) * length, time = std::sqrt(length);
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -10}},
            {"simulate", {{"until", 0.5 * time}}},
            {"record", {{"every", 0.025 * time}, {"observe", json::object()}}}};
  const auto touch = [&](const std::string& name, const std::string& marker, const json& plane) {
    s["contacts"][name] = contact(marker, plane, mu);
    s["record"]["observe"][name] = fmt::format("contacts.{}.force", name);
  };
  for (int i = 0; i < blocks; ++i) {
    const std::string b = fmt::format("b{}", i);
    const double m = any(0.5, 2);
    s["bodies"][b] = {{"type", "rigid_body"},
                      {"mass", m},
                      {"inertia", m * (w * w + h * h) / 12},
                      {"position", {0, (i + 0.5) * h}},
                      {"velocity", {any(-2, 2) * length / time, 0}},
                      {"markers",
                       {{"l", {-w / 2, -h / 2}},
                        {"r", {w / 2, -h / 2}},
                        {"tl", {-w / 2, h / 2}},
                        {"tr", {w / 2, h / 2}},
                        {"top", {0, h / 2}}}}};
    json plane = {{"point", {0, 0}}, {"normal", {0, 1}}};
    if (i > 0) plane["on"] = fmt::format("b{}.top", i - 1);
    for (const char* side : {"l", "r"}) touch(fmt::format("{}{}", side, i), fmt::format("{}.{}", b, side), plane);
  }
  for (const char* corner : {"tl", "tr"})
    touch(corner, fmt::format("b{}.{}", blocks - 1, corner), {{"point", {0, blocks * h}}, {"normal", {0, -1}}});
  return s;
}

TEST(StackInAChannel, SlowsDownByForcesThatContactsHave) {
  std::mt19937 random(27);
  int held_by_the_ceiling = 0;
  for (int i = 0; i < 60; ++i) {
    const int blocks = 1 + i % 3;
    const Finished run = run_text(stack_in_a_channel(blocks, std::vector{0.1, 0.2, 0.3, 0.5}[i % 4], random).dump());
    SCOPED_TRACE(i);
    expect_trusted(run);
    const std::vector<double>&kinetic = run.series.at("energy_kinetic"), &potential = run.series.at("energy_potential");
    for (std::size_t k = 1; k < kinetic.size(); ++k)
      EXPECT_LE(kinetic[k] + potential[k], kinetic[k - 1] + potential[k - 1] + 1e-9 * kinetic[0]) << k;
    double ceiling = 0;
    for (const char* corner : {"tl", "tr"})
      for (const double N : run.series.at(corner)) ceiling = std::max(ceiling, N);
    held_by_the_ceiling += ceiling > 0.01;
  }
  EXPECT_GT(held_by_the_ceiling, 0);
}

// Errors of 1e-9 a step, grown where forces pass from one contact to the other.
TEST(StackInAChannel, OfAnySizeSlowsDownAlike) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const auto kinetic = [seed](double length) {
      std::mt19937 random(seed);
      const Finished run =
          run_text(stack_in_a_channel(1 + int(seed) % 3, std::vector{0.1, 0.2, 0.3}[seed % 3], random, length).dump());
      expect_trusted(run);
      std::vector<double> energies = run.series.at("energy_kinetic");
      for (double& energy : energies) energy /= length;
      return energies;
    };
    const std::vector<double> here = kinetic(1);
    for (const double length : {1e-3, 1e3}) {
      const std::vector<double> there = kinetic(length);
      ASSERT_EQ(there.size(), here.size());
      for (std::size_t i = 0; i < here.size(); ++i)
        EXPECT_NEAR(there[i], here[i], 1e-6 * here[0]) << "seed " << seed << ", length " << length << ", row " << i;
    }
  }
}

// A box slides on a table of its own width: corners of the box touch the table, and corners of the table touch the box.
// At first they touch at the same places, and these contacts share rows with no others; a moment later with all.
// x = v0 t - mu g t^2 / 2, whichever of the contacts the scene has and whatever the others' names are.
TEST(BoxOnATableOfItsWidth, SlidesAsOnAFloor) {
  constexpr double g = 9.81, half = 0.3, low = 0.02, mu = 0.3, v0 = 2, until = 0.3;
  std::mt19937 random(5);
  for (const bool spatial : {false, true})
    for (int i = 0; i < 12; ++i) {
      json s = {{"trammel", 1},
                {"space", spatial ? "spatial" : "planar"},
                {"simulate", {{"until", until}}},
                {"record", {{"every", 0.01}, {"observe", {{"x", "box.com.x"}}}}}};
      const auto at = [&](double x, double y, double up) { return spatial ? json{x, y, up} : json{x, up}; };
      s["gravity"] = at(0, 0, -g);
      s["bodies"]["box"] = {{"type", "rigid_body"},
                            {"mass", 2},
                            {"inertia", spatial ? json{0.06, 0.06, 0.12} : json(0.06)},
                            {"position", at(0, 0, low)},
                            {"velocity", at(v0, 0, 0)},
                            {"markers", {{"bottom", at(0, 0, -low)}}}};
      s["bodies"]["table"] = {{"type", "moving_base"}, {"markers", {{"top", at(0, 0, 0)}}}};
      std::vector<std::string> names = {"a", "b", "c", "d", "e", "f", "g", "h"};
      std::shuffle(names.begin(), names.end(), random);
      std::vector<json> corners;
      for (const double x : {-half, half})
        for (const double y : spatial ? std::vector<double>{-half, half} : std::vector<double>{0})
          corners.push_back(at(x, y, 0));
      for (std::size_t k = 0; k < corners.size(); ++k) {
        json of_box = corners[k];
        of_box.back() = -low;
        s["bodies"]["box"]["markers"][fmt::format("c{}", k)] = of_box;
        s["bodies"]["table"]["markers"][fmt::format("c{}", k)] = corners[k];
        s["contacts"][names[2 * k]] = contact(
            fmt::format("box.c{}", k), {{"on", "table.top"}, {"point", at(0, 0, 0)}, {"normal", at(0, 0, 1)}}, mu);
        if (random() % 4 == 0) continue;
        s["contacts"][names[2 * k + 1]] = contact(
            fmt::format("table.c{}", k), {{"on", "box.bottom"}, {"point", at(0, 0, 0)}, {"normal", at(0, 0, -1)}}, mu);
      }
      const Finished run = run_text(s.dump());
      expect_trusted(run);
      EXPECT_NEAR(run.end("x"), v0 * until - mu * g * until * until / 2, 1e-9) << s.dump();
    }
}

// The rows of its feet follow from those of the guide alone.
TEST(BoxOnAGuide, TouchesAFloorThatLeavesItsMotionAlone) {
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -9.81}},
            {"simulate", {{"until", 0.5}}},
            {"record", {{"every", 0.1}, {"observe", {{"x", "box.com.x"}}}}}};
  s["bodies"]["box"] = {{"type", "rigid_body"}, {"mass", 2},
                        {"inertia", 0.1},       {"position", {0, 0.1}},
                        {"velocity", {1, 0}},   {"markers", {{"l", {-0.2, -0.1}}, {"r", {0.2, -0.1}}}}};
  s["joints"]["guide"] = {{"type", "prismatic"}, {"between", {"ground", "box.com"}}};
  for (const char* foot : {"l", "r"})
    s["contacts"][foot] = contact("box." + std::string(foot), {{"point", {0, 0}}, {"normal", {0, 1}}}, 0);
  s["bodies"]["rail"] = {{"type", "moving_base"}, {"markers", {{"at", {0, 0.1}}}}};
  s["joints"]["guide"]["between"][0] = "rail.at";
  const Finished run = run_text(s.dump());
  expect_trusted(run);
  EXPECT_NEAR(run.end("x"), 0.5, 1e-12);
}

}  // namespace
}  // namespace trammel::test
