// How the Runge-Kutta methods bring the points of their stages onto the rows, and what that costs.
#include <trammel/methods/runge_kutta.hpp>
#include <trammel/outside_domain.hpp>

#include "support.hpp"
#include "testing/kit/integrators/problems.hpp"

namespace trammel::test {
namespace {

// A particle on the row of a problem, at (x, y) with the velocity (1, 0.5): where it is projected to, at what cost.
struct Projected {
  bool possible = false;
  Vec q, v;
  int points = 0, factorisations = 0;
};
using RowsOf = std::function<Problem::Rows(const Vec& q, const Vec& v)>;

// `fails`: of the solutions with its matrix, the first that fails; -1: none.
Projected project(const RowsOf& of, double x, double y, int fails = -1) {
  Projected found;
  Problem p;
  p.closed_form = false;
  p.M = Mat::Identity(2, 2);
  p.force = [](double, const Vec&, const Vec&) { return Vec::Zero(2); };
  p.tangent = [](const Blend& c, const Vec&, const Vec&) -> Mat { return c.c_d * Mat{{1, 2}, {2, 9}}; };
  p.rows = [&](double, const Vec& q, const Vec& v) { return ++found.points, of(q, v); };
  p.exact = [&](double, Vec& q, Vec& v) { q = Eigen::Vector2d(x, y), v = Eigen::Vector2d(1, 0.5); };
  Posed posed(p);
  kit::Failing counted(posed, kit::Failing::How::singular);
  RungeKutta method({1, nullptr, nullptr, nullptr});
  method.rows = RungeKutta::Rows::projected;
  Slope slope;
  found.points = 0;
  if (fails >= 0) counted.fail_at(fails);
  found.possible = method.evaluate(counted, 0, Eigen::Vector2d(x, y), Eigen::Vector2d(1, 0.5), slope);
  found.factorisations = int(counted.evaluations) - found.points;
  method.taken_at(found.q, found.v);
  return found;
}

Problem::Rows row(double g, const Eigen::RowVector2d& G) {
  return {Vec::Constant(1, g), Vec::Zero(1), Vec::Zero(1), G};
}
// Of y = 0 with a matrix that leaves the part theta of each violation of the positions.
RowsOf plane(double theta) {
  return [theta](const Vec& q, const Vec&) { return row(q[1], Eigen::RowVector2d(0, 1 / (1 - theta))); };
}
const RowsOf circle = [](const Vec& q, const Vec&) { return row((q.squaredNorm() - 1) / 2, q.transpose()); };

TEST(RowsOfRungeKutta, AreSatisfiedToRoundOffWithTwoFactorisations) {
  const Projected at = project(circle, 0.0, 1.01);
  ASSERT_TRUE(at.possible);
  EXPECT_NEAR((at.q - Eigen::Vector2d(0, 1)).norm(), 0, 1e-15);  // the shortest way, whatever the damping
  EXPECT_NEAR(at.q.dot(at.v), 0, 1e-15);
  EXPECT_EQ(at.factorisations, 2);
}

TEST(RowsOfRungeKutta, NeedOneFactorisationNearBy) {
  const Projected at = project(circle, 0.0, 1.0001);
  ASSERT_TRUE(at.possible);
  EXPECT_NEAR(at.q.norm(), 1, 1e-15);
  EXPECT_EQ(at.factorisations, 1);
}

TEST(RowsOfRungeKutta, AreFactorisedAgainWhileTheyConvergeSlowlyOnly) {
  // From 5e-4, below which the first factors serve, to 1e-9, from which on slow convergence may be round-off.
  EXPECT_EQ(project(plane(0.05), 0, 5e-4).factorisations, 1);
  EXPECT_GE(project(plane(0.2), 0, 5e-4).factorisations, 6);
}

TEST(RowsOfRungeKutta, AreMissingWhereTheyAreNotReached) {
  EXPECT_TRUE(project(plane(0.5), 0, 0.01).possible);   // 1e-8 after 20 iterations
  EXPECT_FALSE(project(plane(0.8), 0, 0.01).possible);  // 1e-4
}

// However near they are: 1e-8 m would be within what slow convergence may leave.
TEST(RowsOfRungeKutta, AreMissingWhereTheirMatrixIsSingular) {
  for (const int of_places_or_velocities : {0, 1})
    EXPECT_FALSE(project(circle, 0, 1 + 1e-8, of_places_or_velocities).possible);
  EXPECT_TRUE(project(circle, 0, 1 + 1e-8, 9).possible);
}

// At 1e11 m places are 1.5e-5 m apart, so no iteration reduces the violation to less than some 1e-6.
TEST(RowsOfRungeKutta, OfFarPlacesAreSatisfiedToTheirRoundOffAtOnce) {
  for (int i = 1; i < 20; ++i) {
    const double far = 1e11, between = 1e-5 * (0.4 + 0.02 * i);
    const RowsOf there = [&](const Vec& q, const Vec&) { return row(q[0] - far - between, Eigen::RowVector2d(1, 0)); };
    const Projected at = project(there, far + 1, 0);
    EXPECT_TRUE(at.possible);
    EXPECT_LE(at.points, 8);
  }
}

// Its velocity's violation is judged beside the speed.
TEST(RowsOfRungeKutta, OfAFastMotionNeedNoMorePoints) {
  const auto points = [](double speed) {
    int count = 0;
    Problem p = problems::pendulum_with_rod();
    p.rows = [&count, of = p.rows](double t, const Vec& q, const Vec& v) { return ++count, of(t, q, v); };
    Posed s(p);
    const State start = s.start();
    RungeKutta method({1, nullptr, nullptr, nullptr});
    method.rows = RungeKutta::Rows::projected;
    Slope slope;
    count = 0;
    EXPECT_TRUE(method.evaluate(s, 0, start.q * 1.0001, speed * (start.v + Eigen::Vector2d(0.1, 0.2)), slope));
    return count;
  };
  EXPECT_LE(points(1e6), points(1));
}

// An error across the rod, and one along its circle.
TEST(RowsOfRungeKutta, AreLeftOutOfTheErrorAlongThem) {
  Posed s(problems::pendulum_with_rod());
  const State at = s.start();
  const Vec none = Vec::Zero(2), along = Eigen::Vector2d(-at.q[1], at.q[0]);
  RungeKutta method({1, nullptr, nullptr, nullptr});
  const Tolerance one{.relative = 0, .absolute = 1};
  const auto norm = [&](RungeKutta::Part part, Vec e_v) { return method.norm(s, at, at, none, e_v, part, one); };
  EXPECT_NEAR(norm(RungeKutta::Part::whole, 3 * at.q + 2 * along), std::sqrt(13 / 4.0), 1e-14);
  EXPECT_NEAR(norm(RungeKutta::Part::along_rows, 3 * at.q + 2 * along), 1, 1e-14);
}

struct Stepped {
  State next;
  int factorisations;
};
// Of the pendulum whose pivot is at `x`.
Stepped step_of(const char* name, const std::string& rows, double h, double x = 0) {
  int points = 0;
  Problem p = problems::pendulum_with_rod(1, 4);
  const Eigen::Vector2d pivot(x, 0);
  p.rows = [&, of = p.rows](double t, const Vec& q, const Vec& v) { return ++points, of(t, q - pivot, v); };
  p.exact = [&, of = p.exact](double t, Vec& q, Vec& v) { of(t, q, v), q += pivot; };
  Posed posed(p);
  kit::Failing counted(posed, kit::Failing::How::singular);
  auto method = make(name, {{"rows", rows}});
  const State start = posed.start();
  method->restart(counted, start);
  points = 0, counted.evaluations = 0;
  Stepped stepped;
  EXPECT_TRUE(method->step(counted, start, h, stepped.next));
  stepped.factorisations = int(counted.evaluations) - points;
  return stepped;
}

TEST(NullSpace, NeedsOneFactorisationAStep) {
  for (const char* name : {"runge_kutta_4", "dormand_prince"}) {
    EXPECT_EQ(step_of(name, "null_space", 0.01).factorisations, 1) << name;
    EXPECT_EQ(step_of(name, "null_space", 0.01, 1e4).factorisations, 1) << name << ", far from the origin";
    EXPECT_GE(step_of(name, "projected", 0.01).factorisations, 4) << name;
  }
}

// 4 rad/s for 0.35 s: the rod turns by 80 degrees, so its row at the start says little about its end.
TEST(NullSpace, GivesWayToProjectionInAStepThatTurnsTheRowsFar) {
  for (const char* name : {"runge_kutta_4", "dormand_prince"}) {
    const Stepped by_null_space = step_of(name, "null_space", 0.35), by_projection = step_of(name, "projected", 0.35);
    EXPECT_TRUE(same_bits(by_null_space.next, by_projection.next)) << name;
    EXPECT_FALSE(same_bits(step_of(name, "null_space", 0.05).next, step_of(name, "projected", 0.05).next)) << name;
  }
}

// Between the ends of a step by its own slopes and three more: a shorter step would need all twelve.
TEST(NullSpace, IsThatOfTheStepInItsInterpolationToo) {
  Posed posed(problems::pendulum_with_rod(1, 4));
  kit::Failing counted(posed, kit::Failing::How::singular);
  auto method = make("dop853", {{"rows", std::string("null_space")}});
  const State start = posed.start();
  State next, inside;
  method->restart(counted, start);
  counted.evaluations = 0;
  ASSERT_TRUE(method->step(counted, start, 0.01, next));
  const long long of_step = counted.evaluations;
  counted.evaluations = 0;
  dynamic_cast<DenseOutput&>(*method).interpolate(counted, start, next, 0.5, inside);
  EXPECT_LE(2 * counted.evaluations, of_step);
  EXPECT_NEAR((inside.q - posed.exact(0.005).q).norm(), 0, 1e-12);
}

// The difference of two times of 1e6 s gives the step's length to 1e-10 s only.
TEST(StepsOfRungeKutta, AreNotRepeatedForAnInterpolationAtALateTime) {
  Posed posed(problems::oscillator());
  kit::Failing counted(posed, kit::Failing::How::singular);
  auto method = make("dormand_prince");
  State start = posed.start(), next, inside;
  for (int i = 0; i < 20; ++i) {
    start.t = 1e6 + 0.01 * i;
    method->restart(counted, start);
    ASSERT_TRUE(method->step(counted, start, 0.1 + 0.01 * i, next));
    counted.evaluations = 0;
    dynamic_cast<DenseOutput&>(*method).interpolate(counted, start, next, 0.5, inside);
    EXPECT_EQ(counted.evaluations, 0) << i;
  }
}

// The next motion begins a quarter of a turn further and a little off the rod, where rows of the old place say nothing.
TEST(NullSpace, OfAStepThatThrowsIsForgottenByTheNextMotion) {
  Posed s(problems::pendulum_with_rod());
  const State start = s.start();
  State later = start;
  later.q = 1.001 * Eigen::Vector2d(-start.q[1], start.q[0]);
  const auto begun = [&](bool after_a_throw) {
    RungeKutta method({1, nullptr, nullptr, nullptr});
    method.rows = RungeKutta::Rows::null_space;
    const auto trial = []() -> Outcome { throw OutsideDomain(""); };
    if (after_a_throw) {
      EXPECT_THROW((void)method.within_step(s, start, trial), OutsideDomain);
    }
    Slope slope;
    method.begin(s, later, slope);
    return slope.v;
  };
  ASSERT_EQ(begun(false).size(), 2);
  EXPECT_EQ(begun(true), begun(false));
}

}  // namespace
}  // namespace trammel::test
