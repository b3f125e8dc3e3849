#include <gtest/gtest.h>

#include <cmath>

#include <trammel/methods/error_along_rows.hpp>
#include <trammel/testing/problems.hpp>

namespace trammel {
namespace {

// Trials from t = 1, each half as long as the one before, whose errors fall by 2^order a trial from far above 1: which
// part counts of the last of them.
ErrorAlongRows::Part counted(double order) {
  ErrorAlongRows along;
  State now, next;
  now.t = 1;
  auto part = ErrorAlongRows::Part::whole;
  for (int i = 0; i < 3; ++i) {
    next.t = 1 + std::ldexp(0.5, -i);
    along.judge(now, next, [&](ErrorAlongRows::Part p) {
      part = p;
      return 1e9 * std::pow(2, -order * i);
    });
  }
  return part;
}

// Estimates of every method that holds rows fall with h^3 or faster; round-off grows by 1/h and 1/h^2, or stays.
TEST(ErrorAlongRows, TakesForRoundOffWhatFallsMoreSlowlyThanAnErrorOfSecondOrder) {
  for (const double order : {2.2, 3.0, 8.0}) EXPECT_EQ(counted(order), ErrorAlongRows::Part::whole) << order;
  for (const double order : {-2.0, -1.0, 0.0, 0.5, 1.0, 1.8})
    EXPECT_EQ(counted(order), ErrorAlongRows::Part::along_rows) << order;
}

TEST(ErrorAlongRows, ComparesTrialsFromTheSamePlaceOnly) {
  ErrorAlongRows along;
  State now, next;
  for (const double t : {1.0, 2.0}) {
    now.t = t, next.t = t + 0.5 / t;
    EXPECT_EQ(
        along.judge(now, next, [](ErrorAlongRows::Part p) { return p == ErrorAlongRows::Part::whole ? 100. : 1.; }),
        100);
  }
}

TEST(ErrorAlongRows, ComparesALongerTrialWithNone) {
  ErrorAlongRows along;
  State now, next;
  for (const double h : {0.1, 0.1, 0.2}) {
    now.t = 1, next.t = 1 + h;
    EXPECT_EQ(
        along.judge(now, next, [](ErrorAlongRows::Part p) { return p == ErrorAlongRows::Part::whole ? 100. : 1.; }),
        100);
  }
}

// Of the pendulum's rod: what is left is along the circle, and as it was; with unit masses the projection is
// orthogonal, whatever the damping.
TEST(ErrorAlongRows, LeavesWhatIsAlongTheRows) {
  Problem problem = problems::pendulum_with_rod();
  problem.tangent = [](const Blend& c, const Vec&, const Vec&) -> Mat { return c.c_d * Mat{{1, 2}, {2, 9}}; };
  const auto system = problem.system();
  const State at = problem.solution(0.3);
  const Vec along = Eigen::Vector2d(-at.q[1], at.q[0]);
  Vec e = 2 * along + 3 * at.q;
  ErrorAlongRows().project(*system, at, e);
  EXPECT_LE((e - 2 * along).norm(), 1e-14);  // some roundings of numbers about 3
}

TEST(ErrorAlongRows, LeavesEverythingWhereThereAreNoRowsAndEvaluatesNothing) {
  Problem problem = problems::pendulum();
  int evaluations = 0;
  problem.mass = [&, M = problem.M](const Vec&) { return ++evaluations, M; };
  const auto system = problem.system();
  const State at = problem.solution(0);
  evaluations = 0;
  Vec e = Vec::Constant(1, 3);
  ErrorAlongRows().project(*system, at, e);
  EXPECT_EQ(e[0], 3);
  EXPECT_EQ(evaluations, 0);
}

}  // namespace
}  // namespace trammel
