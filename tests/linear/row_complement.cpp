// The complement of the rows of many bodies, against the dense one: chains, rings, stars and grids of bodies.
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "linear/complement/row_complement.hpp"

namespace trammel::numerics {
namespace {

using Joints = std::vector<std::pair<int, int>>;  // bodies; -1: the ground

// Bodies of unit masses that joints of `rows` rows each hold together, no entry of which is 0.
struct Mechanism {
  std::vector<BodyBlock> bodies;
  BodyMasses masses;
  int nc;

  Mechanism(int n, int velocities, const Joints& joints, int rows)
      : bodies(std::size_t(n)), nc(int(joints.size()) * rows) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (BodyBlock& body : bodies) {
      body.v0 = velocities * int(&body - bodies.data());
      body.M.setIdentity(velocities, velocities);
      body.Gt.resize(velocities, 0);
    }
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      for (const int k : {joints[joint].first, joints[joint].second}) {
        if (k < 0) continue;
        BodyBlock& body = bodies[std::size_t(k)];
        body.Gt.conservativeResize(velocities, body.Gt.cols() + rows);
        body.Gt.rightCols(rows) = Mat::NullaryExpr(velocities, rows, [&] { return uniform(random); });
        for (int i = 0; i < rows; ++i) body.rows.push_back(int(joint) * rows + i);
      }
    masses.take_identity(bodies);
  }

  Mat dense(int first) const {
    Mat S = Mat::Zero(nc, nc);
    for (const BodyBlock& body : bodies) {
      const Mat share = body.Gt.transpose() * body.Gt;
      for (std::size_t i = 0; i < body.rows.size(); ++i)
        for (std::size_t j = 0; j < body.rows.size(); ++j)
          S(body.rows[i], body.rows[j]) += share(Eigen::Index(i), Eigen::Index(j));
    }
    return S.topLeftCorner(first, first);
  }
};

Joints chain(int n) {
  Joints joints;
  for (int k = 0; k < n; ++k) joints.emplace_back(k - 1, k);
  return joints;
}
Joints ring(int n) {
  Joints joints = chain(n);
  joints.front().first = n - 1;
  return joints;
}
Joints star(int n) {
  Joints joints;
  for (int k = 1; k < n; ++k) joints.emplace_back(k, 0);
  return joints;
}
Joints grid(int n) {
  Joints joints;
  for (int i = 0; i * i < n; ++i)
    for (int j = 0; j * j < n; ++j) {
      int side = 0;
      while (side * side < n) ++side;
      if (j + 1 < side) joints.emplace_back(i * side + j, i * side + j + 1);
      if (i + 1 < side) joints.emplace_back(i * side + j, (i + 1) * side + j);
    }
  return joints;
}

struct Case {
  const char* name;
  std::function<Joints(int)> joints;
  int bodies, velocities, rows;
};

class RowComplementOf : public testing::TestWithParam<Case> {
 protected:
  Mechanism mechanism() const {
    const Case& of = GetParam();
    return {of.bodies, of.velocities, of.joints(of.bodies), of.rows};
  }
};

// Against the dense solution, by the residual: round-off of sums of some dozen products.
void expect_solved(const Mat& S, RowComplement& complement) {
  const Vec r = Vec::LinSpaced(S.rows(), 1, -2);
  Vec y;
  complement.solve(r, y);
  EXPECT_LT((S * y - r).norm(), 1e-14 * S.norm() * y.norm());
}

// Two rows of one body at an angle: its sine decides, not its square.
TEST(RowComplement, RefusesRowsAtLessThanTheLeastSine) {
  const auto factorised = [](double angle) {
    std::vector<BodyBlock> bodies(1);
    bodies[0].M = Mat::Identity(2, 2);
    bodies[0].Gt = Eigen::Matrix2d{{1, std::cos(angle)}, {0, std::sin(angle)}};
    bodies[0].rows = {0, 1};
    BodyMasses masses;
    masses.take_identity(bodies);
    return RowComplement().factorise(bodies, masses, 2, 1e-4);
  };
  EXPECT_TRUE(factorised(2e-4));
  EXPECT_FALSE(factorised(0.5e-4));
}

// The last joint holds the last body to the ground, then to the body before it, and to the ground again: only that body
// has rows more, or fewer, than before.
TEST(RowComplement, FollowsRowsThatComeToABodyAndLeaveIt) {
  Joints to_ground = chain(4), to_body = chain(4);
  to_ground.back().first = -1;
  RowComplement complement;
  for (const Joints& joints : {to_ground, to_body, to_ground}) {
    const Mechanism m(4, 6, joints, 3);
    ASSERT_TRUE(complement.factorise(m.bodies, m.masses, m.nc, 1e-7));
    expect_solved(m.dense(m.nc), complement);
  }
}

TEST_P(RowComplementOf, SolvesAsTheWholeMatrix) {
  const Mechanism m = mechanism();
  RowComplement complement;
  ASSERT_TRUE(complement.factorise(m.bodies, m.masses, m.nc, 1e-7));
  expect_solved(m.dense(m.nc), complement);
}

TEST_P(RowComplementOf, LeavesOutRowsBeyondThoseAskedFor) {
  const Mechanism m = mechanism();
  RowComplement complement;
  for (const int nc : {m.nc, m.nc - 1, m.nc / 2, m.nc}) {
    ASSERT_TRUE(complement.factorise(m.bodies, m.masses, nc));
    expect_solved(m.dense(nc), complement);
  }
}

TEST_P(RowComplementOf, SolutionsDoNotDependOnWhatWasBefore) {
  const Mechanism m = mechanism(), other(3, 6, chain(3), 2);
  const Vec r = Vec::LinSpaced(m.nc, 1, -2);
  RowComplement fresh, used;
  Vec y, y_again;
  ASSERT_TRUE(fresh.factorise(m.bodies, m.masses, m.nc));
  fresh.solve(r, y);
  ASSERT_TRUE(used.factorise(other.bodies, other.masses, other.nc));
  ASSERT_FALSE(used.factorise(m.bodies, m.masses, m.nc, 1));
  ASSERT_TRUE(used.factorise(m.bodies, m.masses, m.nc));
  used.solve(r, y_again);
  EXPECT_EQ(y, y_again);
}

TEST_P(RowComplementOf, TellsARowSaidTwice) {
  const Mechanism before = mechanism();
  Mechanism m = before;
  // The last joint's last row again as its first: one pivot is round-off.
  const int last = m.nc - 1, first = m.nc - GetParam().rows;
  for (std::size_t k = 0; k < m.bodies.size(); ++k) {
    const std::vector<int>& rows = m.bodies[k].rows;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < rows.size(); ++j)
        if (rows[i] == last && rows[j] == first)
          m.bodies[k].Gt.col(Eigen::Index(i)) = m.bodies[k].Gt.col(Eigen::Index(j));
  }
  RowComplement complement;
  EXPECT_FALSE(complement.factorise(m.bodies, m.masses, m.nc, 1e-6));
  EXPECT_TRUE(complement.factorise(before.bodies, before.masses, m.nc, 1e-6)) << "what it was before is forgotten";
}

