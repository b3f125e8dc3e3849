// One step of the trapezoidal rule, driven by hand on linear systems whose iteration matrix is wrong by a known amount:
// each increment of Newton's iteration then leaves the part theta of the error before it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include <trammel/methods/newmark_step.hpp>
#include <trammel/testing/problems.hpp>

namespace trammel {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Unit masses on springs: f_i = -k_i (q_i - rest_i).
struct Springs {
  Vec k, rest, q, v;
  std::function<Vec(const Vec& q)> force = {};  // in place of the springs' own
  std::function<Problem::Rows(const Vec& q, const Vec& v)> rows = {};
  double theta = 0;
  double hides = 1;            // the first coordinate's entry of the first matrix is this many times as large
  int coordinates_beside = 0;  // coordinates without velocity, at 1e6, after the others
  mutable int residuals = 0, factorisations = 0;

  Vec forces(const Vec& at) const { return force ? force(at) : Vec(-k.cwiseProduct(at.head(k.size()) - rest)); }
  std::unique_ptr<System> system() const {
    Problem p;
    p.name = "springs";
    p.closed_form = false;
    const Eigen::Index n = k.size();
    p.M = Mat::Identity(n, n);
    p.force = [this](double, const Vec& at, const Vec&) { return ++residuals, forces(at); };
    if (rows) p.rows = [this](double, const Vec& at, const Vec& u) { return rows(at, u); };
    p.tangent = [this, n](const Blend& c, const Vec&, const Vec&) -> Mat {
      const double of_first = factorisations++ == 0 ? hides : 1;
      Vec S = (Vec::Ones(n) + c.c_k * k) / (1 - theta);
      S[0] *= of_first;
      return (S - Vec::Ones(n)).asDiagonal();
    };
    p.exact = [this](double, Vec& at, Vec& u) { at = place(), u = v; };
    if (coordinates_beside > 0) {
      p.manifold.retract = [n](const Vec& at, const Vec& dq) {
        Vec moved = at;
        moved.head(n) += dq;
        return moved;
      };
    }
    return p.system();
  }
  Vec place() const {
    Vec all(q.size() + coordinates_beside);
    all << q, Vec::Constant(coordinates_beside, 1e6);
    return all;
  }
  State start(System& s) const {
    State now{0, place(), v, {}, {}};
    s.move_to(0, now.q, now.v);
    s.accelerate({}, now.a, now.lambda);
    return now;
  }
};

Springs one_spring(double k, double q, double v) {
  return {.k = Vec::Constant(1, k), .rest = Vec::Zero(1), .q = Vec::Constant(1, q), .v = Vec::Constant(1, v)};
}

struct Previous {
  Vec a;
  double ratio = 1;
};

// A step of the trapezoidal rule, an increment at a time.
struct Trapezoidal {
  NewmarkStep step;
  System& s;
  State now, next;
  double h, c_q, c_v;

