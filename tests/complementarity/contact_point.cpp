// How far forces are from the conditions of one contact, against closed forms.
#include "complementarity/programs/contact_point.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace trammel::complementarity {
namespace {

using Tangent = ContactPoint::Tangent;

// Relative to b alone: `a` is given, and A F is small beside b.
double off(const ContactPoint& p, const Mat& A, const Vec& F, const Vec& a) {
  Vec b = Vec::Zero(a.size() + 1);
  b[a.size()] = 1e6;
  Mat all = Mat::Zero(b.size(), b.size());
  all.topLeftCorner(a.size(), a.size()) = A;
  Vec F_all = Vec::Zero(b.size()), a_all = F_all;
  F_all.head(a.size()) = F, a_all.head(a.size()) = a;
  return 1e6 * violation({p}, all, b, F_all, a_all, 0);
}

TEST(Violation, OfANormalIsTheSmallerOfItsAccelerationAndThatOfItsForce) {
  const ContactPoint p{.normal = 0};
  const Mat A{{4.0}};
  EXPECT_NEAR(off(p, A, Vec{{0.0}}, Vec{{3.0}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{2.0}}, Vec{{0.0}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{2.0}}, Vec{{3.0}}), 3, 1e-6);
  EXPECT_NEAR(off(p, A, Vec{{0.5}}, Vec{{3.0}}), 2, 1e-6);
  EXPECT_NEAR(off(p, A, Vec{{-0.5}}, Vec{{3.0}}), 2, 1e-6);
  EXPECT_NEAR(off(p, A, Vec{{2.0}}, Vec{{-3.0}}), 3, 1e-6);
}

TEST(Violation, OfFrictionInThePlane) {
  ContactPoint p{.normal = 0, .tangent = 1, .kind = Tangent::resting, .coefficient = 0.5};
  const Mat A{{4, 1}, {1, 2}};
  EXPECT_NEAR(off(p, A, Vec{{2, -1}}, Vec{{0, 3}}), 0, 1e-12);  // slides
  EXPECT_NEAR(off(p, A, Vec{{2, 1}}, Vec{{0, -3}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{2, 0.3}}, Vec{{0, 0}}), 0, 1e-12);          // sticks
  EXPECT_NEAR(off(p, A, Vec{{2, 1.2}}, Vec{{0, 0}}), 2 * 0.2, 1e-6);     // leaves its cone
  EXPECT_NEAR(off(p, A, Vec{{2, 1}}, Vec{{0, 3}}), 3, 1e-6);             // friction pushes
  EXPECT_NEAR(off(p, A, Vec{{2, 0.3}}, Vec{{0, 0.4}}), 0.4, 1e-6);       // moves in its cone
  EXPECT_NEAR(off(p, A, Vec{{2, 0.3}}, Vec{{0, 100}}), 2 * 1.3, 1e-6);   // likewise, farther than the cone is wide
  EXPECT_NEAR(off(p, A, Vec{{-2, 0}}, Vec{{0, 3}}), 8, 1e-6);            // a normal force that pulls has no friction
  EXPECT_NEAR(off(p, A, Vec{{0.1, 0.1}}, Vec{{0, 0}}), 2 * 0.05, 1e-6);  // likewise, of a light contact
  p.coefficient = 0;
  EXPECT_NEAR(off(p, A, Vec{{2, 0}}, Vec{{0, 3}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{2, 0.25}}, Vec{{0, 0}}), 2 * 0.25, 1e-6);
}

TEST(Violation, OfFrictionInSpaceIsMeasuredByTheMeanOfItsStiffness) {
  const ContactPoint p{.normal = 0, .tangent = 1, .tangents = 2, .kind = Tangent::resting, .coefficient = 0.5};
  const Mat A{{4, 0, 0}, {0, 2, 0}, {0, 0, 6}};
  EXPECT_NEAR(off(p, A, Vec{{2, -0.6, 0.8}}, Vec{{0, 3, -4}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{2, 0.6, 0.8}}, Vec{{0, 0, 0}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{2, 0.9, 1.2}}, Vec{{0, 0, 0}}), 4 * 0.5, 1e-6);
  EXPECT_NEAR(off(p, A, Vec{{2, 0, 0}}, Vec{{0, 0.3, -0.4}}), 0.5, 1e-6);
  // On the bound, but not against the slip: the way along the disk to where T - a_t/4 projects.
  const double turned = (Eigen::Vector2d(1, 1) / std::sqrt(2) - Eigen::Vector2d(1, 0)).norm();
  EXPECT_NEAR(off(p, A, Vec{{2, 1, 0}}, Vec{{0, 0, -4}}), 4 * turned, 1e-6);
}

TEST(Violation, UnderAGivenNormalForce) {
  ContactPoint p{.tangent = 0, .kind = Tangent::resting, .coefficient = 0.5, .given = 2};
  const Mat A{{2.0}};
  EXPECT_NEAR(off(p, A, Vec{{-1.0}}, Vec{{3.0}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{-1.5}}, Vec{{3.0}}), 1, 1e-6);
  p.given = 0;
  EXPECT_NEAR(off(p, A, Vec{{-1.0}}, Vec{{3.0}}), 2, 1e-6);
}

TEST(Violation, OfSlidingFrictionIsTheForceThatIsNotInProportion) {
  ContactPoint p{.normal = 0, .tangent = 1, .tangents = 1, .kind = Tangent::sliding};
  p.ratio = {0.4, 9};  // the second one is of no tangent
  EXPECT_NEAR(off(p, Mat{{4, 1}, {1, 2}}, Vec{{2, 0.8}}, Vec{{0, 5}}), 0, 1e-12);
  EXPECT_NEAR(off(p, Mat{{4, 1}, {1, 2}}, Vec{{2, 1.0}}, Vec{{0, 5}}), 2 * 0.2, 1e-6);
  p.tangents = 2;
  p.ratio = {0.3, -0.4};
  const Mat A{{4, 0, 0}, {0, 2, 0}, {0, 0, 6}};
  EXPECT_NEAR(off(p, A, Vec{{2, 0.6, -0.8}}, Vec{{0, 1, 1}}), 0, 1e-12);
  EXPECT_NEAR(off(p, A, Vec{{2, 0.6 + 0.3, -0.8 + 0.4}}, Vec{{0, 1, 1}}), 4 * 0.5, 1e-6);
  p.kind = Tangent::none;
  EXPECT_NEAR(off(p, A, Vec{{2, 5, 5}}, Vec{{0, 1, 1}}), 0, 1e-12);
}

TEST(Violation, IsRelativeToLoadsToTheTermsOfForcesAndToWhatCountsAsNothing) {
  const std::vector<ContactPoint> one{{.normal = 0}};
  const Mat A{{4, 0}, {-4e5, 1}};  // terms of 1e6 that do not cancel
  EXPECT_NEAR(violation(one, Mat{{4.0}}, Vec{{-8.0}}, Vec{{1.0}}), 4 / (8 + 4e-4), 1e-15);
  EXPECT_NEAR(violation(one, A, Vec{{-8, 0}}, Vec{{1, 0}}), 4 / (8 + 1e-4 * 4e5), 1e-15);
  EXPECT_NEAR(violation(one, Mat{{4.0}}, Vec{{-8.0}}, Vec{{1.0}}, 1e-6), 4 / (8 + 4e-4 + 1e3), 1e-15);
  EXPECT_NEAR(violation(one, Mat{{4.0}}, Vec{{-8e-3}}, Vec{{1e-3}}), 4 / (8 + 4e-4), 1e-15);
  EXPECT_EQ(violation(one, Mat{{4.0}}, Vec{{0.0}}, Vec{{0.0}}), 0);
  EXPECT_EQ(violation({}, Mat(0, 0), Vec(0), Vec(0)), 0);
  EXPECT_EQ(violation(one, Mat{{4.0}}, Vec{{-8.0}}, Vec{{std::nan("")}}), std::numeric_limits<double>::infinity());
  // The worst of all contacts counts.
  const std::vector<ContactPoint> two{{.normal = 0}, {.normal = 1}};
  EXPECT_NEAR(violation(two, Mat::Identity(2, 2), Vec{{-1, -1}}, Vec{{1, 0.25}}), 0.75 / (1 + 1e-4), 1e-15);
  EXPECT_NEAR(violation(two, Mat::Identity(2, 2), Vec{{-1, -1}}, Vec{{0.25, 1}}), 0.75 / (1 + 1e-4), 1e-15);
}

}  // namespace
}  // namespace trammel::complementarity
