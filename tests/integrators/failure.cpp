// Every integrator in every form on systems that fail at the n-th evaluation, for every n: a step is accepted with
// finite numbers or rejected, and leaves no trace; what lies inside a step is a state, or not finite.
#include <cmath>

#include <trammel/methods/runge_kutta.hpp>

#include "support.hpp"
#include "testing/kit/integrators/problems.hpp"

namespace trammel::test {
namespace {

using kit::Failing;

bool finite(const State& s) {
  return s.q.allFinite() && s.v.allFinite() && s.a.allFinite() && s.lambda.allFinite();
}

class FailingSystem : public testing::TestWithParam<Form> {
 protected:
  static constexpr double h = 5e-3;

  // A restart and three steps, with every call of the interface after each step; the n-th evaluation fails. False:
  // there are fewer than n evaluations.
  bool run(Failing::How how, int n) {
    Posed sound(problems::pendulum_with_rod());
    Failing system(sound, how);
    auto method = make(GetParam().name, GetParam().settings);
    State now = sound.start(), next, inside;
    system.fail_at(n);
    method->restart(system, now);
    for (int i = 0; i < 3; ++i) {
      const State before = now;
      if (!method->step(system, now, h, next)) {
        EXPECT_TRUE(system.has_failed()) << n;
        EXPECT_TRUE(same_bits(before, now));
        // Where a motion could not begin none can go on; else the rejected trial has left nothing behind.
        const Outcome again = method->step(system, now, h, next);
        if (i == 0 && !again) return true;
        EXPECT_TRUE(again) << again.reason();
      }
      EXPECT_TRUE(finite(next)) << n;
      if (auto* estimate = dynamic_cast<ErrorEstimate*>(method.get())) estimate->error(system, now, next, {});
      if (auto* dense = dynamic_cast<DenseOutput*>(method.get()))
        for (const double theta : {0.3, 0.7}) {
          dense->interpolate(system, now, next, theta, inside);
          EXPECT_NEAR(inside.t, now.t + theta * h, 1e-15);
          const bool state = inside.q.allFinite() && inside.v.allFinite();
          EXPECT_TRUE(state || system.has_failed()) << n;
          if (state) {
            // Between two points of an arc of 0.1 rad/s to 10 rad/s, 5 ms apart.
            EXPECT_LE((inside.q - now.q).norm(), 1.5 * (next.q - now.q).norm() + 1e-3) << n;
          }
        }
      method->accept(system, now, next);
      std::swap(now, next);
    }
    return system.has_failed();
  }
};

TEST_P(FailingSystem, IsRejectedOrLeftOutAtAnyEvaluation) {
  for (const auto how : {Failing::How::beyond_range, Failing::How::not_a_number, Failing::How::singular}) {
    int n = 0;
    while (run(how, n) && n < 2000) ++n;
    EXPECT_LT(n, 2000);
    if (how != Failing::How::singular) {
      EXPECT_GE(n, 6);  // at least two evaluations in each step
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FailingSystem, testing::ValuesIn(all_forms()),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

// Numbers so large that a model cannot square them: nothing begins there, and a step says so.
TEST(RungeKuttaMethods, RejectEveryStepFromWhereNoMotionBegins) {
  for (const char* name : {"adams_baumgarte", "runge_kutta_4", "dormand_prince", "dop853"}) {
    Posed s(flight());
    auto method = make(name);
    State now = s.start(), next;
    now.v.setConstant(1e100);
    method->restart(s, now);
    const Outcome outcome = method->step(s, now, 1e-3, next);
    ASSERT_FALSE(outcome) << name;
    EXPECT_STREQ(outcome.reason(), RungeKutta::out_of_range) << name;
    // And forgets it with the next motion.
    now = s.start();
    method->restart(s, now);
    EXPECT_TRUE(method->step(s, now, 1e-3, next)) << name;
  }
}

}  // namespace
}  // namespace trammel::test
