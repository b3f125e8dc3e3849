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

// Coefficients from `mu` to `widest`.
Loaded random_loads(std::mt19937& random, double mu, double widest) {
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> any;
  Loaded loaded;
  const int contacts = 2 + int(random() % 4), tangents = 1 + int(random() % 2);
  loaded.forces.resize(contacts * (1 + tangents));
  for (Eigen::Index i = 0; i < contacts; ++i) {
    SharingContact& c = loaded.contacts.emplace_back();
    c.normal = i * (1 + tangents), c.coefficient = mu;
    if (widest > mu) c.coefficient *= std::pow(widest / mu, part(random));
    const double N = -std::log(0.001 + 0.999 * part(random)), angle = 2 * std::numbers::pi * part(random),
                 T = c.coefficient * N * 0.99 * part(random);
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

Loaded random_loads(std::mt19937& random, double mu) {
  return random_loads(random, mu, mu);
}

using Extended = Eigen::Vector<long double, Eigen::Dynamic>;

// How much less than F admissible forces may be, as a part of |F|^2: by weak duality lambda . y - |Pi(E^T y)|^2 / 2 is
// a lower bound of |F|^2 / 2 for every y, where Pi projects onto the cones. In extended precision, since y is of the
// order of 1/mu.
double less_than(const Loaded& loaded, const Vec& F, const Vec& y) {
  const Extended y_extended = y.cast<long double>(), pushed = loaded.E.cast<long double>().transpose() * y_extended;
  long double squares = 0;  // of the projections
  for (const SharingContact& c : loaded.contacts) {
    const long double mu = c.coefficient, T = pushed(c.tangents).norm();
    if (c.normal < 0) {
      const long double projected = std::min(T, mu * c.given);
      squares += projected * (2 * T - projected);
      continue;
    }
    const long double a = pushed[c.normal];
    if (T <= mu * a)
      squares += a * a + T * T;
    else if (a > -mu * T)
      squares += (a + mu * T) * (a + mu * T) / (1 + mu * mu);
  }
  const long double all = F.cast<long double>().squaredNorm();
  return double(1 - (2 * loaded.resultants.cast<long double>().dot(y_extended) - squares) / all);
}

void expect_least_forces(const Loaded& loaded) {
  Vec F, y;
  const double missed = admissible_forces(loaded.contacts, loaded.E, loaded.resultants, F, &y);
  EXPECT_NEAR(missed, (loaded.E * F - loaded.resultants).norm(), 1e-13 * loaded.resultants.norm());
  // The interior point method ends at 1e-12 of numbers of the order of 1.
  EXPECT_LE(missed, 1e-11 * loaded.resultants.norm());
  for (const SharingContact& c : loaded.contacts) {
    const double N = c.normal >= 0 ? F[c.normal] : c.given;
    EXPECT_LE(F(c.tangents).norm(), c.coefficient * N + 1e-14 * F.norm());
  }
  EXPECT_LE(less_than(loaded, F, y), 1e-9);
}

TEST(AdmissibleForces, AreTheLeastHoweverThinTheConesAre) {
  std::mt19937 random(51);
  for (const double mu : {1e-7, 1e-6, 1e-5, 1e-4, 1e-2, 0.3, 1.0, 30.0})
    for (int i = 0; i < 300; ++i) {
      SCOPED_TRACE(testing::Message() << mu << ", " << i);
      expect_least_forces(random_loads(random, mu));
    }
}

TEST(AdmissibleForces, AreTheLeastInThinConesBesideWideOnes) {
  std::mt19937 random(54);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    expect_least_forces(random_loads(random, 1e-8, 30));
  }
}

// The normal force of the last contact, whose columns are the last ones, becomes given.
Loaded given_last(Loaded loaded) {
  SharingContact& c = loaded.contacts.back();
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < loaded.forces.size(); ++k)
    if (k != c.normal) others.push_back(k);
  c.given = loaded.forces[c.normal], c.normal = -1;
  for (Eigen::Index& k : c.tangents) --k;
  const Mat E = loaded.E(Eigen::all, others);
  const Vec forces = loaded.forces(others);
  return {loaded.contacts, E, forces, E * forces};
}

