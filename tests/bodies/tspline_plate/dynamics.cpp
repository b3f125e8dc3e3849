// Frequencies, the pendulum of the reference, and what a refinement in motion keeps.
#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "difference_checks.hpp"
#include "plates.hpp"

namespace trammel::plate {
namespace {

using namespace test;

// omega L^2 sqrt(rho h / D) of a square plate that moves across its plane only.
Vec frequencies(const std::string& n, const std::string& edge) {
  auto plate = rectangle_plate(1, 1, n + "x" + n, 0.01, 1e6, 0.3, 100);
  plate->sole_patch.edge_u0 = plate->sole_patch.edge_u1 = plate->sole_patch.edge_v0 = plate->sole_patch.edge_v1 = edge;
  plate->held_axes = "xy";
  plate->quadrature = 4;
  plate->prepare(space());
  const double D = 1e6 * 1e-6 / 12 / (1 - 0.09);
  const Mat K = stiffness(*plate, rest(*plate)), M = trammel::test::mass(*plate, rest(*plate));
  const Vec squares = Eigen::GeneralizedSelfAdjointEigenSolver<Mat>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
  return (squares * 100 * 0.01 / D).cwiseMax(0).cwiseSqrt();
}

TEST(SquarePlate, FrequenciesOfTheReference) {
  const auto& kl = reference()["classical"]["frequencies"]["kl"];
  for (const std::string n : {"4", "8", "10"}) {
    const Vec clamped = frequencies(n, "clamped"), free = frequencies(n, "free");
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(clamped(k), double(kl[n]["clamped"][std::size_t(k)]), 1e-7);
      EXPECT_NEAR(free(k + 3), double(kl[n]["free"][std::size_t(k)]), 1e-6) << "behind three rigid modes";
    }
  }
}

// Fourth-order Runge-Kutta with the constant mass factorised once.
void advance(const TsplinePlate& plate, const Eigen::LLT<Mat>& mass, Vec& q, Vec& v, double h) {
  const auto acceleration = [&](const Vec& x, const Vec& y) -> Vec {
    return mass.solve(trammel::test::force(plate, x, y));
  };
  const Vec a1 = acceleration(q, v), v2 = v + h / 2 * a1;
  const Vec a2 = acceleration(q + h / 2 * v, v2), v3 = v + h / 2 * a2;
  const Vec a3 = acceleration(q + h / 2 * v2, v3), v4 = v + h * a3;
  const Vec a4 = acceleration(q + h * v3, v4);
  q += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
  v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

// A sheet of 0.3 x 0.3 x 0.01 m falls about one edge that is held.
void expect_pendulum(const std::string& mesh, double h) {
  auto plate = rectangle_plate(0.3, 0.3, mesh, 0.01, 1e7, 0.3, 7810);
  plate->sole_patch.edge_u0 = "hinged";
  plate->quadrature = 4;
  plate->prepare(space(9.81));
  const Eigen::LLT<Mat> mass(trammel::test::mass(*plate, rest(*plate)));
  Vec q = rest(*plate), v = q;
  int steps = 0;
  for (const auto& row : reference()["ex43_pendulum"]["hinges"]["edge"][mesh]) {
    const double t = row[0];
    if (t > 0.5001) break;
    for (; steps < std::lround(t / h); ++steps) advance(*plate, mass, q, v, h);
    const Eigen::Vector3d C = point_of(*plate, 1, 1, q);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(C(axis), double(row[std::size_t(1 + axis)]), 1e-5) << "t = " << t;
    const Energy energy = plate->energy(0, q, v);
    EXPECT_NEAR(energy.kinetic, double(row[4]), 1e-4);
    EXPECT_NEAR(energy.elastic, double(row[5]), 1e-4);
    EXPECT_NEAR(energy.total(), 0, 2e-6) << "of 10 J; t = " << t;
  }
}

TEST(SheetPendulum, FollowsTheReferenceOf2x2) {
  expect_pendulum("2x2", 2e-4);
}

TEST(SheetPendulum, FollowsTheReferenceOf4x4) {
  expect_pendulum("4x4", 1e-4);
}

struct Moving {
  std::unique_ptr<TsplinePlate> plate;
  Vec q, v;
};

// The plate of example 4.4 in a swing of its first modes.
Moving swinging(Closure closure, int quadrature) {
  Moving m{rectangle_plate(2, 2, "10x10", 0.1, 2e7, 0.3, 7810), {}, {}};
  TsplinePlate& p = *m.plate;
  p.sole_patch.edge_u0 = p.sole_patch.edge_u1 = p.sole_patch.edge_v0 = p.sole_patch.edge_v1 = "clamped";
  p.quadrature = quadrature, p.sole_patch.closure = closure;
  p.prepare(space(9.81));
  const auto bump = [](const Eigen::Vector3d& P, double c, double s) {
    const double x = P.x() / 2, y = P.y() / 2, w = x * x * (1 - x) * (1 - x) * y * y * (1 - y) * (1 - y) * 256;
    return Eigen::Vector3d(0.01 * s * w * (x - 0.5), 0.02 * s * w * (y - 0.4), c * w * (1 + 0.3 * x));
  };
  m.q = moved(p, [&](const Eigen::Vector3d& P) -> Eigen::Vector3d { return bump(P, -0.1, 1); });
  m.v = moved(p, [&](const Eigen::Vector3d& P) -> Eigen::Vector3d { return bump(P, 0.7, -2); });
  return m;
}

std::vector<Box<double>> central(const TsplinePlate& plate) {
  std::vector<Box<double>> boxes;
  const auto faces = plate.mesh().basis.patch(0).mesh().elements();
  for (std::size_t e : {44, 45, 54, 55}) boxes.push_back(plate.mesh().basis.patch(0).mesh().parameters(faces[e]));
  return boxes;
}

TEST(Refinement, KeepsSurfaceMomentumAndEnergies) {
  for (Closure closure : {Closure::both, Closure::greedy, Closure::none}) {
    Moving m = swinging(closure, 6);
    TsplinePlate& plate = *m.plate;
    std::vector<Eigen::Vector3d> before;
    std::vector<Eigen::Vector2d> places;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j) places.emplace_back(0.37 + i / 60.0, 0.41 + j / 70.0);
    for (const auto& at : places) before.push_back(point_of(plate, at.x(), at.y(), m.q));
    const Momentum p = plate.momentum(0, m.q, m.v);
    const Energy e = plate.energy(0, m.q, m.v);

    const auto transfer = plate.refine_elements_in(central(plate));
    Vec q = rest(plate), v = q;
    transfer->q(m.q, q), transfer->v(m.v, v);

    for (std::size_t k = 0; k < places.size(); ++k)
      EXPECT_LT((point_of(plate, places[k].x(), places[k].y(), q) - before[k]).norm(), 1e-14);
    const Momentum p2 = plate.momentum(0, q, v);
    const Energy e2 = plate.energy(0, q, v);
    EXPECT_LT((Vec(p2.linear) - Vec(p.linear)).norm(), 1e-12 * p.linear.norm());
    EXPECT_LT((Vec(p2.angular) - Vec(p.angular)).norm(), 1e-12 * p.angular.norm());
    EXPECT_NEAR(p2.mass, p.mass, 1e-12 * p.mass);
    EXPECT_NEAR(e2.kinetic, e.kinetic, 1e-12 * e.kinetic);
    EXPECT_NEAR(e2.potential, e.potential, 1e-12 * p.mass * 9.81);
    EXPECT_NEAR(e2.elastic, e.elastic, 1e-12 * e.elastic);
  }
}

TEST(Refinement, KeepsTheEdgesHeld) {
  Moving m = swinging(Closure::both, 3);
  const auto transfer = m.plate->refine_elements_in(
      {m.plate->mesh().basis.patch(0).mesh().parameters(m.plate->mesh().basis.patch(0).mesh().elements()[0])});
  Vec q = rest(*m.plate);
  transfer->q(m.q, q);
  for (double s : {0.0, 0.03, 0.07, 0.5}) {
    const Place at = place(m.plate->mesh(), surface_point(m.plate->mesh(), 0, s), q);
    EXPECT_LT((at.r - Eigen::Vector3d(0, 2 * s, 0)).norm(), 1e-14);
    EXPECT_LT(std::abs(at.a1.z()), 1e-14);
  }
}

TEST(Refinement, IsRepeatedFromAnArchive) {
  struct Memory final : Archive {
    std::vector<Vec> vectors;
    long long count = 0;
    std::size_t at = 0;
    bool reading = false;
    void operator()(std::string_view, bool&) override {}
    void operator()(std::string_view, int& n) override { reading ? void(n = int(count)) : void(count = n); }
    void operator()(std::string_view, long long& n) override { reading ? void(n = count) : void(count = n); }
    void operator()(std::string_view, double&) override {}
    void operator()(std::string_view, std::string&) override {}
    void operator()(std::string_view, Vec& x) override {
      if (reading)
        x = vectors[at++];
      else
        vectors.push_back(x);
    }
  } memory;
  Moving first = swinging(Closure::both, 3), second = swinging(Closure::both, 3);
  first.plate->refine_elements_in(central(*first.plate));
  first.plate->archive(memory);
  memory.reading = true;
  second.plate->archive(memory);
  EXPECT_EQ(second.plate->mesh().points, first.plate->mesh().points);
  EXPECT_EQ(second.plate->coordinates().nq(), first.plate->coordinates().nq());
}

}  // namespace
}  // namespace trammel::plate
