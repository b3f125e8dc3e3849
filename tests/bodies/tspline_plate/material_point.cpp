#include "tspline_plate/shell/material_point.hpp"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tspline_plate/shell/viscous_point.hpp"

namespace trammel::plate {
namespace {

using Vector15 = Eigen::Matrix<double, 15, 1>;
using Matrix15 = Eigen::Matrix<double, 15, 15>;
const Section section{0.1, 20, 0.3};

Vectors5 random_vectors(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> in(-size, size);
  Vectors5 y;
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) y(i, j) = in(random);
  return y;
}

struct Sample {
  ReferencePoint reference;
  Vectors5 d, rate;
};

Sample sample(unsigned seed) {
  std::mt19937 random(seed);
  Sample s;
  Vectors5 Y = random_vectors(random, 0.5);
  Y.row(0) += Eigen::RowVector3d(1.2, 0, 0), Y.row(1) += Eigen::RowVector3d(0.3, 1.4, 0);
  EXPECT_TRUE(s.reference.set(Y, section));
  s.d = random_vectors(random, 0.3), s.rate = random_vectors(random, 1);
  return s;
}

double energy(const ReferencePoint& reference, const Vectors5& d) {
  DeformedPoint at;
  deform(reference, d, at);
  return 0.5 * at.eps.dot(reference.membrane * at.eps) + 0.5 * at.kappa.dot(reference.bending * at.kappa);
}

// Gradient of the energy, with the viscous stresses of `rate` times tau.
Vector15 gradient(const Sample& s, const Vectors5& d, const Vectors5& rate, double tau) {
  DeformedPoint at;
  deform(s.reference, d, at);
  const StrainRate strain = strain_rate(at, rate);
  Vectors5 g = Vectors5::Zero();
  add_gradient(at, s.reference.membrane * (at.eps + tau * strain.eps),
               s.reference.bending * (at.kappa + tau * strain.kappa), g);
  return Eigen::Map<const Vector15>(g.data());
}

// Central differences of step h: error about h^2 f''' + eps f / h, 1e-9 for values of order one.
constexpr double h = 1e-5, difference_error = 1e-8;

Vectors5 stepped(const Vectors5& d, int k, double step) {
  Vectors5 result = d;
  result.data()[k] += step;
  return result;
}

Matrix15 assembled(const double (&H)[9][25]) {
  constexpr int plane_of[3][3] = {{0, 3, 4}, {6, 1, 5}, {7, 8, 2}};
  Matrix15 result;
  for (int p = 0; p < 5; ++p)
    for (int q = 0; q < 5; ++q)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result(3 * p + i, 3 * q + j) = H[plane_of[i][j]][5 * p + q];
  return result;
}

void mirror(double (&H)[9][25]) {
  for (int plane = 6; plane < 9; ++plane)
    for (int p = 0; p < 5; ++p)
      for (int q = 0; q < 5; ++q) H[plane][5 * p + q] = H[plane - 3][5 * q + p];
}

TEST(MaterialPoint, GradientIsTheDerivativeOfTheEnergy) {
  for (unsigned seed : {1u, 2u, 3u}) {
    const Sample s = sample(seed);
    const Vector15 g = gradient(s, s.d, s.rate, 0);
    for (int k = 0; k < 15; ++k)
      EXPECT_NEAR(g(k), (energy(s.reference, stepped(s.d, k, h)) - energy(s.reference, stepped(s.d, k, -h))) / (2 * h),
                  difference_error);
  }
}

TEST(MaterialPoint, HessianIsTheDerivativeOfTheGradientAndSymmetric) {
  for (unsigned seed : {1u, 2u, 3u}) {
    const Sample s = sample(seed);
    DeformedPoint at;
    deform(s.reference, s.d, at);
    double H[9][25] = {};
    add_hessian(s.reference, at, s.reference.membrane * at.eps, s.reference.bending * at.kappa, 2,
                reinterpret_cast<Planes&>(H));
    mirror(H);
    const Matrix15 matrix = assembled(H) / 2;
    EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-13 * matrix.norm());
    for (int k = 0; k < 15; ++k) {
      const Vector15 expected =
          (gradient(s, stepped(s.d, k, h), s.rate, 0) - gradient(s, stepped(s.d, k, -h), s.rate, 0)) / (2 * h);
      EXPECT_LT((matrix.col(k) - expected).norm(), 10 * difference_error);
    }
  }
}

