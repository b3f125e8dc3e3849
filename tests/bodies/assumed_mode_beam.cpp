// Against the published system's unit vectors (tests/data/beam/unit_N*.json, made by two independent implementations).
// Derivatives and balances are checked by tests/plugins/shipped_components.cpp.
#include "../../bodies/assumed_mode_beam/beam.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>
#include <trammel/quadrature.hpp>

namespace trammel::beam {
namespace {

using nlohmann::json;

enum class Mount { hinge, clamped, free };

std::unique_ptr<AssumedModeBeam> make(int N, Coupling coupling = Coupling::full, Mount mount = Mount::hinge,
                                      double hub_radius = 0, double hub_inertia = 0) {
  auto beam = std::make_unique<AssumedModeBeam>();
  beam->length = 1, beam->area = 3.14e-4, beam->second_moment = 7.85e-9;
  beam->density = 2766.7, beam->youngs_modulus = 6.8952e10;
  beam->axial_modes = beam->transverse_modes = N;
  beam->coupling = coupling;
  beam->hub_radius = hub_radius, beam->hub_inertia = hub_inertia;
  const Eigen::Vector2d o(0, 0);
  if (mount == Mount::hinge) beam->hinge = o;
  if (mount == Mount::clamped) beam->clamped = o;
  if (mount == Mount::free) beam->free = o;
  beam->prepare({Space::planar, Eigen::Vector2d(0, -9.81)});
  return beam;
}

Vec vec(const json& j) {
  const auto numbers = j.get<std::vector<double>>();
  return Eigen::Map<const Vec>(numbers.data(), Eigen::Index(numbers.size()));
}

Mat mass(const Body& beam, const Vec& q) {
  Mat M = Mat::Zero(q.size(), q.size());
  Matrix target = Matrix::onto(M);
  beam.mass(0, q, target);
  return M;
}

Vec force(const Body& beam, const Vec& q, const Vec& v) {
  Vec f = Vec::Zero(v.size());
  beam.force(0, q, v, f);
  return f;
}

struct Reference {
  explicit Reference(int N) : beam(make(N)) {
    std::ifstream file(std::string(TRAMMEL_SOURCE_DIR "/tests/data/beam/unit_N") + std::to_string(N) + ".json");
    data = json::parse(file);
    q = vec(data["q"]);
    v = vec(data["qd"]);
  }
  std::unique_ptr<AssumedModeBeam> beam;
  json data;
  Vec q, v;
};

class BeamReference : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(N, BeamReference, testing::Values(1, 3, 5));

TEST_P(BeamReference, MassMatrixAgrees) {
  const Reference r(GetParam());
  const Mat M = mass(*r.beam, r.q);
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    EXPECT_LT((M.row(i).transpose() - vec(r.data["M"][std::size_t(i)])).norm(), 1e-12 * M.row(i).norm());
}

TEST_P(BeamReference, ForcesAgree) {
  const Reference r(GetParam());
  const Vec Q = vec(r.data["Q"]), f = force(*r.beam, r.q, r.v);
  for (Eigen::Index i = 0; i < Q.size(); ++i) EXPECT_NEAR(f(i), Q(i), 1e-10 * std::abs(Q(i))) << i;
}

TEST_P(BeamReference, TipMotionAgrees) {
  const Reference r(GetParam());
  Motion tip;
  r.beam->motion(1, 0, r.q, r.v, tip);
  const Vec Cq = vec(r.data["gap_Cq"]);
  EXPECT_NEAR(tip.x(1), r.data["gap_C"].get<double>(), 1e-13);
  EXPECT_NEAR(tip.V(1), r.data["gap_Cdot"].get<double>(), 1e-12);
  EXPECT_NEAR(tip.bias(1), r.data["gap_bias"].get<double>(), 1e-10 * std::abs(tip.bias(1)));
  EXPECT_LT((tip.J.row(1).transpose() - Cq).norm(), 1e-12 * Cq.norm());
}

TEST_P(BeamReference, ContactForceAndEffectiveMassAgree) {
  const Reference r(GetParam());
  Motion tip;
  r.beam->motion(1, 0, r.q, r.v, tip);
  const Vec G = tip.J.row(1).transpose();
  const auto M = mass(*r.beam, r.q).llt();
  const double effective = 1 / G.dot(M.solve(G));
  const double pressing = -effective * (G.dot(M.solve(force(*r.beam, r.q, r.v))) + tip.bias(1));
  EXPECT_NEAR(effective, r.data["tip_effective_mass"].get<double>(), 1e-10 * effective);
  EXPECT_NEAR(pressing, r.data["contact_force_if_constrained"].get<double>(), 1e-10 * std::abs(pressing));
}

TEST_P(BeamReference, EnergiesAgree) {
  const Reference r(GetParam());
  const Energy e = r.beam->energy(0, r.q, r.v);
  EXPECT_NEAR(e.kinetic, r.data["E_kin"].get<double>(), 1e-12);
  EXPECT_NEAR(e.elastic, r.data["E_el"].get<double>(), 1e-11);
  EXPECT_NEAR(e.potential, r.data["E_grav"].get<double>(), 1e-12);
}

TEST(Beam, EnergyOfTheFreeBeamIsUnchangedByRigidMotion) {
  const auto beam = make(3, Coupling::full, Mount::free);
  Vec q(9), v(9);
  q << 0.3, -0.2, 0.4, 1e-3, -2e-3, 1e-3, 0.02, 0.01, -0.005;
  v << 1.2, -0.4, 2.0, 0.3, -0.1, 0.2, 1, -2, 0.5;
  const double turn = 1.1, c = std::cos(turn), s = std::sin(turn);
  Vec q2 = q, v2 = v;
  q2.head<2>() << 5 + c * q(0) - s * q(1), -3 + s * q(0) + c * q(1);
  q2(2) += turn;
  v2.head<2>() << c * v(0) - s * v(1), s * v(0) + c * v(1);
  EXPECT_NEAR(beam->energy(0, q, v).kinetic, beam->energy(0, q2, v2).kinetic, 1e-13);
  EXPECT_NEAR(beam->energy(0, q, v).elastic, beam->energy(0, q2, v2).elastic, 1e-12);
}

TEST(BendingMode, AreOrthogonalAndScaledUpToThirty) {
  const double L = 0.7;
  std::vector<BendingMode> modes;
  for (int i = 1; i <= 30; ++i) modes.emplace_back(i, L);
  const Quadrature rule = gauss_legendre(200, 0, L);
  for (int i = 0; i < 30; ++i) {
    EXPECT_NEAR(modes[std::size_t(i)].value(L), i % 2 ? -2 : 2, 1e-11) << i;
    for (int j = 0; j <= i; ++j) {
      double sum = 0;
      for (int g = 0; g < 200; ++g)
        sum += rule.weight(g) * modes[std::size_t(i)].value(rule.x(g)) * modes[std::size_t(j)].value(rule.x(g));
      EXPECT_NEAR(sum, i == j ? L : 0, 1e-12) << i << ' ' << j;  // 200 terms of size 4 at round-off
    }
  }
}

// To modes and to one another, in the mass (here of weight 1) and in the stiffness; scaled as the modes are. Their
// values are differences of functions of order 1, 1e-6 of them at 40 modes: round-off is some 1e-9 of the difference.
TEST(StaticFunctions, AreOrthogonalToModesAndToOneAnother) {
  const double L = 0.7;
  for (const int N : {0, 1, 5, 20, 40}) {
    std::vector<BendingMode> bending;
    std::vector<AxialMode> axial;
    for (int i = 1; i <= N; ++i) bending.emplace_back(i, L), axial.emplace_back(i, L);
    const auto across = static_bending(L, bending);
    const auto along = static_stretching(L, axial);
    const Quadrature rule = gauss_legendre(300, 0, L);
    const auto product = [&](const auto& f, const auto& g) {
      double sum = 0;
      for (Eigen::Index k = 0; k < 300; ++k) sum += rule.weight(k) * f(rule.x(k)) * g(rule.x(k));
      return sum;
    };
    const auto value = [](const auto& s) { return [&s](double x) { return s.value(x); }; };
    const auto slope = [](const auto& s) { return [&s](double x) { return s.slope(x); }; };
    ASSERT_EQ(across.size(), 2u);
    EXPECT_NEAR(product(value(across[0]), value(across[0])), L, 1e-8 * L) << N;
    EXPECT_NEAR(product(value(across[1]), value(across[1])), L, 1e-8 * L) << N;
    EXPECT_NEAR(product(value(across[0]), value(across[1])), 0, 1e-8 * L) << N;
    EXPECT_NEAR(product(value(along), value(along)), L / 2, 1e-9 * L) << N;
    EXPECT_NEAR(product(slope(along), slope(along)) / along.stiffness, 1, 1e-9) << N;
    for (int i = 0; i < N; ++i) {
      for (const auto& s : across)
        EXPECT_NEAR(product(value(s), value(bending[std::size_t(i)])), 0, 1e-8 * L) << N << i;
      EXPECT_NEAR(product(value(along), value(axial[std::size_t(i)])), 0, 1e-9 * L) << N << i;
    }
    // By differences of slopes: int s'' s'' of each is its stiffness, of both 0.
    const auto curvature = [&](const auto& s) {
      return [&](double x) {
        const double h = 1e-5 * L / (N + 1);
        return (s.slope(x + h) - s.slope(x - h)) / (2 * h);
      };
    };
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        EXPECT_NEAR(product(curvature(across[std::size_t(i)]), curvature(across[std::size_t(j)])) /
                        std::sqrt(across[std::size_t(i)].stiffness * across[std::size_t(j)].stiffness),
                    i == j, 1e-5)
            << N;
    EXPECT_GT(across[0].stiffness, N > 0 ? L * std::pow(bending.back().wave_number(), 4) : 0) << "above all modes";
  }
}

TEST(Beam, IsFiniteForAnyNumberOfModes) {
  for (int N : {0, 1, 2, 13, 30, 40}) {
    const auto beam = make(N);
    Vec q = Vec::Constant(2 * N + 1, 1e-4), v = Vec::Constant(2 * N + 1, 0.1);
    EXPECT_TRUE(force(*beam, q, v).allFinite()) << N;
    EXPECT_EQ(mass(*beam, q).llt().info(), Eigen::Success) << N;
  }
}

TEST(Beam, RefusesTwoMounts) {
  AssumedModeBeam beam;
  beam.hinge = beam.clamped = Vec3(Eigen::Vector2d(0, 0));
  EXPECT_THROW(beam.prepare({}), ParameterError);
}

}  // namespace
}  // namespace trammel::beam
