// Least forces with given resultants, in friction cones of any width.
#include "complementarity/shares/admissible_forces.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "complementarity/shares/spare_load.hpp"

namespace trammel::complementarity {
namespace {

// Forces inside their cones, and what they add up to in fewer equations than they are.
struct Loaded {
  std::vector<SharingContact> contacts;
  Mat E;
  Vec forces, resultants;
};

Loaded random_loads(std::mt19937& random, double mu) {
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> any;
  Loaded loaded;
  const int contacts = 2 + int(random() % 4), tangents = 1 + int(random() % 2);
  loaded.forces.resize(contacts * (1 + tangents));
  for (Eigen::Index i = 0; i < contacts; ++i) {
    SharingContact& c = loaded.contacts.emplace_back();
    c.normal = i * (1 + tangents), c.coefficient = mu;
    const double N = -std::log(0.001 + 0.999 * part(random)), angle = 2 * std::numbers::pi * part(random),
                 T = mu * N * 0.99 * part(random);
    loaded.forces[c.normal] = N;
    for (int k = 0; k < tangents; ++k) {
      c.tangents.push_back(c.normal + 1 + k);
      loaded.forces[c.tangents.back()] =
          tangents == 1 ? std::copysign(T, angle - 3) : T * (k ? std::sin(angle) : std::cos(angle));
    }
  }
  const auto rows = std::min<Eigen::Index>(loaded.forces.size() - 1, 2 + Eigen::Index(random() % 5));
  loaded.E = Mat::NullaryExpr(rows, loaded.forces.size(), [&] { return any(random); });
  loaded.resultants = loaded.E * loaded.forces;
  return loaded;
}

TEST(AdmissibleForces, AreFoundHoweverThinTheConesAre) {
  std::mt19937 random(51);
  for (const double mu : {1e-6, 1e-4, 1e-2, 0.3, 1.0, 30.0})
    for (int i = 0; i < 200; ++i) {
      const Loaded loaded = random_loads(random, mu);
      Vec F;
      const double missed = admissible_forces(loaded.contacts, loaded.E, loaded.resultants, F);
      // The interior point method ends at 1e-12 of numbers of the order of 1.
      EXPECT_LE(missed, 1e-11 * loaded.resultants.norm()) << mu << ", " << i;
      EXPECT_LE(F.norm(), loaded.forces.norm() * (1 + 1e-6)) << mu << ", " << i;
      for (const SharingContact& c : loaded.contacts) {
        const double T = F(c.tangents).norm();
        EXPECT_LE(T, mu * F[c.normal] + 1e-14 * F.norm()) << mu << ", " << i;
      }
    }
}

TEST(SpareLoad, IsNotNegativeWhereForcesAreInsideTheirCones) {
  std::mt19937 random(52);
  for (const double mu : {1e-6, 1e-2, 0.3, 30.0})
    for (int i = 0; i < 100; ++i) {
      const Loaded loaded = random_loads(random, mu);
      EXPECT_GT(spare_load(loaded.contacts, loaded.E, loaded.resultants), -1e-11 * loaded.forces.norm())
          << mu << ", " << i;
    }
}

// Where no admissible forces have the resultants, those with the least spare load have them, each beyond its cone by no
// more than that.
TEST(SpareLoad, IsThatOfForcesWithTheResultants) {
  std::mt19937 random(53);
  std::normal_distribution<double> any;
  int beyond = 0;
  for (const double mu : {1e-2, 0.3, 2.0})
    for (int i = 0; i < 200; ++i) {
      Loaded loaded = random_loads(random, mu);
      if (i % 2) loaded.resultants = Vec::NullaryExpr(loaded.E.rows(), [&] { return any(random); });
      Vec F;
      const double spare = spare_load(loaded.contacts, loaded.E, loaded.resultants, &F);
      EXPECT_LE((loaded.E * F - loaded.resultants).norm(), 1e-13 * F.norm()) << mu << ", " << i;
      for (const SharingContact& c : loaded.contacts)
        EXPECT_LE(F(c.tangents).norm(), mu * (F[c.normal] - spare) + 1e-8 * (F.norm() + std::abs(spare)))
            << mu << ", " << i;
      beyond += spare < 0;
    }
  EXPECT_GT(beyond, 100);
}

}  // namespace
}  // namespace trammel::complementarity
