#include <trammel/joint_rows.hpp>

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include <trammel/component.hpp>

#include "scene/expression.hpp"

namespace trammel {
namespace {

// Numbers whose squares are beyond the range of numbers.
TEST(UnitAxis, IsThatOfADirectionOfAnyLength) {
  for (const double length : {1e-200, 1.0, 1e200}) {
    const Vec3 axis = unit_axis(Eigen::Vector3d(3 * length, 0, -4 * length), "axis");
    EXPECT_NEAR((axis - Eigen::Vector3d(0.6, 0, -0.8)).norm(), 0, 1e-15) << length;
  }
}

TEST(UnitAxis, OfNoLengthIsRefused) {
  try {
    unit_axis(Eigen::Vector3d::Zero(), "axis");
    FAIL() << "accepted";
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.parameter(), "axis");
  }
}

TEST(UnitQuaternion, IsThatOfFourNumbersOfAnySize) {
  World world;
  world.space = Space::spatial;
  for (const double size : {1e-200, 1.0, 1e200}) {
    const Eigen::Quaterniond p = unit_quaternion(world, {3 * size, 0, 4 * size, 0}, "orientation");
    EXPECT_NEAR((p.coeffs() - Eigen::Vector4d(0, 0.8, 0, 0.6)).norm(), 0, 1e-15) << size;  // (x, y, z, w)
  }
}

// Markers at rest: A turned and moved, B at `d` from it in A's axes, turned by `relative` against A.
struct Pair {
  Motion A, B;
};
Pair pair_of(const Eigen::Vector3d& d, const Eigen::Quaterniond& relative) {
  const Eigen::Quaterniond of_A(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 2).normalized()));
  Pair pair;
  pair.A.x = Eigen::Vector3d(3, 1, -2);
  pair.A.R = of_A.toRotationMatrix();
  pair.B.x = pair.A.x + of_A * d;
  pair.B.R = (of_A * relative).toRotationMatrix();
  for (Motion* m : {&pair.A, &pair.B}) m->V = m->bias = Vec::Zero(6);
  return pair;
}
double largest_gap(const JointRows& list, double t, const Pair& pair) {
  Rows rows;
  rows.resize(list.count(), Space::spatial);
  list.rows(t, pair.A, pair.B, rows);
  return rows.g.lpNorm<Eigen::Infinity>();
}
TimeFunction law(const char* text) {
  return scene::compile_time_function(text, [](std::string_view, int) { return 0.0; });
}

TEST(JointRows, AreZeroWhereTheirLawsSay) {
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, -1).normalized(), across = n.unitOrthogonal();
  const Eigen::Quaterniond Q(Eigen::AngleAxisd(0.4, Eigen::Vector3d(0, 0.6, 0.8)));
  // Laws that are constant, zero at the start only, or neither.
  for (const TimeFunction& p : {TimeFunction(0), TimeFunction(0.3), law("sin(t)"), law("0.2+t^2")})
    for (const double t : {0.0, 0.8}) {
      const Eigen::Quaterniond turned(Eigen::AngleAxisd(p(t), n));
      const Pair held = pair_of(p(t) * n + 0.5 * across, turned * Q);
      const Pair moved = pair_of((p(t) + 0.1) * n, Eigen::AngleAxisd(p(t) + 0.1, n) * Q);
      for (const JointRows& list : {JointRows(Space::spatial).offset(n, p), JointRows(Space::spatial).angle(n, Q, p),
                                    JointRows(Space::spatial).orientation(n, Q, p)}) {
        EXPECT_NEAR(largest_gap(list, t, held), 0, 1e-15) << p.text() << " at " << t;
        EXPECT_NEAR(largest_gap(list, t, moved), 0.1, 2e-4) << p.text() << " at " << t;  // sin(0.1) of an angle
      }
      const Pair tilted = pair_of(p(t) * n, turned * Eigen::AngleAxisd(0.1, across) * Q);
      EXPECT_GT(largest_gap(JointRows(Space::spatial).orientation(n, Q, p), t, tilted), 0.07);
    }
}

// Markers with constant twists, so that g'' = -gamma.
Pair moving_pair(Space space, double t) {
  const Eigen::Vector3d w_A(0.3, -0.5, 0.7), w_B(-0.4, 0.6, 1.1), v_A(1, 2, -0.5), v_B(-0.3, 0.8, 1.2);
  Pair pair = pair_of(Eigen::Vector3d(0.4, -0.7, 0.9), Eigen::Quaterniond(0.8, 0, 0.6, 0));
  const auto move = [&](Motion& m, const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
    if (space == Space::spatial) {
      m.x += t * v;
      m.R = Mat(Eigen::AngleAxisd(t * w.norm(), w.normalized()).toRotationMatrix() * m.R);
      m.V << v, w;
      return;
    }
    m.x = Vec(m.x.head(2) + t * v.head(2));
    m.angle = 0.2 * v.x() + t * w.z();
    m.R = Mat(Eigen::Rotation2Dd(m.angle).toRotationMatrix());
    m.V = Eigen::Vector3d(v.x(), v.y(), w.z());
  };
  move(pair.A, v_A, w_A), move(pair.B, v_B, w_B);
  return pair;
}

