// SUNDIALS' IDA as an integrator, where it is built.
#include <filesystem>
#include <fstream>

#include <trammel/testing/archive.hpp>
#include <trammel/testing/suites.hpp>

#include "support.hpp"

namespace trammel::test {
namespace {

bool is_built() {
  return std::filesystem::exists(TRAMMEL_BUILD_DIR "/lib/trammel/sundials_ida.so");
}

std::unique_ptr<Integrator> ida(double tolerance = 1e-6) {
  return make("sundials_ida", {{"rtol", tolerance}, {"atol", tolerance / 100}});
}

// The checks that any author's method passes. Its energy drifts with the tolerance, about 1e-5 in a second.
const bool registered = is_built() && register_integrator_suite("SundialsIdaChecks", [] { return ida(); },
                                                                {.order = 0, .steps = 64, .energy = 1e-4});

class SundialsIda : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_built()) GTEST_SKIP() << "SUNDIALS is not installed";
  }
};

double error_of_pendulum(double tolerance, int n = 50) {
  const Problem problem = problems::pendulum_with_rod();
  Posed s(problem);
  auto method = ida(tolerance);
  const State end = integrate(*method, s, s.start(), 1, n), exact = s.exact(1);
  return (end.q - exact.q).norm() + (end.v - exact.v).norm();
}

TEST_F(SundialsIda, FollowsItsToleranceNotTheStep) {
  // Local errors of 1e-8 add up over some hundred internal steps, those of 1e-4 over some ten.
  EXPECT_LE(error_of_pendulum(1e-4), 1e-2);
  EXPECT_LE(error_of_pendulum(1e-6), 1e-4);
  EXPECT_LE(error_of_pendulum(1e-8), 1e-5);
  EXPECT_LE(error_of_pendulum(1e-8), error_of_pendulum(1e-4) / 100);
  EXPECT_NEAR(error_of_pendulum(1e-6, 7), error_of_pendulum(1e-6, 900),
              1e-9);  // the same solution, looked at elsewhere
}

TEST_F(SundialsIda, HoldsRowsToRoundOffThoughTheyRepeat) {
  for (const std::vector<double>& weights : {std::vector<double>{1}, {1, 2, 1}}) {
    Posed s(problems::pendulum_with_rod(1, 0.4, weights));
    auto method = ida(1e-4);
    integrate(*method, s, s.start(), 5, 100, [&](const State& now) {
      s->move_to(now.t, now.q, now.v);
      EXPECT_LE(s->g().lpNorm<Eigen::Infinity>(), 4e-15);  // roundings of a row of weight 2
      EXPECT_LE(s->g_dot().lpNorm<Eigen::Infinity>(), 2e-14);
    });
  }
}

TEST_F(SundialsIda, KeepsMultipliersOfRepeatedRowsBoundedOverThousandsOfSteps) {
  const Problem problem = problems::pendulum_with_rod(1, 0.4, {1, 2, 1});
  Posed s(problem);
  auto method = ida(1e-9);
  const State start = s.start(), end = integrate(*method, s, start, 20, 200);
  EXPECT_LE(end.lambda.norm(), 30);  // m (g + omega^2 L), shared
  EXPECT_NEAR(problem.energy.value(end), problem.energy.value(start), 1e-5 * problem.energy.scale);
}

TEST_F(SundialsIda, TurnsUnitQuaternions) {
  const Problem top = problems::heavy_top();
  Posed s(top);
  auto method = ida(1e-8);
  const State start = s.start();
  const State end = integrate(*method, s, start, 1, 20);
  EXPECT_NEAR(end.q.norm(), 1, 1e-15);
  auto fine = make("dop853", {});
  const State exact = integrate(*fine, s, start, 1, 2000);
  EXPECT_LE((end.q - exact.q).norm(), 1e-5);  // some hundred turns of tolerance 1e-8
}

TEST_F(SundialsIda, SlidesWhereFrictionTiltsTheReactions) {
  Posed s(sliding(0.5, 0));
  const State start = s.start();
  auto method = ida();
  State next;
  method->restart(s, start);
  ASSERT_TRUE(method->step(s, start, 1e-2, next));
  EXPECT_LE(std::abs(next.q[1]), 1e-15);
  EXPECT_NEAR(next.q[0], 1e-2, 1e-15);  // nothing presses it, so nothing slows it
}

TEST_F(SundialsIda, GoesOverFastMotionsThatNothingExcites) {
  // 1e8 N/m in a pendulum of 1 kg: 1e4 rad/s beside 3 rad/s; an explicit method needs 3000 steps a second.
  Posed s(problems::stiff_pendulum(1e8));
  auto method = make("sundials_ida", {{"rtol", 1e-5}, {"atol", 1e-7}, {"max_order", 2}});
  const State end = integrate(*method, s, s.start(), 1, 10);
  EXPECT_NEAR(end.q.norm(), 1, 1e-4);
}

