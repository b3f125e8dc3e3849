// Plates of several patches.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <trammel/testing/archive.hpp>

#include "difference_checks.hpp"
#include "plates.hpp"

namespace trammel::plate {
namespace {

using namespace test;
using Eigen::Vector3d;

Patch rectangle(const Vector3d& origin, const Vector3d& along_u, const Vector3d& along_v, const std::string& elements) {
  Patch patch;
  patch.origin = origin, patch.along_u = along_u, patch.along_v = along_v, patch.elements = elements;
  return patch;
}

std::unique_ptr<TsplinePlate> section(double h = 0.01, double E = 1e6, double nu = 0.3) {
  auto plate = std::make_unique<TsplinePlate>();
  plate->thickness = h, plate->youngs_modulus = E, plate->poissons_ratio = nu, plate->density = 1,
  plate->quadrature = 4;
  return plate;
}

// The unit square, cut at x = cut; clamped at x = 0 and y = 0.
std::unique_ptr<TsplinePlate> halves(Continuity continuity = Continuity::C1, double cut = 0.5, int left = 2,
                                     int right = 2) {
  auto plate = section();
  const auto mesh = [](int n) { return std::to_string(n) + "x4"; };
  Patch a = rectangle({0, 0, 0}, {cut, 0, 0}, {0, 1, 0}, mesh(left)),
        b = rectangle({cut, 0, 0}, {1 - cut, 0, 0}, {0, 1, 0}, mesh(right));
  a.edge_u0 = "clamped", a.edge_v0 = b.edge_v0 = "clamped";
  plate->named_patches = {{"a", a}, {"b", b}};
  plate->joined = {{"cut", joining("a.u1", "b.u0", continuity)}};
  return plate;
}

std::unique_ptr<TsplinePlate> quarters() {
  auto plate = section();
  const Vector3d x(0.5, 0, 0), y(0, 0.5, 0);
  Patch a = rectangle({0, 0, 0}, x, y, "2x2"), b = rectangle(x, x, y, "2x2"), c = rectangle(y, x, y, "2x2"),
        d = rectangle(x + y, x, y, "2x2");
  a.edge_u0 = c.edge_u0 = a.edge_v0 = b.edge_v0 = "clamped";
  plate->named_patches = {{"a", a}, {"b", b}, {"c", c}, {"d", d}};
  plate->joined = {{"ab", joining("a.u1", "b.u0")},
                   {"cd", joining("c.u1", "d.u0")},
                   {"ac", joining("a.v1", "c.v0")},
                   {"bd", joining("b.v1", "d.v0")}};
  return plate;
}

// One patch of the same functions: a knot that stands twice makes them C1 there.
std::unique_ptr<TsplinePlate> single(const std::vector<double>& u, const std::vector<double>& v) {
  auto plate = section();
  plate->sole_patch = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, "");
  plate->sole_patch.knots_u = u, plate->sole_patch.knots_v = v;
  plate->sole_patch.edge_u0 = plate->sole_patch.edge_v0 = "clamped";
  return plate;
}

const std::vector<double> quartered = {0, 0.25, 0.5, 0.75, 1}, cut_at_half = {0, 0.25, 0.5, 0.5, 0.75, 1};

double corner_deflection(TsplinePlate& plate, const std::string& corner) {
  plate.load = Vector3d(0.3, -0.2, 1);
  plate.prepare(space());
  const auto markers = plate.markers();
  const auto marker = std::find(markers.begin(), markers.end(), corner) - markers.begin();
  const Vec q = solve(stiffness(plate, rest(plate)), force_at(plate, rest(plate)));
  return trammel::test::motion(plate, int(marker), q, rest(plate)).x(2);
}

Vec squared_frequencies(TsplinePlate& plate) {
  plate.prepare(space());
  const Mat K = stiffness(plate, rest(plate)), M = trammel::test::mass(plate, rest(plate));
  return Eigen::GeneralizedSelfAdjointEigenSolver<Mat>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
}

constexpr double round_off = 1e-9;  // of K's condition number, 1e6, with room

TEST(JoinedPatches, BendAsOnePatchOfTheSameFunctions) {
  const double expected = corner_deflection(*single(cut_at_half, quartered), "u1v1");
  EXPECT_NEAR(corner_deflection(*halves(), "b_u1v1") / expected, 1, round_off);
  const double of_four = corner_deflection(*single(cut_at_half, cut_at_half), "u1v1");
  EXPECT_NEAR(corner_deflection(*quarters(), "d_u1v1") / of_four, 1, round_off);
}

TEST(JoinedPatches, VibrateAsOnePatchOfTheSameFunctions) {
  const Vec expected = squared_frequencies(*single(cut_at_half, cut_at_half)), found = squared_frequencies(*quarters());
  ASSERT_EQ(found.size(), expected.size());
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(found(k) / expected(k), 1, round_off) << k;
}

TEST(JoinedPatches, MayBeOfDifferentLengthAcrossTheJoint) {
  const double expected = corner_deflection(*single({0, 0.125, 0.25, 0.25, 0.5, 0.75, 1}, quartered), "u1v1");
  EXPECT_NEAR(corner_deflection(*halves(Continuity::C1, 0.25, 2, 3), "b_u1v1") / expected, 1, round_off);
}

TEST(JoinedPatches, MayRunInAnyDirection) {
  const double expected = corner_deflection(*halves(), "b_u1v1");
  struct Case {
    Vector3d origin, along_u, along_v;
    const char *edge, *elements, *corner, *clamped;
  };
  for (const Case& c : {Case{{1, 1, 0}, {-0.5, 0, 0}, {0, -1, 0}, "b.u1", "2x4", "b_u0v0", "v1"},
                        Case{{1, 0, 0}, {0, 1, 0}, {-0.5, 0, 0}, "b.v1", "4x2", "b_u1v0", "u0"},
                        Case{{0.5, 1, 0}, {0, -1, 0}, {0.5, 0, 0}, "b.v0", "4x2", "b_u0v1", "u1"}}) {
    auto plate = halves();
    Patch b = rectangle(c.origin, c.along_u, c.along_v, c.elements);
    (c.clamped == std::string("v1") ? b.edge_v1 : c.clamped == std::string("u0") ? b.edge_u0 : b.edge_u1) = "clamped";
    plate->named_patches[1].second = b;
    plate->joined = {{"cut", joining(c.edge, "a.u1")}};
    EXPECT_NEAR(corner_deflection(*plate, c.corner) / expected, 1, round_off) << c.edge;
  }
}

TEST(JoinedPatches, FeelNoForceInRigidMotion) {
  for (const Continuity continuity : {Continuity::C0, Continuity::C1}) {
    auto plate = halves(continuity, 0.25, 2, 3);
    for (auto& [name, patch] : plate->named_patches) patch.edge_u0 = patch.edge_v0 = "free";
    plate->prepare(space());
    const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    const Vec q = moved(*plate, [&](const Vector3d& P) -> Vector3d { return R * P + Vector3d(3, 1, 2) - P; });
    EXPECT_LT(force_at(*plate, q).norm(), 1e-14 * 1e6 * 0.01 * 100);  // E h times round-off of 100 points
    EXPECT_LT(plate->energy(0, q, rest(*plate)).elastic, 1e-20);
  }
}

TEST(JoinedPatches, HaveTheTangentOfTheirForce) {
  auto plate = halves();
  plate->thickness = 0.3, plate->youngs_modulus = 20, plate->density = 10;
  plate->mass_damping = 0.3, plate->stiffness_damping = 0.05;
  plate->named_patches[1].second.moment_u1 = 0.3, plate->pressure = 0.4;
  plate->prepare(space());
  const Vec q = wavy(*plate, 0.05), v = wavy(*plate, 0.2, 1);
  Mat S = Mat::Zero(q.size(), q.size());
  Matrix into = Matrix::onto(S);
  plate->add_tangent(0, q, v, v, {.c_m = 0, .c_d = 0, .c_k = 1}, into);
  const Vec d = wavy(*plate, 1, 2);
  const Vec by_difference =
      trammel::test::derivative([&](double s) -> Vec { return -trammel::test::force(*plate, q + s * d, v); }, 0, 1e-4);
  EXPECT_LT((S * d - by_difference).norm(), 1e-9 * by_difference.norm());
}

// A strip that is clamped at both ends and cut in the middle: two cantilevers, w = q l^4 / (8 D), no moment at the
// hinge.
TEST(JoinedPatches, AreAHingeWhereTheyAreC0) {
  auto plate = section(0.01, 12e6, 0);
  Patch a = rectangle({0, 0, 0}, {0.5, 0, 0}, {0, 0.1, 0}, "8x1"),
        b = rectangle({0.5, 0, 0}, {0.5, 0, 0}, {0, 0.1, 0}, "8x1");
  a.edge_u0 = b.edge_u1 = "clamped";
  plate->named_patches = {{"a", a}, {"b", b}};
  plate->joined = {{"hinge", joining("a.u1", "b.u0", Continuity::C0)}};
  plate->load = Vector3d(0, 0, 1e-6);
  plate->prepare(space());
  const Vec q = solve(stiffness(*plate, rest(*plate)), force_at(*plate, rest(*plate)));
  const double D = 12e6 * 1e-6 / 12, l = 0.5;
  EXPECT_NEAR(point_of(*plate, 1, 0.5, q).z() / (1e-6 * std::pow(l, 4) / (8 * D)), 1,
              1e-4);  // order 4, 8 elements: (1/8)^4
  const double at_clamp = plate->stress_at(0, 0.5, q).top.x(), at_hinge = plate->stress_at(1, 0.5, q).top.x();
  EXPECT_LT(std::abs(at_hinge), 0.01 * std::abs(at_clamp));  // a second derivative: (1/8)^2
}

TEST(JoinedPatches, TurnFreelyAboutAHingeAndNotAboutASmoothJoint) {
  for (const auto& [continuity, mechanisms] : {std::pair{Continuity::C0, 1}, std::pair{Continuity::C1, 0}}) {
    auto plate = halves(continuity);
    plate->named_patches[0].second.edge_v0 = plate->named_patches[1].second.edge_v0 = "free";
    plate->prepare(space());
    const Vec stiff =
        Eigen::SelfAdjointEigenSolver<Mat>(stiffness(*plate, rest(*plate)), Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_EQ((stiff.array() < 1e-12 * stiff.maxCoeff()).count(), mechanisms);
  }
}

// A tube of exact quarter circles. Under pressure it widens by p R^2 / (E h), up to bending of (h/R)^2.
TEST(JoinedPatches, CloseAnExactCylinder) {
  auto plate = section(0.001, 1e6, 0.3);
  for (int k = 0; k < 4; ++k) {
    Patch quarter;
    quarter.shape = Patch::Shape::cylinder, quarter.elements = "2x2";
    quarter.radius = 0.5, quarter.length = 1, quarter.from = k * M_PI / 2, quarter.to = (k + 1) * M_PI / 2;
    plate->named_patches.emplace_back(std::string(1, char('a' + k)), quarter);
    plate->joined.emplace_back(std::to_string(k), joining(std::string(1, char('a' + k)) + ".u1",
                                                          std::string(1, char('a' + (k + 1) % 4)) + ".u0"));
  }
  plate->pressure = 1e-5, plate->quadrature = 6;
  plate->prepare(space());
  EXPECT_NEAR(plate->momentum(0, rest(*plate), rest(*plate)).mass, 0.001 * M_PI,
              1e-4 * 0.001 * M_PI);  // 4 Gauss points
  // The load, in equilibrium, does no work in the six rigid motions, which K leaves free.
  const Vec f = force_at(*plate, rest(*plate));
  plate->pressure = 0;
  const Eigen::SelfAdjointEigenSolver<Mat> modes(stiffness(*plate, rest(*plate)));
  Vec q = rest(*plate);
  int rigid = 0;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (modes.eigenvalues()(k) < 1e-12 * modes.eigenvalues().maxCoeff())
      ++rigid;
    else
      q += modes.eigenvectors().col(k).dot(f) / modes.eigenvalues()(k) * modes.eigenvectors().col(k);
  }
  EXPECT_EQ(rigid, 6);
  const double widening = 1e-5 * 0.25 / (1e6 * 0.001);
  for (double u : {0.0, 0.3, 1.0, 2.4, 6.7}) {
    const Vector3d at = point_of(*plate, u, 0.5, q);
    EXPECT_NEAR((at.head<2>().norm() - 0.5) / widening, 1, 1e-5) << u;
  }
}

TEST(JoinedPatches, KeepSlopesEqualOnBothSidesWhenTheyMove) {
  auto plate = quarters();
  plate->prepare(space());
  const Vec q = Vec::LinSpaced(plate->coordinates().nq(), -1, 1).array().sin();
  const auto at = [&](double u, double v) { return place(plate->mesh(), surface_point(plate->mesh(), u, v), q); };
  for (double s : {0.0, 0.3, 1.0}) {
    EXPECT_LT((at(1, s).r - at(2, s).r).norm(), 1e-13);
    EXPECT_LT((at(1, s).a1 - at(2, s).a1).norm(), 1e-12);
    EXPECT_LT((at(s, 1).a2 - at(4 + s, 0).a2).norm(), 1e-12);
  }
}

TEST(JoinedPatches, HaveTheirNearestPointOnEitherSide) {
  auto plate =
      halves(Continuity::C1, 0.9, 12, 1);  // the middles of the nearest cells lie on the side of the small ones
  for (auto& [name, patch] : plate->named_patches) patch.edge_u0 = patch.edge_v0 = "free";
  plate->prepare(space());
  for (double x : {0.2, 0.88, 0.9, 0.91, 0.99}) {
    Eigen::Vector2d found;
    Vec3 point, normal;
    plate->nearest(0, rest(*plate), Vector3d(x, 0.4, 0.1), found, point, normal);
    EXPECT_LT((Vector3d(point) - Vector3d(x, 0.4, 0)).norm(), 1e-9) << x;
    EXPECT_LT((Vector3d(normal) - Vector3d::UnitZ()).norm(), 1e-9);
  }
}

TEST(JoinedPatches, AreSampledForContactAllOver) {
  auto plate = halves();
  plate->prepare(space());
  double area = 0, farthest = 0;
  for (int cell = 0; cell < plate->patches(); ++cell) {
    SurfacePatch points;
    plate->sample(cell, 0.05, points);
    area += points.area.sum();
    farthest = std::max(farthest, points.X.col(0).maxCoeff());
  }
  EXPECT_NEAR(area, 1, 1e-12);
  EXPECT_GT(farthest, 0.95);
}

TEST(JoinedPatches, NameTheirMarkersAndAreDrawnAllOver) {
  auto plate = quarters();
  plate->named_patches[3].second.markers = {{"top", Vector3d(0.5, 0.25, 0.01)}};
  plate->prepare(space());
  const auto names = plate->markers();
  const auto top = std::find(names.begin(), names.end(), "d_top");
  ASSERT_NE(top, names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "a_centre"), names.end());
  const Motion m = trammel::test::motion(*plate, int(top - names.begin()), rest(*plate), rest(*plate));
  EXPECT_LT((Vector3d(m.x) - Vector3d(0.75, 0.625, 0.01)).norm(), 1e-12);
  Mat drawn;
  plate->shape(0, rest(*plate), drawn);
  for (const Vector3d& corner : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(1, 1, 0)})
    EXPECT_LT((drawn.colwise() - Vec(corner)).colwise().norm().minCoeff(), 1e-12);
  // In one go: never further than between two neighbouring points of a patch's edge, 1/16 of it, or from line to line,
  // 1/8.
  const Mat steps = drawn.rightCols(drawn.cols() - 1) - drawn.leftCols(drawn.cols() - 1);
  EXPECT_LT(steps.colwise().norm().maxCoeff(), 0.5 / 8 + 1e-12);
}

