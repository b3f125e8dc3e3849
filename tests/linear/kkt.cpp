// Saddle-point systems: what comes out satisfies both equations, whichever way it was solved.
#include "linear/kkt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace trammel::numerics {
namespace {

// Three unequal masses, coupled; two rows of a size.
const Mat M{{2, 0.3, 0}, {0.3, 1, -0.2}, {0, -0.2, 0.5}};
const Mat G{{1, 2, -1}, {0.5, -1, 2}};
const Vec b = Eigen::Vector3d(1, -2, 0.7);

struct Solution {
  Vec x, y;
};
Solution by_mass(const Mat& mass, const Mat& rows, const Vec& right, const Vec& c) {
  MassKkt kkt;
  EXPECT_TRUE(kkt.factorise(mass, rows));
  Solution s;
  kkt.solve(right, c, s.x, s.y);
  return s;
}

class Iteration {
 public:
  Iteration(const Mat& S, const Mat& W, const Mat& rows) {
    kkt_.begin(S.rows(), rows.rows()).topLeftCorner(S.rows(), S.cols()) = S;
    kkt_.factorise(W, rows);
  }
  bool solve(const Vec& right, const Vec& c, Solution& s) { return kkt_.solve(right, c, s.x, s.y); }

 private:
  IterationKkt kkt_;
};

// Residuals of both equations within a few roundings of their own terms.
void expect_solved(const Mat& S, const Mat& W, const Mat& rows, const Vec& right, const Vec& c, const Solution& s,
                   double roundings = 50) {
  const double eps = roundings * 2.2e-16;
  const Vec terms = S.cwiseAbs() * s.x.cwiseAbs() + W.transpose().cwiseAbs() * s.y.cwiseAbs() + right.cwiseAbs();
  EXPECT_LE((S * s.x + W.transpose() * s.y - right).cwiseAbs().maxCoeff(), eps * terms.maxCoeff());
  if (c.size()) {
    EXPECT_LE((rows * s.x - c).cwiseAbs().maxCoeff(),
              eps * (rows.cwiseAbs() * s.x.cwiseAbs() + c.cwiseAbs()).maxCoeff());
  }
}

// Bodies of a place and an angle each, with levers of a unit; the last `spare` rows are combinations of the others.
struct Mechanism {
  Mat rows;
  Vec levers;
  Mat masses;  // of a mass and its square of the lever
};
Mechanism mechanism(unsigned seed, int rows, int spare, double unit) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const int bodies = 4, n = 3 * bodies;
  Mechanism m{Mat(rows + spare, n), Vec::Ones(n), Mat::Identity(n, n)};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < n; ++j) m.rows(i, j) = number(random) * (j % 3 == 2 ? unit : 1);
  for (int i = 0; i < spare; ++i) {
    m.rows.row(rows + i).setZero();
    for (int k = 0; k < rows; ++k) m.rows.row(rows + i) += number(random) * m.rows.row(k);
  }
  for (int j = 2; j < n; j += 3) m.levers(j) = unit, m.masses(j, j) = unit * unit;
  return m;
}

