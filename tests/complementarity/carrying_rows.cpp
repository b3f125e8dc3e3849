// How closed contacts carry their resultants: shares as of equal springs, groups of contacts that share, and the
// equations of contacts that stick and slide.
#include "complementarity/shares/carrying_rows.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include <trammel/decompositions.hpp>

#include "complementarity/shares/carrying_equations.hpp"
#include "complementarity/shares/independent_rows.hpp"

namespace trammel::complementarity {
namespace {

using Tangent = ContactRole::Tangent;

Mat random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> any;
  return Mat::NullaryExpr(rows, columns, [&] { return any(random); });
}

// Feet at these places under a beam of mass 1 and moment of inertia 1, and the same on a second beam.
Mat beams(const std::vector<double>& first, const std::vector<double>& second) {
  Mat G = Mat::Zero(Eigen::Index(first.size() + second.size()), 4);
  for (std::size_t i = 0; i < first.size(); ++i) G.row(Eigen::Index(i)) << 1, first[i], 0, 0;
  for (std::size_t i = 0; i < second.size(); ++i) G.row(Eigen::Index(first.size() + i)) << 0, 0, 1, second[i];
  return G;
}

std::vector<ContactPoint> normals(Eigen::Index n) {
  std::vector<ContactPoint> points;
  for (Eigen::Index i = 0; i < n; ++i) points.push_back({.normal = int(i)});
  return points;
}

TEST(CarryingRows, ShareAsEqualSpringsUnderABeam) {
  const Mat G = beams({-1, 0, 2}, {});
  const CarryingRows carrying =
      carrying_rows(normals(3), G * G.transpose(), std::vector<ContactRole>(3, {.closed = true}));
  std::vector<Eigen::Index> order = carrying.rows.basis;
  order.insert(order.end(), carrying.rows.implied.begin(), carrying.rows.implied.end());
  ASSERT_EQ(carrying.rows.basis.size(), 2u);
  // Springs give way as a rigid beam moves: F is a linear function of the place.
  const Mat shared = carrying.share * Vec{{1, 3}};
  Vec F(3);
  for (std::size_t k = 0; k < 3; ++k) F[order[k]] = shared(Eigen::Index(k), 0);
  EXPECT_NEAR((F[1] - F[0]) / 1, (F[2] - F[1]) / 2, 1e-13);
  EXPECT_NEAR((carrying.rows.resultants() * shared - Vec{{1, 3}}).norm(), 0, 1e-13);
  EXPECT_EQ(carrying.indeterminate, std::vector<bool>(3, true));
  EXPECT_FALSE(carrying.sliding_shares);
}

TEST(CarryingRows, LeaveIdleAndOpenContactsWithoutAShare) {
  const Mat G = beams({-1, 0, 2, 3}, {});
  std::vector<ContactRole> roles(4, {.closed = true});
  roles[0].closed = false;
  roles[2].idle = true;
  const CarryingRows carrying = carrying_rows(normals(4), G * G.transpose(), roles);
  EXPECT_EQ(carrying.rows.implied, std::vector<Eigen::Index>{2});
  EXPECT_EQ(carrying.rows.basis.size(), 2u);
  EXPECT_EQ(carrying.share.bottomRows(1), Mat::Zero(1, 2));
  EXPECT_NEAR((carrying.share.topRows(2) - Mat::Identity(2, 2)).norm(), 0, 1e-14);
  EXPECT_EQ(carrying.indeterminate, (std::vector<bool>{false, true, true, true}));
}

// The rows of a contact need not be in the order of contacts.
TEST(CarryingRows, BelongToTheContactsThatNameThem) {
  const std::vector<ContactPoint> points{{.normal = 1}, {.tangent = 0, .given = 1}, {.tangent = 2, .given = 1}};
  const Mat G{{1, 0}, {0, 1}, {1, 0}};
  const std::vector<ContactRole> roles{
      {.closed = true}, {.closed = true, .tangent = Tangent::sticks}, {.closed = true, .tangent = Tangent::sticks}};
  const CarryingRows carrying = carrying_rows(points, G * G.transpose(), roles);
  EXPECT_EQ(carrying.indeterminate, (std::vector<bool>{false, true, true}));
}

TEST(CarryingRows, OfLeastNormForAnyBasisAndAnyIdleContacts) {
  std::mt19937 random(81);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Index n = 1 + Eigen::Index(random() % 4), m = n + 1 + Eigen::Index(random() % 4);
    const Mat E = random_matrix(random, n, m);
    std::vector<bool> idle(std::size_t(m), false);
    if (i % 2) idle[random() % std::size_t(m)] = true;
    const Mat share = least_norm_shares(E, idle);
    EXPECT_NEAR((E * share - Mat::Identity(n, n)).norm(), 0, 1e-9 * share.norm()) << i;
    // Least norm: orthogonal to every self-stress, and so E^T X where contacts carry.
    Mat carrying = E;
    for (Eigen::Index k = 0; k < m; ++k)
      if (idle[std::size_t(k)]) {
        EXPECT_EQ(share.row(k).norm(), 0) << i;
        carrying.col(k).setZero();
      }
    const Mat gram = carrying * carrying.transpose(), wanted = Eigen::LDLT<Mat>(gram).solve(carrying);
    EXPECT_NEAR((share - wanted.transpose()).norm(), 0, 1e-8 * share.norm()) << i;
    const Vec resultants = random_matrix(random, n, 1);
    EXPECT_NEAR(force_as_spring(E, resultants),
                E.col(m - 1).dot(Vec(Eigen::LDLT<Mat>(Mat(E * E.transpose())).solve(resultants))),
                1e-8 * share.norm() * resultants.norm())
        << i;
  }
  const Mat K = random_matrix(random, 3, 2);
  Mat E(2, 5);
  E << Mat::Identity(2, 2), K.transpose();
  EXPECT_NEAR((least_norm_shares(K) - least_norm_shares(E, std::vector<bool>(5, false))).norm(), 0, 1e-14);
}