  Trapezoidal(System& system, const State& from, double size)
      : s(system), now(from), h(size), c_q(size * size / 4), c_v(size / 2) {}
  void begin(const Previous& before = {}) {
    step.dq = h * now.v + c_q * now.a;
    step.v = now.v + c_v * now.a;
    step.begin(s, now, h, c_q, c_v, next);
    step.extrapolate(now, before.a, before.ratio, next);
  }
  Vec residual() {
    step.move(s, now, next);
    Vec r = -s.f();
    s.add_reaction(1, next.lambda, r);
    s.add_mass_times(1, next.a, r);
    return r;
  }
  void correct() { step.correct(s, {1, c_v, c_q}, residual(), next); }
  int iterate() {
    int n = 0;
    for (; step.iterating(); ++n) correct();
    return n;
  }
  // Of springs: a of the step's end.
  Vec exact(const Springs& of) const {
    const Vec at = now.q.head(of.k.size()) + step.dq - of.rest;
    return -of.k.cwiseProduct(at).cwiseQuotient(Vec::Ones(of.k.size()) + c_q * of.k);
  }
};

// --- The prediction ---

TEST(NewmarkStep, PredictsAccelerationsByALineAndMultipliersByTheirLastValue) {
  const Springs springs = one_spring(1, 1, 0);
  const auto s = springs.system();
  State now = springs.start(*s);
  now.a[0] = 1.25;
  Trapezoidal t(*s, now, 0.1);
  t.begin({Vec::Constant(1, 1), 2});
  EXPECT_EQ(t.next.a[0], 1.75);
  EXPECT_EQ(t.next.t, 0.1);

  Springs rod = springs;
  rod.rows = [](const Vec& q, const Vec&) { return Problem::Rows{q, Vec::Zero(1), Vec::Zero(1), Mat::Ones(1, 1)}; };
  rod.force = [](const Vec&) { return Vec::Constant(1, 3); };
  const auto held = rod.system();
  Trapezoidal u(*held, rod.start(*held), 0.1);
  u.begin();
  EXPECT_EQ(u.next.lambda, u.now.lambda);
  EXPECT_NEAR(u.now.lambda[0], 3, 8 * eps);
}

TEST(NewmarkStep, KeepsTheAccelerationThatChangesByHalfOrWasThatOfAMuchShorterStep) {
  const Springs springs = one_spring(1, 1, 0);
  const auto s = springs.system();
  State now = springs.start(*s);
  now.a[0] = 1;
  Trapezoidal t(*s, now, 0.1);
  const auto predicted = [&](double before, double ratio) {
    t.begin({Vec::Constant(1, before), ratio});
    return t.next.a[0];
  };
  EXPECT_NEAR(predicted(0.51, 1), 1.49, 4 * eps);
  EXPECT_EQ(predicted(0.49, 1), 1);
  EXPECT_EQ(predicted(1.51, 1), 1);
  EXPECT_NEAR(predicted(0.9, 3.9), 1.39, 4 * eps);
  EXPECT_EQ(predicted(0.9, 4.1), 1);
  t.begin();
  EXPECT_EQ(t.next.a[0], 1) << "without a step before";
}

// omega h = 1000: a_n moves q by 250 times its amplitude. Without it the first guess is the place that v leads to.
TEST(NewmarkStep, BeginsAlongTheVelocityWhereAccelerationsLeadAstray) {
  const double h = 1;
  for (const bool line : {false, true}) {
    const Springs springs = one_spring(1e6, 1e-3, 0.1);
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), h);
    t.begin(line ? Previous{0.9 * t.now.a, 1} : Previous{});
    t.correct();
    EXPECT_EQ(springs.factorisations, 0) << "nothing is solved for yet";
    t.residual();
    EXPECT_NEAR(t.next.q[0], 1e-3 + h * 0.1, 1e-12);  // round-off of 250 m of a_n
    t.correct();
    EXPECT_NEAR(t.next.a[0], t.exact(springs)[0], 1e-9 * std::abs(t.now.a[0]));
  }
}

// Each is half of what makes an acceleration misleading: it moves q further than v does, and changes forces by more
// than M a.
TEST(NewmarkStep, BeginsWithTheAccelerationWhereItMovesLittleOrChangesForcesLittle) {
  const auto first_solves = [](const Springs& springs) {
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1);
    t.begin();
    t.correct();
    return springs.factorisations == 1 && std::abs(t.next.a[0] - t.exact(springs)[0]) <= 1e-9 * std::abs(t.now.a[0]);
  };
  EXPECT_TRUE(first_solves(one_spring(1e6, 1e-3, 1e5))) << "v moves q by 1e5 m, a by 500 m";
  EXPECT_TRUE(first_solves(one_spring(0.1, 1, 0))) << "a slow motion from rest";
  EXPECT_FALSE(first_solves(one_spring(1e6, 1e-3, 0.1)));
}

// --- The end of the iteration ---