// Two rows that differ by levers alone are independent, whatever their length is in metres.
TEST(RankOfRows, IsTheSameForLeversOfAnyLength) {
  for (const double unit : {1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (unsigned seed = 1; seed <= 20; ++seed)
      for (const int spare : {0, 1, 3}) {
        Mechanism m = mechanism(seed, 6, spare, unit);
        m.rows.row(1) = m.rows.row(0);
        m.rows(1, 2) += 0.5 * unit;  // another lever of the first body
        for (int i = 0; i < spare; ++i) m.rows.row(6 + i) = 0.3 * m.rows.row(1) - m.rows.row(2 + i);
        const Levers levers = [&]() -> const Vec& { return m.levers; };
        EXPECT_EQ(rank_of_rows(m.rows, rank_tolerance_at(0), levers), 6) << unit << ", " << seed << ", " << spare;
        MassKkt kkt;
        kkt.measure_by(levers);
        ASSERT_TRUE(kkt.factorise(m.masses, m.rows));
        const Vec right = Vec::LinSpaced(12, -1, 1).cwiseProduct(m.levers), c = m.rows * right;
        Solution s;
        kkt.solve(right, c, s.x, s.y);
        EXPECT_LE((m.rows * s.x - c).cwiseAbs().maxCoeff(), 1e-9 * c.cwiseAbs().maxCoeff()) << unit << ", " << seed;
      }
}

TEST(MassKkt, SaysWhetherRowsAreRedundant) {
  MassKkt kkt;
  ASSERT_TRUE(kkt.factorise(M, G));
  EXPECT_FALSE(kkt.redundant());
  kkt.change_rows(G.row(0).replicate(2, 1));
  EXPECT_TRUE(kkt.redundant());
  kkt.change_rows(G);
  EXPECT_FALSE(kkt.redundant());
  Mat more_rows_than_coordinates(4, 3);
  more_rows_than_coordinates << G, Mat::Identity(2, 3);
  kkt.change_rows(more_rows_than_coordinates);
  EXPECT_TRUE(kkt.redundant());
}

// Dropped, the second row would miss its 0.7 whole; kept, it is met to round-off over the sine.
TEST(MassKkt, KeepsARowThatIsNearlyDependentBesideALongOne) {
  const double sine = 5 * rank_tolerance_at(0);
  const Mat rows{{1, 0, 0}, {1, sine, 0}, {0, 0, 100}};
  const Solution s = by_mass(M, rows, b, Vec(rows * Eigen::Vector3d(0.2, 0.7, -1)));
  EXPECT_NEAR(s.x(1), 0.7, 1e-14 / sine);
}

TEST(MassKkt, TakesNewRowsWithTheSameMass) {
  MassKkt kkt;
  ASSERT_TRUE(kkt.factorise(M, G));
  kkt.change_rows(G.row(1));
  Solution s;
  const Vec c = Vec::Constant(1, 0.3);
  kkt.solve(b, c, s.x, s.y);
  expect_solved(M, G.row(1), G.row(1), b, c, s);
}

// Friction of a hinge by its load, one of two that repeat each other's rows: W = G + n t^T. Of the y that solve both
// equations only those in the range of G keep the meaning of a reaction.
TEST(MassKkt, GivesMultipliersInTheRangeOfRedundantRowsWhereFrictionFollowsFromThem) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const Vec n = 0.3 * Vec::NullaryExpr(5, [&] { return normal(random); });
    const Vec t = Vec::NullaryExpr(6, [&] { return normal(random); });
    const Mat independent = Mat::NullaryExpr(3, 6, [&] { return normal(random); });
    const Mat among = Mat::NullaryExpr(5, 3, [&] { return normal(random); });
    const Mat rows = among * independent, W = rows + n * t.transpose();
    const Mat L = Mat::NullaryExpr(6, 6, [&] { return normal(random); });
    const Mat mass = L * L.transpose() + Mat::Identity(6, 6);
    const Vec right = Vec::NullaryExpr(6, [&] { return normal(random); }), c = rows * right;
    MassKkt kkt;
    ASSERT_TRUE(kkt.factorise(mass, rows, W));
    Solution s, by_whole;
    ASSERT_TRUE(kkt.solve(right, c, s.x, s.y));
    ASSERT_TRUE(Iteration(mass, W, rows).solve(right, c, by_whole));
    const double size = 1 + s.x.norm() + s.y.norm();
    EXPECT_LT((mass * s.x + W.transpose() * s.y - right).norm(), 1e-9 * size) << trial;
    EXPECT_LT((rows * s.x - c).norm(), 1e-9 * size) << trial;
    EXPECT_LT((s.y - among * (among.colPivHouseholderQr().solve(s.y))).norm(), 1e-9 * size) << trial;
    EXPECT_LT((s.x - by_whole.x).norm() + (s.y - by_whole.y).norm(), 1e-8 * size) << trial;
  }
}

// Rows in m and rad of a small mechanism: the units of rows do not make them redundant.
TEST(MassKkt, SolvesCoupledRowsOfAnyLength) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const Mat one = Mat::NullaryExpr(3, 6, [&] { return normal(random); });
    const Vec n = 0.3 * Vec::NullaryExpr(3, [&] { return normal(random); });
    const Vec t = Vec::NullaryExpr(6, [&] { return normal(random); });
    const Vec lengths{{1, 1e-4, 1e-7}}, right = Vec::NullaryExpr(6, [&] { return normal(random); });
    const Mat identity = Mat::Identity(6, 6), W_one = one + n * t.transpose();
    MassKkt of_length_one, of_any;
    Solution s, any;
    ASSERT_TRUE(of_length_one.factorise(identity, one, W_one));
    ASSERT_TRUE(of_any.factorise(identity, lengths.asDiagonal() * one, lengths.asDiagonal() * W_one));
    const Vec c = one * right;
    ASSERT_TRUE(of_length_one.solve(right, c, s.x, s.y));
    ASSERT_TRUE(of_any.solve(right, lengths.asDiagonal() * c, any.x, any.y));
    EXPECT_LT((s.x - any.x).norm(), 1e-8 * (1 + s.x.norm())) << trial;
    EXPECT_LT((s.y - lengths.cwiseProduct(any.y)).norm(), 1e-8 * (1 + s.y.norm())) << trial;
  }
}

