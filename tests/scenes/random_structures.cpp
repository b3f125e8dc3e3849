// Random instances of structures with many contacts: nothing in them is chosen for the algorithms. Each runs again with
// its bodies and contacts named in another order, which must not matter.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

class Numbers {
 public:
  explicit Numbers(unsigned seed) : generator_(seed) {}
  // The same with every standard library, unlike its distributions.
  double between(double low, double high) { return low + (high - low) * double(generator_()) / 4294967296.0; }
  int one_of(int low, int high) { return low + int(generator_() % unsigned(high - low + 1)); }
  std::vector<int> permutation(int n) {
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (int i = n - 1; i > 0; --i) std::swap(order[std::size_t(i)], order[std::size_t(one_of(0, i))]);
    return order;
  }

 private:
  std::mt19937 generator_;
};

// Names of things 0, 1, ...: in their order, or in another one.
class Names {
 public:
  Names(char kind, int n, bool permuted) : kind_(kind), order_(Numbers(7).permutation(n)), permuted_(permuted) {}
  std::string operator()(int i) const { return fmt::format("{}{:02}", kind_, permuted_ ? order_[std::size_t(i)] : i); }

 private:
  char kind_;
  std::vector<int> order_;
  bool permuted_;
};

json with_friction(const std::string& marker, const json& plane, double mu, double e) {
  return {{"type", "constraint_method"},
          {"restitution", e},
          {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}},
          {"between", {marker, {{"plane", plane}}}}};
}

// Blocks of random sizes, dropped one above the other, or pushed.
json tower(unsigned seed, bool permuted) {
  Numbers random(seed);
  const int n = random.one_of(2, 12);
  const bool dropped = random.one_of(0, 1) == 1;
  const double mu = random.between(0.3, 0.8);
  const Names body('b', n, permuted), contact('c', 2 * n, permuted);
  json s = {{"trammel", 1}, {"space", "planar"}, {"gravity", {0, -9.81}}, {"simulate", {{"until", 0.7}}}};
  s["record"] = {{"every", 0.05}, {"observe", json::object()}};
  double y = 0;
  for (int i = 0; i < n; ++i) {
    const double w = random.between(0.7, 1.1), h = random.between(0.3, 0.6), m = 10 * w * h;
    const double gap = random.between(0.003, 0.03), off = random.between(-0.02, 0.02);
    if (dropped) y += gap;
    s["bodies"][body(i)] = {
        {"type", "rigid_body"},
        {"mass", m},
        {"inertia", m * (w * w + h * h) / 12},
        {"position", {off, y + h / 2}},
        {"markers", {{"l", {-w / 2, -h / 2}}, {"r", {w / 2, -h / 2}}, {"top", {0, h / 2}}, {"side", {-w / 2, 0}}}}};
    json plane = {{"point", {0, 0}}, {"normal", {0, 1}}};
    if (i > 0) plane["on"] = body(i - 1) + ".top";
    s["contacts"][contact(2 * i)] = with_friction(body(i) + ".l", plane, mu, 0);
    s["contacts"][contact(2 * i + 1)] = with_friction(body(i) + ".r", plane, mu, 0);
    s["record"]["observe"][fmt::format("x{}", i)] = body(i) + ".com.x";
    y += h;
  }
  if (!dropped)
    s["forces"]["push"] = {{"type", "load"},
                           {"on", body(random.one_of(0, n - 1)) + ".side"},
                           {"force", {{"x", fmt::format("={}*t", 15 * n)}, {"y", 0}}}};
  return s;
}

