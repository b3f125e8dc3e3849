#include "linear/bodies/body_masses.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace trammel::numerics {
namespace {

// A diagonal mass, one that is not, and one more that is.
std::vector<BodyBlock> three_bodies() {
  std::vector<BodyBlock> bodies(3);
  bodies[0].M = Eigen::Vector3d(2, 3, 4).asDiagonal();
  bodies[1].M = (Eigen::Matrix3d() << 4, 1, 0, 1, 3, 1, 0, 1, 5).finished();
  bodies[2].M = Eigen::Vector2d(0.5, 1e-9).asDiagonal();
  bodies[1].v0 = 3, bodies[2].v0 = 6;
  return bodies;
}

Mat whole(const std::vector<BodyBlock>& bodies) {
  Mat M = Mat::Zero(8, 8);
  for (const BodyBlock& body : bodies) M.block(body.v0, body.v0, body.M.rows(), body.M.rows()) = body.M;
  return M;
}

void expect_solved(const std::vector<BodyBlock>& bodies, BodyMasses& masses) {
  const Vec b = Vec::LinSpaced(8, 1, 2), expected = whole(bodies).llt().solve(b);
  Vec x = b;
  masses.solve(x);
  EXPECT_LT((x - expected).norm(), 1e-15 * expected.norm());
}

TEST(BodyMasses, SolveAsTheWholeMatrix) {
  std::vector<BodyBlock> bodies = three_bodies();
  BodyMasses masses;
  ASSERT_TRUE(masses.factorise(bodies));
  expect_solved(bodies, masses);
  EXPECT_EQ(masses.dense(0), nullptr);
  EXPECT_NE(masses.dense(1), nullptr);
  bodies[0].M(1, 0) = bodies[0].M(0, 1) = 0.5;  // as of a body that turns
  bodies[1].M = Mat::Identity(3, 3);
  ASSERT_TRUE(masses.factorise(bodies));
  expect_solved(bodies, masses);
}

// C^-1 as RowComplement puts it together: by rows, the diagonal first.
TEST(BodyMasses, RootsAreThoseOfTheInverse) {
  const std::vector<BodyBlock> bodies = three_bodies();
  BodyMasses masses;
  ASSERT_TRUE(masses.factorise(bodies));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Eigen::Index n = bodies[k].M.rows();
    Mat C = Eigen::Map<const Vec>(masses.inverse_roots(bodies[k]), n).asDiagonal();  // C^-T, of rows
    if (const Cholesky* dense = masses.dense(k)) dense->solve_lower_of_rows(C);
    EXPECT_LT((C * C.transpose() * bodies[k].M - Mat::Identity(n, n)).norm(), 1e-14);
  }
}

TEST(BodyMasses, OfTheIdentityChangeNothingAlsoAfterMasses) {
  const std::vector<BodyBlock> bodies = three_bodies();
  BodyMasses masses;
  ASSERT_TRUE(masses.factorise(bodies));
  masses.take_identity(bodies);
  EXPECT_FALSE(masses.are_of(bodies)) << "the masses of before are gone";
  const Vec b = Vec::LinSpaced(8, 1, 2);
  Vec x = b;
  masses.solve(x);
  EXPECT_EQ(x, b);
  EXPECT_EQ(masses.dense(1), nullptr);
  ASSERT_TRUE(masses.factorise(bodies));
  expect_solved(bodies, masses);
}

TEST(BodyMasses, AreOfAsManyBodiesAndVelocities) {
  const std::vector<BodyBlock> bodies = three_bodies();
  BodyMasses masses;
  EXPECT_FALSE(masses.are_of(bodies));
  ASSERT_TRUE(masses.factorise(bodies));
  EXPECT_TRUE(masses.are_of(bodies));
  std::vector<BodyBlock> other = bodies;
  other[2].M = Mat::Identity(3, 3);
  EXPECT_FALSE(masses.are_of(other)) << "a body that grew";
  other = bodies;
  other[1].M = Mat::Identity(2, 2), other[2].v0 = 5;
  other.emplace_back().v0 = 7, other.back().M = Mat::Identity(1, 1);
  EXPECT_FALSE(masses.are_of(other)) << "as many velocities of one body more";
}

TEST(BodyMasses, RefuseWhatIsNotPositiveDefinite) {
  for (const double m : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const std::size_t k : {0u, 1u}) {
      std::vector<BodyBlock> bodies = three_bodies();
      bodies[k].M(2, 2) = m;
      EXPECT_FALSE(BodyMasses().factorise(bodies)) << m << " in body " << k;
    }
}

}  // namespace
}  // namespace trammel::numerics
