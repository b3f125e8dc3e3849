// What a joint's reactions are on motions that the joint allows: balanced, and doing no work.
#include <functional>

#include <gtest/gtest.h>
#include <trammel/joint.hpp>

#include "../made.hpp"
#include "../moving_marker.hpp"

namespace trammel::test {
namespace {

using Eigen::Vector2d;

struct Case {
  const char* name;
  const char* entry;
  std::function<Vec(double t, const Motion& A)> coordinates_of_B;  // x, y, angle that the joint allows
};

Vec allowed(const Vector2d& x, double angle) {
  Vec q(3);
  q << x, angle;
  return q;
}

const Case cases[] = {
    {"revolute", R"({"type": "revolute"})",
     [](double t, const Motion& A) { return allowed(A.x, 2 * t + std::sin(3 * t)); }},
    {"prismatic", R"({"type": "prismatic", "axis": [2, 1], "angle": 0.3})",
     [](double t, const Motion& A) { return allowed(A.x + std::cos(2 * t) * (A.R * Vector2d(2, 1)), A.angle + 0.3); }},
    {"fixed", R"({"type": "fixed", "angle": -0.2})",
     [](double, const Motion& A) { return allowed(A.x, A.angle - 0.2); }},
    {"distance", R"({"type": "distance", "length": 1.3})",
     [](double t, const Motion& A) {
       return allowed(A.x + 1.3 * Vector2d(std::cos(t * t), std::sin(t * t)), std::sin(4 * t));
     }},
};

class JointReactions : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const double t = 0.6;
    const MovingMarker marker = marker_a();
    const auto coordinates = [&](double s) { return GetParam().coordinates_of_B(s, marker.at(s)); };
    A = marker.at(t);
    B = marker.motion(coordinates(t), derivative(coordinates, t));
    rows.resize(joint->row_count(Space::planar), Space::planar);
    joint->rows(t, A, B, rows);
    lambda = Vec::LinSpaced(rows.g.size(), 1.5, -0.7);
  }
  const std::unique_ptr<Joint> joint = made<Joint>(Kind::joint, GetParam().entry);
  Motion A, B;
  Rows rows;
  Vec lambda;
};

TEST_P(JointReactions, TheMotionIsAllowed) {
  EXPECT_LT(rows.g.norm(), 1e-14);                                        // round-off
  EXPECT_LT((rows.H_A * A.V + rows.H_B * B.V).norm(), difference_error);  // B's velocity comes from differences
}

TEST_P(JointReactions, DoNoWork) {
  const Vec on_A = -rows.H_A.transpose() * lambda, on_B = -rows.H_B.transpose() * lambda;
  EXPECT_NEAR(on_A.dot(A.V) + on_B.dot(B.V), 0, difference_error);
}

TEST_P(JointReactions, BalanceInForceAndMoment) {
  const Vec on_A = -rows.H_A.transpose() * lambda, on_B = -rows.H_B.transpose() * lambda;
  const auto about_origin = [](const Vec& w, const Vec3& x) { return w(2) + x(0) * w(1) - x(1) * w(0); };
  EXPECT_LT((on_A + on_B).head<2>().norm(), 1e-14);  // round-off of values of order one
  EXPECT_NEAR(about_origin(on_A, A.x) + about_origin(on_B, B.x), 0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(All, JointReactions, testing::ValuesIn(cases),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(Distance, ReactionIsTheTensionInTheRod) {
  const auto rod = made<Joint>(Kind::joint, R"({"type": "distance", "length": 2})");
  const MovingMarker marker = marker_a();
  Rows rows;
  rows.resize(1, Space::planar);
  rod->rows(0, marker.motion(Vec::Zero(3), Vec::Zero(3)), marker.motion(2 * Vec::Unit(3, 0), Vec::Zero(3)), rows);
  EXPECT_EQ(-rows.H_B(0, 0), -1);  // lambda = 1 N pulls B towards A
  EXPECT_EQ(-rows.H_A(0, 0), 1);
}

TEST(Prismatic, MeasuresTheDistanceFromTheGuideWhateverTheAxisLength) {
  const auto slider = made<Joint>(Kind::joint, R"({"type": "prismatic", "axis": [300, 0]})");
  const MovingMarker marker = marker_a();
  Rows rows;
  rows.resize(2, Space::planar);
  slider->rows(0, marker.motion(Vec::Zero(3), Vec::Zero(3)), marker.motion(Eigen::Vector3d(5, 0.25, 0), Vec::Zero(3)),
               rows);
  EXPECT_EQ(rows.g(0), 0.25);
}

TEST(Joints, RefuseWhatTheyCannotDo) {
  for (const char* planar_only : {"revolute", "prismatic", "fixed"}) {
    const std::string entry = std::string(R"({"type": ")") + planar_only + "\"}";
    EXPECT_NE(refusal(Kind::joint, entry, spatial()).find("this scene is spatial"), std::string::npos) << planar_only;
    EXPECT_EQ(refusal(Kind::joint, entry), "") << planar_only;
  }
  EXPECT_NE(refusal(Kind::joint, R"({"type": "prismatic", "axis": [0, 0]})").find("axis"), std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "distance"})").find("length"), std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "distance", "length": -1})").find("greater than 0"), std::string::npos);
}

TEST(Distance, RefusesALengthThatVanishesDuringTheRun) {
  const auto rod = made<Joint>(Kind::joint, R"({"type": "distance", "length": "=1-t"})");
  Rows rows;
  rows.resize(1, Space::planar);
  EXPECT_NO_THROW(rod->rows(0.5, marker_a().at(0), marker_b().at(0), rows));
  EXPECT_THROW(rod->rows(1, marker_a().at(0), marker_b().at(0), rows), std::domain_error);
}

}  // namespace
}  // namespace trammel::test
