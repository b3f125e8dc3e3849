#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include <trammel/methods/newmark_error.hpp>
#include <trammel/testing/archive.hpp>
#include <trammel/testing/problems.hpp>

namespace trammel {
namespace {

struct Weights {
  double alpha_m, alpha_f, beta, gamma;
};

// A unit mass on a spring and a damper, the accelerations of three points of its motion, and the errors that the
// formulas of newmark_error.hpp make of them.
struct Mode {
  double k, d;
  double begin = 8, h_before = 0.5, h = 0.25;
  double a_before = 1, a = 1.5, a_next = 1.875;  // 1 m/s^3, then 1.5 m/s^3
  double e_q = 0, e_v = 0, z = 0;

  Mode(const Weights& w, double stiffness, double damping) : k(stiffness), d(damping) {
    const double delta = w.alpha_m - w.alpha_f, share = (1 - w.alpha_f) / (1 - w.alpha_m);
    const double C_1 = w.gamma - 0.5 + delta, C_q = w.beta + delta / 2 - 1.0 / 6;
    const double C_v = (delta * (2 * w.alpha_m - 1) + w.gamma * (1 + 2 * delta) - 1.0 / 3) / 2;
    const double second = h * h * ((a_next - a) / h - (a - a_before) / h_before) / ((h + h_before) / 2);
    e_q = C_q * h * h * (a_next - a);
    e_v = C_1 * h * (a_next - a) + C_v * h * second;
    z = share * (w.beta * h * h * k + w.gamma * h * d);
  }
  std::unique_ptr<System> system() const {
    Problem p;
    p.closed_form = false;
    p.M = Mat::Ones(1, 1);
    p.force = [](double, const Vec& q, const Vec&) { return Vec::Zero(q.size()); };
    p.tangent = [this](const Blend& c, const Vec&, const Vec&) { return Mat::Constant(1, 1, c.c_d * d + c.c_k * k); };
    p.exact = [](double, Vec& q, Vec& v) { q = v = Vec::Zero(1); };
    return p.system();
  }
  static State at(double t, double a) { return {t, Vec::Zero(1), Vec::Zero(1), Vec::Constant(1, a), Vec(0)}; }
  double estimate(NewmarkError& error, const Tolerance& tolerance) const {
    error.restart(at(begin - 3, 100));
    error.accept(at(begin - h_before, a_before));
    error.accept(at(begin, a));
    return trial(error, tolerance);
  }
  double trial(NewmarkError& error, const Tolerance& tolerance) const {
    return error(*system(), at(begin, a), at(begin + h, a_next), tolerance);
  }
};

double rms(double x, double y) {
  return std::sqrt((x * x + y * y) / 2);
}

constexpr Tolerance loose{.relative = 0, .absolute = 1}, tight{.relative = 0, .absolute = 1e-9};

NewmarkError estimator(const Weights& w) {
  NewmarkError error;
  error.set(w.alpha_m, w.alpha_f, w.beta, w.gamma);
  return error;
}

constexpr Weights methods[] = {
    {0, 0, 0.25, 0.5}, {0, 0.2, 0.36, 0.7}, {0.25, 0.375, 0.31640625, 0.625}, {0, 0, 0.3, 0.6}};

TEST(NewmarkError, IsOfTheDifferencesOfAccelerationsWithinItsTolerance) {
  for (const Weights& w : methods) {
    const Mode mode(w, 1e6, 0);
    NewmarkError error = estimator(w);
    EXPECT_NEAR(mode.estimate(error, loose) / rms(mode.e_q, mode.e_v), 1, 1e-12);
  }
}

// z of a mode: the part of the step's matrix that is no mass, stiffness and damping alike.
TEST(NewmarkError, IsFilteredByTheMatrixOfTheStep) {
  for (const Weights& w : methods)
    for (const auto& [k, d] : {std::pair(1e4, 0.0), std::pair(0.0, 1e4), std::pair(300.0, 40.0)}) {
      const Mode mode(w, k, d);
      ASSERT_GT(mode.z, 1);
      NewmarkError error = estimator(w);
      const double x_q = mode.e_q / (1 + mode.z), x_v = mode.e_v / (1 + mode.z);
      const double expected = rms(x_q, x_v + (mode.e_v - x_v) / std::sqrt(mode.z)) / 1e-9;
      EXPECT_NEAR(mode.estimate(error, tight) / expected, 1, 1e-9) << k << " " << d;
    }
}

TEST(NewmarkError, IsFilteredWhereItExceedsItsToleranceOnly) {
  for (const Weights& w : methods) {
    const Mode mode(w, 1e6, 0);
    NewmarkError error = estimator(w);
    const double whole = rms(mode.e_q, mode.e_v);
    EXPECT_NEAR(mode.estimate(error, {.relative = 0, .absolute = whole / 0.99}), 0.99, 1e-12);
    EXPECT_LT(mode.estimate(error, {.relative = 0, .absolute = whole / 1.01}), 0.1);
  }
}

// e_q is filtered by a part of (omega h)^2; e_v not at all.
TEST(NewmarkError, KeepsTheVelocitiesOfModesThatTheStepResolves) {
  for (const Weights& w : methods) {
    const Mode mode(w, 4, 0);
    ASSERT_LT(mode.z, 1);
    NewmarkError error = estimator(w);
    EXPECT_NEAR(mode.estimate(error, tight) / (rms(mode.e_q / (1 + mode.z), mode.e_v) / 1e-9), 1, 1e-9);
  }
}

// A spring that pushes (negative stiffness) would amplify: the filter never makes an error larger.
TEST(NewmarkError, IsNeverMadeLargerByItsFilter) {
  const Weights w = methods[0];
  const Mode mode(w, -40, 0);
  ASSERT_LT(mode.z, -0.1);
  NewmarkError error = estimator(w);
  EXPECT_NEAR(mode.estimate(error, tight) / (rms(mode.e_q, mode.e_v) / 1e-9), 1, 1e-9);
}

// Directly after a restart a' is a difference over a thousandth of the step, which is off by half of that.
TEST(NewmarkError, FindsTheRateOfAccelerationsWithoutAStepBefore) {
  const double h = 0.5, v = 0.25, a_next = 3;
  struct Law {
    const char* name;
    std::function<double(double t, double q, double v)> force;
    double v, a, rate;  // at the start, q = 0
  };
  const Law laws[] = {{"of time", [](double t, double, double) { return 1 + 2 * t; }, 0, 1, 2},
                      {"of the place", [](double, double q, double) { return 1 - 2 * q; }, v, 1, -2 * v},
                      {"of the place, from rest", [](double, double q, double) { return 1 - 2 * q; }, 0, 1, 0},
                      {"of the velocity", [](double, double, double u) { return 1 - 2 * u; }, 0, 1, -2}};
  for (const Law& law : laws) {
    Problem p;
    p.closed_form = false;
    p.M = Mat::Ones(1, 1);
    p.force = [&law](double t, const Vec& q, const Vec& u) { return Vec::Constant(1, law.force(t, q[0], u[0])); };
    p.exact = [&law](double, Vec& q, Vec& u) { q = Vec::Zero(1), u = Vec::Constant(1, law.v); };
    const auto s = p.system();
    const State now{0, Vec::Zero(1), Vec::Constant(1, law.v), Vec::Constant(1, law.a), Vec(0)};
    const State next{h, Vec::Zero(1), Vec::Constant(1, law.v), Vec::Constant(1, a_next), Vec(0)};
    NewmarkError error = estimator({0, 0, 0.25, 0.5});
    error.restart(now);
    const double e_q = h * h / 12 * (a_next - law.a), e_v = h / 12 * 2 * h * ((a_next - law.a) / h - law.rate);
    EXPECT_NEAR(error(*s, now, next, loose) / rms(e_q, e_v), 1, 0.6e-3) << law.name;
  }
}

// A particle on the plane y = 0, whose accelerations differ by 1 along x and by `across` along y.
struct Sliding {
  std::unique_ptr<System> s;
  State now = at(0, 0, 0);

