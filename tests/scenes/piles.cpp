// Many contacts at once: a channel, stacks, piles, towers and arches, with what statics says of them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

json contact(const std::string& marker, const json& plane, double mu, double e = 0) {
  json c = {{"type", "constraint_method"}, {"restitution", e}, {"between", {marker, {{"plane", plane}}}}};
  if (mu > 0) c["friction"] = {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}};
  return c;
}

json scene(double g, double until) {
  return {{"trammel", 1},
          {"space", "planar"},
          {"gravity", {0, -g}},
          {"simulate", {{"until", until}}},
          {"record", {{"every", until / 20}, {"observe", json::object()}}}};
}

void expect_trusted(const Finished& run) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
}

// Blocks of width w and height h on each other, the lowest on a base that moves by `x` or on the ground.
json tower(int n, double w, double h, double mu, double gap, const std::string& base, double until) {
  json s = scene(9.81, until);
  if (!base.empty()) s["bodies"]["base"] = {{"type", "moving_base"}, {"x", base}, {"markers", {{"top", {0, 0}}}}};
  for (int i = 0; i < n; ++i) {
    const std::string b = fmt::format("b{}", i);
    s["bodies"][b] = {
        {"type", "rigid_body"},
        {"mass", 1},
        {"inertia", (w * w + h * h) / 12},
        {"position", {0, (i + 0.5) * h + gap * (i + 1)}},
        {"markers", {{"l", {-w / 2, -h / 2}}, {"r", {w / 2, -h / 2}}, {"top", {0, h / 2}}, {"side", {-w / 2, 0}}}}};
    json plane = {{"point", {0, 0}}, {"normal", {0, 1}}};
    if (i > 0)
      plane["on"] = fmt::format("b{}.top", i - 1);
    else if (!base.empty())
      plane["on"] = "base.top";
    for (const char* side : {"l", "r"}) {
      const std::string name = fmt::format("{}{}", side, i);
      s["contacts"][name] = contact(b + "." + side, plane, mu);
      s["record"]["observe"][name] = "contacts." + name + ".force";
    }
  }
  return s;
}

TEST(BlockInAChannel, IsSlowedByFrictionHoweverNarrowTheClearance) {
  // mu g = 2 m/s^2 from 1 m/s on: 0.4 m/s after 0.3 s, whether the ceiling touches or not.
  for (const double clearance : {0.0, 1e-12, 1e-9, 1e-6}) {
    json s = scene(10, 0.3);
    s["bodies"]["b"] = {
        {"type", "rigid_body"},
        {"mass", 1},
        {"inertia", 1e-3},
        {"velocity", {1, 0}},
        {"markers", {{"l", {-0.04, -0.02}}, {"r", {0.04, -0.02}}, {"tl", {-0.04, 0.02}}, {"tr", {0.04, 0.02}}}}};
    const json floor = {{"point", {0, -0.02}}, {"normal", {0, 1}}},
               ceiling = {{"point", {0, 0.02 + clearance}}, {"normal", {0, -1}}};
    for (const char* m : {"l", "r"}) s["contacts"][m] = contact(fmt::format("b.{}", m), floor, 0.2);
    for (const char* m : {"tl", "tr"}) s["contacts"][m] = contact(fmt::format("b.{}", m), ceiling, 0.2);
    s["record"]["observe"] = {{"v", "b.com.vx"},
                              {"l", "contacts.l.force"},
                              {"r", "contacts.r.force"},
                              {"tl", "contacts.tl.force"},
                              {"tr", "contacts.tr.force"}};
    const Finished run = run_text(s.dump());
    expect_trusted(run);
    EXPECT_NEAR(run.end("v"), 0.4, 1e-9) << clearance;
    EXPECT_NEAR(run.end("l") + run.end("r"), 10, 1e-8) << clearance;
    EXPECT_NEAR(run.end("tl"), 0, 1e-9) << clearance;
    EXPECT_NEAR(run.end("tr"), 0, 1e-9) << clearance;
    EXPECT_NEAR(run.result["energy_dissipated"]["friction_total"], 0.5 * (1 - 0.16), 1e-8) << clearance;
  }
}

TEST(StackOnAMovingBase, TipsAsOneWhereItsResultantLeavesTheBase) {
  // Base acceleration 4 t: the stack of height n h tips about its right edge at 4 t = g w / (n h).
  for (const int n : {2, 3, 5}) {
    const double t = 9.81 * 0.2 / (n * 0.1) / 4;
    const Finished run = run_text(tower(n, 0.2, 0.1, 2, 0, "=t^3/6*4", t + 0.05).dump());
    expect_trusted(run);
    const std::vector<Event> open = run.of_kind("contact_open");
    ASSERT_FALSE(open.empty()) << n;
    EXPECT_NEAR(open[0].t, t, 1e-6) << n;  // decided by what exceeds round-off of the forces
    for (const Event& event : open) EXPECT_EQ(event.contact.back(), '0') << n << ": " << event.contact;
  }
}