// Largest error of a, and where Newton's iteration should end.
struct Ended {
  double error, allowed;
  int factorisations;
};
// Of one coordinate of `springs`. `scale_q`, `scale_v`: by what the changes of its place and of velocities count.
Ended ended(const Springs& springs, int coordinate, double h, double scale_q, double scale_v) {
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), h);
  t.step.newton.max_iterations = 100;
  t.begin();
  const double at_first = std::abs(t.next.a[coordinate] - t.exact(springs)[coordinate]);
  const int increments = t.iterate();
  EXPECT_TRUE(t.step.newton.converged());
  const double a = std::abs(t.next.a[coordinate]), largest = t.next.a.lpNorm<Eigen::Infinity>();
  const double error = std::abs(t.next.a[coordinate] - t.exact(springs)[coordinate]);
  EXPECT_NEAR(error, at_first * std::pow(springs.theta, increments), 0.01 * error) << "a residual without an increment";
  const double tolerance = t.step.newton.tolerance;
  return {error, tolerance * std::min((scale_q + t.c_q * a) / t.c_q, (scale_v + t.c_v * largest) / t.c_v),
          springs.factorisations};
}
// The error left is below what is allowed, and one iteration earlier it was not. The factors of the start serve: what
// they leave of the residual does not matter.
void expect_just_below(const Ended& ended, double theta) {
  EXPECT_LE(ended.error, 1.001 * ended.allowed);  // round-off of differences of a: 1e-16 beside 1e-11
  EXPECT_GE(ended.error, 0.999 * theta * ended.allowed);
  EXPECT_EQ(ended.factorisations, 1);
}

constexpr double theta = 0.2;

// Beside a coordinate that is far away and fast: all lengths and velocities together are 1e6 times its own.
Springs beside_a_fast_one(double q, double v, double rest = 0) {
  return {.k = Eigen::Vector2d(0, 1),
          .rest = Eigen::Vector2d(0, rest),
          .q = Eigen::Vector2d(1e6, q),
          .v = Eigen::Vector2d(1e6, v),
          .theta = theta};
}

TEST(NewmarkStep, EndsAtItsToleranceOfAMetreOrARadianOfEachCoordinate) {
  expect_just_below(ended(beside_a_fast_one(0.1, 0), 1, 1, 1, 4e6), theta);
}

TEST(NewmarkStep, EndsAtItsToleranceOfTheChangeOfACoordinateThatMovesFar) {
  const double q = 100, v = 1000, h = 1, a = q;
  const double change = h * v + h * h * a + std::abs(h * v - h * h / 4 * a);
  expect_just_below(ended(beside_a_fast_one(q, v), 1, h, change, 4e6), theta);
}

TEST(NewmarkStep, EndsAtTheRoundOffOfACoordinate) {
  const double far = 1e6;
  expect_just_below(ended(beside_a_fast_one(far, 0, far - 1), 1, 1, 64 * eps / 1e-11 * far, 4e6), theta);
}

// Entries of q that do not belong to those of v: the largest one counts for all.
TEST(NewmarkStep, EndsAtTheRoundOffOfTheLargestNumberWhereCoordinatesAreNotVelocities) {
  const Springs springs{.k = Eigen::Vector2d(1, 0),
                        .rest = Vec::Zero(2),
                        .q = Eigen::Vector2d(0.1, 0),
                        .v = Eigen::Vector2d(0, 1e6),
                        .theta = theta,
                        .coordinates_beside = 1};
  expect_just_below(ended(springs, 0, 1, 64 * eps / 1e-11 * 1e6, 2e6), theta);
}

TEST(NewmarkStep, EndsAtItsToleranceOfTheVelocities) {
  const double v = 2, h = 1e-3;
  Springs springs = one_spring(1e4, 1, v);
  springs.theta = theta;
  // a = -1e4 m/s^2: its v is 2 m/s at the start, and changes by 10 m/s.
  const double size_v = v + h * 1e4 + std::abs(v - h / 2 * 1e4);
  expect_just_below(ended(springs, 0, h, 1, size_v), theta);
}