// A table with four legs or more, three of which would carry it, dropped or sliding, pushed at its top.
json table(unsigned seed, bool permuted) {
  Numbers random(seed);
  const int legs = random.one_of(4, 8);
  const double a = random.between(0.3, 0.8), b = random.between(0.3, 0.8), h = random.between(0.2, 0.5),
               m = random.between(2, 20), mu = random.between(0.2, 0.8);
  const double above = random.one_of(0, 1) * 0.01, vx = random.between(-1, 1), spin = random.between(-2, 2);
  const Names leg('l', legs, permuted);
  json s = {{"trammel", 1}, {"space", "spatial"}, {"gravity", {0, 0, -9.81}}, {"simulate", {{"until", 0.5}}}};
  s["record"] = {{"every", 0.05}, {"observe", {{"x0", "table.com.x"}, {"x1", "table.com.y"}}}};
  json markers = {{"push", {0, 0.05, 0.05}}};
  for (int i = 0; i < legs; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / legs;
    markers[leg(i)] = {a * std::cos(angle), b * std::sin(angle), -h};
    s["contacts"][leg(i)] = with_friction("table." + leg(i), {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}}, mu, 0);
  }
  s["bodies"]["table"] = {{"type", "rigid_body"},
                          {"mass", m},
                          {"inertia", {m * (b * b + 0.04) / 4, m * (a * a + 0.04) / 4, m * (a * a + b * b) / 4}},
                          {"position", {0, 0, h + above}},
                          {"velocity", {vx, 0, 0}},
                          {"angular_velocity", {0, 0, spin}},
                          {"markers", markers}};
  s["forces"]["push"] = {{"type", "load"},
                         {"on", "table.push"},
                         {"force", {{"x", fmt::format("={}*t", 30 * mu * m)}, {"y", "=sin(9*t)"}, {"z", 0}}}};
  return s;
}

// One to three pairs of cards that lean on each other and carry one roof, whose forces are indeterminate. The feet
// slip, and the contacts of the roof unload one after the other, or at once.
json card_house(unsigned seed, bool permuted) {
  Numbers random(seed);
  const int n = random.one_of(1, 3);
  const double length = 0.09, lean = random.between(0.15, 0.6), m = 0.002, mu = random.between(0.2, 0.6);
  const double s_lean = std::sin(lean), c_lean = std::cos(lean), pitch = 2 * length * s_lean;
  const Names card('k', 2 * n, permuted), contact('c', 5 * n, permuted);
  json s = {{"trammel", 1}, {"space", "planar"}, {"gravity", {0, -9.81}}, {"simulate", {{"until", 0.4}}}};
  s["record"] = {{"every", 0.01}, {"observe", {{"x", "roof.com.x"}}}};
  s["integrator"] = {{"type", "dop853"}, {"step", {{"tolerance", 1e-6}}}};
  const json floor = {{"point", {0, 0}}, {"normal", {0, 1}}};
  for (int i = 0; i < 2 * n; ++i) {
    const double side = i % 2 == 0 ? -1 : 1, middle = pitch * (i / 2);
    s["bodies"][card(i)] = {{"type", "rigid_body"},
                            {"mass", m * random.one_of(2, 3) / 2},
                            {"inertia", m * length * length / 12},
                            {"angle", side * lean},
                            {"position", {middle + side * length / 2 * s_lean, length / 2 * c_lean}},
                            {"markers", {{"foot", {0, -length / 2}}, {"head", {0, length / 2}}}}};
    s["contacts"][contact(i)] = with_friction(card(i) + ".foot", floor, mu, 0);
    const json under = {{"point", {0, 0}}, {"normal", {0, -1}}, {"on", "roof.under"}};
    s["contacts"][contact(2 * n + i)] = with_friction(card(i) + ".head", under, mu, 0);
    if (i % 2 == 0) continue;
    const json beside = {{"point", {0, 0}}, {"normal", {-c_lean, s_lean}}, {"on", card(i) + ".head"}};
    s["contacts"][contact(4 * n + i / 2)] = with_friction(card(i - 1) + ".head", beside, mu, 0);
  }
  const double width = pitch * (n - 1) + 0.05;
  s["bodies"]["roof"] = {{"type", "rigid_body"},
                         {"mass", m * n},
                         {"inertia", m * n * width * width / 12},
                         {"position", {pitch * (n - 1) / 2, length * c_lean}},
                         {"markers", {{"under", {0, 0}}}}};
  s["forces"]["push"] = {
      {"type", "load"}, {"on", "roof.com"}, {"force", {{"x", fmt::format("={}*t", random.between(0, 0.2))}, {"y", 0}}}};
  return s;
}

