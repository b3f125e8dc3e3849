// The energetic law on contacts set by hand.
#include "simulate/impact/energetic_impact.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulate/start/setup.hpp"
#include "support/made.hpp"

namespace trammel::test {
namespace {

// Painleve's rod of m = l = 1, whose tip slides to -x and finds no finite force, and a ball of 1 kg that strikes a
// floor of its own: both at `speed`.
simulate::Setup rod_and_ball(double speed) {
  const double theta = std::atan(2.0);
  return simulate::set_up(scene::Scene::parse(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {{
      "ball": {{"type": "point_mass", "mass": 1, "position": [5, 1], "velocity": [0, {0:.17g}]}},
      "rod": {{"type": "rigid_body", "mass": 1, "inertia": "=1/3", "position": [{1:.17g}, {2:.17g}], "angle": {3:.17g},
               "velocity": [{0:.17g}, 0], "markers": {{"tip": [-1, 0]}}}}}},
    "contacts": {{
      "ball": {{"type": "constraint_method", "restitution": 0.5,
                "between": ["ball.point", {{"plane": {{"point": [0, 1], "normal": [0, 1]}}}}]}},
      "tip": {{"type": "constraint_method", "between": ["rod.tip", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
               "friction": {{"type": "coulomb", "static": 2, "kinetic": 2}}}}}},
    "simulate": {{"until": 1}}, "record": {{"every": 1}}}})",
                                                          -speed, std::cos(theta), std::sin(theta), theta),
                                              "test.json"),
                          registry());
}

int index_of(const model::AssembledSystem& system, const std::string& name) {
  for (int i = 0;; ++i)
    if (system.model().contacts[std::size_t(i)].name == name) return i;
}

// A = (1.6 -1.2; -1.2 3.4) takes the tip from (0, -1) m/s to rest by (0.3, 0.4) N s, however small the approach that
// begins it; the ball beside it rebounds. At any speed: the law has none of its own.
TEST(EnergeticImpact, StopsASlipWithoutCollisionAndLeavesAReboundBesideItAsItIs) {
  for (const double speed : {1e-6, 1.0, 1e6}) {
    const simulate::Setup setup = rod_and_ball(speed);
    model::AssembledSystem system(setup.model);
    const State& at = setup.initial;
    system.move_to(at.t, at.q, at.v);
    std::vector<simulate::TouchingContact> touching(2);
    touching[0].contact = index_of(system, "ball"), touching[0].before = -speed, touching[0].restitution = 0.5;
    touching[1].contact = index_of(system, "tip"), touching[1].was_closed = touching[1].without_collision = true;
    touching[1].approach = -simulate::vanishing_approach * speed;
    Vec dv;
    simulate::EnergeticImpact impact;
    ASSERT_EQ(impact.solve(system, touching, dv).outcome, complementarity::LcpOutcome::solved);
    // The approach is a millionth of the slip; what it leaves behind is taken out to round-off.
    const double noise = 1e-12 * speed;
    EXPECT_NEAR(touching[0].after, 0.5 * speed, noise);
    EXPECT_NEAR(touching[0].impulse, 1.5 * speed, noise);
    EXPECT_NEAR(touching[1].after, 0, noise);
    EXPECT_NEAR(touching[1].slip_after.norm(), 0, noise);
    EXPECT_NEAR(touching[1].impulse, 0.3 * speed, noise);
    EXPECT_NEAR(touching[1].friction[0], 0.4 * speed, noise);
    system.move_to(at.t, at.q, at.v + dv);
    EXPECT_NEAR(system.gap_rate(touching[0].contact), 0.5 * speed, noise);
    EXPECT_NEAR(system.gap_rate(touching[1].contact), 0, noise);
    EXPECT_NEAR(system.slip(touching[1].contact).norm(), 0, noise);
  }
}

}  // namespace
}  // namespace trammel::test