// The first increment after a prediction measures the step's own error.
TEST(NewmarkStep, EndsAtAThousandthOfTheFirstIncrementAfterAPrediction) {
  for (const double factor : {0.05, 0.08, 0.09}) {
    Springs springs = one_spring(0.04, 1, 1);
    springs.theta = factor;
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1);
    t.begin({Vec::Constant(1, -0.03), 1});
    const double wrong = std::abs(t.next.a[0] - t.exact(springs)[0]), first = (1 - factor) * wrong;
    EXPECT_EQ(t.iterate(), 3);
    const double left = std::abs(t.next.a[0] - t.exact(springs)[0]);
    EXPECT_LE(left, 1e-3 * first);
    EXPECT_GE(left / factor, 1e-3 * first);
    EXPECT_EQ(springs.factorisations, 1);
  }
}

// Nothing moves along x at first, but y is off its plane, which changes the force along x.
TEST(NewmarkStep, DoesNotEndBeforePositionsAreOnTheirRows) {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(1e6, 1e-6), .v = Eigen::Vector2d(1, 0)};
  springs.force = [](const Vec& q) { return Eigen::Vector2d(1e6 * q[1], 0); };
  springs.rows = [](const Vec& q, const Vec&) {
    return Problem::Rows{q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1)};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  EXPECT_NEAR(t.now.a[0], 1, 8 * eps);
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_EQ(t.next.q[1], 0);
  EXPECT_LE(std::abs(t.next.a[0]), 1e-9);  // 1e6 times the round-off of y
}

TEST(NewmarkStep, SatisfiesLinearRowsByItsFirstIncrement) {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(0, 1e-3), .v = Eigen::Vector2d(1, 0.5)};
  springs.rows = [](const Vec& q, const Vec&) {
    return Problem::Rows{q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1)};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 0.1);
  t.begin();
  t.correct();
  t.residual();
  EXPECT_LE(std::abs(s->g()[0]), 1e-16);
  EXPECT_LE(std::abs(s->g_dot()[0]), 1e-16);
}

TEST(NewmarkStep, HasNothingToFindWithoutVelocities) {
  Springs nothing{.k = Vec(0), .rest = Vec(0), .q = Vec(0), .v = Vec(0)};
  const auto s = nothing.system();
  Trapezoidal t(*s, State{0, Vec(0), Vec(0), Vec(0), Vec(0)}, 1);
  t.begin({Vec(0), 1});
  EXPECT_FALSE(t.step.iterating());
  EXPECT_TRUE(t.step.finish(*s, t.now, t.next));
}

// --- Round-off ---

// Positions resolve 1e-13 m, so forces 1e-7 N, far more than the tolerance of a velocity of a micrometre per second.
TEST(NewmarkStep, AcceptsForcesThatAreTheRoundOffOfFarPositions) {
  for (int i = 0; i < 40; ++i) {
    Springs springs = one_spring(1e6, 1e3, 1e-6 * std::sin(i));
    springs.rest[0] = 1e3;
    const auto s = springs.system();
    Trapezoidal t(*s, springs.start(*s), 1e-3);
    t.begin();
    t.iterate();
    EXPECT_TRUE(t.step.finish(*s, t.now, t.next)) << i;
  }
}

// A force of 1e6 N on a slope: what its rounding leaves along the slope is all that could move, also where springs do
// not let it.
TEST(NewmarkStep, AcceptsRestUnderForcesThatRowsCarry) {
  for (const double k : {0, 4})
    for (int i = 1; i < 40; ++i) {
      const Eigen::Vector2d n(std::sin(0.03 * i), std::cos(0.03 * i)), F = 1e6 / 3.0 * n;
      Springs springs{.k = Vec::Constant(2, k), .rest = Vec::Zero(2), .q = Vec::Zero(2), .v = Vec::Zero(2)};
      springs.force = [F, k](const Vec& q) { return F - k * q; };
      springs.rows = [n](const Vec& q, const Vec&) {
        return Problem::Rows{Vec::Constant(1, n.dot(q)), Vec::Zero(1), Vec::Zero(1), n.transpose()};
      };
      const auto s = springs.system();
      State now = springs.start(*s);
      now.a.setZero();
      Trapezoidal t(*s, now, 1);
      t.begin();
      t.iterate();
      EXPECT_TRUE(t.step.finish(*s, t.now, t.next)) << i;
      EXPECT_LE(t.next.v.norm(), 1e-9) << i;  // 1e6 N: round-off 1e-10 m/s^2
    }
}

