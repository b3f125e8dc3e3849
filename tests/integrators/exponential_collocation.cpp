// What exponential collocation is for: steps of many radians of oscillations that only ring.
#include <cmath>

#include "../../plugins/integrators/exponential_collocation/oscillator_moments.hpp"
#include "support.hpp"

namespace trammel::test {
namespace {

constexpr const char* name = "exponential_collocation";

// A soft degree of freedom x beside a stiff one y (m = 1): v' = -dU/dq, U = (x - y)^4/4 + (x + y)^4/8 + omega^2 y^2/2.
Problem soft_and_stiff(double omega) {
  Problem p;
  p.name = "soft_and_stiff";
  p.M = Mat::Identity(2, 2);
  p.force = [omega](double, const Vec& q, const Vec&) {
    const double less = std::pow(q[0] - q[1], 3), more = 0.5 * std::pow(q[0] + q[1], 3);
    return Vec{{-less - more, less - more - omega * omega * q[1]}};
  };
  p.exact = [omega](double, Vec& q, Vec& v) { q = Vec{{1, 0.5 / (omega * omega)}}, v = Vec{{0, 1e-5}}; };
  p.closed_form = false;
  return p;
}

TEST(OscillatorMoments, AreTheIntegralsTheyNameAtAnyFrequency) {
  for (const double z : {0.0, 1e-6, 0.3, 1.999, 2.001, 7.0, 300.0}) {
    const auto moments = oscillator_moments<7>(z);
    for (int k = 0; k < 7; ++k) {
      double c = 0, s = 0;
      constexpr int panels = 4000;  // of Simpson's rule: (z/n)^4 = 3e-5 of a swing at 300, and that over 180
      for (int i = 0; i <= 2 * panels; ++i) {
        const double u = i / (2.0 * panels), w = (i % 2 ? 4 : i % (2 * panels) ? 2 : 1) / (6.0 * panels);
        c += w * std::cos(z * (1 - u)) * std::pow(u, k);
        s += w * (z > 0 ? std::sin(z * (1 - u)) / z : 1 - u) * std::pow(u, k);
      }
      EXPECT_NEAR(moments.c[std::size_t(k)], c, 1e-8) << z << " " << k;
      EXPECT_NEAR(moments.s[std::size_t(k)], s, 1e-8) << z << " " << k;
    }
  }
}

TEST(ExponentialCollocation, FollowsOscillatorsAtAnyStep) {
  Posed s(oscillators({1, 30, 1e3}));
  const State start = s.start();
  auto method = make(name);
  const State end = integrate(*method, s, start, 20, 10);  // 2000 radians a step
  // omega^2 comes from differences over 2^-24 and has their round-off, 2^-29: a phase of half of it in 2e4 radians.
  EXPECT_LE((end.q - s.exact(20).q).norm(), 0.5 * 0x1p-29 * 2e4);
}

// Of the contract's tests its order is at least: seven points, three sweeps.
TEST(ExponentialCollocation, IsOfTenthOrderWithThreeSweeps) {
  for (const char* rows : {"baumgarte", "projected"}) {
    Posed s(problems::pendulum_with_rod());
    const State start = s.start();
    auto fine = make("dop853", {{"delta", 0.0}, {"epsilon", 0.0}});
    const State end = integrate(*fine, s, start, 2, 400);
    const Order f = fit_order(7, 3, [&](int n) {
      auto method = make(name, {{"delta", 1.0}, {"epsilon", 1.0}, {"rows", std::string(rows)}});
      const State x = integrate(*method, s, start, 2, n);
      return (x.q - end.q).norm() + (x.v - end.v).norm() + (x.lambda - end.lambda).norm();
    });
    EXPECT_GE(f.value, 9.4) << rows << "\n" << f.table;  // slopes vary by half an order between 1e-7 and round-off
  }
}

TEST(ExponentialCollocation, TakesStepsOfManyRadiansWhereTheStiffOnlyRings) {
  constexpr double omega = 2000;
  Posed s(soft_and_stiff(omega));
  const State start = s.start();
  auto fine = make("dop853");
  const State end = integrate(*fine, s, start, 2, 8000);  // half a radian a step: 1e-12
  const auto error = [&](int n) {
    auto method = make(name, {{"sweeps", 2}});
    const State x = integrate(*method, s, start, 2, n);
    return std::abs(x.q[0] - end.q[0]) + std::abs(x.v[0] - end.v[0]) + std::abs(x.v[1] - end.v[1]);
  };
  // 100 radians a step: the ringing is not resolved where it enters the soft force, by 3 N/m of its amplitude of 5e-9
  // m.
  EXPECT_LE(error(40), 3 * 5e-9 * 2);
}

// Steps of 10 radians, in each of which the direction of the fast mode turns by a few thousandths: about the modes of
// the start alone sweeps would not converge once it has turned by some tenths.
TEST(ExponentialCollocation, LinearisesAgainWhereModesTurn) {
  const Problem p = problems::stiff_pendulum(1e8);
  Posed s(p);
  auto method = make(name);
  const State start = s.start();
  const double before = p.energy.value(start);
  const State end = integrate(*method, s, start, 2, 2000);
  EXPECT_NEAR(p.energy.value(end), before, 1e-9 * std::abs(before) + 1e-9);
}

TEST(ExponentialCollocation, GoesOnWhereNothingSwings) {
  Posed s(oscillators({0}));
  auto method = make(name);
  State start = s.start();
  start.v.setOnes();
  const State end = integrate(*method, s, start, 3, 2);
  EXPECT_NEAR(end.q[0], start.q[0] + 3, 1e-14);
}

TEST(ExponentialCollocation, RefusesSystemsWhoseEigenproblemWouldTakeTooLongAndNamesOthers) {
  Posed s(oscillators(std::vector<double>(1001, 1.0)));
  auto method = make(name);
  try {
    method->restart(s, State());
    FAIL() << "accepted";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("dop853"), std::string::npos);
  }
}

TEST(ExponentialCollocation, RefusesStepsWhoseSweepsDoNotConverge) {
  Posed s(oscillators({1, 2}, 200));
  auto method = make(name, {{"sweeps", 1}});
  const State start = s.start();
  method->restart(s, start);
  State next;
  EXPECT_FALSE(method->step(s, start, 0.1, next));  // decay rates times h: 40
}

// Where errors would grow from step to step (2 mu h = 0.5 for one sweep), and not after they have.
TEST(ExponentialCollocation, RefusesStepsThatWouldBeUnstable) {
  Posed s(oscillators({100}, 25));
  const State start = s.start();
  const auto run = [&](int sweeps) {
    auto method = make(name, {{"sweeps", sweeps}});
    return integrate(*method, s, start, 3, 300);
  };
  EXPECT_THROW(run(1), std::runtime_error);
  EXPECT_LE((run(3).q - s.exact(3).q).norm(), 1e-9);
}

// To `until` with errors below `tolerance` each.
State controlled(Integrator& method, Posed& s, double until, double tolerance) {
  auto& estimate = dynamic_cast<ErrorEstimate&>(method);
  State now = s.start(), next;
  method.restart(s, now);
  for (double h = until / 100; now.t < until;) {
    h = std::min(h, until - now.t);
    const bool taken(method.step(s, now, h, next));
    const double e = taken ? estimate.error(s, now, next, {.relative = 0, .absolute = tolerance}) : 100;
    h *= std::clamp(0.9 * std::pow(e, -1.0 / estimate.error_order()), 0.2, 1.5);
    if (e > 1) continue;
    method.accept(s, now, next);
    std::swap(now, next);
    if (until - now.t < 1e-12) break;
  }
  return now;
}

// Also with one sweep, whose own error is seen only now and then.
TEST(ExponentialCollocation, KeepsToItsToleranceThoughDamped) {
  for (const double mu : {1.0, 50.0})
    for (const int sweeps : {1, 2, 3}) {
      Posed s(oscillators({70, 100}, mu));
      auto method = make(name, {{"sweeps", sweeps}});
      constexpr double until = 0.05, tolerance = 1e-8;
      const State end = controlled(*method, s, until, tolerance);
      EXPECT_LE((end.q - s.exact(until).q).norm(), 10 * tolerance) << mu << " " << sweeps;  // of some steps
    }
}

}  // namespace
}  // namespace trammel::test