TEST(AdmissibleForces, AreTheLeastBesideGivenNormalForces) {
  std::mt19937 random(55);
  for (const double mu : {1e-6, 1e-4, 1e-2, 0.3, 1.0, 30.0})
    for (int i = 0; i < 200; ++i) {
      SCOPED_TRACE(testing::Message() << mu << ", " << i);
      expect_least_forces(given_last(random_loads(random, mu)));
    }
}

TEST(AdmissibleForces, AreTheLeastInAnyUnits) {
  std::mt19937 random(59);
  for (const double unit : {1e-9, 1e9})
    for (int i = 0; i < 300; ++i) {
      SCOPED_TRACE(testing::Message() << unit << ", " << i);
      Loaded loaded = random_loads(random, 1e-4, 1);
      loaded.forces *= unit, loaded.resultants *= unit;
      expect_least_forces(loaded);
    }
}

// Where the resultants ask for slightly more than that, what is returned is how much.
TEST(AdmissibleForces, AreNotBeyondGivenNormalForces) {
  std::vector<SharingContact> contacts(2);
  for (Eigen::Index k = 0; k < 2; ++k)
    contacts[std::size_t(k)].tangents = {k}, contacts[std::size_t(k)].coefficient = 1;
  contacts[0].given = 1;
  for (const double bound : {0.0, 1e-3})
    for (double beyond = 1e-13; beyond < 1e-6; beyond *= 10) {
      contacts[1].given = bound;
      Vec F;
      const double missed = admissible_forces(contacts, Mat::Identity(2, 2), Vec{{0.3, bound + beyond}}, F);
      EXPECT_NEAR(F[1], bound, 1e-16) << bound << ", " << beyond;
      EXPECT_NEAR(missed, beyond, 0.01 * beyond + 1e-15) << bound << ", " << beyond;
    }
}

// The last contact, whose columns are the last ones, has no friction: no tangents, or a coefficient of 0.
Loaded without_friction_at_last(Loaded loaded, bool tangents) {
  SharingContact& c = loaded.contacts.back();
  if (tangents) {
    c.coefficient = 0;
    loaded.forces(c.tangents).setZero();
  } else {
    c.tangents.clear();
    const Eigen::Index columns = c.normal + 1;
    loaded.E.conservativeResize(Eigen::NoChange, columns);
    loaded.forces.conservativeResize(columns);
  }
  loaded.resultants = loaded.E * loaded.forces;
  return loaded;
}

TEST(AdmissibleForces, AreTheLeastBesideContactsWithoutFriction) {
  std::mt19937 random(56);
  for (const double mu : {1e-6, 1e-2, 0.3, 30.0})
    for (int i = 0; i < 200; ++i) {
      SCOPED_TRACE(testing::Message() << mu << ", " << i);
      expect_least_forces(without_friction_at_last(random_loads(random, mu), i % 2));
    }
}

TEST(AdmissibleForces, AreTheSameWhereverTheirSearchBegins) {
  std::mt19937 random(57);
  std::normal_distribution<double> any;
  for (const double mu : {1e-2, 0.3, 30.0})
    for (int i = 0; i < 100; ++i) {
      const Loaded loaded = random_loads(random, mu);
      Vec F, again, y;
      admissible_forces(loaded.contacts, loaded.E, loaded.resultants, F, &y);
      const Vec found = y, far = Vec::NullaryExpr(y.size(), [&] { return 100 * any(random); });
      for (const Vec& start : {found, Vec(2 * found), far}) {
        y = start;
        EXPECT_LE(admissible_forces(loaded.contacts, loaded.E, loaded.resultants, again, &y),
                  1e-11 * loaded.resultants.norm())
            << mu << ", " << i;
        EXPECT_LE((again - F).norm(), 1e-6 * F.norm()) << mu << ", " << i;
        EXPECT_LE(less_than(loaded, again, y), 1e-9) << mu << ", " << i;
      }
    }
}