// Element 1 of the lower left patch touches the joint with the one on its right, element 3 the corner of all four. A
// joint takes only edges that are divided alike.
TEST(JoinedPatches, AreDividedAlikeWhenOneIsRefinedAtAJoint) {
  for (const std::size_t element : {1, 3}) {
    auto plate = quarters();
    plate->quadrature = 6;  // elastic energy of a large displacement, integrated almost exactly
    plate->prepare(space(9.81));
    const auto bump = [](const Vector3d& P, double size) -> Vector3d {
      return size * Vector3d(P.x() * P.y(), 0, P.x() * P.x() * P.y());
    };
    const Vec q = moved(*plate, [&](const Vector3d&P) { return bump(P, 0.1); }),
              v = moved(*plate, [&](const Vector3d&P) { return bump(P, 0.7); });
    const Energy before = plate->energy(0, q, v);
    const Momentum p = plate->momentum(0, q, v);
    const Vector3d somewhere = point_of(*plate, 2.2, 0.9, q);
    const auto transfer = plate->refine_elements_in({plate->mesh().basis.elements()[element]});
    Vec q2 = rest(*plate), v2 = q2;
    transfer->q(q, q2), transfer->v(v, v2);
    EXPECT_GT(q2.size(), q.size());
    const Energy after = plate->energy(0, q2, v2);
    const Momentum p2 = plate->momentum(0, q2, v2);
    EXPECT_LT((point_of(*plate, 2.2, 0.9, q2) - somewhere).norm(), 1e-14);
    EXPECT_NEAR(after.kinetic, before.kinetic, 1e-12 * before.kinetic);
    EXPECT_NEAR(after.elastic, before.elastic, 1e-9 * before.elastic);
    EXPECT_LT((Vec(p2.linear) - Vec(p.linear)).norm(), 1e-12 * p.linear.norm());
    EXPECT_LT((Vec(p2.angular) - Vec(p.angular)).norm(), 1e-12 * p.angular.norm());
    const Multipatch& basis = plate->mesh().basis;
    EXPECT_GT(basis.patch(1).mesh().elements().size(), 4u) << "the patch behind the joint";
  }
}

