// A compliant contact after Hertz with the damping of Hunt and Crossley, to change:
//
//     F = K d^(3/2) (1 + c d'),   d = -gap > 0,   d' = -gap_rate;   F >= 0
//     V = 2/5 K d^(5/2)
#include <algorithm>
#include <cmath>

#include <trammel/contact.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct MyContact final : ContactForce {
  double stiffness = 1e6, damping = 0.3;

  double normal(double gap, double gap_rate, double) const override {
    return gap < 0 ? std::max(0.0, hertz(-gap) * (1 - damping * gap_rate)) : 0;
  }
  double potential(double gap) const override { return gap < 0 ? 0.4 * stiffness * std::pow(-gap, 2.5) : 0; }
  Slope slope(double gap, double gap_rate, double approach_speed) const override {
    if (normal(gap, gap_rate, approach_speed) <= 0) return {};
    return {.by_gap = -1.5 * stiffness * std::sqrt(-gap) * (1 - damping * gap_rate), .by_rate = -damping * hertz(-gap)};
  }

 private:
  double hertz(double d) const { return stiffness * std::pow(d, 1.5); }
};

}  // namespace

TRAMMEL_PLUGIN(trammel::contact<MyContact>("my_contact", "Hertz's force with damping, to change")
                   .source("Hunt and Crossley 1975, J. Appl. Mech. 42(2), 440-445")
                   .parameter("stiffness", &MyContact::stiffness,
                              {.unit = "N/m^1.5", .min = 0, .above_min = true, .doc = "K"})
                   .parameter("damping", &MyContact::damping, {.unit = "s/m", .min = 0, .doc = "c"}))