TEST(MassKkt, HasNoMultipliersOfCoupledRowsThatAreAllZero) {
  const Mat none = Mat::Zero(2, 3), W = Mat::Constant(2, 3, 0.1);
  MassKkt kkt;
  ASSERT_TRUE(kkt.factorise(M, none, W));
  Solution s;
  ASSERT_TRUE(kkt.solve(b, Vec::Zero(2), s.x, s.y));
  EXPECT_EQ(s.y, Vec::Zero(2));
  EXPECT_LT((M * s.x - b).norm(), 1e-14);
}

TEST(MassKkt, RefusesAMassThatIsNotPositive) {
  MassKkt kkt;
  EXPECT_FALSE(kkt.factorise(Eigen::Vector3d(1, 0, 1).asDiagonal().toDenseMatrix(), G));
  EXPECT_FALSE(kkt.factorise(Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix(), G));
}

// Nothing of it is symmetric: a stiffness with gyroscopic terms, friction in W.
const Mat S{{3, 1, -2}, {0.5, 2, 1}, {4, -1, 1}};
const Mat W{{1, 2.3, -1}, {0.5, -1, 2.6}};

TEST(IterationKkt, SolvesBothEquationsWithAnotherWThanG) {
  Iteration kkt(S, W, G);
  const Vec c = Eigen::Vector2d(0.4, -3);
  Solution s;
  ASSERT_TRUE(kkt.solve(b, c, s));
  expect_solved(S, W, G, b, c, s);
}

TEST(IterationKkt, SolvesNothingAndNoRows) {
  Solution s;
  Iteration empty(Mat(0, 0), Mat(0, 0), Mat(0, 0));
  EXPECT_TRUE(empty.solve(Vec(0), Vec(0), s));
  Iteration free(S, Mat(0, 3), Mat(0, 3));
  ASSERT_TRUE(free.solve(b, Vec(0), s));
  expect_solved(S, Mat(0, 3), Mat(0, 3), b, Vec(0), s);
}

TEST(IterationKkt, SolvesWhereOnlyTheRowsHoldASingularMatrix) {
  const Mat singular = Eigen::Vector3d(1, 1, 0).asDiagonal();  // the third coordinate is held by both rows
  Iteration kkt(singular, G, G);
  const Vec c = Eigen::Vector2d(0.4, -3);
  Solution s;
  ASSERT_TRUE(kkt.solve(b, c, s));
  expect_solved(singular, G, G, b, c, s);
}

TEST(IterationKkt, RefusesAMatrixThatIsSingularWhereTheRowsLeaveItFree) {
  const Mat singular = Eigen::Vector3d(1, 0, 1).asDiagonal();
  const Mat row{{1, 0, 1}};
  Iteration kkt(singular, row, row);
  Solution s;
  EXPECT_FALSE(kkt.solve(b, Vec::Zero(1), s));
  EXPECT_TRUE(kkt.solve(Eigen::Vector3d(1, 0, 2), Vec::Zero(1), s));  // no force where nothing resists
}

TEST(IterationKkt, LeavesOfRedundantRowsWhatNoneReaches) {
  Mat rows(3, 3);
  rows << G.row(0), G.row(1), G.row(0);
  Iteration kkt(S, rows, rows);
  Solution s;
  ASSERT_TRUE(kkt.solve(b, Eigen::Vector3d(0.4, -3, 0.5), s));
  EXPECT_LT((rows * s.x - Eigen::Vector3d(0.45, -3, 0.45)).norm(), 1e-14 * s.x.norm());  // round-off
  EXPECT_LT((S * s.x + rows.transpose() * s.y - b).norm(), 1e-14 * s.x.norm());
  EXPECT_NEAR(s.y[0], s.y[2], 1e-14 * s.y.norm()) << "of minimum norm";
}

TEST(IterationKkt, DoesNotTakeUnlikeScalesForSingular) {
  // From a matrix of masses of grams to one of a stiff beam; rows in micrometres and in megametres.
  for (const auto& [stiffness, row] : {std::pair{1e-8, 1.0}, {1.0, 1e-6}, {1.0, 1e6}, {1e12, 1.0}}) {
    const Mat scaled = stiffness * S, rows = row * G;
    Iteration kkt(scaled, rows, rows);
    const Vec right = stiffness * b, c = row * Eigen::Vector2d(0.4, -3);  // x stays of the order of 1
    Solution s;
    ASSERT_TRUE(kkt.solve(right, c, s)) << stiffness << " " << row;
    expect_solved(scaled, rows, rows, right, c, s);
  }
}

}  // namespace
}  // namespace trammel::numerics