  explicit Sliding(double k = 0) {
    Problem p;
    p.closed_form = false;
    p.M = Mat::Identity(2, 2);
    p.force = [](double, const Vec&, const Vec&) { return Vec::Zero(2); };
    p.rows = [](double, const Vec& q, const Vec&) {
      return Problem::Rows{q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1)};
    };
    p.tangent = [k](const Blend& c, const Vec&, const Vec&) -> Mat { return c.c_k * k * Mat::Identity(2, 2); };
    p.exact = [](double, Vec& q, Vec& v) { q = v = Vec::Zero(2); };
    s = p.system();
  }
  static State at(double t, double along, double across) {
    return {t, Vec::Zero(2), Vec::Zero(2), Eigen::Vector2d(along, across), Vec::Zero(1)};
  }
  double trial(NewmarkError& error, double h, double across, double along = 1) {
    return error(*s, now, at(h, along, across), {.relative = 0, .absolute = 1e-6});
  }
};

TEST(NewmarkError, IsThatAlongTheRowsWhereOnlyPositionsHoldThem) {
  Sliding on;
  NewmarkError error;
  error.set(0, 0, 0.25, 0.5, false);
  error.restart(on.now);
  const double along = on.trial(error, 0.1, 0);
  EXPECT_GT(along, 1);
  EXPECT_NEAR(on.trial(error, 0.1, 100) / along, 1, 1e-12);
}

// However stiff the springs are across the rows.
TEST(NewmarkError, KeepsWhatIsAcrossTheRowsInItsFilter) {
  const auto across = [](double k) {
    Sliding on(k);
    NewmarkError error = estimator(methods[0]);
    error.restart(on.now);
    return on.trial(error, 0.1, 1, 0);
  };
  EXPECT_GT(across(0), 1);
  EXPECT_NEAR(across(1e6) / across(0), 1, 1e-9);
}

// Of an error of 1 in both directions the part along the rows is filtered by z, the part across them is kept.
TEST(NewmarkError, FiltersWhatIsAlongTheRowsBesideWhatIsAcross) {
  const double h = 0.1, k = 1e6, z = h * h / 4 * k;
  Sliding on(k);
  NewmarkError error = estimator(methods[0]);
  error.restart(on.now);
  const double e_q = h * h / 12, e_v = h / 6;
  const double x_q = e_q / (1 + z), x_v = (e_v + e_v * std::sqrt(z)) / (1 + z);
  const double expected = std::sqrt((e_q * e_q + e_v * e_v + x_q * x_q + x_v * x_v) / 4) / 1e-6;
  EXPECT_NEAR(on.trial(error, h, 1) / expected, 1, 1e-9);
}

// Accelerations across the rows that are the same in a shorter trial are round-off; after a restart nothing is known.
TEST(NewmarkError, ComparesNoTrialWithThoseBeforeARestart) {
  Sliding on;
  NewmarkError error = estimator(methods[0]);
  error.restart(on.now);
  const double whole = on.trial(error, 0.1, 100);
  on.trial(error, 0.1, 100);
  EXPECT_LT(on.trial(error, 0.099, 100), 0.6 * whole);
  error.restart(on.now);
  EXPECT_EQ(on.trial(error, 0.1, 100), whole);
}

TEST(NewmarkError, IsOfThirdOrderWhereTheMethodIsOfSecond) {
  EXPECT_EQ(estimator(methods[0]).order(), 3);
  EXPECT_EQ(estimator(methods[1]).order(), 3);
  EXPECT_EQ(estimator(methods[3]).order(), 2);
}

TEST(NewmarkError, GoesOnInAResumedRun) {
  const Mode mode(methods[0], 1, 0);
  NewmarkError error = estimator(methods[0]), resumed = estimator(methods[0]);
  const double expected = mode.estimate(error, loose);
  MemoryArchive memory;
  error.archive(memory);
  memory.reading = true;
  resumed.archive(memory);
  EXPECT_EQ(mode.trial(resumed, loose), expected);
  const State next = Mode::at(mode.begin + mode.h, mode.a_next), after = Mode::at(mode.begin + 1, 7);
  resumed.accept(next), error.accept(next);
  EXPECT_EQ(resumed.h_before(), mode.h);
  EXPECT_EQ(resumed(*mode.system(), next, after, loose), error(*mode.system(), next, after, loose));
}

TEST(NewmarkError, GoesOnBesideRowsInAResumedRun) {
  Sliding on;
  NewmarkError error = estimator(methods[0]), resumed = estimator(methods[0]);
  error.restart(on.now);
  const double whole = on.trial(error, 0.1, 100);
  on.trial(error, 0.099, 100);  // shows that the part across the rows is round-off
  MemoryArchive memory;
  error.archive(memory);
  memory.reading = true;
  resumed.archive(memory);
  const double along = on.trial(resumed, 0.098, 100);
  EXPECT_EQ(along, on.trial(error, 0.098, 100));
  EXPECT_LT(along, 0.6 * whole);
}

TEST(NewmarkError, KnowsTheFirstStepAfterARestart) {
  NewmarkError error = estimator(methods[0]);
  error.restart(Mode::at(8, 1));
  error.accept(Mode::at(8.5, 2));
  EXPECT_EQ(error.h_before(), 0.5);
  EXPECT_EQ(error.a_before(), Vec::Constant(1, 1));
}

TEST(NewmarkError, KnowsNoStepBeforeARestart) {
  const Mode mode(methods[0], 1, 0);
  NewmarkError error = estimator(methods[0]), fresh = estimator(methods[0]);
  mode.estimate(error, loose);
  for (NewmarkError* each : {&error, &fresh}) each->restart(Mode::at(mode.begin, mode.a));
  EXPECT_EQ(mode.trial(error, loose), mode.trial(fresh, loose));
}

}  // namespace
}  // namespace trammel