TEST(MaterialPoint, ViscousTangentIsTheDerivativeOfTheViscousForce) {
  const double tau = 0.7, c_d = 3, c_k = 2;
  const Sample s = sample(4);
  DeformedPoint at;
  deform(s.reference, s.d, at);
  const StrainRate strain = strain_rate(at, s.rate);
  double H[9][25] = {};
  add_hessian(s.reference, at, s.reference.membrane * (at.eps + tau * strain.eps),
              s.reference.bending * (at.kappa + tau * strain.kappa), c_k, reinterpret_cast<Planes&>(H));
  mirror(H);
  add_viscous(s.reference, at, s.rate, tau, c_d, c_k, H);
  const Matrix15 matrix = assembled(H);
  for (int k = 0; k < 15; ++k) {
    const Vector15 by_y =
        (gradient(s, stepped(s.d, k, h), s.rate, tau) - gradient(s, stepped(s.d, k, -h), s.rate, tau)) / (2 * h);
    const Vector15 by_rate =
        (gradient(s, s.d, stepped(s.rate, k, h), tau) - gradient(s, s.d, stepped(s.rate, k, -h), tau)) / (2 * h);
    EXPECT_LT((matrix.col(k) - c_k * by_y - c_d * by_rate).norm(), 30 * difference_error);
  }
}

TEST(MaterialPoint, StrainRateIsTheRateOfTheStrain) {
  const Sample s = sample(5);
  DeformedPoint at, later, earlier;
  deform(s.reference, s.d, at);
  deform(s.reference, s.d + h * s.rate, later), deform(s.reference, s.d - h * s.rate, earlier);
  const StrainRate rate = strain_rate(at, s.rate);
  EXPECT_LT((rate.eps - (later.eps - earlier.eps) / (2 * h)).norm(), difference_error);
  EXPECT_LT((rate.kappa - (later.kappa - earlier.kappa) / (2 * h)).norm(), difference_error);
}

TEST(MaterialPoint, RigidTurnsDoNotStrain) {
  const Sample s = sample(6);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  DeformedPoint at;
  deform(s.reference, s.reference.Y * R.transpose() - s.reference.Y, at);
  EXPECT_LT(at.eps.norm(), 1e-14);
  EXPECT_LT(at.kappa.norm(), 1e-14);
}

// Strains of 1e-12 keep eleven digits: the stress of very thin plates is not noise.
TEST(MaterialPoint, SmallStrainsKeepTheirDigits) {
  const Sample s = sample(7);
  const double tiny = 1e-12;
  DeformedPoint at, half;
  deform(s.reference, tiny * s.d, at), deform(s.reference, tiny / 2 * s.d, half);
  EXPECT_LT((at.eps - 2 * half.eps).norm(), 1e-10 * at.eps.norm());
  EXPECT_LT((at.kappa - 2 * half.kappa).norm(), 1e-10 * at.kappa.norm());
}

TEST(MaterialPoint, IsotropicStiffnessDoesNotDependOnTheParameters) {
  Vectors5 skew = Vectors5::Zero();
  skew.row(0) << 2, 0.4, 0, skew.row(1) << -0.5, 1.1, 0;
  ReferencePoint reference;
  ASSERT_TRUE(reference.set(skew, section));
  // Stretch by 1 % in all directions: sigma = E / (1 - nu) eps, energy h sigma eps.
  const double eps = 0.5 * (1.01 * 1.01 - 1);
  EXPECT_NEAR(energy(reference, 0.01 * skew), section.thickness * section.youngs_modulus / (1 - 0.3) * eps * eps,
              1e-14);
}

TEST(MaterialPoint, RefusesParallelTangents) {
  Vectors5 flat = Vectors5::Zero();
  flat.row(0) << 1, 0, 0, flat.row(1) << 2, 0, 0;
  ReferencePoint reference;
  EXPECT_FALSE(reference.set(flat, section));
}

}  // namespace
}  // namespace trammel::plate
