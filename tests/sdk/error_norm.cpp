#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include <trammel/methods/error_norm.hpp>

namespace trammel {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

State at(double t, const Vec& q, const Vec& v) {
  return {t, q, v, {}, {}};
}
Vec vec(double x) {
  return Vec::Constant(1, x);
}

// One coordinate that moves from q to q + h v, with an error of e_q in it and e_v in its velocity.
double norm(double e_q, double e_v, double q, double v, double h, const Tolerance& tolerance) {
  return error_norm(vec(e_q), vec(e_v), at(1, vec(q), vec(v)), at(1 + h, vec(q), vec(v)), tolerance);
}

TEST(ErrorNorm, IsTheRootMeanSquareOverPositionsAndVelocities) {
  const Tolerance one{.relative = 0, .absolute = 1};
  EXPECT_NEAR(norm(3, 4, 0, 0, 1, one), std::sqrt((9 + 16) / 2.0), 4 * eps);
  const State now = at(0, Vec::Zero(2), Vec::Zero(2));
  EXPECT_NEAR(error_norm(Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 4), now, now, one), std::sqrt(30 / 4.0), 4 * eps);
}

TEST(ErrorNorm, LeavesThePartsOfItsSquareWhereTheyAreWanted) {
  Vec parts;
  const Tolerance one{.relative = 0, .absolute = 1, .parts = &parts};
  const State now = at(0, Vec::Zero(2), Vec::Zero(2));
  const double whole = error_norm(Eigen::Vector2d(1, 0), Eigen::Vector2d(3, 4), now, now, one);
  EXPECT_NEAR((parts - Eigen::Vector2d(10, 16)).norm(), 0, 64 * eps);
  EXPECT_NEAR(parts.sum(), 4 * whole * whole, 64 * eps);
}

TEST(ErrorNorm, MayHaveAnAbsoluteToleranceOfVelocitiesOfItsOwn) {
  const Tolerance tolerance{.relative = 0, .absolute = 1e-3, .absolute_rate = 0.1};
  EXPECT_NEAR(norm(0, 1, 0, 0, 1, tolerance), 10 / std::sqrt(2), 1e-14);
  EXPECT_NEAR(norm(1, 0, 0, 0, 1, tolerance), 1000 / std::sqrt(2), 1e-11);
}

TEST(ErrorNorm, MeasuresAVelocityByItsSizeAtTheLargerEnd) {
  const Tolerance relative{.relative = 1e-3, .absolute = 0};
  const State slow = at(0, vec(0), vec(2)), fast = at(1, vec(0), vec(-8));
  const double expected = 1 / (8e-3) / std::sqrt(2);
  // The round-off of v, 4 eps of 8, relative to 8e-3 is about 1e-12.
  EXPECT_NEAR(error_norm(vec(0), vec(1), slow, fast, relative), expected, 1e-11 * expected);
  EXPECT_NEAR(error_norm(vec(0), vec(1), fast, slow, relative), expected, 1e-11 * expected);
}

