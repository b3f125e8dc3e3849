// The block solver: what the dense one gives, for chains of bodies with and without redundant rows.
#include <random>

#include <gtest/gtest.h>

#include "linear/kkt.hpp"
#include "linear/sparse_iteration_kkt.hpp"
#include "linear/sparse_mass_kkt.hpp"

namespace trammel::numerics {
namespace {

// Bodies of three velocities in a chain, two rows between neighbours, the first tied to the ground; `twice`: so many of
// the joints are said twice.
struct Chain {
  std::vector<BodyBlock> bodies;
  Mat M, G;

  Chain(int n, int twice) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto some = [&](int rows, int columns) {
      return Mat(Mat::NullaryExpr(rows, columns, [&] { return uniform(random); }));
    };
    M = Mat::Zero(3 * n, 3 * n);
    G = Mat::Zero(2 * n + 2 * twice, 3 * n);
    bodies.resize(std::size_t(n));
    for (int k = 0; k < n; ++k) {
      BodyBlock& body = bodies[std::size_t(k)];
      const Mat root = some(3, 3);
      body.v0 = 3 * k;
      body.M = root * root.transpose() + 0.1 * Mat::Identity(3, 3);
      M.block(3 * k, 3 * k, 3, 3) = body.M;
      G.block(2 * k, 3 * k, 2, 3) = some(2, 3);
      if (k > 0) G.block(2 * k, 3 * k - 3, 2, 3) = some(2, 3);
    }
    for (int k = 0; k < twice; ++k) G.middleRows(2 * n + 2 * k, 2) = G.middleRows(2 * k, 2);
    for (BodyBlock& body : bodies) {
      for (int i = 0; i < G.rows(); ++i)
        if (!G.row(i).segment(body.v0, 3).isZero(0)) body.rows.push_back(i);
      body.Gt.resize(3, Eigen::Index(body.rows.size()));
      for (std::size_t i = 0; i < body.rows.size(); ++i)
        body.Gt.col(Eigen::Index(i)) = G.row(body.rows[i]).segment(body.v0, 3).transpose();
    }
  }
};

// Rows (of rows 2 k and 2 k + 1 said twice) that are consistent.
Vec right_hand(const Chain& chain) {
  return chain.G * Vec::LinSpaced(chain.G.cols(), -1, 2);
}

class SparseMass : public testing::TestWithParam<int> {};

TEST_P(SparseMass, TakesTheIdentityForAMetric) {
  const Chain chain(12, GetParam());
  const Vec b = Vec::Zero(chain.M.rows()), c = right_hand(chain);
  SparseMassKkt sparse;
  ASSERT_TRUE(sparse.factorise(chain.bodies, int(chain.G.rows()), SparseMassKkt::Metric::identity));
  Vec x, y;
  sparse.solve(chain.bodies, b, c, x, y);
  const Vec least = chain.G.completeOrthogonalDecomposition().solve(c);
  EXPECT_LT((x - least).norm(), 1e-11 * least.norm());
}

// Rows (1, 0) and (1, sine), S = 1: c = (0, delta) asks for x = (0, delta/sine).
TEST(SparseIteration, DoesNotFollowTheRoundOffOfRowsThatAreNearlyDependent) {
  const double delta = 1e-15;
  for (double sine = 1e-1; sine > 1e-10; sine /= 3) {
    Mat G(2, 2), full = Mat::Identity(4, 4);
    G << 1, 0, 1, sine;
    full.bottomRows(2) << G, Mat::Zero(2, 2);
    full.topRightCorner(2, 2) = G.transpose();
    SparseIterationKkt kkt;
    kkt.factorise(full.sparseView(), 2);
    Vec x, y;
    ASSERT_TRUE(kkt.solve(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, delta), x, y)) << sine;
    EXPECT_LT(x.norm(), 1e5 * delta)
        << sine;  // the rows' round-off over the sine below which they count as dependent, 1e-5
    if (sine > 1e-3) {
      EXPECT_NEAR(x(1), delta / sine, 1e-4 * delta / sine) << sine;
    }
    // A force along the second row: held, or free, or between; the equation of motion holds by what y then
    // is.
    const Eigen::Vector2d b(0, 1);
    ASSERT_TRUE(kkt.solve(b, Eigen::Vector2d(0, 0), x, y)) << sine;
    EXPECT_LT((x + G.transpose() * y - b).norm(), 1e-9) << sine;
    EXPECT_GE(x(1), -1e-9) << sine;
    EXPECT_LE(x(1), 1 + 1e-9) << sine;
  }
}

INSTANTIATE_TEST_SUITE_P(Redundant, SparseMass, testing::Values(0, 1, 5));

}  // namespace
}  // namespace trammel::numerics
