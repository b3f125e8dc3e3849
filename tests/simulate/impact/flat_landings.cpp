// Bars of a chain that fall flat: all contacts of a bar strike at once, although the steps leave drifts in its joints
// and in contacts that rest.
#include <cmath>
#include <iterator>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// A chain of `links` bars lies on the floor. The last one leans upwards and falls about its end, which rests, with
// several feet along it. `above` [m]: of its last foot.
struct Landing {
  int links = 3, feet = 3;
  double length = 0.5, mass = 1, angle = 0.3, turns = 0, above = 0, tolerance = 1e-9;
  bool hinged = false;  // to the ground: without the others

  Finished run() const {
    std::string bodies, joints, contacts;
    const auto comma = [](const std::string& text) { return text.empty() ? "" : ", "; };
    for (int k = hinged ? links - 1 : 0; k < links; ++k) {
      const bool last = k + 1 == links;
      const double x = k * length + length / 2 * (last ? std::cos(angle) : 1),
                   y = last ? length / 2 * std::sin(angle) : 0;
      std::string markers = fmt::format(R"("l": [{:.17g}, 0], "r": [{:.17g}, 0])", -length / 2, length / 2);
      for (int i = 1; i <= feet; ++i)
        markers +=
            fmt::format(R"(, "f{}": [{:.17g}, {:.17g}])", i, length * (double(i) / feet - 0.5), i == feet ? above : 0);
      bodies +=
          fmt::format(R"({}"b{}": {{"type": "rigid_body", "mass": {:.17g}, "inertia": {:.17g},
                                "position": [{:.17g}, {:.17g}], "angle": {:.17g}, "angular_velocity": {:.17g},
                                "velocity": [{:.17g}, {:.17g}], "markers": {{{}}}}})",
                      comma(bodies), k, mass, mass * length * length / 12, x, y, last ? angle : 0, last ? turns : 0,
                      last ? -turns * y : 0, last ? turns * length / 2 * std::cos(angle) : 0, markers);
      if (k > 0)
        joints += fmt::format(
            R"({}"j{}": {{"type": "revolute", "between": [{}, "b{}.l"]}})", comma(joints), k,
            hinged ? fmt::format(R"({{"point": [{:.17g}, 0]}})", k * length) : fmt::format(R"("b{}.r")", k - 1), k);
      for (int i = 0; i <= feet; ++i)
        if (!hinged || i > 0)
          contacts += fmt::format(R"({}"c{}_{}": {{"type": "constraint_method", "restitution": 0,
                                      "friction": {{"type": "coulomb", "static": 0.3, "kinetic": 0.3}},
                                      "between": ["b{}.{}", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                                  comma(contacts), k, i, k, i == 0 ? "l" : fmt::format("f{}", i));
    }
    return run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81], "bodies": {{{}}}, "joints": {{{}}},
            "contacts": {{{}}}, "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"y": "b{}.com.y"}}}},
            "integrator": {{"type": "dop853", "step": {{"tolerance": {}}}}}}})",
        bodies, joints, contacts, links - 1, tolerance));
  }
  // The times at which feet of the last bar strike.
  std::set<double> strikes() const {
    const Finished run = this->run();
    EXPECT_TRUE(run.done()) << run.report.reason;
    std::set<double> times;
    for (const Event& event : run.of_kind("impact"))
      if (event.contact.starts_with(fmt::format("contacts.c{}_", links - 1))) times.insert(event.t);
    return times;
  }
};

TEST(ABarThatFallsFlat, StrikesOnceWithAllOfItsFeet) {
  std::mt19937 random(7);
  const auto between = [&random](double low, double high) { return low + (high - low) * random() / 4294967296.0; };
  for (int k = 0; k < 12; ++k) {
    Landing landing{.links = 2 + k % 3, .feet = 2 + k % 4, .length = between(0.2, 0.8), .mass = between(0.5, 2)};
    landing.angle = between(0.1, 0.6), landing.turns = between(0, 2), landing.hinged = k % 2 == 1;
    for (const double tolerance : {1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
      landing.tolerance = tolerance;
      EXPECT_EQ(landing.strikes().size(), 1) << k << ' ' << tolerance;
    }
  }
}

// Its end is above the line of its other feet. Its middle strikes nearer than the centre of percussion, so its other
// end lifts off, and this one comes about a microsecond later.
TEST(ABarThatFallsFlat, StrikesTwiceIfItsEndComesLater) {
  for (const int links : {1, 2, 4})
    for (const double tolerance : {1e-7, 1e-9, 1e-11}) {
      const Landing landing{.links = links, .feet = 2, .above = 2e-6, .tolerance = tolerance};
      const std::set<double> times = landing.strikes();
      ASSERT_GE(times.size(), 2) << links << ' ' << tolerance;
      const double between = *std::next(times.begin()) - *times.begin();
      EXPECT_GT(between, 0.2e-6) << links << ' ' << tolerance;
      EXPECT_LT(between, 5e-6) << links << ' ' << tolerance;
    }
}

}  // namespace
}  // namespace trammel::test
