// What single joints promise beyond the checks of shipped_components.cpp: signs, scales and refusals.
#include <gtest/gtest.h>
#include <trammel/joint.hpp>
#include <trammel/testing_markers.hpp>

#include "../made.hpp"

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
  const MovingPair pair = moving_pair(Space::planar);
  EXPECT_NO_THROW(rod->rows(0.5, pair.a.at(0), pair.b.at(0), rows));
  EXPECT_THROW(rod->rows(1, pair.a.at(0), pair.b.at(0), rows), std::domain_error);
}

}  // namespace
}  // namespace trammel::test
