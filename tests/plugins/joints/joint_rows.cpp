// What every joint owes the assembly: g, H, g_t and gamma belong together, along any motion of its two markers.
#include <gtest/gtest.h>
#include <trammel/joint.hpp>

#include "../made.hpp"
#include "../moving_marker.hpp"

namespace trammel::test {
namespace {

struct Case {
  const char* name;
  const char* entry;
  Space space = Space::planar;
};

const Case cases[] = {
    {"revolute", R"({"type": "revolute"})"},
    {"prismatic", R"({"type": "prismatic", "axis": [2, 1], "angle": 0.3})"},
    {"prismatic_driven", R"({"type": "prismatic", "axis": [0, 1], "angle": "=sin(3*t)*0.4"})"},
    {"fixed", R"({"type": "fixed", "angle": -0.2})"},
    {"fixed_driven", R"({"type": "fixed", "angle": "=(1+t)^2-3*t"})"},
    {"distance", R"({"type": "distance", "length": 1.3})"},
    {"distance_driven", R"({"type": "distance", "length": "=sin(2*t)*0.4+1.3"})"},
    {"distance_spatial", R"({"type": "distance", "length": 1.3})", Space::spatial},
    {"distance_spatial_driven", R"({"type": "distance", "length": "=sin(2*t)*0.4+1.3"})", Space::spatial},
};

class JointRows : public testing::TestWithParam<Case> {
 protected:
  const Space space = GetParam().space;
  const World world = space == Space::planar ? planar() : spatial();
  const std::unique_ptr<Joint> joint = made<Joint>(Kind::joint, GetParam().entry, world);
  const MovingMarker a = space == Space::planar ? marker_a() : point_a();
  const MovingMarker b = space == Space::planar ? marker_b() : point_b();

  Rows rows(double t, const Motion& A, const Motion& B) const {
    Rows r;
    r.resize(joint->row_count(space), space);
    joint->rows(t, A, B, r);
    return r;
  }
  Rows along(double t) const { return rows(t, a.at(t), b.at(t)); }
  Vec g_dot(double t) const {
    const Rows r = along(t);
    return r.H_A * a.at(t).V + r.H_B * b.at(t).V + r.g_t;
  }
};

TEST_P(JointRows, VelocityRowsAreTheRateOfTheGap) {
  for (double t : {0.1, 0.7, 1.9}) {
    const Vec expected = derivative([&](double s) -> Vec { return along(s).g; }, t);
    EXPECT_LT((g_dot(t) - expected).norm(), difference_error) << "t = " << t;
  }
}

TEST_P(JointRows, AccelerationRowsAreTheRateOfTheVelocityRows) {
  for (double t : {0.1, 0.7, 1.9}) {
    const Rows r = along(t);
    const Vec actual = r.H_A * a.acceleration(t) + r.H_B * b.acceleration(t) - r.gamma;
    const Vec expected = derivative([&](double s) { return g_dot(s); }, t);
    EXPECT_LT((actual - expected).norm(), difference_error) << "t = " << t;
  }
}

TEST_P(JointRows, JacobianIsTheGradientAtFixedTime) {
  const double t = 0.8;
  const Rows r = along(t);
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const auto moved = [&](double step, bool of_a) -> Vec {
      const Vec shift = step * Vec::Unit(a.size(), i);
      return of_a ? rows(t, a.at(t, shift), b.at(t)).g : rows(t, a.at(t), b.at(t, shift)).g;
    };
    const Vec by_a = derivative([&](double step) { return moved(step, true); }, 0);
    const Vec by_b = derivative([&](double step) { return moved(step, false); }, 0);
    EXPECT_LT((r.H_A.col(i) - by_a).norm(), difference_error) << "coordinate " << i << " of A";
    EXPECT_LT((r.H_B.col(i) - by_b).norm(), difference_error) << "coordinate " << i << " of B";
  }
}

TEST_P(JointRows, TimeDerivativeIsThatOfFrozenMarkers) {
  const Motion A = a.at(0.8), B = b.at(0.8);
  const Vec expected = derivative([&](double s) -> Vec { return rows(s, A, B).g; }, 0.8);
  EXPECT_LT((rows(0.8, A, B).g_t - expected).norm(), difference_error);
}

INSTANTIATE_TEST_SUITE_P(All, JointRows, testing::ValuesIn(cases),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

}  // namespace
}  // namespace trammel::test