// Where no forces in the cones have the resultants, what is returned is how far those of F are from them.
TEST(AdmissibleForces, AreMissedByWhatIsReturnedWhereThereAreNone) {
  std::mt19937 random(58);
  for (const double mu : {1e-2, 0.3, 30.0})
    for (int i = 0; i < 50; ++i) {
      Loaded loaded = random_loads(random, mu);
      // y pushes all contacts apart, so that y . E F <= 0 for all forces in the cones.
      Vec y = Vec::Unit(loaded.E.rows(), 0);
      for (const SharingContact& c : loaded.contacts) {
        const double T = loaded.E.row(0)(c.tangents).norm();
        loaded.E(0, c.normal) = -mu * T - std::abs(loaded.E(0, c.normal));
      }
      Vec F;
      const double missed = admissible_forces(loaded.contacts, loaded.E, y, F);
      EXPECT_NEAR(missed, (loaded.E * F - y).norm(), 1e-12) << mu << ", " << i;
      EXPECT_GE(missed, 1 - 1e-12) << mu << ", " << i;
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

// A lever between two pairs of contacts that press against each other, a short distance apart: forces as large as its
// moment divided by the distance hold it, and each pair could press more without limit.
TEST(SpareLoad, IsFoundHoweverLargeTheForcesInBalanceAre) {
  for (const double distance : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    std::vector<SharingContact> contacts(4);
    for (Eigen::Index k = 0; k < 4; ++k) contacts[std::size_t(k)].normal = k;
    Mat E(2, 4);
    E << 1, -1, 1, -1, 0, 0, distance, -distance;
    const Vec resultants = (Vec(2) << 0.3, 1).finished();  // force [N] and moment [N m]
    EXPECT_NEAR(spare_load(contacts, E, resultants), most_spare_load, 1e-6) << distance;
    Vec F;
    EXPECT_LE(admissible_forces(contacts, E, resultants, F), 1e-14 / distance) << distance;
    EXPECT_GE(F.minCoeff(), 0) << distance;
  }
}

// In any units: N - s of each contact still carries, and the forces are those with which it does.
TEST(SpareLoad, IsHowFarTheLeastLoadedContactCouldBeUnloaded) {
  const auto expect_load = [](const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda,
                              double spare, const Vec& forces) {
    for (const double unit : {1.0, 1e-6, 1e6}) {
      std::vector<SharingContact> scaled = contacts;
      for (SharingContact& c : scaled) c.given *= unit;
      Vec F;
      EXPECT_NEAR(spare_load(scaled, E, unit * lambda, &F), unit * spare, 1e-9 * unit) << unit;
      EXPECT_LE((F - unit * forces).norm(), 1e-7 * unit) << F.transpose();
      EXPECT_NEAR(spare_load(scaled, E, unit * lambda), unit * spare, 1e-9 * unit) << unit;
    }
  };
  const std::vector<SharingContact> feet{
      {.normal = 0, .tangents = {}}, {.normal = 1, .tangents = {}}, {.normal = 2, .tangents = {}}};
  const std::vector<SharingContact> two(feet.begin(), feet.begin() + 2);
  // Under a beam, of weight and moment: of two feet the forces are known, of three at -1, 0 and 1 the least can be 2.
  expect_load(two, Mat{{1, 1}, {-1, 1}}, Vec{{10, 4}}, 3, Vec{{3, 7}});
  expect_load(two, Mat{{1, 1}, {-1, 1}}, Vec{{10, 14}}, -2, Vec{{-2, 12}});
  expect_load(feet, Mat{{1, 1, 1}, {-1, 0, 1}}, Vec{{9, 3}}, 2, Vec{{2, 2, 5}});
  // Against each other they could press without limit: `most_spare_load` times the largest resultant.
  EXPECT_NEAR(spare_load(two, Mat{{1, -1}}, Vec{{3}}), most_spare_load * 3, 1e-9);
  // A foot that presses with 10 holds 3, or would have to hold 6, with c = 0.5; its normal force may be given.
  const std::vector<SharingContact> foot{{.normal = 0, .tangents = {1}, .coefficient = 0.5}};
  expect_load(foot, Mat::Identity(2, 2), Vec{{10, 3}}, 4, Vec{{10, 3}});
  expect_load(foot, Mat::Identity(2, 2), Vec{{10, -6}}, -2, Vec{{10, -6}});
  const std::vector<SharingContact> pressed{{.tangents = {0}, .coefficient = 0.5, .given = 10}};
  expect_load(pressed, Mat{{1}}, Vec{{3}}, 4, Vec{{3}});
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
