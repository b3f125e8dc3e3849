#include "system/assembled_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "particle.hpp"

namespace trammel::model {
namespace {

constexpr double round_off = 1e-12;

class Law final : public Restitution {
 public:
  double coefficient(double) const override { return 0; }
  Treatment treatment() const override { return {}; }
};

class Cubic final : public ContactForce {
 public:
  double normal(double gap, double rate, double) const override {
    return gap < 0 ? 1e6 * -gap * gap * gap - 10 * rate : 0;
  }
  double potential(double gap) const override { return gap < 0 ? 1e6 * gap * gap * gap * gap / 4 : 0; }
  Slope slope(double gap, double, double) const override {
    return {gap < 0 ? -3e6 * gap * gap : 0, gap < 0 ? -10.0 : 0};
  }
};

// A double pendulum of particles, in redundant coordinates; `doubled` adds the first rod once more.
std::shared_ptr<Model> double_pendulum(bool doubled) {
  auto model = std::make_shared<Model>();
  model->world.gravity = Eigen::Vector2d(0, -9.81);
  test::add_particle(*model, "one", 1.0, {0.6, -0.8}, {0.8 * 1.5, 0.6 * 1.5});
  test::add_particle(*model, "two", 3.0, {1.6, -0.8}, {0.8 * 1.5, 0.6 * 1.5 - 2.0});
  test::add_rod(*model, {0, 0}, {}, 1.0);
  test::add_rod(*model, {1, 0}, {0, 0}, 1.0);
  if (doubled) test::add_rod(*model, {0, 0}, {}, 1.0);
  model->lay_out();
  return model;
}

struct At {
  explicit At(std::shared_ptr<const Model> model) : system(std::move(model)) {
    system.initial(q, v);
    system.move_to(0, q, v);
  }
  AssembledSystem system;
  Vec q, v;
};

TEST(AssembledSystem, AccelerationsSatisfyMotionAndRows) {
  At at(double_pendulum(false));
  Vec a, lambda, r = Vec::Zero(4), rc;
  at.system.accelerate({}, a, lambda);
  at.system.add_mass_times(1, a, r);
  at.system.add_reaction(1, lambda, r);
  r -= at.system.f();
  at.system.constraint_acceleration(a, rc);
  EXPECT_LT(r.norm(), round_off);
  EXPECT_LT(rc.norm(), round_off);
}

TEST(AssembledSystem, RowsAloneGiveTheirRatesAndTheirForces) {
  At at(double_pendulum(false));
  Vec rates = Vec::Ones(2), force = Vec::Ones(4);
  const Eigen::Vector2d mu(2, -5);
  at.system.add_rows_times(3, at.v, rates);  // no row depends on time: G v = g_dot
  at.system.add_rows_force(3, mu, force);
  EXPECT_LT((rates - Vec::Ones(2) - 3 * at.system.g_dot()).norm(), round_off);
  // The same power either way.
  EXPECT_NEAR(at.v.dot(force - Vec::Ones(4)), 3 * mu.dot(at.system.g_dot()), round_off);
  const Vec x = Eigen::Vector4d(1, -2, 3, 4);
  Vec Gx = Vec::Zero(2);
  at.system.add_rows_times(1, x, Gx);
  EXPECT_NEAR(x.dot(force - Vec::Ones(4)), 3 * mu.dot(Gx), round_off);
}

TEST(AssembledSystem, BaumgarteTermsEnterTheRows) {
  At at(double_pendulum(false));
  Vec a, lambda, rc;
  at.q(0) += 1e-3;
  at.system.move_to(0, at.q, at.v);
  at.system.accelerate({3, 7}, a, lambda);
  at.system.constraint_acceleration(a, rc);
  EXPECT_LT((rc + 6 * at.system.g_dot() + 49 * at.system.g()).norm(), round_off);
}

TEST(AssembledSystem, RedundantRowsLeaveAccelerationsUniqueAndMultipliersOfMinimumNorm) {
  At once(double_pendulum(false)), twice(double_pendulum(true));
  Vec a1, a2, lambda1, lambda2;
  once.system.accelerate({}, a1, lambda1);
  twice.system.accelerate({}, a2, lambda2);
  // The rank decision works at sqrt(eps); its effect on a is round-off times the condition of the rows.
  EXPECT_LT((a1 - a2).norm(), 1e-11);
  EXPECT_NEAR(lambda2(0), lambda1(0) / 2, 1e-10);
  EXPECT_NEAR(lambda2(2), lambda1(0) / 2, 1e-10);
}

TEST(AssembledSystem, TangentIsTheDerivativeOfTheResidual) {
  At at(double_pendulum(false));
  const Vec a = Vec::LinSpaced(4, -1, 2), lambda = Vec::LinSpaced(2, 3, -5);
  const auto residual = [&](const Vec& q) {
    Vec r = Vec::Zero(4);
    at.system.move_to(0, q, at.v);
    at.system.add_mass_times(1, a, r);
    at.system.add_reaction(1, lambda, r);
    return Vec(r - at.system.f());
  };
  Mat K(4, 4);
  const double s = 1e-5;
  for (int j = 0; j < 4; ++j) {
    const Vec e = s * Vec::Unit(4, j);
    K.col(j) = (residual(at.q + e) - residual(at.q - e)) / (2 * s);
  }
  // Solve with S = M + c K through the system, and with the difference matrix directly.
  at.system.move_to(0, at.q, at.v);
  at.system.factorise({1, 0, 0.3}, a, lambda);
  Vec da, dlambda;
  const Vec b = Vec::LinSpaced(4, 1, 2), c = Vec::LinSpaced(2, -1, 1);
  ASSERT_TRUE(at.system.correct(-b, -c, da, dlambda));
  Mat M = Mat::Zero(4, 4);
  M.diagonal() << 1, 1, 3, 3;
  Vec left = M * da + 0.3 * (K * da);
  at.system.add_reaction(1, dlambda, left);
  EXPECT_LT((left - b).norm(), 1e-7);  // truncation of the differences, here and in the fallback
}

TEST(AssembledSystem, BothFactorisationsAreKeptSideBySide) {
  At at(double_pendulum(false));
  const Vec zero = Vec::Zero(4), none = Vec::Zero(2), b = Vec::Ones(4);
  Vec first, again, dlambda;
  at.system.factorise({1, 0, 0.3}, zero, none);
  ASSERT_TRUE(at.system.correct(b, none, first, dlambda));
  at.system.factorise({1, 0, 0}, zero, none, Factors::projection);
  ASSERT_TRUE(at.system.correct(b, none, again, dlambda));
  EXPECT_EQ(first, again);
}

TEST(AssembledSystem, ProjectionBringsTheRowsToZero) {
  At at(double_pendulum(false));
  at.q += 1e-4 * Vec::LinSpaced(4, -1, 1);
  Vec dq, mu;
  for (int i = 0; i < 3; ++i) {
    at.system.move_to(0, at.q, at.v);
    at.system.factorise({1, 0, 0}, at.v, Vec::Zero(2));
    ASSERT_TRUE(at.system.correct(Vec::Zero(4), at.system.g(), dq, mu));
    at.q += dq;
  }
  at.system.move_to(0, at.q, at.v);
  EXPECT_LT(at.system.g().norm(), 1e-15);  // quadratic: 1e-4, 1e-8, round-off
}

std::shared_ptr<Model> particle_over_plane(std::unique_ptr<Component> law) {
  auto model = std::make_shared<Model>();
  test::add_particle(*model, "ball", 2.0, {0.3, 0.1}, {1.0, -3.0});
  model->contacts.emplace_back();
  ContactEntry& contact = model->contacts.back();
  contact.name = "floor";
  contact.A = {0, 0};
  contact.geometry = {Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 1)};
  contact.law = std::move(law);
  model->lay_out();
  return model;
}

TEST(AssembledSystem, AnOpenContactAddsNoRow) {
  At at(particle_over_plane(std::make_unique<Law>()));
  EXPECT_EQ(at.system.sizes().nc, 0);
  EXPECT_DOUBLE_EQ(at.system.gap(0), 0.1);
  EXPECT_DOUBLE_EQ(at.system.gap_rate(0), -3.0);
}

TEST(AssembledSystem, AClosedContactPushesWithMinusLambda) {
  At at(particle_over_plane(std::make_unique<Law>()));
  Modes modes = at.system.modes();
  modes.contacts[0].closed = true;
  at.system.set_modes(modes);
  at.system.move_to(0, at.q, at.v);
  Vec a, lambda;
  at.system.accelerate({}, a, lambda);
  EXPECT_EQ(at.system.sizes().nc, 1);
  EXPECT_NEAR(at.system.normal_force(0, lambda), 2 * 9.81, round_off);
  EXPECT_NEAR(at.system.acceleration({0, 0}, a), 0, round_off);
}

TEST(AssembledSystem, ImpulseResponseIsTheInverseEffectiveMass) {
  At at(particle_over_plane(std::make_unique<Law>()));
  Mat jump, delassus;
  at.system.impulse_response({{0, 0}}, jump, delassus);
  EXPECT_NEAR(delassus(0, 0), 1 / 2.0, round_off);
  EXPECT_NEAR(jump(1, 0), 1 / 2.0, round_off);
}

TEST(AssembledSystem, ACompliantContactActsOnlyWhileClosed) {
  At at(particle_over_plane(std::make_unique<Cubic>()));
  at.q(1) = -0.01;
  at.system.move_to(0, at.q, at.v);
  EXPECT_NEAR(at.system.f()(1), -2 * 9.81, round_off);
  Modes modes = at.system.modes();
  modes.contacts[0].closed = true;
  at.system.set_modes(modes);
  EXPECT_NEAR(at.system.f()(1), -2 * 9.81 + 1 + 30, round_off);
  EXPECT_NEAR(at.system.energy().elastic, 1e6 * 1e-8 / 4, round_off);
  EXPECT_NEAR(at.system.balance(Vec()).contacts, 30 * 3, 1e-10);  // 10 N s/m at 3 m/s
  modes.contacts[0].closed = false;
  at.system.set_modes(modes);
  EXPECT_EQ(at.system.energy().elastic, 0);
  EXPECT_EQ(at.system.balance(Vec()).contacts, 0);
}

// Of a body's own spring, damper and drive.
class Oscillator final : public Body {
 public:
  Coordinates coordinates() const override { return Coordinates::flat(1); }
  void initial(Out q, Out v) const override { q(0) = 0.5, v(0) = 3; }
  void mass(double, In, Matrix& M) const override { M.add(0, 0, 2); }
  void force(double, In q, In v, Out f) const override { f(0) += 7 - 40 * q(0) - 6 * v(0); }
  Energy energy(double, In q, In v) const override {
    return {.kinetic = v(0) * v(0), .potential = 11, .elastic = 20 * q(0) * q(0)};
  }
  Power power(double, In, In v) const override { return {.supplied = 7 * v(0), .dissipated = 6 * v(0) * v(0)}; }
  std::span<const std::string> markers() const override { return {}; }
  void motion(int, double, In, In, Motion&) const override {}
};

TEST(AssembledSystem, AddsUpWhatItsBodiesStoreSupplyAndDissipate) {
  auto model = std::make_shared<Model>();
  for (const char* name : {"one", "two"}) {
    model->bodies.emplace_back();
    model->bodies.back().name = name;
    model->bodies.back().body = std::make_unique<Oscillator>();
  }
  model->lay_out();
  At at(model);
  const Energy energy = at.system.energy();
  EXPECT_EQ(energy.kinetic, 2 * 9);
  EXPECT_EQ(energy.potential, 2 * 11);
  EXPECT_EQ(energy.elastic, 2 * 5);
  for (int again = 0; again < 2; ++again) {
    const AssembledSystem::Balance& balance = at.system.balance(Vec());
    EXPECT_EQ(balance.drives, 2 * 21);
    EXPECT_EQ(balance.dampers, 2 * 54);
    EXPECT_EQ(balance.contacts, 0);
    EXPECT_EQ(balance.constraints, 0);
    EXPECT_EQ(balance.markers, 0);
  }
}

// Their forces do work on velocities that violate them; that is the method's error and no supply.
TEST(AssembledSystem, RowsThatTimeDoesNotMoveSupplyNothingWhateverTheVelocities) {
  At at(double_pendulum(false));
  at.system.move_to(0, at.q, Eigen::Vector4d(5, -3, 2, 7));
  ASSERT_GT(at.system.g_dot().norm(), 1);
  EXPECT_NEAR(at.system.balance(Eigen::Vector2d(20, -30)).constraints, 0, round_off);
}

// The ledger calls balance() in every step.
TEST(AssembledSystem, ReusesTheMemoryOfItsBalance) {
  At at(particle_over_plane(std::make_unique<Cubic>()));
  const double* const friction = at.system.balance(Vec()).friction.data();
  at.system.move_to(1, at.q, at.v);
  EXPECT_EQ(at.system.balance(Vec()).friction.data(), friction);
}

TEST(AssembledSystem, NamesTheComponentThatIsNotFinite) {
  At at(double_pendulum(false));
  at.q(2) = std::numeric_limits<double>::quiet_NaN();
  at.system.move_to(0, at.q, at.v);
  const CallSite site = at.system.find_not_finite();
  EXPECT_EQ(site.origin, &at.system.model().bodies[1].origin);  // whose coordinate it is
}

// Several solutions at one point are one iteration of Newton's method, those of rows alone are none.
TEST(AssembledSystem, CountsNewtonIterationsByPoints) {
  At at(double_pendulum(false));
  const Vec r = Vec::Ones(4), rows = Vec::Ones(2), none = Vec::Zero(4), no_rows = Vec::Zero(2);
  Vec da, dlambda;
  at.system.factorise({1, 0, 0}, none, no_rows);
  at.system.factorise({1, 0, 0}, none, no_rows, Factors::projection);
  const auto count = [&] { return at.system.counts().newton_iterations; };
  ASSERT_TRUE(at.system.correct(r, rows, da, dlambda));
  ASSERT_TRUE(at.system.correct(r, no_rows, da, dlambda));
  ASSERT_TRUE(at.system.correct(none, rows, da, dlambda));
  EXPECT_EQ(count(), 1);
  at.system.move_to(0.1, at.q, at.v);
  ASSERT_TRUE(at.system.correct(none, rows, da, dlambda));
  ASSERT_TRUE(at.system.correct(r, rows, da, dlambda, Factors::projection));
  EXPECT_EQ(count(), 1);
  at.system.move_to(0.2, at.q, at.v);
  ASSERT_TRUE(at.system.correct(r, rows, da, dlambda));
  EXPECT_EQ(count(), 2);
}

}  // namespace
}  // namespace trammel::model