// Beside an absolute tolerance of three times as much: 3 + 1. Of either end, and of velocities by that of places, too.
TEST(ErrorNorm, AllowsFourUnitsOfRoundOff) {
  const double far = 1e6, unit = 4 * eps * far;
  const Tolerance tolerance{.relative = 0, .absolute = 3 * unit};
  const State here = at(0, vec(0), vec(0)), there = at(0, vec(far), vec(0)), fast = at(0, vec(0), vec(far));
  for (const auto& [now, next] : {std::pair(here, there), std::pair(there, here)})
    EXPECT_NEAR(error_norm(vec(4 * unit), vec(0), now, next, tolerance), std::sqrt(0.5), 1e-12);
  for (const auto& [now, next] : {std::pair(here, fast), std::pair(fast, here)})
    EXPECT_NEAR(error_norm(vec(0), vec(4 * unit), now, next, tolerance), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(error_norm(vec(0), vec(unit), there, there, {.relative = 0, .absolute = 0}), std::sqrt(0.5), 1e-12);
}

TEST(ErrorNorm, MeasuresACoordinateByItsWayInTwoStepsWhereverItIs) {
  const Tolerance relative{.relative = 1e-3, .absolute = 0};
  const double h = 0.125, v = 4, way = 2 * h * v, expected = 0.01 / (1e-3 * way) / std::sqrt(2);
  for (const double q : {10.0, 1e3, -1e6})  // round-off of q, 4 eps 1e6, beside 1e-3: 1e-6
    EXPECT_NEAR(norm(0.01, 0, q, v, h, relative), expected, 1e-6 * expected) << q;
}

TEST(ErrorNorm, MeasuresACoordinateByItselfWhereAStepIsManySwingsLong) {
  const double expected = 0.01 / (1e-3 * 0.5) / std::sqrt(2);
  EXPECT_NEAR(norm(0.01, 0, 0.5, 1e3, 1, {.relative = 1e-3, .absolute = 0}), expected, 1e-11 * expected);
}

TEST(ErrorNorm, MeasuresACoordinateByItselfAtTheLargerEnd) {
  const Tolerance relative{.relative = 1e-3, .absolute = 0};
  const State near = at(0, vec(0.1), vec(1e3)), far = at(1, vec(-0.5), vec(1e3));
  const double expected = 0.01 / (1e-3 * 0.5) / std::sqrt(2);
  EXPECT_NEAR(error_norm(vec(0.01), vec(0), near, far, relative), expected, 1e-11 * expected);
  const State back = at(2, vec(0.1), vec(1e3));
  EXPECT_NEAR(error_norm(vec(0.01), vec(0), far, back, relative), expected, 1e-11 * expected);
}

TEST(ErrorNorm, MeasuresRotationsByTheLargestEntry) {
  // q has four numbers, v three: the entries of q do not belong to those of v.
  const Vec q = Eigen::Vector4d(0.1, 0.8, 0.5, 0.1), v = Vec::Constant(3, 100);
  const Vec e = Eigen::Vector3d(0.01, 0, 0);
  const double expected = 0.01 / (1e-3 * 0.8) / std::sqrt(6);
  EXPECT_NEAR(error_norm(e, Vec::Zero(3), at(0, q, v), at(1, q, v), {.relative = 1e-3, .absolute = 0}), expected,
              1e-11 * expected);
}

TEST(ErrorNorm, AddsTheAbsoluteTolerance) {
  const double expected = 1 / (0.5 + 0.25 * 2) / std::sqrt(2);
  EXPECT_NEAR(norm(0, 1, 0, 2, 1, {.relative = 0.25, .absolute = 0.5}), expected, 8 * eps);
  EXPECT_NEAR(norm(1, 0, 2, 100, 1, {.relative = 0.25, .absolute = 0.5}), expected, 8 * eps);
}

TEST(ErrorNorm, TakesRoundOffOfTheLargestEntryForNoError) {
  const Tolerance none{.relative = 0, .absolute = 0};
  const Vec q = Eigen::Vector2d(1e6, 0), v = Eigen::Vector2d(0, 1e3), still = Vec::Zero(2);
  const State now = at(0, q, v);
  EXPECT_LE(error_norm(Eigen::Vector2d(0, 1e6 * eps), Eigen::Vector2d(1e3 * eps, 0), now, now, none), 1);
  EXPECT_GE(error_norm(Eigen::Vector2d(0, 1e8 * eps), still, now, now, none), 1);
  EXPECT_GE(error_norm(still, Eigen::Vector2d(1e8 * eps, 0), now, now, none), 1);
  const State here = at(0, still, v);
  EXPECT_GE(error_norm(still, Eigen::Vector2d(1e5 * eps, 0), here, here, none), 1);
}

TEST(ErrorNorm, TakesRatesThatStabilisedRowsMakeOfRoundOffForNoError) {
  const Tolerance none{.relative = 0, .absolute = 0};
  const State far = at(0, Eigen::Vector2d(1e6, 0), Vec::Zero(2));
  EXPECT_LE(error_norm(Vec::Zero(2), Eigen::Vector2d(1e6 * eps, 0), far, far, none), 1);  // 1 1/s
}

TEST(ErrorNorm, IsZeroOfNoErrorAndInfiniteOfNoNumber) {
  const Tolerance none{.relative = 0, .absolute = 0};
  EXPECT_EQ(norm(0, 0, 0, 0, 1, none), 0);
  EXPECT_EQ(norm(std::nan(""), 0, 1, 1, 1, {}), HUGE_VAL);
  EXPECT_EQ(norm(0, 1, 0, 0, 1, none), HUGE_VAL);
  EXPECT_EQ(error_norm(Vec(0), Vec(0), at(0, Vec(0), Vec(0)), at(1, Vec(0), Vec(0)), none), 0);
}

}  // namespace
}  // namespace trammel