TEST(JoinedPatches, ResumeWithTheRefinedMesh) {
  auto first = quarters(), second = quarters();
  first->prepare(space()), second->prepare(space());
  first->refine_elements_in({first->mesh().basis.elements()[3]});
  MemoryArchive memory;
  first->archive(memory);
  memory.reading = true;
  second->archive(memory);
  EXPECT_EQ(second->mesh().points, first->mesh().points);
  EXPECT_EQ(second->coordinates().nq(), first->coordinates().nq());
}

std::string refusal(const std::function<void(TsplinePlate&)>& spoil) {
  auto plate = halves();
  spoil(*plate);
  return test::refusal(*plate);
}

TEST(JoinedPatches, AreRefusedWhereTheyDoNotFit) {
  const auto b = [](TsplinePlate& p) -> Patch& { return p.named_patches[1].second; };
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.joined[0].second.to = "c.u0"; }),
            "joined.cut: no edge \"c.u0\"; expected a patch and an edge, as in \"a.u1\": u0, u1, v0 or v1, of a, b");
  EXPECT_EQ(refusal([&](TsplinePlate& p) { b(p).origin = Vector3d(0.5, 0, 0.01); }),
            "joined.cut: a.u1 and b.u0 do not lie on each other: up to 0.01 m apart");
  EXPECT_EQ(
      refusal([&](TsplinePlate& p) { b(p).elements = "2x5"; }),
      "joined.cut: the edges are divided differently; of the knots along a.u1 (0 to 1), 0.25, 0.5, 0.75 only on a.u1, "
      "0.2, 0.4, 0.6, 0.8 only on b.u0: divide both sides alike");
  EXPECT_EQ(
      refusal([&](TsplinePlate& p) { b(p).along_u = Vector3d(0.3, 0, 0.3); }),
      "joined.cut: lines across the joint have a kink of 45 degrees there; C1 needs them to go on straight, C0 does "
      "not (a hinge)");
  EXPECT_EQ(
      refusal([&](TsplinePlate& p) {
        b(p).origin = Vector3d(0.5, 1, 0), b(p).along_v = Vector3d(0, -1, 0);
        b(p).edge_v0 = "free", b(p).edge_v1 = "clamped";
      }),
      "joined.cut: the normals of a.u1 and b.u0 point to different sides; swap u and v, or the direction of one, of a "
      "patch");
  EXPECT_EQ(refusal([&](TsplinePlate& p) { b(p).edge_u0 = "hinged"; }),
            "joined.cut: b.u0 is joined and \"hinged\" as well; leave it free");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.joined.clear(); }),
            "patches.b: nothing in \"joined\" ties it to a; a separate plate is a body of its own");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.joined.emplace_back("again", joining("a.v1", "b.v0")); }),
            "joined.again: b.v0 is joined and \"clamped\" as well; leave it free");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.joined.emplace_back("again", joining("a.u1", "b.u1")); }),
            "joined.again: a.u1 is joined C1 twice; it can go on smoothly in one edge");
  EXPECT_EQ(refusal([&](TsplinePlate& p) { b(p).elements = "2by2"; }),
            "patches.b.mesh.elements: found \"2by2\", expected two whole numbers such as \"10x10\"");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.sole_patch.edge_u0 = "clamped"; }),
            "edges.u0: the plate has \"patches\"; say it in one of them");
}

}  // namespace
}  // namespace trammel::plate