TEST(Tower, ComesToRestWhereItIsDropped) {
  for (const int n : {2, 5, 10, 20}) {
    const Finished run = run_text(tower(n, 1, 0.5, 0.5, 0.02, "", 3).dump());
    expect_trusted(run);
    EXPECT_NEAR(run.end("l0") + run.end("r0"), n * 9.81, 1e-6) << n;
    EXPECT_NEAR(run.end("energy_kinetic"), 0, 1e-12) << n;
    EXPECT_LT(run.events.size(), std::size_t(20 * n)) << n;
  }
}

TEST(Tower, TipsAsOneAboutItsEdgeWhereItIsPushed) {
  // 10 t at the height of 5.5 blocks against the weight of ten at half their width, before any joint slides (24.5 N
  // under block 5).
  json s = tower(10, 1, 0.5, 0.5, 0, "", 2);
  s["forces"]["push"] = {{"type", "load"}, {"on", "b5.side"}, {"force", {{"x", "=10*t"}, {"y", 0}}}};
  const Finished run = run_text(s.dump());
  expect_trusted(run);
  const std::vector<Event> open = run.of_kind("contact_open");
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].contact, "contacts.l0");
  EXPECT_NEAR(open[0].t, 10 * 9.81 * 0.5 / (5.5 * 0.5) / 10, 1e-6);
  EXPECT_TRUE(run.of_kind("slip").empty());
}

// Discs of radius 0.1 between two walls, in rows, without friction between them.
json discs(int n, double e, double mu) {
  json s = scene(9.81, 3);
  const int columns = std::max(3, int(std::ceil(std::sqrt(n))));
  const double wall = 0.11 * columns + 0.01;
  for (int i = 0; i < n; ++i) {
    const std::string d = fmt::format("d{}", i);
    const int row = i / columns;
    s["bodies"][d] = {{"type", "rigid_body"},
                      {"mass", 1},
                      {"inertia", 0.005},
                      {"position", {-wall + 0.108 + 0.213 * (i % columns) + 0.006 * (row % 3), 0.15 + 0.24 * row}}};
    const auto wall_contact = [&](double x, double nx, double ny, const char* name) {
      json c = contact(d + ".com", {{"point", {x, 0}}, {"normal", {nx, ny}}}, mu, e);
      c["radius"] = 0.1;
      s["contacts"][fmt::format("{}{}", name, i)] = c;
    };
    wall_contact(0, 0, 1, "floor"), wall_contact(-wall, 1, 0, "left"), wall_contact(wall, -1, 0, "right");
    s["record"]["observe"][fmt::format("F{}", i)] = fmt::format("contacts.floor{}.force", i);
    for (int j = 0; j < i; ++j)
      s["contacts"][fmt::format("d{}_{}", j, i)] = {{"type", "constraint_method"},
                                                    {"restitution", e},
                                                    {"between", {fmt::format("d{}.com", j), d + ".com"}},
                                                    {"reaches", {{"type", "distance"}, {"length", 0.2}}}};
  }
  return s;
}

struct Pile {
  int discs;
  double e, mu;
};

TEST(PileOfDiscs, ComesToRestInABoundedNumberOfEvents) {
  for (const auto& [n, e, mu] :
       {Pile{4, 0, 0}, {6, 0, 0}, {10, 0, 0}, {15, 0, 0}, {6, 0.5, 0}, {6, 0, 0.3}, {10, 0, 0.3}}) {
    const Finished run = run_text(discs(n, e, mu).dump());
    expect_trusted(run);
    double carried = 0;
    for (int i = 0; i < n; ++i) carried += run.end(fmt::format("F{}", i));
    // With friction the walls carry a part.
    if (mu == 0) {
      EXPECT_NEAR(carried, n * 9.81, 1e-5 * n) << n << " " << e;
    }
    EXPECT_LT(run.end("energy_kinetic"), 1e-9) << n << " " << e << " " << mu;
    EXPECT_LT(run.events.size(), std::size_t(100 * n)) << n << " " << e << " " << mu;
  }
}

