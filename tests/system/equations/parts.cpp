// Each part of the equations at a point, by itself.
#include "parts.hpp"

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

constexpr double s = 1e-6;  // central differences: truncation 1e-12 of numbers near 1, round-off 1e-10
constexpr double by_differences = 1e-8;
constexpr double round_off = 1e-13;

TEST(Point, MovingToWhereItIsChangesNothing) {
  TestParts p;
  const long long number = p.at.number, configuration = p.at.configuration;
  EXPECT_FALSE(p.at.move_to(0, Vec(p.at.q), Vec(p.at.v)));
  EXPECT_EQ(p.at.number, number);
  EXPECT_TRUE(p.at.move_to(0, Vec(p.at.q), Vec(2 * p.at.v)));
  EXPECT_EQ(p.at.number, number + 1);
  EXPECT_EQ(p.at.configuration, configuration);  // M and G do not depend on v
}

TEST(RowsAtPoint, RatesAreTheDerivativesOfTheRows) {
  TestParts p;
  const Vec q = p.at.q, v = p.at.v, g_dot = p.rows.g_dot();
  p.move_to(q + s * v, v);
  const Vec plus = p.rows.g();
  p.move_to(q - s * v, v);
  EXPECT_LT(((plus - p.rows.g()) / (2 * s) - g_dot).lpNorm<Eigen::Infinity>(), by_differences);
}

TEST(RowsAtPoint, GammaIsWhatTheRatesLackForAnAcceleration) {
  TestParts p;
  const Vec q = p.at.q, v = p.at.v, a = Vec::LinSpaced(v.size(), -1, 2), gamma = p.rows.gamma();
  Vec acceleration = -gamma;
  p.rows.add_times(1, a, acceleration);
  p.move_to(q + s * v, v + s * a);
  const Vec plus = p.rows.g_dot();
  p.move_to(q - s * v, v - s * a);
  EXPECT_LT(((plus - p.rows.g_dot()) / (2 * s) - acceleration).lpNorm<Eigen::Infinity>(), by_differences);
}

TEST(JointFriction, LoadIsLinearAlongARayAndItsDerivativeFormsTheReaction) {
  TestParts p;
  const int guide = p.in_joint();
  const Vec lambda = Vec::LinSpaced(p.rows.count(), 3, -5);
  const double N = p.friction.load(guide, lambda);
  EXPECT_GT(N, 0);
  EXPECT_NEAR(p.friction.load(guide, 2 * lambda), 2 * N, round_off * N);
  p.friction.load_with(lambda);
  const model::JointEntry& joint = p.friction.joint_of(guide);
  EXPECT_NEAR(p.friction.load_by_row(guide).dot(lambda.segment(joint.row, joint.rows)), N, round_off * N);
}

TEST(JointFriction, FrictionOpposesSlip) {
  TestParts p;
  const Vec lambda = Vec::LinSpaced(p.rows.count(), 3, -5);
  Vec reaction = Vec::Zero(p.at.v.size()), of_rows = reaction;
  p.rows.add_reaction(1, lambda, reaction);
  p.rows.add_force(1, lambda, of_rows);
  const int guide = p.in_joint();
  const double power = -(reaction - of_rows).head(3).dot(p.at.v.head(3));  // of the drawer
  EXPECT_NEAR(power, -0.25 * p.friction.load(guide, lambda) * p.contacts.slip(guide).norm(), 1e-12);
}

TEST(MassAndForceAtPoint, KineticEnergyIsHalfTheSquareOfVByM) {
  TestParts p;
  Vec momentum = Vec::Zero(p.at.v.size());
  p.masses.add_times(1, p.at.v, momentum);
  double energy = 0;
  for (const model::BodyEntry& body : p.at.model->bodies)
    energy += body.body->energy(0, p.at.q_of(body), p.at.v_of(body)).kinetic;
  EXPECT_NEAR(momentum.dot(p.at.v) / 2, energy, round_off * energy);
}

TEST(TangentAtPoint, IsTheDerivativeOfTheEquationsOfMotion) {
  TestParts p;
  const Vec q = p.at.q, v = p.at.v, a = Vec::LinSpaced(v.size(), -1, 2);
  const Vec lambda = Vec::LinSpaced(p.rows.count(), 3, -5);
  const auto residual_at = [&](const Vec& place, const Vec& speed) {
    p.move_to(place, speed);
    Vec r = -p.masses.force();
    p.masses.add_times(1, a, r);
    p.rows.add_reaction(1, lambda, r);
    return r;
  };
  Mat D = Mat::Zero(v.size(), v.size()), K = D;
  Matrix onto_D = Matrix::onto(D), onto_K = Matrix::onto(K);
  p.tangent.add({.c_m = 0, .c_d = 1}, a, lambda, onto_D);
  p.tangent.add({.c_m = 0, .c_k = 1}, a, lambda, onto_K);
  for (Eigen::Index j = 0; j < v.size(); ++j) {
    const Vec e = s * Vec::Unit(v.size(), j);
    // Of forces near 100 N: 100 times the bound of numbers near 1.
    EXPECT_LT(((residual_at(q + e, v) - residual_at(q - e, v)) / (2 * s) - K.col(j)).lpNorm<Eigen::Infinity>(),
              100 * by_differences)
        << j;
    EXPECT_LT(((residual_at(q, v + e) - residual_at(q, v - e)) / (2 * s) - D.col(j)).lpNorm<Eigen::Infinity>(),
              100 * by_differences)
        << j;
  }
}

TEST(FactorsAtPoint, AccelerationsSatisfyBothEquations) {
  TestParts p;
  ASSERT_TRUE(p.factors.factorise_mass(model::FactorsAtPoint::at_point, true));
  Vec a, lambda;
  ASSERT_TRUE(p.factors.solve(model::FactorsAtPoint::at_point, p.masses.force(), p.rows.gamma(), a, lambda));
  Vec rows = -p.rows.gamma();
  p.rows.add_times(1, a, rows);
  EXPECT_LT(rows.lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(ImpulseResponse, IsSymmetricAndMovesNoJoint) {
  TestParts p;
  const int tip = 1 - p.in_joint();
  Mat jump, delassus;
  p.response.respond({{tip, 0}, {tip, 1}, {p.in_joint(), 1}}, jump, delassus);
  EXPECT_LT((delassus - delassus.transpose()).lpNorm<Eigen::Infinity>(), round_off);
  EXPECT_GT(delassus(0, 0), 0);
  EXPECT_LT((p.rows.G().topRows(p.rows.held()) * jump).lpNorm<Eigen::Infinity>(), round_off);
}

TEST(SharedRowsAtPoint, AContactWithItsOwnRowCarriesMinusItsMultiplier) {
  TestParts p;
  const int tip = 1 - p.in_joint();
  const Vec lambda = Vec::LinSpaced(p.rows.count(), 3, -5);
  EXPECT_EQ(p.shares.force_along({tip, 0}, lambda), -lambda(p.rows.count() - 1));
}

}  // namespace
}  // namespace trammel::test
