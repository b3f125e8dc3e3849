// The exact forces where rows depend on each other: the documented shares, whatever modes were tried before. Places,
// weights and coefficients are chosen so that the answers are known by hand.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "complementarity/exact_modes.hpp"

namespace trammel::complementarity {
namespace {

using Tangent = ContactPoint::Tangent;

ContactPoint pressing(int normal) {
  return {.normal = normal};
}
ContactPoint resting(int normal, int tangent, double c, double given = 0) {
  return {.normal = normal, .tangent = tangent, .kind = Tangent::resting, .coefficient = c, .given = given};
}
ContactPoint sliding(int normal, int tangent, double ratio) {
  return {.normal = normal, .tangent = tangent, .kind = Tangent::sliding, .ratio = {ratio, 0}};
}

// Contacts of bodies of mass 1: a row of G for each direction, and what the bodies do without contacts.
struct Bodies {
  std::vector<ContactPoint> points;
  Mat G;
  Vec free;

  Mat A() const { return G * G.transpose(); }
  Vec b() const { return G * free; }
};

struct Exact {
  bool found = false;
  Vec F, a;
};
// From the modes that F and a show: a contact with neither a force nor an acceleration of 1 or more is closed.
Exact exact_from(const Bodies& bodies, const Vec& F, const Vec& a) {
  Exact exact{.F = F, .a = a};
  exact.found = make_exact(bodies.points, bodies.A(), bodies.b(), 1e-8, exact.F, exact.a);
  return exact;
}
// From closed contacts that stick.
Exact exact_at_rest(const Bodies& bodies) {
  return exact_from(bodies, Vec::Zero(bodies.G.rows()), Vec::Zero(bodies.G.rows()));
}

void expect_forces(const Exact& exact, const Vec& F, double digits = 1e-14) {
  ASSERT_TRUE(exact.found);
  EXPECT_LE((exact.F - F).norm(), digits * F.norm()) << exact.F.transpose();
}

// A beam of mass 1 and moment of inertia 1 on feet at -1, 0 and 1, that carries `weight` at a lever: the normals are
// rows 0 to 2. Springs share it as N = weight (1/3 + lever x / 2).
Bodies beam(double weight, double lever) {
  Bodies beam;
  beam.points = {pressing(0), pressing(1), pressing(2)};
  beam.G = Mat{{1, -1}, {1, 0}, {1, 1}};
  beam.free = -weight * Vec{{1, lever}};
  return beam;
}

// The same with more rows and velocities.
Bodies with(Bodies bodies, const std::vector<ContactPoint>& more, const Mat& G, const Vec& free) {
  bodies.points.insert(bodies.points.end(), more.begin(), more.end());
  const Eigen::Index m = bodies.G.rows(), n = bodies.G.cols();
  Mat both = Mat::Zero(m + G.rows(), n + G.cols());
  both.topLeftCorner(m, n) = bodies.G, both.bottomRightCorner(G.rows(), G.cols()) = G;
  Vec all(n + free.size());
  all << bodies.free, free;
  bodies.G = both, bodies.free = all;
  return bodies;
}

// Beside it, a contact that parts.
TEST(ExactShares, AreThoseOfSpringsWhicheverFeetCarryFirst) {
  for (const double weight : {3.0, 3e8}) {
    const Bodies bodies = with(beam(weight, 1.0 / 3), {pressing(3)}, Mat{{1}}, Vec{{weight}});
    const Vec shares = weight * Vec{{0.5 / 3, 1.0 / 3, 1.5 / 3, 0}};
    for (int open = 0; open < 7; ++open) {
      SCOPED_TRACE(open);
      Vec a = Vec::Zero(4);
      for (int i = 0; i < 3; ++i) a[i] = open >> i & 1 ? weight : 0;
      const Exact exact = exact_from(bodies, Vec::Zero(4), a);
      expect_forces(exact, shares);
      EXPECT_LE((exact.a - Vec{{0, 0, 0, weight}}).norm(), 1e-14 * weight);
    }
  }
}

// N = 3 (1/3 - 5/12) at the first one.
TEST(ExactShares, OfAFootThatSpringsWouldLiftAreThoseOfTheOthers) {
  for (const Vec& a : {Vec{{0, 0, 0}}, Vec{{1, 0, 0}}, Vec{{0, 1, 0}}, Vec{{0, 0, 1}}})
    expect_forces(exact_from(beam(3, 2.5 / 3), Vec::Zero(3), a), Vec{{0, 0.5, 2.5}});
}

// Where its neighbours slide it is idle, and its friction ends with its force. Tangents have velocities of their own.
TEST(ExactShares, OfAFootThatIsIdleHaveNoFriction) {
  Bodies bodies = with(beam(3, 2.5 / 3), {}, Mat::Identity(3, 3), Vec{{-0.1, 0, 0}});
  bodies.points = {resting(0, 3, 0.5), sliding(1, 4, 0.3), sliding(2, 5, -0.2)};
  const Exact exact = exact_at_rest(bodies);
  expect_forces(exact, Vec{{0, 0.5, 2.5, 0, 0.15, -0.5}});
  EXPECT_LE((exact.a - Vec{{0, 0, 0, -0.1, 0.15, -0.5}}).norm(), 1e-14);
}

// Beside sliding contacts that share, one that shares with none opens when it pulls.
TEST(ExactShares, OfAFootThatPullsAloneAreNone) {
  Bodies bodies = with(beam(3, 1.0 / 3), {pressing(3)}, Mat{{1}}, Vec{{0.2}});
  bodies = with(bodies, {}, Mat::Identity(2, 2), Vec::Zero(2));
  bodies.points[0] = sliding(0, 4, 0.3), bodies.points[1] = sliding(1, 5, -0.2);
  const Exact exact = exact_at_rest(bodies);
  expect_forces(exact, Vec{{0.5, 1, 1.5, 0, 0.15, -0.2}});
  EXPECT_NEAR(exact.a[3], 0.2, 1e-15);
}

// Friction under the first foot turns the beam by 3 N. Then it may carry as a spring does, (0.5, 1, 1.5), or be idle:
// 0.5 and 2.5 of the others alone would lift its spring. The nearby solution decides.
TEST(ExactShares, OfAnIdleFootStayNoneBesideSlidingOnes) {
  Bodies bodies = with(beam(3, 2.5 / 3), {}, Mat::Zero(1, 0), Vec());
  bodies.points[0] = sliding(0, 3, 1);
  bodies.G.row(3) << 0, 3;
  expect_forces(exact_at_rest(bodies), Vec{{0.5, 1, 1.5, 0.5}});
  // It was open if it parted with more than 1e-8 of the accelerations of its forces, 7.5, and of the others, 7.5.
  const auto nearby = [&](double parts) { return exact_from(bodies, Vec{{0, 0.5, 2.5, 0}}, Vec{{parts, 0, 0, 0}}); };
  expect_forces(nearby(1.6e-7), Vec{{0, 0.5, 2.5, 0}});
  expect_forces(nearby(1.4e-7), Vec{{0.5, 1, 1.5, 0.5}});
}

// A foot that was open closes beside sliding ones, here without friction, if its spring would press.
TEST(ExactShares, OfAnOpenFootAreThoseOfSpringsIfItsOwnWouldPress) {
  Bodies bodies = with(beam(3, 1.0 / 3), {pressing(3)}, Mat{{1}}, Vec{{0}});
  bodies = with(bodies, {}, Mat::Identity(2, 2), Vec::Zero(2));
  bodies.points[0] = sliding(0, 4, 0), bodies.points[1] = sliding(1, 5, 0);
  for (const double touches : {0.0, 1e-13}) {  // beside one that just touches and shares with none
    bodies.free[2] = touches;
    const Exact exact = exact_from(bodies, Vec::Zero(6), Vec{{1, 0, 0, 1, 0, 0}});
    expect_forces(exact, Vec{{0.5, 1, 1.5, 0, 0, 0}}, 1e-13);
  }
}

// Two feet that hold a body along one direction with 0.8, each pressed with N = 1 on its own, c = 0.5. The second one's
// normal force is given or not.
Bodies two_that_hold(bool given) {
  Bodies feet;
  if (given) {
    feet.points = {resting(-1, 0, 0.5, 1), resting(-1, 1, 0.5, 1)};
    feet.G = Mat{{1}, {1}}, feet.free = Vec{{-0.8}};
  } else {
    feet.points = {resting(0, 1, 0.5), resting(2, 3, 0.5)};
    feet.G = Mat{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 0, 1}}, feet.free = Vec{{-1, -1, -0.8}};
  }
  return feet;
}

// But not if its friction would then change the motion: the nearby solution had another one.
TEST(ExactShares, OfAnOpenFootStayNoneIfItsFrictionWouldChangeTheMotion) {
  for (const double unit : {1.0, 1e-6, 1e6}) {
    Bodies bodies = with(beam(3 * unit, 1.0 / 3), {}, Mat::Identity(1, 1), Vec::Zero(1));
    bodies.points[0] = sliding(0, 3, 0.3);
    const Exact opened = exact_from(bodies, Vec::Zero(4), Vec{{unit, 0, 0, 0}}), closed = exact_at_rest(bodies);
    expect_forces(opened, unit * Vec{{0, 2, 1, 0}});
    EXPECT_LE(opened.a.norm(), 1e-14 * unit);
    expect_forces(closed, unit * Vec{{0.5, 1, 1.5, 0.15}});
    EXPECT_NEAR(closed.a[3], 0.15 * unit, 1e-15 * unit);
  }
}

// The first foot was at its bound, 0.5. It stays there beside sliding contacts that share, if its own normal force is
// unknown; springs would have 0.4 each.
TEST(ExactShares, OfAFootAtItsBoundStayThereBesideSlidingOnes) {
  enum class Beside { share, slide_alone, stick };
  const auto forces = [](bool given, Beside beside) {
    Bodies bodies = two_that_hold(given);
    const int k = int(bodies.G.rows());
    // Two that press one body, of which the first may slide, and one that presses another.
    const std::vector<ContactPoint> others{
        beside == Beside::share ? sliding(k, k + 1, 0.3) : pressing(k), pressing(k + 2),
        beside == Beside::slide_alone ? sliding(k + 3, k + 1, 0.3) : pressing(k + 3)};
    bodies = with(bodies, others, Mat{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, Vec{{-2, 0, -1}});
    Vec F = Vec::Zero(k + 4), a = Vec::Zero(k + 4);
    a[given ? 0 : 1] = -1;  // slips
    const Exact exact = exact_from(bodies, F, a);
    EXPECT_TRUE(exact.found);
    EXPECT_LE((exact.F.tail(4) - Vec{{1, beside == Beside::stick ? 0 : 0.3, 1, 1}}).norm(), 1e-14);
    return given ? Vec(exact.F.head(2)) : Vec(exact.F(std::vector{1, 3}));
  };
  EXPECT_LE((forces(false, Beside::share) - Vec{{0.5, 0.3}}).norm(), 1e-14);
  EXPECT_LE((forces(false, Beside::slide_alone) - Vec{{0.4, 0.4}}).norm(), 1e-14);
  EXPECT_LE((forces(false, Beside::stick) - Vec{{0.4, 0.4}}).norm(), 1e-14);
  EXPECT_LE((forces(true, Beside::share) - Vec{{0.4, 0.4}}).norm(), 1e-14);
}

constexpr double units[] = {1, 1e-6, 1e6};  // of forces and accelerations

// N = 1, 2, 9 and c = 0.5: springs would have 5/3 each. The first two hold what they can.
TEST(ExactShares, OfFrictionAreTheLeastThatFeetCanHold) {
  const Vec N{{1, 2, 9}}, T{{0.5, 1, 3.5}};
  const auto expect_shares = [&](int tangents, bool given, double unit) {
    const Vec way = tangents == 1 ? Vec{{-1}} : Vec{{-0.6, -0.8}};
    const int own = given ? 0 : 3, rows = own + 3 * tangents;
    Bodies feet;
    feet.G = Mat::Zero(rows, own + tangents);
    feet.G.topLeftCorner(own, own).setIdentity();
    Vec F(rows);
    F.head(own) = N.head(own);
    for (int i = 0; i < 3; ++i) {
      const int row = own + i * tangents;
      feet.points.push_back(given ? resting(-1, row, 0.5, unit * N[i]) : resting(i, row, 0.5));
      feet.points.back().tangents = tangents;
      feet.G.block(row, own, tangents, tangents).setIdentity();
      F.segment(row, tangents) = -T[i] * way;
    }
    feet.free = Vec(own + tangents);
    feet.free << -unit * N.head(own), 5 * unit * way;
    expect_forces(exact_at_rest(feet), unit * F, 1e-12);
  };
  for (const int tangents : {1, 2})
    for (const bool given : {true, false})
      for (const double unit : units) {
        SCOPED_TRACE(testing::Message() << tangents << given << unit);
        expect_shares(tangents, given, unit);
      }
}

// Two that slide on a wall press with 1 each, the first with a friction of 1; two that rest hold 4 more, 0.5 and 3.5,
// because the first can hold no more. Other shares on the wall would let them hold less.
TEST(ExactShares, OfSlidingContactsAreThoseOfSpringsIfTheOthersCanHold) {
  Bodies block;
  block.points = {sliding(0, 1, 1), sliding(2, 3, 0), resting(-1, 4, 0.5, 1), resting(-1, 5, 0.5, 9)};
  block.G = Mat{{1, 0}, {0, 1}, {1, 0}, {0, 1}, {0, 1}, {0, 1}}, block.free = Vec{{-2, -5}};
  expect_forces(exact_at_rest(block), Vec{{1, 1, 1, 0, 0.5, 3.5}}, 1e-12);
}

// A block between two walls holds 3 by friction of c = 0.5 and 1, with the least normal forces with which they can.
TEST(ExactShares, OfABlockBetweenWallsAreTheLeastThatHoldIt) {
  for (const double unit : units) {
    SCOPED_TRACE(unit);
    Bodies block;
    block.points = {resting(0, 1, 0.5), resting(2, 3, 1)};
    block.G = Mat{{1, 0}, {0, 1}, {-1, 0}, {0, 1}}, block.free = Vec{{0, -3 * unit}};
    const Exact exact = exact_at_rest(block);
    expect_forces(exact, unit * Vec{{2, 1, 2, 2}}, 1e-12);
    EXPECT_LE(exact.a.norm(), 1e-14 * unit);
  }
}

// The thinner the cones, the larger the normal forces, 2 weight / (3 c), whose round-off is all that is left of the
// accelerations. The walls are inclined by 0.3.
TEST(ExactShares, OfABlockBetweenSlipperyWallsBalanceToTheRoundOffOfTheirSum) {
  const Eigen::Vector2d normal(std::cos(0.3), std::sin(0.3)), along(-normal[1], normal[0]);
  for (const double c : {1e-5, 1e-7, 1e-9})
    for (int i = 1; i <= 20; ++i) {
      SCOPED_TRACE(testing::Message() << c << ", " << i);
      const double weight = 2 + 0.53 * i;  // along the walls
      Bodies block;
      block.points = {resting(0, 1, 0.5 * c), resting(2, 3, c)};
      block.G = Mat(4, 2), block.free = -weight * along;
      block.G << normal.transpose(), along.transpose(), -normal.transpose(), along.transpose();
      const Exact exact = exact_at_rest(block);
      const double N = 2 * weight / (3 * c);
      expect_forces(exact, Vec{{N, weight / 3, N, 2 * weight / 3}}, 1e-12);
      EXPECT_LE(exact.a.lpNorm<Eigen::Infinity>(), 2 * std::numeric_limits<double>::epsilon() * N);
    }
}

// The first and the last slide along the left wall, with friction 0.5 and 0.25; the right one could hold with c = 0.5,
// if walls pressed on the block from both sides, by N_0 + N_2 = N_1. Springs do not press, so it falls. Another block
// slides by itself, under a given force and under its weight.
TEST(ExactShares, OfSlidingContactsAreNoneWhereSpringsDoNotPress) {
  for (const double unit : units) {
    SCOPED_TRACE(unit);
    Bodies block;
    block.points = {sliding(0, 1, 0.5), resting(2, 3, 0.5), sliding(4, 5, 0.25)};
    block.G = Mat{{1, 0}, {0, 1}, {-1, 0}, {0, 1}, {1, 0}, {0, 1}}, block.free = unit * Vec{{0, -15}};
    const Bodies bodies =
        with(block, {resting(-1, 6, 0.5, unit), sliding(7, 8, 0.1)}, Mat::Identity(3, 3), unit * Vec{{-2, -1, 0}});
    const Exact exact = exact_at_rest(bodies);
    expect_forces(exact, unit * Vec{{0, 0, 0, 0, 0, 0, 0.5, 1, 0.1}}, 1e-12);
    EXPECT_LE((exact.a - unit * Vec{{0, -15, 0, -15, 0, -15, -1.5, 0, 0.1}}).norm(), 1e-13 * unit);
  }
}

}  // namespace
}  // namespace trammel::complementarity