// Whatever was solved; and its least eigenvalue itself where the right side has that direction alone.
TEST_P(RowComplementOf, SoftnessIsAMeanOfItsEigenvalues) {
  const Mechanism m = mechanism();
  RowComplement complement;
  ASSERT_TRUE(complement.factorise(m.bodies, m.masses, m.nc));
  const Mat S = m.dense(m.nc);
  const Vec roots = S.diagonal().cwiseSqrt(), inverse = roots.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Mat> modes(inverse.asDiagonal() * S * inverse.asDiagonal());
  const Vec r = Vec::LinSpaced(m.nc, 1, -2), softest = roots.cwiseProduct(modes.eigenvectors().col(0));
  Vec y;
  complement.solve(r, y);
  EXPECT_GE(complement.softness(r, y), (1 - 1e-6) * modes.eigenvalues()[0]);
  EXPECT_LE(complement.softness(r, y), (1 + 1e-6) * modes.eigenvalues()[m.nc - 1]);
  complement.solve(softest, y);
  EXPECT_NEAR(complement.softness(softest, y), modes.eigenvalues()[0], 1e-9 * modes.eigenvalues()[0]);
}

// A ring of balls has rows to spare: 3 n of 6 n; grids of four rows a joint in the mean 1.8 joints a body.
INSTANTIATE_TEST_SUITE_P(Mechanisms, RowComplementOf,
                         testing::Values(Case{"ChainOfHinges", chain, 30, 6, 5}, Case{"ChainOfPins", chain, 30, 3, 2},
                                         Case{"RingOfBalls", ring, 20, 6, 3}, Case{"StarOfHinges", star, 12, 6, 5},
                                         Case{"StarOfFixedBodies", star, 2, 6, 6}, Case{"GridOfBalls", grid, 64, 6, 3},
                                         Case{"ChainOfMembranes", chain, 4, 60, 20}, Case{"OneBody", chain, 1, 6, 5}),
                         [](const auto& of) { return of.param.name; });

// Unit masses along a line, each row a second difference of three of them: the softest direction, half a wave, falls
// with n^-4.
Mechanism beam_of_masses(int n) {
  Mechanism m(n + 2, 1, {}, 0);
  for (int row = 0; row < n; ++row)
    for (int k = 0; k < 3; ++k) {
      BodyBlock& body = m.bodies[std::size_t(row + k)];
      body.Gt.conservativeResize(1, body.Gt.cols() + 1);
      body.Gt(0, body.Gt.cols() - 1) = k == 1 ? -2 : 1;
      body.rows.push_back(row);
    }
  m.nc = n;
  return m;
}

// Noise has of each direction about as much; the solution has of the k-th softest k^-4 times as much as of the softest.
// Where it happens to have hardly any of that one, the next ones show it, the fourth by 256 times its eigenvalue.
TEST(RowComplement, SoftnessOfNoiseIsThatOfTheSoftestDirections) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int n = 100; n < 1000; n += 7) {
    const Mechanism m = beam_of_masses(n);
    RowComplement complement;
    ASSERT_TRUE(complement.factorise(m.bodies, m.masses, n));
    const Vec r = Vec::NullaryExpr(n, [&] { return normal(random); });
    Vec y;
    complement.solve(r, y);
    const double least = std::pow(2 * std::sin(std::acos(-1) / (2 * (n + 1))), 4) / 6;  // of a diagonal of 6
    EXPECT_GE(complement.softness(r, y), (1 - 1e-3) * least) << n;
    EXPECT_LE(complement.softness(r, y), 256 * least) << n;
  }
}

TEST(RowComplement, OfBodiesThatGrowHasRoomForThem) {
  const Mechanism small(4, 3, chain(4), 2), large(4, 6, chain(4), 2);
  RowComplement complement;
  for (const Mechanism* m : {&small, &large}) {
    ASSERT_TRUE(complement.factorise(m->bodies, m->masses, m->nc));
    expect_solved(m->dense(m->nc), complement);
  }
}

TEST(RowComplement, OfNoRowsIsEmpty) {
  const Mechanism m(2, 6, {}, 0);
  RowComplement complement;
  EXPECT_TRUE(complement.factorise(m.bodies, m.masses, 0, 1e-6));
  Vec y;
  complement.solve(Vec(), y);
  EXPECT_EQ(y.size(), 0);
}

}  // namespace
}  // namespace trammel::numerics