TEST(NewmarkStep, RejectsAPlaceBeyondAllNumbers) {
  const Springs free = one_spring(0, 0, 1e308);
  const auto s = free.system();
  Trapezoidal t(*s, free.start(*s), 10);
  t.begin();
  t.iterate();
  EXPECT_FALSE(t.step.finish(*s, t.now, t.next));
}

// --- Rows ---

// A particle at (0, y), at rest, on the rows y = 0 as they are given.
struct OnRows {
  Springs springs;
  int evaluations = 0;
  explicit OnRows(double x, double y, std::function<Problem::Rows(const Vec& q)> of) {
    springs = {.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(x, y), .v = Vec::Zero(2)};
    springs.force = [](const Vec&) { return Vec::Zero(2); };
    springs.rows = [this, of](const Vec& q, const Vec&) { return ++evaluations, of(q); };
  }
  // What `finish` returns, and how often it evaluates rows.
  std::pair<Outcome, int> finish() {
    const auto s = springs.system();
    State now = springs.start(*s);
    now.a.setZero(), now.lambda.setZero();
    Trapezoidal t(*s, now, 1);
    t.begin();
    t.iterate();
    evaluations = 0;
    const Outcome outcome = t.step.finish(*s, t.now, t.next);
    return {outcome, evaluations};
  }
};
Problem::Rows plane(double y, double slope = 1) {
  return {Vec::Constant(1, y), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, slope)};
}

TEST(NewmarkStep, EvaluatesRowsOnceMoreWhereItsIterationHasSatisfiedThem) {
  EXPECT_EQ(OnRows(0, 1e-3, [](const Vec& q) { return plane(q[1]); }).finish().second, 1);
}

// Factors are as wrong as q has moved since: 1e-12 of what the iteration left, 1e-13, is below round-off.
TEST(NewmarkStep, EvaluatesRowsOnceMoreAfterATinyMotion) {
  EXPECT_EQ(OnRows(1, 1e-12, [](const Vec& q) { return plane(q[1], 1 / 0.9); }).finish().second, 1);
}

TEST(NewmarkStep, GoesOnWhileFactorsOfAnEarlierPointLeaveMoreThanRoundOff) {
  OnRows wrong(1, 1e-2, [](const Vec& q) { return plane(q[1], 1 / 0.9); });
  EXPECT_GE(wrong.finish().second, 2);
}

// y = 0 and y = apart: half of `apart` is left in each.
TEST(NewmarkStep, RejectsRowsThatContradictEachOtherByAMillionthOfTheLengths) {
  for (const double x : {1.0, 1000.0}) {
    const auto contradicting = [&](double apart) {
      return OnRows(x, 0,
                    [apart](const Vec& q) {
                      return Problem::Rows{Eigen::Vector2d(q[1], q[1] - apart), Vec::Zero(2), Vec::Zero(2),
                                           Mat{{0, 1}, {0, 1}}};
                    })
          .finish()
          .first;
    };
    EXPECT_TRUE(contradicting(1.9e-6 * x));
    EXPECT_FALSE(contradicting(2.1e-6 * x));
  }
}

TEST(NewmarkStep, AcceptsSatisfiedRowsThatMoveNothing) {
  Springs nothing{.k = Vec(0), .rest = Vec(0), .q = Vec(0), .v = Vec(0)};
  double off = 0;
  nothing.rows = [&](const Vec&, const Vec&) {
    return Problem::Rows{Vec::Constant(1, off), Vec::Zero(1), Vec::Zero(1), Mat(1, 0)};
  };
  const auto s = nothing.system();
  Trapezoidal t(*s, State{0, Vec(0), Vec(0), Vec(0), Vec::Zero(1)}, 1);
  t.begin();
  EXPECT_TRUE(t.step.finish(*s, t.now, t.next));
  off = 1e-3;
  EXPECT_FALSE(t.step.finish(*s, t.now, t.next));
}