// Rows that follow from the joints' rows alone have no resultants.
TEST(CarryingRows, OfWhichNoneIsIndependentHaveNoShares) {
  const Mat share = least_norm_shares(Mat::Zero(0, 3), {false, true, false});
  EXPECT_EQ(share.rows(), 3);
  EXPECT_EQ(share.cols(), 0);
}

// Two contacts that carry, along (1, 0) and (1, d), beside one along (0, 1). Where d passes 0 their forces may stay
// finite, although the inverse does not.
TEST(CarryingRows, ShareAcrossADependenceAsALittleBesideIt) {
  for (const double d : {1e-2, 1e-4, 1e-6, 1e-7, 1e-9, 1e-12, 1e-16, 0.0}) {
    for (const double sign : {1.0, -1.0}) {
      Mat E(2, 3);
      E << 1, 1, 0, 0, sign * d, 1;
      const Mat share = least_norm_shares(E, {false, false, true});
      SCOPED_TRACE(sign * d);
      EXPECT_LE(share.norm(), 2e8);
      EXPECT_EQ(share.row(2).norm(), 0);
      const Mat carried = E * share;
      EXPECT_NEAR(carried(0, 0), 1, 1e-7);
      EXPECT_NEAR(carried(0, 1), 0, 1e-7 * share.norm());
      EXPECT_NEAR(carried(1, 0), 0, 1e-7);
      if (d < 1e-7) continue;
      EXPECT_NEAR(share(1, 1) * sign * d, 1, 1e-8);
      EXPECT_NEAR(share(0, 1) * sign * d, -1, 1e-8);
    }
  }
}

// The third foot of each beam follows from the others; a contact on its own shares with none.
TEST(SharingGroups, AreTheContactsOfOneBody) {
  Mat G = Mat::Zero(7, 5);
  G.topLeftCorner(6, 4) = beams({-1, 0, 2}, {-1, 1, 4});
  G(6, 4) = 1;
  const Mat A = G * G.transpose();
  std::vector<ContactRole> roles(7, {.closed = true});
  std::vector<ContactPoint> points = normals(7);
  points[4].tangent = 6, points[6].normal = -1;
  roles[4].tangent = Tangent::slides;
  const CarryingRows carrying = carrying_rows(points, A, roles);
  EXPECT_TRUE(carrying.sliding_shares);
  EXPECT_FALSE(carrying.indeterminate[6]);
  std::vector<SharingGroup> groups = sharing_groups(points, roles, carrying);
  ASSERT_EQ(groups.size(), 2u);
  std::sort(groups.begin(), groups.end(),
            [](const SharingGroup& a, const SharingGroup& b) { return a.implied[0] < b.implied[0]; });
  for (int k = 0; k < 2; ++k) {
    const SharingGroup& group = groups[std::size_t(k)];
    std::vector<Eigen::Index> rows = group.basis;
    rows.insert(rows.end(), group.implied.begin(), group.implied.end());
    EXPECT_EQ(group.basis.size(), 2u);
    ASSERT_EQ(group.K.rows(), Eigen::Index(group.implied.size()));
    ASSERT_EQ(group.K.cols(), Eigen::Index(group.basis.size()));
    EXPECT_NEAR((G(group.implied, Eigen::all) - group.K * G(group.basis, Eigen::all)).norm(), 0, 1e-13);
    EXPECT_NEAR((group.share - least_norm_shares(group.K)).norm(), 0, 1e-13);
    std::sort(rows.begin(), rows.end());
    EXPECT_EQ(rows, (std::vector<Eigen::Index>{3 * k, 3 * k + 1, 3 * k + 2}));
  }
  EXPECT_TRUE(groups[0].sliding.empty());
  EXPECT_EQ(groups[1].sliding, std::vector<std::size_t>{4});
}

