#include "statics/anderson.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <trammel/decompositions.hpp>

namespace trammel::numerics {
namespace {

// s = P^-1 (b - A x) with a P that is A except in three directions, in which it is wrong by 1e4, by a half, and has the
// wrong sign.
TEST(Anderson, NeedsOneStepMoreThanDirectionsAreWrong) {
  const Eigen::Index n = 20;
  const Mat Q = Eigen::HouseholderQR<Mat>(Mat(Mat::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
                  return std::sin(double(1 + i + n * j * j));
                }))).householderQ();
  Vec share = Vec::Ones(n);
  share.head(3) = Vec(Eigen::Vector3d(1e-4, 0.5, -2));
  const Mat A = Q * share.asDiagonal() * Q.transpose();
  const Vec solution = Vec::LinSpaced(n, -1, 2);
  Vec x = Vec::Zero(n);
  Anderson accelerated;
  const auto go_on = [&](int steps) {
    for (int i = 0; i < steps; ++i) x += accelerated.next(A * (solution - x));
    return (x - solution).norm();
  };
  EXPECT_GT(go_on(3), 1e-2);
  EXPECT_LT(go_on(2), 1e-5);   // round-off of the differences, times 1e4 twice
  EXPECT_LT(go_on(2), 1e-10);  // once more, from there
}

TEST(Anderson, TakesARightStepAsItIs) {
  Anderson accelerated;
  const Vec s = Vec::LinSpaced(4, 1, 2);
  EXPECT_EQ(accelerated.next(s), s);
  EXPECT_EQ(accelerated.next(Vec::Zero(4)), Vec::Zero(4));
}

TEST(Anderson, BeginsAfreshWithAnotherNumberOfUnknowns) {
  Anderson accelerated;
  for (int i = 0; i < 4; ++i) accelerated.next(Vec::NullaryExpr(20, [i](Eigen::Index k) { return std::sin(i + k); }));
  // Halves of the way in each direction: the second step goes all of it.
  Vec left = Vec::LinSpaced(3, 1, 2);
  EXPECT_EQ(accelerated.next(left / 2), left / 2);
  left /= 2;
  EXPECT_LE((accelerated.next(left / 2) - left).norm(), 1e-15);
}

// The fixed point of x_i = cos(x_(i+1)).
TEST(Anderson, SolvesNonlinearEquationsFasterThanTheirFixedPoint) {
  const Eigen::Index n = 5;
  Vec x = Vec::LinSpaced(n, 0, 1);
  Anderson accelerated;
  for (int i = 0; i < 14; ++i) {
    Vec s(n);
    for (Eigen::Index k = 0; k < n; ++k) s[k] = std::cos(x[(k + 1) % n]) - x[k];
    x += accelerated.next(s);
  }
  EXPECT_LT((x.array() - 0.73908513321516064).matrix().lpNorm<Eigen::Infinity>(), 1e-8);  // cos alone: 0.67^14 = 4e-3
}

}  // namespace
}  // namespace trammel::numerics