// First along a plane with friction, whose reactions are tilted, then along a wall without: positions are brought onto
// the wall across it.
TEST(NewmarkStep, ForgetsTheFactorsOfRowsThatHadFriction) {
  bool wall = false;
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Eigen::Vector2d(1e-3, 1e-3), .v = Vec::Zero(2)};
  springs.rows = [&](const Vec& q, const Vec&) {
    Problem::Rows rows = plane(q[1]);
    if (wall)
      rows.g = q.head(1), rows.G = Eigen::RowVector2d(1, 0);
    else
      rows.W = Eigen::RowVector2d(-0.5, 1);
    return rows;
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 0.1);
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_NEAR(t.next.q[1], 0, 1e-16);
  wall = true;
  t.begin();
  t.iterate();
  ASSERT_TRUE(t.step.finish(*s, t.now, t.next));
  EXPECT_NEAR(t.next.q[0], 0, 1e-16);
  EXPECT_NEAR(t.next.q[1], 1e-3, 1e-16);
}

// --- Doubts ---

// The first factors make x a million times too stiff: it hardly moves, which looks like convergence.
TEST(NewmarkStep, FactorisesAgainWhereItsFactorsHideAForce) {
  Springs springs{
      .k = Eigen::Vector2d(1, 1), .rest = Vec::Zero(2), .q = Eigen::Vector2d(0.02, 1), .v = Vec::Zero(2), .hides = 1e6};
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.begin({0.99 * t.now.a, 1});
  t.iterate();
  EXPECT_EQ(springs.factorisations, 2);
  EXPECT_LE((t.next.a - t.exact(springs)).norm(), 1e-3 * t.now.a.norm());
  EXPECT_NEAR(t.next.a[0], t.exact(springs)[0], 1e-3 * 0.02);
}

// Half of the inertia is stiffness, so factors of an earlier point are doubted; but the next residual is too small to
// matter.
TEST(NewmarkStep, TakesASmallResidualForAConfirmation) {
  Springs springs = one_spring(4, 1, 1);
  springs.theta = 0.05;
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.begin({1.3 * t.now.a, 1});
  for (int i = 0; i < 3; ++i) t.correct();
  EXPECT_TRUE(t.step.iterating()) << "doubted";
  const Vec a = t.next.a;
  t.correct();
  EXPECT_TRUE(t.step.newton.converged());
  EXPECT_EQ(t.next.a, a);
  EXPECT_EQ(springs.factorisations, 1);
}

// Nor is a doubt left to the next step where a caller has given up.
TEST(NewmarkStep, BeginsWithoutTheDoubtsOfAnAbandonedStep) {
  Springs springs = one_spring(4, 1, 1);
  springs.theta = 0.05;
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.begin({1.3 * t.now.a, 1});
  for (int i = 0; i < 3; ++i) t.correct();
  ASSERT_TRUE(t.step.iterating());
  t.begin({1.3 * t.now.a, 1});
  t.next.a = t.exact(springs) * (1 + 1e-4);
  t.correct();
  EXPECT_EQ(springs.factorisations, 2);
}

// Each increment of x changes the force on the row by a thousand times as much; multipliers take all of it.
TEST(NewmarkStep, HasNoDoubtsBecauseOfForcesThatMultipliersBalance) {
  Springs springs{.k = Vec::Zero(2), .rest = Vec::Zero(2), .q = Vec::Zero(2), .v = Eigen::Vector2d(1, 0)};
  springs.theta = 0.05;
  springs.force = [](const Vec& q) { return Eigen::Vector2d(0.1 + 0 * q[0], -1000 * q[0]); };
  springs.rows = [](const Vec& q, const Vec&) {
    return Problem::Rows{q.tail(1), Vec::Zero(1), Vec::Zero(1), Eigen::RowVector2d(0, 1)};
  };
  const auto s = springs.system();
  Trapezoidal t(*s, springs.start(*s), 1);
  t.begin({Eigen::Vector2d(0.08, 0), 1});
  t.iterate();
  EXPECT_TRUE(t.step.newton.converged());
  EXPECT_EQ(springs.factorisations, 1);
}

}  // namespace
}  // namespace trammel
