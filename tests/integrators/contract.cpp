// What the Simulator relies on, for every integrator in every form.
#include <limits>

#include <trammel/testing/archive.hpp>

#include "support.hpp"

namespace trammel::test {
namespace {

class EveryIntegrator : public testing::TestWithParam<Form> {
 protected:
  std::unique_ptr<Integrator> method() const { return make(GetParam().name, GetParam().settings); }
};

TEST_P(EveryIntegrator, LeavesNoTraceOfATrial) {
  Posed s(problems::pendulum_with_rod()), t(problems::pendulum_with_rod());
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
  Posed s(problems::pendulum_with_rod()), t(problems::pendulum_with_rod());
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
  Posed s(problems::pendulum_with_rod());
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
  Posed s(problems::pendulum_with_rod()), t(problems::pendulum_with_rod());
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

TEST_P(EveryIntegrator, RestartsLikeAFreshOne) {
  Posed s(problems::pendulum_with_rod()), t(problems::pendulum_with_rod());
  auto used = method(), fresh = method();
  const State start = s.start();
  used->restart(s, start);
  advance(*used, s, start, 4e-3, 7);
  used->restart(s, start), fresh->restart(t, start);
  State now = start, next, of_fresh;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(used->step(s, now, 5e-3, next));
    ASSERT_TRUE(fresh->step(t, now, 5e-3, of_fresh));
    EXPECT_TRUE(same_bits(next, of_fresh)) << i;
    if (auto* estimate = dynamic_cast<ErrorEstimate*>(used.get())) {
      auto& of_other = dynamic_cast<ErrorEstimate&>(*fresh);
      EXPECT_EQ(estimate->error(s, now, next, {}), of_other.error(t, now, of_fresh, {})) << i;
    }
    used->accept(s, now, next), fresh->accept(t, now, of_fresh);
    now = next;
  }
}

TEST_P(EveryIntegrator, KeepsItsAccuracyWhenRowsComeAndGo) {
  // The rod is taken off for a while (free flight, exactly known) and put back; against small steps of dop853.
  const auto flown = [](Integrator& m, double h) {
    Posed rod(problems::pendulum_with_rod()), off(flight());
    State now = integrate(m, rod, rod.start(), 0.2, int(std::lround(0.2 / h)));
    const Vec q = now.q, v = now.v;
    now = integrate(m, off, off.at(now.t, q, v), now.t + 0.1, int(std::lround(0.1 / h)));
    // Back to where the rod came off, so that it fits.
    return integrate(m, rod, rod.at(now.t, q, v), now.t + 0.2, int(std::lround(0.2 / h)));
  };
  auto reference = make("dop853", {{"delta", 0.0}, {"epsilon", 0.0}});
  auto m = method();
  const State end = flown(*m, 1e-3), exact = flown(*reference, 1e-3);
  const double h = m->traits().order > 1 ? 1e-3 : 30e-3;  // errors of order p: h^p with constants of the order 10
  EXPECT_LE((end.q - exact.q).norm(), 10 * h * h);
  EXPECT_LE((end.v - exact.v).norm(), 30 * h * h);
}

TEST_P(EveryIntegrator, EvaluatesAndReturnsUnitQuaternionsOnly) {
  double off = 0;
  const auto look = [&](const Vec& q) { off = std::max(off, std::abs(q.norm() - 1)); };
  Problem top = problems::heavy_top();
  top.force = [&, force = top.force](double t, const Vec& q, const Vec& v) { return look(q), force(t, q, v); };
  Posed s(top);
  auto m = method();
  integrate(*m, s, s.start(), 0.02, 4, [&](const State& now) { look(now.q); });
  EXPECT_LE(off, 1e-14);  // a step turns the top by 0.1, which leaves the sphere by 1e-3 where nothing is done about it
}

TEST_P(EveryIntegrator, StandsStillWithNothingToMove) {
  Posed s(nothing());
  auto m = method();
  const State start{0, Vec(0), Vec(0), Vec(0), Vec(0)};
  const State end = integrate(*m, s, start, 1, 10);
  EXPECT_NEAR(end.t, 1, 1e-14);  // ten roundings
  EXPECT_EQ(end.q.size(), 0);
}

TEST_P(EveryIntegrator, EndsAnyStepInFiniteNumbersOrARejection) {
  Posed systems[] = {Posed(problems::pendulum_with_rod()), Posed(problems::stiff_pendulum(1e16)),
                     Posed(oscillators({1e-8, 1, 1e8}))};
  for (int i = 0; i < 3; ++i)
    for (int e = -12; e <= 3; ++e) {
      auto m = method();
      State now = systems[i].start(), next;
      m->restart(systems[i], now);
      for (int step = 0; step < 5; ++step) {
        const Outcome outcome = m->step(systems[i], now, std::pow(10, e), next);
        if (!outcome) {
          EXPECT_STRNE(outcome.reason(), "");
          break;
        }
        ASSERT_TRUE(next.q.allFinite() && next.v.allFinite() && next.a.allFinite() && next.lambda.allFinite())
            << "system " << i << ", h = 1e" << e;
        m->accept(systems[i], now, next);
        std::swap(now, next);
      }
    }
}

TEST_P(EveryIntegrator, RejectsAForceThatIsNotANumber) {
  bool broken = false;
  Posed s(
      particle([&](double, const Vec&, const Vec&) -> Vec { return Vec::Constant(1, broken ? std::nan("") : 1.0); }));
  auto m = method();
  const State now = s.start();
  State next;
  m->restart(s, now);
  broken = true;
  EXPECT_FALSE(m->step(s, now, 1e-3, next));
}

TEST_P(EveryIntegrator, ReturnsTheSameInMillimetres) {
  // 2^10 units to the metre: powers of two change no rounding, so only thresholds could make a difference.
  const auto end = [&](double unit) {
    Problem falling = particle(
        [unit](double, const Vec& q, const Vec&) -> Vec { return -9.81 * unit * (q / unit).array().sin(); }, unit);
    falling.tangent = [](const Blend& c, const Vec&, const Vec&) -> Mat { return Mat::Constant(1, 1, c.c_k * 9.81); };
    Posed s(falling);
    auto m = method();
    return integrate(*m, s, s.start(), 1, 100).q[0] / unit;
  };
  EXPECT_EQ(end(1), end(1024));
}

INSTANTIATE_TEST_SUITE_P(All, EveryIntegrator, testing::ValuesIn(all_forms()),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

class NewmarkFamily : public testing::TestWithParam<Form> {};

TEST_P(NewmarkFamily, NeedsThreeResidualsAndOneFactorisationAStepOnNonlinearOscillators) {
  int evaluations = 0, factorisations = 0;
  Problem counted = oscillators({1, 30});
  counted.force = [&, force = counted.force](double t, const Vec& q, const Vec& v) {
    ++evaluations;
    return Vec(force(t, q, v) - 0.1 * q * q.squaredNorm());  // not linear: the matrix is not exact
  };
  counted.tangent = [&, tangent = counted.tangent](const Blend& c, const Vec& q, const Vec& v) {
    ++factorisations;
    return tangent(c, q, v);
  };
  Posed s(counted);
  auto method = make(GetParam().name, GetParam().settings);
  const State start = s.start();
  method->restart(s, start);
  evaluations = factorisations = 0;
  advance(*method, s, start, 1e-3, 1000);
  EXPECT_EQ(factorisations, 1000);
  // Each residual asks for f, and for its size when it judges the round-off.
  EXPECT_LE(evaluations, 2 * 3000 + 2000);
}

// f = 1 + t: the line through the last two accelerations is exact, whatever the sizes of the steps.
TEST_P(NewmarkFamily, NeedsOneResidualWhereAccelerationsChangeLinearly) {
  int evaluations = 0;
  Posed s(particle([&](double t, const Vec&, const Vec&) { return ++evaluations, Vec::Constant(1, 1 + t); }));
  auto method = make(GetParam().name, GetParam().settings);
  State now = s.start(), next;
  method->restart(s, now);
  now = advance(*method, s, now, 0.1, 1);
  for (const double h : {0.05, 0.15, 0.1, 0.1, 0.02}) {
    evaluations = 0;
    now = advance(*method, s, now, h, 1);
    // The numerical tangent asks four times: at two places and two velocities.
    EXPECT_EQ(evaluations, 1 + 4) << h;
  }
}

// Its matrix includes the damping, of which 5 times as much as of the mass acts in this step, however long it is.
TEST_P(NewmarkFamily, SolvesLinearEquationsByOneIncrement) {
  for (const double h : {1.0, 0.25}) {
    int evaluations = 0;
    Problem counted = oscillators({2 / h}, 5 / h);
    counted.force = [&, force = counted.force](double t, const Vec& q, const Vec& v) {
      return ++evaluations, force(t, q, v);
    };
    Posed s(counted);
    auto method = make(GetParam().name, GetParam().settings);
    const State start = s.start();
    method->restart(s, start);
    evaluations = 0;
    advance(*method, s, start, h, 1);
    // The residual of a_n, which leads astray, the one to be solved for, and the one that finds nothing left; the size
    // of forces, beside which that is nothing.
    EXPECT_EQ(evaluations, 4) << h;
  }
}

// At rest any acceleration leads further than the velocity does; of a slow motion it is the best guess all the same.
TEST_P(NewmarkFamily, NeedsAsFewResidualsFromRestAsInMotion) {
  const auto residuals = [](double v) {
    int evaluations = 0;
    Posed s(particle(
        [&](double, const Vec& q, const Vec&) {
          ++evaluations;
          return Vec(-10 * q.array().sin());
        },
        1));
    auto method = make(GetParam().name, GetParam().settings);
    const State start = s.at(0, Vec::Ones(1), Vec::Constant(1, v));
    method->restart(s, start);
    evaluations = 0;
    advance(*method, s, start, 1e-2, 1);
    return evaluations;
  };
  EXPECT_LE(residuals(0), residuals(1));
}

TEST_P(NewmarkFamily, DampsOrKeepsAModeOfAnySpeed) {
  for (int e = -3; e <= 8; ++e) {
    Posed s(oscillators({std::pow(10, e)}));
    auto method = make(GetParam().name, GetParam().settings);
    const State start = s.start();
    const State end = integrate(*method, s, start, 100, 100);  // h = 1
    // Energy norm of an unconditionally stable method: no growth, except a transient of the method's own acceleration.
    EXPECT_LE(std::abs(end.q[0]), 3) << "omega h = 1e" << e;
  }
}

// q'' = -1000 sin q over a step in which the spring softens: one iteration is not enough, and the equation of motion at
// the step's end is left with a residual of the tolerance times its stiffness.
TEST_P(NewmarkFamily, IteratesAsFarAsItsSettingsSay) {
  const auto residual = [](const Settings& more) {
    Posed s(particle([](double, const Vec& q, const Vec&) { return Vec(-1000 * q.array().sin()); }, 1));
    Settings settings = GetParam().settings;
    settings.insert(settings.end(), more.begin(), more.end());
    auto method = make(GetParam().name, settings);
    const State start = s.start();
    State next;
    method->restart(s, start);
    if (!method->step(s, start, 0.03, next)) return std::numeric_limits<double>::infinity();
    return std::abs(next.a[0] + 1000 * std::sin(next.q[0]));
  };
  EXPECT_LE(residual({}), 1e-7);
  EXPECT_LE(residual({{"tolerance", 1e-13}}), 1e-9);
  EXPECT_GE(residual({{"tolerance", 1e-2}}), 1e-6);
  EXPECT_TRUE(std::isinf(residual({{"max_iterations", 1}})));
}

INSTANTIATE_TEST_SUITE_P(All, NewmarkFamily,
                         testing::Values(Form{"hht_alpha", {{"alpha", 0.0}}}, Form{"hht_alpha", {{"alpha", -0.15}}},
                                         Form{"hht_alpha", {{"alpha", -1.0 / 3}}}, Form{"newmark", {}},
                                         Form{"generalized_alpha", {{"rho_inf", 0.9}}},
                                         Form{"generalized_alpha", {{"rho_inf", 0.0}}}),
                         [](const testing::TestParamInfo<Form>& tested) {
                           return tested.param.name + "_" + std::to_string(tested.index);
                         });

// The same steps as with the documented defaults.
TEST(NewmarkFamilies, HaveTheirDefaults) {
  const auto steps = [](const std::string& name, const Settings& settings) {
    Posed s(oscillators({1, 30}));
    auto method = make(name, settings);
    const State start = s.start();
    method->restart(s, start);
    return advance(*method, s, start, 0.05, 5);
  };
  EXPECT_TRUE(same_bits(steps("newmark", {}), steps("newmark", {{"beta", 0.25}, {"gamma", 0.5}})));
  EXPECT_TRUE(same_bits(steps("hht_alpha", {}), steps("hht_alpha", {{"alpha", -0.1}})));
  EXPECT_TRUE(same_bits(steps("generalized_alpha", {}), steps("generalized_alpha", {{"rho_inf", 0.9}})));
}

TEST(AdamsBaumgarte, StartsAnewWhenTheStepChanges) {
  Posed s(oscillators({3}));
  auto method = make("adams_baumgarte");
  auto runge = make("runge_kutta_4");
  State now = integrate(*method, s, s.start(), 0.1, 10), by_adams, by_runge;
  ASSERT_TRUE(method->step(s, now, 0.004, by_adams));
  runge->restart(s, now);
  ASSERT_TRUE(runge->step(s, now, 0.004, by_runge));
  EXPECT_LE((by_adams.q - by_runge.q).norm(), 1e-16);  // the same formula; slopes differ by round-off at most
}

}  // namespace
}  // namespace trammel::test