TEST_F(SundialsIda, ResumesBitForBitBeyondARestartOfItsOwn) {
  // With tolerances near round-off it takes thousands of internal steps a second.
  const auto fresh = [] { return make("sundials_ida", {{"rtol", 1e-12}, {"atol", 1e-13}}); };
  Posed s(problems::pendulum_with_rod()), t(problems::pendulum_with_rod());
  auto method = fresh(), resumed = fresh();
  const State start = s.start();
  method->restart(s, start);
  const State middle = advance(*method, s, start, 0.1, 40);
  MemoryArchive memory;
  method->archive(memory);
  const State end = advance(*method, s, middle, 0.1, 3);
  memory.reading = true;
  resumed->archive(memory);
  EXPECT_TRUE(same_bits(end, advance(*resumed, t, middle, 0.1, 3)));
}

TEST_F(SundialsIda, BeginsAnewWhereAStateWasCorrected) {
  Posed s(problems::pendulum_with_rod());
  auto method = ida(1e-8);
  State now = s.start(), next;
  method->restart(s, now);
  ASSERT_TRUE(method->step(s, now, 0.1, next));
  next.v *= 0.5;  // as a correction would; the rows stay satisfied
  s->move_to(next.t, next.q, next.v);
  s->accelerate({}, next.a, next.lambda);
  method->accept(s, now, next);
  auto other = ida(1e-8);
  other->restart(s, next);
  State after, expected;
  ASSERT_TRUE(method->step(s, next, 0.1, after));
  ASSERT_TRUE(other->step(s, next, 0.1, expected));
  EXPECT_TRUE(same_bits(after, expected));
}

TEST_F(SundialsIda, KeepsItsAccuracyWhenRowsComeAndGo) {
  const auto flown = [](Integrator& m, int n) {
    Posed rod(problems::pendulum_with_rod()), off(flight());
    State now = integrate(m, rod, rod.start(), 0.2, n);
    const Vec q = now.q, v = now.v;
    now = integrate(m, off, off.at(now.t, q, v), now.t + 0.1, n);
    return integrate(m, rod, rod.at(now.t, q, v), now.t + 0.2, n);
  };
  auto method = ida(1e-8);
  auto reference = make("dop853", {{"delta", 0.0}, {"epsilon", 0.0}});
  const State end = flown(*method, 10), exact = flown(*reference, 200);
  EXPECT_LE((end.q - exact.q).norm() + (end.v - exact.v).norm(), 1e-5);
}

TEST_F(SundialsIda, StandsStillWithNothingToMove) {
  Posed s(nothing());
  auto method = ida();
  const State end = integrate(*method, s, {0, Vec(0), Vec(0), Vec(0), Vec(0)}, 1, 10);
  EXPECT_NEAR(end.t, 1, 1e-14);
}

TEST_F(SundialsIda, RejectsAForceThatIsNotANumberAndKeepsWhatItHad) {
  bool broken = false;
  Posed s(
      particle([&](double, const Vec&, const Vec&) -> Vec { return Vec::Constant(1, broken ? std::nan("") : 1.0); }));
  auto method = ida();
  const State now = s.start();
  State next;
  method->restart(s, now);
  broken = true;
  const Outcome outcome = method->step(s, now, 1e-3, next);
  EXPECT_FALSE(outcome);
  EXPECT_NE(std::string(outcome.reason()).find("IDA"), std::string::npos);
}

TEST_F(SundialsIda, PassesOnWhatASystemThrows) {
  bool broken = false;
  Posed s(particle([&](double, const Vec&, const Vec&) -> Vec {
    if (broken) throw std::runtime_error("broken");
    return Vec::Ones(1);
  }));
  auto method = ida();
  const State now = s.start();
  State next;
  method->restart(s, now);
  broken = true;
  EXPECT_THROW(static_cast<void>(method->step(s, now, 1e-3, next)), std::runtime_error);
}

TEST_F(SundialsIda, InterpolatesBetweenItsInternalSteps) {
  Posed s(oscillators({1, 2}, 0.1));
  auto method = ida(1e-8);
  auto& dense = dynamic_cast<DenseOutput&>(*method);
  State now = s.start(), next, at;
  method->restart(s, now);
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(method->step(s, now, 0.5, next));
    method->accept(s, now, next);
    for (const double theta : {0.0, 0.2, 0.5, 0.7, 1.0}) {
      dense.interpolate(s, now, next, theta, at);
      const State exact = s.exact(at.t);
      EXPECT_LE((at.q - exact.q).norm() + (at.v - exact.v).norm(), 1e-5);
    }
    std::swap(now, next);
  }
}

}  // namespace
}  // namespace trammel::test
