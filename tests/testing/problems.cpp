// Each closed form satisfies its problem's equations: dop853, of order 8, arrives where the closed form is.
#include <gtest/gtest.h>

#include <trammel/testing/measurements.hpp>

namespace trammel {
namespace {

std::vector<Problem> all() {
  using namespace problems;
  return {oscillator(),
          oscillator(2, 0.3),
          first_order(),
          forced_oscillator(),
          pendulum(),
          pendulum(2.5, 0),
          pendulum_with_rod(),
          pendulum_with_rod(1, 0.4, {1, 2}),
          bead_on_turning_wire(),
          dumbbell()};
}
Maker dop853() {
  return from_plugin(TRAMMEL_BUILD_DIR "/lib/trammel", "dop853", {{"delta", 0.0}, {"epsilon", 0.0}});
}

class ClosedForm : public testing::TestWithParam<int> {};

TEST_P(ClosedForm, SolvesItsEquations) {
  const Problem p = all()[std::size_t(GetParam())];
  const auto method = dop853()();
  const auto system = p.system();
  const State found = integrate(*method, *system, p.solution(0), p.until, 200), exact = p.solution(p.until);
  // Errors h^8 ~ 1e-15 to 1e-18 and 200 steps of round-off, which the light end of the dumbbell sees undiminished.
  EXPECT_LT((found.q - exact.q).norm(), 1e-11) << p.name;
  EXPECT_LT((found.v - exact.v).norm(), 1e-11) << p.name;
}

TEST_P(ClosedForm, HoldsItsRowsAndEnergy) {
  const Problem p = all()[std::size_t(GetParam())];
  const auto system = p.system();
  const State start = p.solution(0);
  for (const double t : {0.0, 0.3, 0.7, 1.0}) {
    const State s = p.solution(t);
    system->move_to(t, s.q, s.v);
    EXPECT_LT(system->g().norm() + system->g_dot().norm(), 1e-13) << p.name;  // round-off of numbers about 5
    if (p.energy.value) {
      EXPECT_NEAR(p.energy.value(s), p.energy.value(start), 1e-13 * p.energy.scale) << p.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Problems, ClosedForm, testing::Range(0, int(all().size())));

TEST(StiffPendulum, ConservesItsEnergyAlongAnAccurateSolution) {
  // omega h = 100/2000: h^8 errors are below round-off of the spring's energy.
  EXPECT_LT(energy_drift(dop853(), problems::stiff_pendulum(), 2000), 1e-11);
}

TEST(PendulumWithRod, SharesTheForceOfRepeatedRowsByMinimumNorm) {
  const State one = problems::pendulum_with_rod().solution(0.5);
  const State two = problems::pendulum_with_rod(1, 0.4, {1, 2}).solution(0.5);
  EXPECT_NEAR(two.lambda[0], one.lambda[0] / 5, 1e-12);  // lambda (1, 2)/(1 + 4)
  EXPECT_NEAR(two.lambda[1], one.lambda[0] * 2 / 5, 1e-12);
}

}  // namespace
}  // namespace trammel