// Two contacts that stick to one body, which only moves in parallel, beside one on a body of its own. The rows of the
// first one are the last.
TEST(SharingGroups, HaveTheContactsOfTheirTangents) {
  std::vector<ContactPoint> points(3);
  for (int k = 0; k < 3; ++k) {
    ContactPoint& p = points[std::size_t(k)];
    p.normal = 3 * (2 - k), p.tangent = p.normal + 1, p.tangents = 2;
    p.kind = ContactPoint::Tangent::resting, p.coefficient = 1;
  }
  Mat G = Mat::Zero(9, 6);
  for (int k = 0; k < 3; ++k) G.block(3 * k, k < 2 ? 0 : 3, 3, 3).setIdentity();
  std::vector<ContactRole> roles(3, {.closed = true, .tangent = Tangent::sticks});
  for (const bool closed : {true, false}) {
    for (ContactRole& role : roles) role.closed = closed;
    const CarryingRows carrying = carrying_rows(points, G * G.transpose(), roles);
    EXPECT_EQ(carrying.indeterminate, (std::vector<bool>{false, true, true})) << closed;
    const std::vector<SharingGroup> groups = sharing_groups(points, roles, carrying);
    ASSERT_EQ(groups.size(), 1u) << closed;
    std::vector<Eigen::Index> rows = groups[0].basis;
    rows.insert(rows.end(), groups[0].implied.begin(), groups[0].implied.end());
    std::sort(rows.begin(), rows.end());
    EXPECT_EQ(rows, closed ? (std::vector<Eigen::Index>{0, 1, 2, 3, 4, 5}) : (std::vector<Eigen::Index>{1, 2, 4, 5}));
  }
}

TEST(SharingGroups, HoldIdleContactsOnTheBestBasisIfTheOthersCarryAll) {
  const Mat G = beams({-1, -0.99, 4, 1}, {});
  const Mat A = G * G.transpose();
  const auto group = group_with_idle(A, {0, 1, 2}, {2});
  ASSERT_TRUE(group);
  const std::vector<Eigen::Index>& basis = group->basis;
  EXPECT_NE(std::find(basis.begin(), basis.end(), Eigen::Index(2)), basis.end());
  std::vector<Eigen::Index> order = basis;
  order.insert(order.end(), group->implied.begin(), group->implied.end());
  ASSERT_EQ(order.size(), 3u);
  EXPECT_NEAR((G(group->implied, Eigen::all) - group->K * G(basis, Eigen::all)).norm(), 0, 1e-12);
  const auto idle = std::find(order.begin(), order.end(), Eigen::Index(2)) - order.begin();
  EXPECT_EQ(group->share.row(idle).norm(), 0);
  EXPECT_NEAR((G(order, Eigen::all).transpose() * group->share - G(basis, Eigen::all).transpose()).norm(), 0, 1e-10);
  EXPECT_FALSE(group_with_idle(A, {0, 1, 2}, {1, 2}));
}

TEST(IndependentRows, HaveTheRankAndTheNullSpace) {
  std::mt19937 random(82);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Index rank = 1 + Eigen::Index(random() % 4);
    const Mat E = random_matrix(random, 5, rank) * random_matrix(random, rank, 6);
    const Mat rows = independent_rows(E);
    EXPECT_EQ(rows.rows(), rank) << i;
    // Combinations with orthonormal columns: the same lengths of E F.
    EXPECT_NEAR((rows.transpose() * rows - E.transpose() * E).norm(), 0, 1e-12 * E.squaredNorm()) << i;
    const Mat rough = E + 1e-12 * random_matrix(random, 5, 6);  // round-off is no row
    EXPECT_EQ(independent_rows(rough).rows(), rank) << i;
  }
}

