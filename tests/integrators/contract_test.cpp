// What the Simulator relies on, for every integrator in every form.
#include <limits>

#include "support.hpp"
#include "systems.hpp"

namespace trammel::test {
namespace {

class EveryIntegrator : public testing::TestWithParam<Form> {
 protected:
  std::unique_ptr<Integrator> method() const { return make(GetParam().name, GetParam().settings); }
};

TEST_P(EveryIntegrator, LeavesNoTraceOfATrial) {
  Pendulum s, t;
  auto plain = method(), tried = method();
  State a = s.start(), b = a, next, other;
  plain->restart(s, a);
  tried->restart(t, b);
  for (int i = 0; i < 12; ++i) {
    for (const double h : {1e-3, 3e-4, 0.2, 1e-7}) static_cast<void>(tried->step(t, b, h, other));
    if (auto* estimate = dynamic_cast<ErrorEstimate*>(tried.get())) {
      ASSERT_TRUE(tried->step(t, b, 2e-3, other));
      estimate->error(t, b, other, {});
    }
    ASSERT_TRUE(plain->step(s, a, 5e-3, next));
    plain->accept(s, a, next);
    std::swap(a, next);
    ASSERT_TRUE(tried->step(t, b, 5e-3, other));
    tried->accept(t, b, other);
    std::swap(b, other);
    ASSERT_TRUE(same_bits(a, b)) << "step " << i;
  }
}

TEST_P(EveryIntegrator, TakesAnEarlierTrialAsTheSolution) {
  // The Simulator may look closer at a step and then accept it after all, at a time rounded otherwise.
  Pendulum s, t;
  auto plain = method(), looked = method();
  State a = s.start(), b = a, next, other, closer;
  plain->restart(s, a);
  looked->restart(t, b);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(plain->step(s, a, 5e-3, next));
    plain->accept(s, a, next);
    std::swap(a, next);
    ASSERT_TRUE(looked->step(t, b, 5e-3, other));
    ASSERT_TRUE(looked->step(t, b, 2e-3, closer));
    other.t = std::nextafter(other.t, 1e9);
    looked->accept(t, b, other);
    std::swap(b, other);
  }
  // HHT's p is then evaluated, not taken over: Newton's tolerance. The others repeat the same operations.
  EXPECT_LE((a.q - b.q).norm() + (a.v - b.v).norm(), 1e-12);
}

TEST_P(EveryIntegrator, LeavesNowUntouchedAndReadsNothingFromNext) {
  Pendulum s;
  auto m = method();
  const State now = s.start(), kept = now;
  State clean, dirty{std::nan(""), Vec::Constant(7, std::nan("")), Vec::Constant(1, std::nan("")), Vec(0),
                     Vec::Constant(3, std::nan(""))};
  m->restart(s, now);
  ASSERT_TRUE(m->step(s, now, 1e-2, clean));
  ASSERT_TRUE(m->step(s, now, 1e-2, dirty));
  EXPECT_TRUE(same_bits(now, kept));
  EXPECT_TRUE(same_bits(clean, dirty));
}

TEST_P(EveryIntegrator, ResumesFromItsArchiveBitForBit) {
  Pendulum s, t;
  auto m = method(), resumed = method();
  const State start = s.start();
  m->restart(s, start);
  const State middle = advance(*m, s, start, 5e-3, 9);
  MemoryArchive memory;
  m->archive(memory);
  const State end = advance(*m, s, middle, 5e-3, 9);

  memory.reading = true;
  resumed->archive(memory);
  const State again = advance(*resumed, t, middle, 5e-3, 9);
  EXPECT_TRUE(same_bits(end, again));
}

TEST_P(EveryIntegrator, KeepsItsAccuracyWhenRowsComeAndGo) {
  // The rod is taken off for a while (free flight, exactly known) and put back; against small steps of dop853.
  const auto flight = [](Integrator& m, double h) {
    Pendulum s;
    State now = s.start();
    m.restart(s, now);
    now = advance(m, s, now, h, int(std::lround(0.2 / h)));
    s.rod = false;
    now = s.at(now.t, now.q[0], now.q[1], now.v[0], now.v[1]);
    m.restart(s, now);
    const State off = now;
    now = advance(m, s, now, h, int(std::lround(0.1 / h)));
    // Back to where the rod came off, so that it fits.
    s.rod = true;
    now = s.at(now.t, off.q[0], off.q[1], off.v[0], off.v[1]);
    m.restart(s, now);
    return advance(m, s, now, h, int(std::lround(0.2 / h)));
  };
  auto reference = make("dop853", {{"delta", 0.0}, {"epsilon", 0.0}});
  auto m = method();
  const State end = flight(*m, 1e-3), exact = flight(*reference, 1e-3);
  const double h = m->traits().order > 1 ? 1e-3 : 30e-3;  // errors of order p: h^p with constants of the order 10
  EXPECT_LE((end.q - exact.q).norm(), 10 * h * h);
  EXPECT_LE((end.v - exact.v).norm(), 30 * h * h);
}

TEST_P(EveryIntegrator, StandsStillWithNothingToMove) {
  Nothing s;
  auto m = method();
  const State start{0, Vec(0), Vec(0), Vec(0), Vec(0)};
  const State end = run(*m, s, start, 1, 10);
  EXPECT_NEAR(end.t, 1, 1e-14);  // ten roundings
  EXPECT_EQ(end.q.size(), 0);
}

TEST_P(EveryIntegrator, EndsAnyStepInFiniteNumbersOrARejection) {
  Pendulum rod, spring;
  spring.rod = false, spring.stiff = 1e16;
  Oscillators fast({1e-8, 1, 1e8});
  const State starts[] = {rod.start(), spring.start(), fast.start()};
  System* systems[] = {&rod, &spring, &fast};
  for (int i = 0; i < 3; ++i)
    for (int e = -12; e <= 3; ++e) {
      auto m = method();
      State now = starts[i], next;
      m->restart(*systems[i], now);
      for (int step = 0; step < 5; ++step) {
        const Outcome outcome = m->step(*systems[i], now, std::pow(10, e), next);
        if (!outcome) {
          EXPECT_STRNE(outcome.reason(), "");
          break;
        }
        ASSERT_TRUE(next.q.allFinite() && next.v.allFinite() && next.a.allFinite() && next.lambda.allFinite())
            << "system " << i << ", h = 1e" << e;
        m->accept(*systems[i], now, next);
        std::swap(now, next);
      }
    }
}

TEST_P(EveryIntegrator, RejectsAForceThatIsNotANumber) {
  class Broken final : public DenseSystem {
   public:
    bool broken = false;
    Sizes sizes() const override { return {1, 1, 0}; }

   protected:
    Mat mass() const override { return Mat::Ones(1, 1); }
    Vec force(double, const Vec&, const Vec&) const override { return Vec::Constant(1, broken ? std::nan("") : 1.0); }
  } s;
  auto m = method();
  const State now{0, Vec::Zero(1), Vec::Zero(1), Vec::Ones(1), Vec(0)};
  State next;
  m->restart(s, now);
  s.broken = true;
  EXPECT_FALSE(m->step(s, now, 1e-3, next));
}

TEST_P(EveryIntegrator, ReturnsTheSameInMillimetres) {
  // 2^10 units to the metre: powers of two change no rounding, so only thresholds could tell.
  class Falling final : public DenseSystem {
   public:
    explicit Falling(double unit) : unit_(unit) {}
    Sizes sizes() const override { return {1, 1, 0}; }
    double unit_;

   protected:
    Mat mass() const override { return Mat::Ones(1, 1); }
    Vec force(double, const Vec& q, const Vec&) const override {
      return Vec::Constant(1, -9.81 * unit_ * std::sin(q[0] / unit_));
    }
    Mat tangent(double, double c_k, const Vec&, const Vec&) const override { return Mat::Constant(1, 1, c_k * 9.81); }
  };
  const auto end = [&](double unit) {
    Falling s(unit);
    State now{0, Vec::Constant(1, unit), Vec::Zero(1), {}, {}};
    s.move_to(0, now.q, now.v);
    s.accelerate({}, now.a, now.lambda);
    auto m = method();
    return run(*m, s, now, 1, 100).q[0] / unit;
  };
  EXPECT_EQ(end(1), end(1024));
}

INSTANTIATE_TEST_SUITE_P(All, EveryIntegrator, testing::ValuesIn(all_forms()),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

class NewmarkFamily : public testing::TestWithParam<Form> {};

TEST_P(NewmarkFamily, NeedsThreeResidualsAndOneFactorisationAStepOnTheFreePendulum) {
  Pendulum s;
  s.rod = false, s.stiff = 1e3;
  auto method = make(GetParam().name, GetParam().settings);
  const State start = s.start();
  method->restart(s, start);
  s.evaluations = s.factorisations = 0;
  advance(*method, s, start, 1e-3, 1000);
  EXPECT_EQ(s.factorisations, 1000);
  // Each residual asks for f, and for its size when it judges the round-off.
  EXPECT_LE(s.evaluations, 2 * 3000 + 2000);
}

TEST_P(NewmarkFamily, DampsOrKeepsAModeOfAnySpeed) {
  for (int e = -3; e <= 8; ++e) {
    Oscillators s({std::pow(10, e)});
    auto method = make(GetParam().name, GetParam().settings);
    const State start = s.start();
    const State end = run(*method, s, start, 100, 100);  // h = 1
    // Energy norm of an unconditionally stable method: no growth, but for a transient of the method's own acceleration.
    EXPECT_LE(std::abs(end.q[0]), 3) << "omega h = 1e" << e;
  }
}

INSTANTIATE_TEST_SUITE_P(All, NewmarkFamily,
                         testing::Values(Form{"hht_alpha", {{"alpha", 0.0}}}, Form{"hht_alpha", {{"alpha", -0.15}}},
                                         Form{"hht_alpha", {{"alpha", -1.0 / 3}}}, Form{"newmark", {}},
                                         Form{"generalized_alpha", {{"rho_inf", 0.9}}},
                                         Form{"generalized_alpha", {{"rho_inf", 0.0}}}),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

TEST(AdamsBaumgarte, StartsAnewWhenTheStepChanges) {
  Oscillators s({3});
  auto method = make("adams_baumgarte");
  auto runge = make("runge_kutta_4");
  State now = run(*method, s, s.start(), 0.1, 10), by_adams, by_runge;
  ASSERT_TRUE(method->step(s, now, 0.004, by_adams));
  runge->restart(s, now);
  ASSERT_TRUE(runge->step(s, now, 0.004, by_runge));
  EXPECT_LE((by_adams.q - by_runge.q).norm(), 1e-16);  // the same formula; slopes differ by round-off at most
}

}  // namespace
}  // namespace trammel::test