// Discs of 10 kg to 3 t that fall and bounce between two inclined planes, with the gaps of all contacts.
json funnel(unsigned seed) {
  Numbers random(seed);
  const int n = random.one_of(5, 8);
  json s = {{"trammel", 1}, {"space", "planar"}, {"gravity", {0, -9.81}}, {"simulate", {{"until", 0.5}}}};
  s["record"] = {{"every", 0.05}, {"observe", json::object()}};
  std::vector<double> radius;
  const auto observe = [&s](const std::string& contact) {
    s["record"]["observe"][contact + "_gap"] = "contacts." + contact + ".gap";
  };
  for (int i = 0; i < n; ++i) {
    const std::string disc = fmt::format("d{}", i);
    const double m = std::pow(10, random.between(1, 3.5)), R = random.between(0.09, 0.11);
    radius.push_back(R);
    s["bodies"][disc] = {
        {"type", "rigid_body"},
        {"mass", m},
        {"inertia", m * R * R / 2},
        {"position",
         {0.26 * (i % 3 - 1) + random.between(-0.02, 0.02), 0.15 + 0.26 * (i / 3) + random.between(0, 0.02)}}};
    for (const double side : {-1.0, 1.0}) {
      const std::string wall = fmt::format("{}{}", side < 0 ? "r" : "l", i);
      const json plane = {{"point", {0, -0.3}}, {"normal", {side * 0.5, std::sqrt(0.75)}}};
      s["contacts"][wall] = with_friction(disc + ".com", plane, 1, 0.2);
      s["contacts"][wall]["radius"] = R;
      observe(wall);
    }
    for (int j = 0; j < i; ++j) {
      const std::string pair = fmt::format("p{}_{}", j, i);
      s["contacts"][pair] = {{"type", "constraint_method"},
                             {"restitution", 0.2},
                             {"between", {fmt::format("d{}.com", j), disc + ".com"}},
                             {"reaches", {{"type", "distance"}, {"length", R + radius[std::size_t(j)]}}}};
      observe(pair);
    }
  }
  return s;
}

void expect_same_whatever_the_names(json (*structure)(unsigned, bool), unsigned seed, bool trusted) {
  const Finished run = run_text(structure(seed, false).dump()), other = run_text(structure(seed, true).dump());
  ASSERT_TRUE(run.done()) << seed << ": " << run.report.reason;
  ASSERT_TRUE(other.done()) << seed << ": " << other.report.reason;
  if (trusted) {
    EXPECT_TRUE(run.result["warnings"].empty()) << seed << ": " << run.result["warnings"].dump();
  }
  EXPECT_GE(run.result["energy_dissipated"]["friction_total"], -1e-9) << seed;
  // Far above what round-off grows to in half a second, far below any other choice of forces.
  for (const auto& [column, values] : run.series)
    if (column[0] == 'x') {
      EXPECT_NEAR(values.back(), other.end(column), 1e-7) << seed << " " << column;
    }
}

TEST(RandomStructures, TowersDroppedOrPushedDoNotDependOnNames) {
  for (unsigned seed = 1; seed <= 6; ++seed) expect_same_whatever_the_names(tower, seed, true);
}

// Contacts that unload at one instant are not opened and struck again without end by what round-off leaves of their
// rates.
TEST(RandomStructures, CardHousesDoNotDependOnNames) {
  // In the last two, contacts of the roof unload together.
  for (const unsigned seed : {1, 2, 3, 4, 5, 6, 59, 60}) expect_same_whatever_the_names(card_house, seed, true);
}

// A disc may rebound from one neighbour and be struck back by another within a nanosecond, nearer to the first than any
// length that matters, and then a step is tried in which it would pass through the first.
TEST(RandomStructures, DiscsInAFunnelDoNotPenetrateEachOther) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Finished run = run_text(funnel(seed).dump());
    ASSERT_TRUE(run.done()) << seed << ": " << run.report.reason;
    for (const auto& [column, values] : run.series)
      if (column.ends_with("_gap")) {
        EXPECT_GE(*std::min_element(values.begin(), values.end()), -1e-10) << seed << " " << column;
      }
  }
}

TEST(RandomStructures, TablesOfManyLegsDoNotDependOnNames) {
  // Not always trusted: legs that slide keep the share of springs, by which one of the second pulls, and the run says
  // so (framework/complementarity/README.md, what is not promised).
  for (unsigned seed = 1; seed <= 6; ++seed) expect_same_whatever_the_names(table, seed, false);
}

}  // namespace
}  // namespace trammel::test
