// What single joints promise beyond the checks of shipped_components.cpp: signs, scales and refusals.
#include <gtest/gtest.h>
#include <trammel/joint.hpp>
#include <trammel/testing/markers.hpp>

#include "support/made.hpp"

namespace trammel::test {
namespace {

TEST(Distance, ReactionIsTheTensionInTheRod) {
  const auto rod = made<Joint>(Kind::joint, R"({"type": "distance", "length": 2})");
  Rows rows;
  rows.resize(1, Space::planar);
  rod->rows(0, marker_at(Vec::Zero(3), Vec::Zero(3)), marker_at(2 * Vec::Unit(3, 0), Vec::Zero(3)), rows);
  EXPECT_EQ(-rows.H_B(0, 0), -1);  // lambda = 1 N pulls B towards A
  EXPECT_EQ(-rows.H_A(0, 0), 1);
}

TEST(Prismatic, MeasuresTheDistanceFromTheGuideWhateverTheAxisLength) {
  const auto slider = made<Joint>(Kind::joint, R"({"type": "prismatic", "axis": [300, 0]})");
  Rows rows;
  rows.resize(2, Space::planar);
  slider->rows(0, marker_at(Vec::Zero(3), Vec::Zero(3)), marker_at(Eigen::Vector3d(5, 0.25, 0), Vec::Zero(3)), rows);
  EXPECT_EQ(rows.g(0), 0.25);
}

TEST(Joints, RefuseWhatTheyCannotDo) {
  for (const char* spatial_only : {"universal", "cylindrical"}) {
    const std::string entry = std::string(R"({"type": ")") + spatial_only + "\"}";
    EXPECT_NE(refusal(Kind::joint, entry).find("this scene is planar"), std::string::npos) << spatial_only;
    EXPECT_EQ(refusal(Kind::joint, entry, spatial()), "") << spatial_only;
  }
  EXPECT_NE(refusal(Kind::joint, R"({"type": "revolute", "axis": [0, 1]})").find("this scene is planar"),
            std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "revolute", "axis": [0, 0, 0]})", spatial()).find("axis"),
            std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "fixed", "orientation": [1, 0]})", spatial()).find("quaternion"),
            std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "gear", "teeth": [1.5, 2]})").find("whole numbers"), std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "prismatic", "axis": [0, 0]})").find("axis"), std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "distance"})").find("length"), std::string::npos);
  EXPECT_NE(refusal(Kind::joint, R"({"type": "distance", "length": -1})").find("greater than 0"), std::string::npos);
}

TEST(Gear, KeepsTheRatioOfItsTeethOverManyTurns) {
  const auto gear = made<Joint>(Kind::joint, R"({"type": "gear", "teeth": [12, 17]})", spatial());
  const auto turned = [](double angle) { return marker_at(angle * Vec::Unit(6, 5), Vec::Zero(6)); };
  Rows rows;
  for (double angle : {0.0, 1.0, 40.0, -300.0}) {
    rows.resize(1, Space::spatial);
    gear->rows(0, turned(17 * angle), turned(-12 * angle), rows);
    EXPECT_NEAR(rows.g(0), 0, 1e-12) << angle;  // round-off of 5100 rad
    gear->rows(0, turned(17 * angle), turned(-12 * angle + 0.01), rows);
    EXPECT_NEAR(rows.g(0), 0.01, 1e-12) << angle;
  }
}

TEST(Distance, RefusesALengthThatVanishesDuringTheRun) {
  const auto rod = made<Joint>(Kind::joint, R"({"type": "distance", "length": "=1-t"})");
  Rows rows;
  rows.resize(1, Space::planar);
  const MovingPair pair = moving_pair(Space::planar);
  EXPECT_NO_THROW(rod->rows(0.5, pair.a.at(0), pair.b.at(0), rows));
  EXPECT_THROW(rod->rows(1, pair.a.at(0), pair.b.at(0), rows), std::domain_error);
}

}  // namespace
}  // namespace trammel::test