// A semicircular arch of mean radius 1 and of n voussoirs.
struct Arch {
  int n;
  double thickness;
  double inner() const { return 1 - thickness / 2; }
  double outer() const { return 1 + thickness / 2; }
  double angle(double k) const { return std::numbers::pi * (1 - k / n); }  // of joint k, from the left springing
  // Of a voussoir's centre of mass.
  double radius() const {
    const double half = std::numbers::pi / n / 2;
    return 2.0 / 3 * (std::pow(outer(), 3) - std::pow(inner(), 3)) / (std::pow(outer(), 2) - std::pow(inner(), 2)) *
           std::sin(half) / half;
  }

  // Whether a line of thrust lies within (Heyman 1969): some horizontal thrust x and moment y of the left springing
  // about the centre, in weights of a voussoir, for which the resultant at each joint passes between intrados and
  // extrados. Linear inequalities p x + q y + r >= 0: if there are solutions, one is a corner.
  bool can_stand() const {
    struct Line {
      double p, q, r;
    };
    std::vector<Line> lines = {{1, 0, 0}};
    double moment = 0;  // of the weights before the joint
    for (int k = 0; k <= n; ++k) {
      const double a = angle(k), V = 0.5 * n - k;
      lines.push_back({outer() * std::sin(a), -1, -outer() * std::cos(a) * V + moment});
      lines.push_back({-inner() * std::sin(a), 1, inner() * std::cos(a) * V - moment});
      moment -= radius() * std::cos(angle(k + 0.5));
    }
    for (const Line& a : lines)
      for (const Line& b : lines) {
        const double det = a.p * b.q - a.q * b.p;
        if (std::abs(det) < 1e-12) continue;
        const double x = (a.q * b.r - a.r * b.q) / det, y = (a.r * b.p - a.p * b.r) / det;
        if (std::all_of(lines.begin(), lines.end(), [&](const Line& l) { return l.p * x + l.q * y + l.r > -1e-10; }))
          return true;
      }
    return false;
  }

  json scene_of() const {
    json s = scene(9.81, 0.2);
    const double mass = std::numbers::pi / n * (std::pow(outer(), 2) - std::pow(inner(), 2)) / 2 * 2000;
    const double about_centre = std::numbers::pi / n * (std::pow(outer(), 4) - std::pow(inner(), 4)) / 4 * 2000;
    for (int i = 0; i < n; ++i) {
      const double x = radius() * std::cos(angle(i + 0.5)), y = radius() * std::sin(angle(i + 0.5));
      const auto local = [&](double r, double k) {
        return json{r * std::cos(angle(k)) - x, r * std::sin(angle(k)) - y};
      };
      s["bodies"][fmt::format("v{}", i)] = {{"type", "rigid_body"},
                                            {"mass", mass},
                                            {"inertia", about_centre - mass * radius() * radius()},
                                            {"position", {x, y}},
                                            {"markers",
                                             {{"si", local(inner(), i)},
                                              {"so", local(outer(), i)},
                                              {"ei", local(inner(), i + 1)},
                                              {"eo", local(outer(), i + 1)},
                                              {"end", local(1, i + 1)}}}};
    }
    for (const char* edge : {"i", "o"}) {
      for (int k = 0; k < n; ++k) {
        const double a = angle(k);
        json plane = {{"point", {std::cos(a), std::sin(a)}}, {"normal", {std::sin(a), -std::cos(a)}}};
        if (k > 0) plane["point"] = {0, 0}, plane["on"] = fmt::format("v{}.end", k - 1);
        s["contacts"][fmt::format("joint{}{}", k, edge)] = contact(fmt::format("v{}.s{}", k, edge), plane, 5);
      }
      s["contacts"][fmt::format("joint{}{}", n, edge)] =
          contact(fmt::format("v{}.e{}", n - 1, edge), {{"point", {1, 0}}, {"normal", {0, 1}}}, 5);
    }
    s["record"]["observe"]["y"] = fmt::format("v{}.com.y", n / 2);
    return s;
  }
};

TEST(Arch, StandsOrFallsByItsKnownThickness) {
  for (const int n : {5, 7, 9, 11, 15}) {
    double falls = 0.05, stands = 0.2;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (falls + stands);
      (Arch{n, middle}.can_stand() ? stands : falls) = middle;
    }
    const Finished thick = run_text(Arch{n, 1.01 * stands}.scene_of().dump());
    expect_trusted(thick);
    EXPECT_NEAR(thick.end("y"), thick.series.at("y")[0], 1e-12) << n;
    const Finished thin = run_text(Arch{n, 0.99 * stands}.scene_of().dump());
    expect_trusted(thin);
    EXPECT_LT(thin.end("y"), thin.series.at("y")[0] - 1e-4) << n;  // some g t^2/2 times the missing part
  }
}

}  // namespace
}  // namespace trammel::test