TEST(JointRows, HaveTheRatesAndAccelerationsOfTheirValues) {
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, -1).normalized();
  const Eigen::Quaterniond Q(Eigen::AngleAxisd(0.4, Eigen::Vector3d(0, 0.6, 0.8)));
  constexpr double t = 0.8, s = 1e-4;  // s^2 = 1e-8 of numbers near 1; round-off 1e-16/s^2 = 1e-8
  for (const Space space : {Space::planar, Space::spatial}) {
    const Vec3 axis = space == Space::planar ? Vec3(Eigen::Vector2d(0.6, 0.8)) : Vec3(n);
    for (const JointRows& list :
         {JointRows(space).same_point(), JointRows(space).offset(axis, law("sin(t)")), JointRows(space).across(axis),
          JointRows(space).parallel(n, n), JointRows(space).orientation(axis, Q, law("0.2+t^2"))}) {
      const auto at = [&](double time, const Pair& pair) {
        Rows rows;
        rows.resize(list.count(), space);
        list.rows(time, pair.A, pair.B, rows);
        return rows;
      };
      const Pair now = moving_pair(space, t);
      const Rows rows = at(t, now);
      const Vec before = at(t - s, moving_pair(space, t - s)).g, after = at(t + s, moving_pair(space, t + s)).g;
      const Vec rate = rows.H_A * now.A.V + rows.H_B * now.B.V + rows.g_t;
      EXPECT_NEAR((rate - (after - before) / (2 * s)).norm(), 0, 1e-6);
      EXPECT_NEAR((rows.gamma + (after - 2 * rows.g + before) / (s * s)).norm(), 0, 1e-6);
    }
  }
}

TEST(JointRows, AreAsManyAsTheFreedomsThatTheyTake) {
  const Eigen::Quaterniond none = Eigen::Quaterniond::Identity();
  for (const auto& [space, point, across, parallel, orientation] :
       {std::tuple(Space::planar, 2, 1, 0, 1), {Space::spatial, 3, 2, 2, 3}}) {
    const Vec3 n = Vec::Unit(dimension(space), 0);
    EXPECT_EQ(JointRows(space).same_point().count(), point);
    EXPECT_EQ(JointRows(space).across(n).count(), across);
    EXPECT_EQ(JointRows(space).parallel(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX()).count(), parallel);
    EXPECT_EQ(JointRows(space).orientation(n, none, 0).count(), orientation);
  }
}

TEST(JointRows, AcrossALineLetMarkersMoveAlongItOnly) {
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, -1).normalized(), e = n.unitOrthogonal();
  const JointRows list = JointRows(Space::spatial).across(n);
  const auto gap = [&](const Eigen::Vector3d& d) {
    return largest_gap(list, 0, pair_of(d, Eigen::Quaterniond::Identity()));
  };
  EXPECT_NEAR(gap(0.5 * n), 0, 1e-15);
  for (const Eigen::Vector3d& off : {e, Eigen::Vector3d(n.cross(e))}) EXPECT_GE(gap(0.5 * n + 0.1 * off), 0.07);
}

TEST(JointRows, OfAnAngleGrowAsBTurnsAboutTheAxis) {
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, -1).normalized();
  const Pair turned = pair_of(Eigen::Vector3d::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(0.1, n)));
  Rows rows;
  rows.resize(1, Space::spatial);
  JointRows(Space::spatial).angle(n, Eigen::Quaterniond::Identity(), 0).rows(0, turned.A, turned.B, rows);
  EXPECT_NEAR(rows.g[0], std::sin(0.1), 1e-15);
}

TEST(JointRows, SayWhichOrientationsTheyReadAndWhetherTheirAxesStay) {
  const Vec3 n = Eigen::Vector3d::UnitX();
  const JointRows offset = JointRows(Space::spatial).offset(n, 0.3),
                  angle = JointRows(Space::spatial).angle(n, Eigen::Quaterniond::Identity(), law("sin(t)"));
  EXPECT_TRUE(offset.needs_orientation(0));
  EXPECT_FALSE(offset.needs_orientation(1));
  EXPECT_TRUE(angle.needs_orientation(0));
  EXPECT_TRUE(angle.needs_orientation(1));
  EXPECT_TRUE(offset.linear());
  EXPECT_FALSE(angle.linear());
}

TEST(SmallestRotation, TurnsADirectionToAnyOther) {
  const Eigen::Vector3d from(1, 2, -2), normal = from.unitOrthogonal();
  for (const double left : {0.0, 1e-16, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-3, 0.1, 1.0, 2.0, M_PI}) {  // of half a turn
    const Eigen::Vector3d to = 5 * (Eigen::AngleAxisd(M_PI - left, normal) * from);
    const Eigen::Quaterniond turn = smallest_rotation(from, to);
    EXPECT_NEAR(turn.norm(), 1, 1e-15) << left;
    // Its axis is a x b, whose errors are those of round-off over the angle that is left.
    EXPECT_NEAR((turn * from.normalized() - to.normalized()).norm(), 0,
                left > 5e-7 ? 1e-15 / std::min(left, 1.0) : 1e-15)
        << left;
    EXPECT_NEAR(Eigen::AngleAxisd(turn).angle(), M_PI - left, 2e-6) << left;
  }
}

}  // namespace
}  // namespace trammel
