#include "tspline_plate/plate.hpp"

#include <Eigen/Geometry>

#include "difference_checks.hpp"
#include "plates.hpp"

namespace trammel::plate {
namespace {

using namespace test;

// Soft and thick, of few elements: values and derivatives of order one.
std::unique_ptr<TsplinePlate> small_plate(bool loaded = false) {
  auto plate = rectangle_plate(1, 1.2, "2x2", 0.3, 20, 0.3, 10);
  plate->sole_patch.crossed = {0};
  plate->sole_patch.markers = {{"top", Eigen::Vector3d(0.3, 0.6, 0.15)}};
  if (loaded) {
    plate->sole_patch.edge_u0 = "clamped", plate->sole_patch.corner_u1v1 = "hinged",
    plate->sole_patch.edge_v0 = "symmetric";
    plate->pressure = 0.4, plate->sole_patch.moment_u1 = 0.3, plate->sole_patch.moment_v1 = -0.2;
    plate->load = Eigen::Vector3d(0.1, -0.2, 0.3), plate->sole_patch.force_v1 = Eigen::Vector3d(1, 0, 0),
    plate->sole_patch.pressure_u1 = 0.5;
    plate->mass_damping = 0.3, plate->stiffness_damping = 0.05;
  }
  plate->prepare(space(9.81));
  return plate;
}

// Five-point differences of a smaller step than the suite's: over the small elements the fifth derivative is large.
template <class F>
Mat gradient(F values, const Vec& x) {
  Mat result(values(x).size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    result.col(i) =
        trammel::test::derivative([&](double s) -> Vec { return values(x + s * Vec::Unit(x.size(), i)); }, 0, 1e-4);
  return result;
}

void expect_exact_tangent(const TsplinePlate& plate, const Vec& q, const Vec& v) {
  const Mat M = trammel::test::mass(plate, q);
  const Mat D = gradient([&](const Vec& u) -> Vec { return -trammel::test::force(plate, q, u); }, v);
  const Mat K = gradient([&](const Vec& p) -> Vec { return -trammel::test::force(plate, p, v); }, q);
  Mat S = Mat::Zero(v.size(), v.size());
  Matrix into = Matrix::onto(S);
  plate.add_tangent(0, q, v, v, {.c_m = 2, .c_d = 3, .c_k = 5}, into);
  EXPECT_LT((S - 2 * M - 3 * D - 5 * K).norm(), 1e-9 * S.norm());
}

TEST(TsplinePlate, HasTheTangentOfItsForce) {
  const auto plate = small_plate();
  expect_exact_tangent(*plate, wavy(*plate, 0.1), wavy(*plate, 0.5, 1));
}

TEST(TsplinePlate, HasTheTangentOfItsForceWithLoadsDampingAndSupports) {
  const auto plate = small_plate(true);
  expect_exact_tangent(*plate, wavy(*plate, 0.1), wavy(*plate, 0.5, 1));
}

TEST(TsplinePlate, KeepsEnergyWithoutLoads) {
  const auto plate = small_plate();
  trammel::test::expect_energy_is_kept(*plate, wavy(*plate, 0.1), wavy(*plate, 0.5, 1));
  trammel::test::expect_kinetic_energy_of_its_mass(*plate, wavy(*plate, 0.1), wavy(*plate, 0.5, 1));
}

TEST(TsplinePlate, EnergyChangesByThePowerOfLoadsAndDampers) {
  const auto plate = small_plate(true);
  const Vec q = wavy(*plate, 0.1), v = wavy(*plate, 0.5, 1);
  const Vec a = trammel::test::mass(*plate, q).ldlt().solve(trammel::test::force(*plate, q, v));
  const auto energy = [&](double t) { return plate->energy(0, q + t * v + t * t / 2 * a, v + t * a).total(); };
  const Power power = plate->power(0, q, v);
  EXPECT_NEAR(trammel::test::derivative(energy, 0, 1e-4), power.supplied - power.dissipated, 1e-8);
  EXPECT_GT(power.dissipated, 0);
}

TEST(TsplinePlate, MarkersMoveAsTheySay) {
  for (bool loaded : {false, true}) {
    const auto plate = small_plate(loaded);
    trammel::test::expect_markers_move_as_they_say(*plate, wavy(*plate, 0.1), wavy(*plate, 0.2, 1));
  }
}

TEST(TsplinePlate, MarkersTurnTheirFrameWithTheAngularVelocity) {
  const auto plate = small_plate();
  const Vec q = wavy(*plate, 0.1), v = wavy(*plate, 0.2, 1);
  for (int i = 0; i < int(plate->markers().size()); ++i) {
    const auto along = [&](double t) { return trammel::test::motion(*plate, i, q + t * v, v); };
    const Motion m = along(0);
    const Eigen::Vector3d omega = m.V.tail<3>();
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d rate =
          trammel::test::derivative([&](double t) -> Eigen::Vector3d { return along(t).R.col(axis); }, 0);
      EXPECT_LT((omega.cross(Eigen::Vector3d(m.R.col(axis))) - rate).norm(), 1e-8);
    }
    EXPECT_LT((m.R.transpose() * m.R - Mat3::Identity(3, 3)).norm(), 1e-14);
    EXPECT_NEAR(Eigen::Matrix3d(m.R).determinant(), 1, 1e-14);
  }
}

TEST(TsplinePlate, HasTheGeometricStiffnessOfItsMarkers) {
  const auto plate = small_plate(true);
  const Vec q = wavy(*plate, 0.1);
  const Wrench F = Vec::LinSpaced(6, 3, -2);
  for (int i = 0; i < int(plate->markers().size()); ++i) {
    const auto generalised = [&](const Vec& p) -> Vec {
      const Motion m = trammel::test::motion(*plate, i, p, rest(*plate));
      Vec f = rest(*plate);
      for (std::size_t k = 0; k < m.dofs.size(); ++k) f(m.dofs[k]) += m.J.col(Eigen::Index(k)).dot(F);
      return f;
    };
    Mat S = Mat::Zero(q.size(), q.size());
    Matrix into = Matrix::onto(S);
    plate->add_reaction_derivative(i, 0, q, F, 7, into);
    EXPECT_LT((S - 7 * gradient(generalised, q)).norm(), 1e-8 * (1 + S.norm())) << plate->markers()[std::size_t(i)];
  }
}

TEST(TsplinePlate, FeelsNoForceInRigidMotion) {
  auto plate = rectangle_plate(1, 1, "4x4", 0.01, 1e6, 0.3);
  plate->prepare(space());
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Vec q =
      moved(*plate, [&](const Eigen::Vector3d& P) -> Eigen::Vector3d { return R * P + Eigen::Vector3d(3, 1, 2) - P; });
  EXPECT_LT(force_at(*plate, q).norm(), 1e-14 * 1e6 * 0.01 * 100);  // E h times round-off of 100 points
  EXPECT_LT(plate->energy(0, q, rest(*plate)).elastic, 1e-20);
}

TEST(TsplinePlate, HasTheMassOfItsArea) {
  auto plate = rectangle_plate(2, 3, "3x2", 0.1, 1e6, 0.3, 7810);
  plate->velocity = Eigen::Vector3d(1, 2, 3);
  plate->prepare(space(9.81));
  Vec q = rest(*plate), v = q;
  plate->initial(q, v);
  const Momentum p = plate->momentum(0, q, v);
  const double m = 7810 * 0.1 * 6;
  EXPECT_NEAR(p.mass, m, 1e-12 * m);
  EXPECT_LT((Eigen::Vector3d(p.linear) - m * Eigen::Vector3d(1, 2, 3)).norm(), 1e-12 * m);
  EXPECT_LT((Eigen::Vector3d(p.angular) - m * Eigen::Vector3d(1, 1.5, 0).cross(Eigen::Vector3d(1, 2, 3))).norm(),
            1e-11 * m);
  EXPECT_NEAR(plate->energy(0, q, v).kinetic, 0.5 * m * 14, 1e-11 * m);
}

TEST(TsplinePlate, NearestPointIsWhereTheSurfaceIsPerpendicular) {
  const auto plate = small_plate();
  const Vec q = wavy(*plate, 0.1);
  for (const auto& [u, v] : {std::pair{0.2, 0.3}, {0.71, 0.52}, {0.5, 0.5}, {0.93, 0.07}}) {
    const Place at = place(plate->mesh(), surface_point(plate->mesh(), u, v), q);
    const Eigen::Vector3d n = at.a1.cross(at.a2).normalized();
    Eigen::Vector2d found;
    Vec3 point, normal;
    plate->nearest(0, q, at.r + 0.1 * n, found, point, normal);
    EXPECT_NEAR(found.x(), u, 1e-9);
    EXPECT_NEAR(found.y(), v, 1e-9);
    EXPECT_LT((Eigen::Vector3d(normal) - n).norm(), 1e-8);
  }
}

TEST(TsplinePlate, NearestPointOfSomethingBesideThePlateIsOnItsEdge) {
  auto plate = rectangle_plate(1, 1, "4x4", 0.1, 1, 0.3);
  plate->prepare(space());
  Eigen::Vector2d found;
  Vec3 point, normal;
  plate->nearest(0, rest(*plate), Eigen::Vector3d(1.5, 0.4, 0.2), found, point, normal);
  EXPECT_LT((found - Eigen::Vector2d(1, 0.4)).norm(), 1e-12);
  plate->nearest(0, rest(*plate), Eigen::Vector3d(-1, -1, 0), found, point, normal);
  EXPECT_LT(found.norm(), 1e-12);
}

// A closed tube of 8 x 2 elements about z, control points on a circle evenly: periodic, so C1 and more across the seam.
std::unique_ptr<TsplinePlate> tube() {
  auto plate = std::make_unique<TsplinePlate>();
  const int n = 8;
  plate->sole_patch.shape = Patch::Shape::points;
  plate->sole_patch.elements = "8x2", plate->joined = {{"seam", joining("u1", "u0")}};
  plate->thickness = 0.05, plate->youngs_modulus = 100, plate->poissons_ratio = 0.3, plate->density = 10;
  // An open knot vector from a periodic one by the blossom: the coefficients of the piece at its ends.
  const TsplineBasis basis(TMesh::uniform(n, 2));
  const auto periodic = [&](double x1, double x2, double x3, int first) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = -3; k < n + 3; ++k) {
      const LocalKnots knots{(k - 2.0) / n, (k - 1.0) / n, double(k) / n, (k + 1.0) / n, (k + 2.0) / n};
      const int span = first - (k - 2);
      if (span < 0 || span > 3) continue;
      const double angle = 2 * M_PI * k / n;
      sum += blossom(knots, span, x1, x2, x3) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return sum;
  };
  for (const Anchor& a : basis.anchors()) {
    const LocalKnots &u = a.knots[0], &v = a.knots[1];
    const int first = std::min(n - 1, int(std::floor(n * (u[0] + u[4]) / 2 + 1e-9)));
    const Eigen::Vector2d p = periodic(u[1], u[2], u[3], first);
    for (double x : {p.x(), p.y(), (v[1] + v[2] + v[3]) / 3}) plate->sole_patch.control_points.push_back(x);
  }
  plate->prepare(space());
  return plate;
}

TEST(TsplinePlate, JoinedEdgesStaySmoothWhenTheTubeMoves) {
  const auto plate = tube();
  const Vec q = Vec::LinSpaced(plate->coordinates().nq(), -0.1, 0.1).array().sin();
  for (double v : {0.0, 0.3, 0.8}) {
    const Place low = place(plate->mesh(), surface_point(plate->mesh(), 0, v), q);
    const Place high = place(plate->mesh(), surface_point(plate->mesh(), 1, v), q);
    EXPECT_LT((low.r - high.r).norm(), 1e-14);
    EXPECT_LT((low.a1 - high.a1).norm(), 1e-13);
  }
  expect_exact_tangent(*plate, q, q);
}

std::string refusal(const std::function<void(TsplinePlate&)>& spoil) {
  auto plate = rectangle_plate(1, 1, "2x2", 0.1, 1, 0.3);
  spoil(*plate);
  return test::refusal(*plate);
}

TEST(TsplinePlate, RefusesWhatItCannotBuild) {
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.sole_patch.elements = "2by2"; }),
            "mesh.elements: found \"2by2\", expected two whole numbers such as \"10x10\"");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.sole_patch.crossed = {4}; }),
            "mesh.cross: no element 4; there are 0 to 3, by rows");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.sole_patch.edge_v1 = "clamp"; }),
            "edges.v1: found \"clamp\", expected free, hinged, clamped, symmetric, pole or held axes such as \"z\" or "
            "\"xz\"");
  EXPECT_EQ(
      refusal([](TsplinePlate& p) { p.sole_patch.along_v = Eigen::Vector3d(2, 0, 0); }),
      "geometry: the surface is degenerate at (u, v) = (0.05635083268962915, 0.05635083268962915): its tangents are "
      "parallel");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.sole_patch.shape = Patch::Shape::ring; }),
            "geometry.inner_radius: geometry ring needs it");
  EXPECT_EQ(refusal([](TsplinePlate& p) {
              p.sole_patch.knots_u = {0, 0.5, 0.4, 1}, p.sole_patch.knots_v = {0, 1};
            }),
            "mesh: u: knots must ascend; 0.4 follows 0.5");
  EXPECT_EQ(refusal([](TsplinePlate& p) {
              p.sole_patch.markers = {{"a", Eigen::Vector3d(1.2, 0, 0)}};
            }),
            "markers: \"a\" is at (u, v) = (1.2, 0), expected u from 0 to 1, v from 0 to 1");
  EXPECT_EQ(refusal([](TsplinePlate& p) {
              p.sole_patch.shape = Patch::Shape::points;
              p.sole_patch.control_points = {0, 0, 0};
            }),
            "geometry.control_points: found 3 numbers, expected 75: x, y, z of 25 control points, by rows");
}

TEST(TsplinePlate, RefusesTriggersThatContradictEachOther) {
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.indicator = Indicator::energy_density; }),
            "refine.threshold: an indicator needs the value above which an element is split");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.refine_near = 0.1; }), "refine.near: it belongs to refine.on_contact");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.refine_on = "ball", p.refine_at = 1, p.refine_elements = {0}; }),
            "refine.at: give one of on_contact, at, indicator");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.refine_on = "ball", p.refine_near = 0.1, p.refine_elements = {0}; }),
            "refine.elements: the elements are chosen by near or by the indicator; leave them out");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.refine_on = "ball"; }),
            "refine.elements: name the elements to split, counted by rows from 0");
}

TEST(TsplinePlate, RefusesACircleOfTooFewElements) {
  EXPECT_EQ(refusal([](TsplinePlate& p) {
              p.sole_patch.shape = Patch::Shape::cylinder;
              p.sole_patch.radius = 1, p.sole_patch.length = 2, p.sole_patch.to = 2 * M_PI;
            }),
            "mesh: an arc of 6.283 rad is a spline whose pieces are 1.6 rad at most; found one of 3.142 rad, take more "
            "elements round it");
}

}  // namespace
}  // namespace trammel::plate
