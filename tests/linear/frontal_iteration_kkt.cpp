#include "linear/frontal_iteration_kkt.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

using numerics::FrontalIterationKkt;

constexpr int n = 60;

Mat stiffness() {
  Mat S = 2.1 * Mat::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) S(i, i + 1) = -1, S(i + 1, i) = -0.9;
  return S;
}

// Row i holds unknown 7 i and half of the next.
Mat rows(int count) {
  Mat G = Mat::Zero(count, n);
  for (int i = 0; i < count; ++i) G(i, 7 * i) = 1, G(i, 7 * i + 1) = 0.5;
  return G;
}

void factorise(FrontalIterationKkt& kkt, const Mat& S, const Mat& W, const Mat& G) {
  Matrix target = Matrix::onto(kkt.sum());
  kkt.factorise(n, G, numerics::rank_tolerance_at(0), [&] {
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - 1); j <= std::min(n - 1, i + 1); ++j) target.add(i, j, S(i, j));
    for (int i = 0; i < G.rows(); ++i)
      for (int j = 0; j < n; ++j)
        if (G(i, j) != 0 || W(i, j) != 0) target.add(n + i, j, G(i, j)), target.add(j, n + i, W(i, j));
  });
}

struct Solution {
  Vec x, y;
};
// What is left of both equations.
double residual(const Mat& S, const Mat& W, const Mat& G, const Vec& b, const Vec& c, const Solution& s) {
  return (S * s.x + W.transpose() * s.y - b).norm() + (G * s.x - c).norm();
}

TEST(FrontalIterationKkt, SolvesBothEquations) {
  const Vec b = Vec::LinSpaced(n, -1, 2);
  for (const int count : {0, 1, 5}) {
    const Vec c = Vec::LinSpaced(count, 0.5, -1);
    FrontalIterationKkt kkt;
    factorise(kkt, stiffness(), rows(count), rows(count));
    Solution s;
    ASSERT_TRUE(kkt.solve(b, c, s.x, s.y));
    EXPECT_LE(residual(stiffness(), rows(count), rows(count), b, c, s), 1e-13) << count;
  }
}

TEST(FrontalIterationKkt, SolvesWithReactionsOtherThanTheRows) {
  const Vec b = Vec::LinSpaced(n, -1, 2), c = Vec::LinSpaced(4, 0.5, -1);
  Mat W = rows(4);
  W(2, 20) = 0.3;
  FrontalIterationKkt kkt;
  factorise(kkt, stiffness(), W, rows(4));
  Solution s;
  ASSERT_TRUE(kkt.solve(b, c, s.x, s.y));
  EXPECT_LE(residual(stiffness(), W, rows(4), b, c, s), 1e-13);
}

// Bodies of 1e-9 to 1e9 kg, rows in nanometres or megametres.
TEST(FrontalIterationKkt, SolvesToRoundOffWhateverMassesAndUnitsAre) {
  const Vec b = Vec::LinSpaced(n, -1, 2), c = Vec::LinSpaced(5, 0.5, -1);
  for (const double mass : {1e-9, 1.0, 1e9})
    for (const double unit : {1e-6, 1.0, 1e9}) {
      SCOPED_TRACE(testing::Message() << mass << " kg, " << unit << " m");
      const Mat S = mass * stiffness(), G = unit * rows(5);
      FrontalIterationKkt kkt;
      factorise(kkt, S, G, G);
      Solution s;
      ASSERT_TRUE(kkt.solve(b, c, s.x, s.y));
      // Each equation to the round-off of its own terms.
      const double forces =
          (S.cwiseAbs() * s.x.cwiseAbs() + G.cwiseAbs().transpose() * s.y.cwiseAbs() + b.cwiseAbs()).norm();
      EXPECT_LE((S * s.x + G.transpose() * s.y - b).norm(), 1e-13 * forces);
      EXPECT_LE((G * s.x - c).norm(), 1e-13 * ((G.cwiseAbs() * s.x.cwiseAbs()).norm() + c.norm()));
    }
}

TEST(FrontalIterationKkt, SharesOutTheForcesOfRowsThatRepeat) {
  Mat G = rows(4);
  G.row(3) = G.row(1);
  const Vec b = Vec::LinSpaced(n, -1, 2);
  Vec c = Vec::LinSpaced(4, 0.5, -1);
  c(3) = c(1);
  FrontalIterationKkt kkt;
  factorise(kkt, stiffness(), G, G);
  Solution s;
  ASSERT_TRUE(kkt.solve(b, c, s.x, s.y));
  EXPECT_LE(residual(stiffness(), G, G, b, c, s), 1e-11);
  EXPECT_NEAR(s.y(1), s.y(3), 1e-3);  // round-off over the regularisation, 1e-12 of S
}

// Nothing ties the last unknown, and a force acts on it.
TEST(FrontalIterationKkt, TellsThatNothingHoldsAnUnknown) {
  Mat S = stiffness();
  S.row(n - 1).setZero(), S.col(n - 1).setZero();
  FrontalIterationKkt kkt;
  factorise(kkt, S, rows(2), rows(2));
  Solution s;
  EXPECT_FALSE(kkt.solve(Vec::Ones(n), Vec::Zero(2), s.x, s.y));
}

// Exchanges within a front find no pivot of any use in the first unknowns.
TEST(FrontalIterationKkt, SolvesWhereExchangesWithinFrontsDoNotServe) {
  Mat S = stiffness();
  for (int i = 0; i < n; ++i) S(i, i) = 1e-17;
  const Vec known = Vec::LinSpaced(n, -1, 2);
  FrontalIterationKkt kkt;
  factorise(kkt, S, Mat(0, n), Mat(0, n));
  Solution s;
  ASSERT_TRUE(kkt.solve(S * known, Vec(0), s.x, s.y));
  EXPECT_LE((s.x - known).norm(), 1e-9 * known.norm());
}

TEST(FrontalIterationKkt, RefusesNumbersThatAreNone) {
  Mat S = stiffness();
  S(30, 30) = std::numeric_limits<double>::quiet_NaN();
  FrontalIterationKkt kkt;
  factorise(kkt, S, rows(1), rows(1));
  Solution s;
  EXPECT_FALSE(kkt.solve(Vec::Ones(n), Vec::Zero(1), s.x, s.y));
}

}  // namespace
}  // namespace trammel::test