// Contacts of every kind: sticks, slides, without friction, with a given normal force that slides or sticks, and open.
TEST(CarryingEquations, HoldContactsAtRestAndKeepTheRatiosOfSlidingOnes) {
  std::mt19937 random(83);
  std::uniform_real_distribution<double> part(-0.3, 0.3);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    std::vector<ContactPoint> points;
    std::vector<ContactRole> roles;
    const Eigen::Index t = 1 + i % 2, m = 4 * (1 + t) + 2 * t + 1;
    for (int k = 0, row = 0; k < 7; ++k) {
      ContactPoint& p = points.emplace_back();
      ContactRole& role = roles.emplace_back();
      if (k < 4 || k == 6) p.normal = row++, role.closed = k != 3;
      if (k < 6) p.tangent = row, p.tangents = int(t), row += int(t);
      p.kind = ContactPoint::Tangent::resting, p.coefficient = k == 2 ? 0 : 0.5, p.given = k == 4 || k == 5 ? 2.0 : 0;
      if (k == 0 || k == 5) role.tangent = Tangent::sticks;
      if (k == 1 || k == 4) role.tangent = Tangent::slides, role.ratio = {part(random), t == 2 ? part(random) : 0};
    }
    Mat G = random_matrix(random, m, m + 2);
    if (i % 3 == 0) G.row(points[6].normal) = G.row(points[0].normal) + G.row(points[2].normal);
    const Mat A = G * G.transpose() * std::pow(10, part(random) * 10);
    Vec b = random_matrix(random, m, 1);
    if (i % 3 == 0) b[points[6].normal] = b[points[0].normal] + b[points[2].normal];
    const CarryingRows carrying = carrying_rows(points, A, roles);
    const CarryingEquations equations(points, A, b, roles, carrying);
    if (equations.least_pivot() < 1e-3) continue;
    EXPECT_TRUE(equations.regular());
    const Vec F = equations.forces(), a = A * F + b;
    const double little = 1e-9 * (A.cwiseAbs() * F.cwiseAbs()).maxCoeff();
    for (const std::size_t k : {0, 1, 2, 6}) EXPECT_NEAR(a[points[k].normal], 0, little);
    for (const std::size_t k : {0, 5}) EXPECT_NEAR(a.segment(points[k].tangent, t).norm(), 0, little);
    const auto T = [&](std::size_t k) { return Vec(F.segment(points[k].tangent, t)); };
    EXPECT_NEAR((T(1) - F[points[1].normal] * roles[1].ratio.head(t)).norm(), 0, 1e-12 * F.norm());
    EXPECT_NEAR((T(4) - 2 * roles[4].ratio.head(t)).norm(), 0, 1e-14);
    EXPECT_EQ(T(2).norm() + T(3).norm() + std::abs(F[points[3].normal]), 0);
    // Equal springs: no self-stress, as of 1 at the two contacts and -1 at the one that follows from them.
    if (i % 3 == 0) {
      EXPECT_NEAR(F[points[0].normal] + F[points[2].normal] - F[points[6].normal], 0, 1e-9 * F.norm());
    }
    // What accelerations along the basis are left, a correction of the resultants cancels.
    const Vec off = random_matrix(random, m, 1), change = equations.correction(off);
    EXPECT_NEAR((equations.correction(a)).norm(), 0, 1e-9 * F.norm());
    EXPECT_NEAR((equations.correction(2 * off) - 2 * change).norm(), 0, 1e-12 * change.norm());
  }
}

TEST(CarryingEquations, HaveNoSolutionAtPainlevesCriticalCoefficient) {
  // a_n = N - T, and T = p N with p = 1 keeps a_n as it is.
  const std::vector<ContactPoint> points{{.normal = 0, .tangent = 1}};
  for (const auto& [p, mass] : {std::pair{1.0, 1.0}, {0.999, 1.0}, {0.999, 4096.0}, {0.999, 1.0 / 4096}}) {
    const Mat A = Mat{{1, -1}, {-1, 2}} / mass;
    ContactRole role{.closed = true, .tangent = Tangent::slides, .ratio = {p, 0}};
    const CarryingEquations equations(points, A, Vec{{-1, 0}}, {role}, carrying_rows(points, A, {role}));
    EXPECT_EQ(equations.regular(), p < 1);
    EXPECT_NEAR(equations.least_pivot(), 1 - p, 1e-15);
    if (p < 1) {
      EXPECT_NEAR(equations.forces()[0], 1000 * mass, 1e-9 * mass);
    }
  }
  const Mat A = Mat::Identity(2, 2);
  const CarryingEquations none(points, A, Vec{{1, 0}}, {ContactRole{}}, carrying_rows(points, A, {ContactRole{}}));
  EXPECT_EQ(none.least_pivot(), 1);
  EXPECT_EQ(none.forces(), Vec::Zero(2));
}

}  // namespace
}  // namespace trammel::complementarity
