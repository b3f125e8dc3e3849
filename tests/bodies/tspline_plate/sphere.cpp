// Spheres from pole to pole: closed shells, smooth about their poles.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "difference_checks.hpp"
#include "plates.hpp"

namespace trammel::plate {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr double radius = 0.5, thickness = 0.01;

std::unique_ptr<TsplinePlate> shell() {
  auto plate = std::make_unique<TsplinePlate>();
  plate->thickness = thickness, plate->youngs_modulus = 1e6, plate->poissons_ratio = 0.3, plate->density = 1;
  return plate;
}

Patch part_of_sphere(double from, double to, double south, double north, const std::string& elements) {
  Patch patch;
  patch.shape = Patch::Shape::sphere, patch.radius = radius, patch.elements = elements;
  patch.from = from, patch.to = to, patch.south = south, patch.north = north;
  return patch;
}

// Eight exact octants; every joint smooth.
std::unique_ptr<TsplinePlate> of_octants() {
  auto plate = shell();
  for (int k = 0; k < 4; ++k) {
    const std::string number = std::to_string(k), next = std::to_string((k + 1) % 4);
    Patch north = part_of_sphere(k * M_PI / 2, (k + 1) * M_PI / 2, 0, M_PI / 2, "2x2"),
          south = part_of_sphere(k * M_PI / 2, (k + 1) * M_PI / 2, -M_PI / 2, 0, "2x2");
    north.edge_v1 = south.edge_v0 = "pole";
    plate->named_patches.emplace_back("n" + number, north);
    plate->named_patches.emplace_back("s" + number, south);
    plate->joined.emplace_back("n" + number, joining("n" + number + ".u1", "n" + next + ".u0"));
    plate->joined.emplace_back("s" + number, joining("s" + number + ".u1", "s" + next + ".u0"));
    plate->joined.emplace_back("equator" + number, joining("s" + number + ".v1", "n" + number + ".v0"));
  }
  return plate;
}

// Two hemispheres, each closed by joining its meridians; round them splines through the circle at the ends of the
// elements.
std::unique_ptr<TsplinePlate> of_halves(const std::string& elements = "8x3") {
  auto plate = shell();
  Patch north = part_of_sphere(0, 2 * M_PI, 0, M_PI / 2, elements),
        south = part_of_sphere(0, 2 * M_PI, -M_PI / 2, 0, elements);
  north.edge_v1 = south.edge_v0 = "pole";
  plate->named_patches = {{"n", north}, {"s", south}};
  plate->joined = {
      {"north", joining("n.u1", "n.u0")}, {"south", joining("s.u1", "s.u0")}, {"equator", joining("s.v1", "n.v0")}};
  return plate;
}

struct Modes {
  Eigen::SelfAdjointEigenSolver<Mat> of;
  explicit Modes(const TsplinePlate& plate) : of(stiffness(plate, rest(plate))) {}
  bool free(Eigen::Index k) const { return of.eigenvalues()(k) < 1e-11 * of.eigenvalues().maxCoeff(); }
  Eigen::Index mechanisms() const { return (of.eigenvalues().array() < 1e-11 * of.eigenvalues().maxCoeff()).count(); }
};

// p R^2 (1 - nu)/(2 E h) all over, up to bending of (h/R)^2 = 4e-4.
TEST(Sphere, OfEightPatchesWidensEvenlyUnderPressure) {
  auto plate = of_octants();
  plate->pressure = 1e-5, plate->quadrature = 6;
  plate->prepare(space());
  EXPECT_NEAR(plate->momentum(0, rest(*plate), rest(*plate)).mass, thickness * 4 * M_PI * radius * radius,
              1e-4 * thickness * M_PI);  // 4 Gauss points
  const Vec f = force_at(*plate, rest(*plate));
  plate->pressure = 0;
  const Modes modes(*plate);
  EXPECT_EQ(modes.mechanisms(), 6);
  Vec q = rest(*plate);
  for (Eigen::Index k = 0; k < q.size(); ++k)
    if (!modes.free(k))
      q += modes.of.eigenvectors().col(k).dot(f) / modes.of.eigenvalues()(k) * modes.of.eigenvectors().col(k);
  const double widening = 1e-5 * radius * radius * (1 - 0.3) / (2 * 1e6 * thickness);
  // Between opposite points, as nothing holds the sphere at its place. Patches lie 2 apart in u, northern and southern
  // by turns.
  for (double u : {0.0, 0.3, 0.9, 4.4, 5.0})
    for (double v : {0.0, 0.4, 0.9, 1.0}) {
      const double across = (point_of(*plate, u, v, q) - point_of(*plate, u + 10, 1 - v, q)).norm();
      EXPECT_NEAR((across / 2 - radius) / widening, 1, 4e-4) << u << ", " << v;
    }
}

TEST(Sphere, OfTwoPatchesMovesFreelyInSixWaysOnly) {
  auto plate = of_halves();
  plate->prepare(space());
  EXPECT_EQ(Modes(*plate).mechanisms(), 6);
}

Vec shaken(const TsplinePlate& plate) {
  return 0.05 * Vec::LinSpaced(plate.coordinates().nq(), 1, 100).array().sin();
}

TEST(Sphere, StaysSmoothAtItsPolesWhenItMoves) {
  for (const bool two : {true, false}) {
    auto plate = two ? of_halves() : of_octants();
    plate->prepare(space());
    const Vec q = shaken(*plate);
    for (const double v : {0.0, 1.0}) {
      // Patches lie 2 apart in u, northern and southern by turns.
      const auto on = [&](int k) {
        return surface_point(plate->mesh(),
                             two ? 2 * (v == 0) + k / 8.0 : 4 * (k / 2) + 2 * (v == 0) + 0.3 + 0.4 * (k % 2), v);
      };
      const Place first = place(plate->mesh(), on(0), q);
      const Vector3d n = first.a1.cross(first.a2).normalized();
      for (int k = 1; k < 8; ++k) {
        const Place at = place(plate->mesh(), on(k), q);
        EXPECT_LT((at.r - first.r).norm(), 1e-13) << k << ", " << v;
        EXPECT_GT(at.a1.cross(at.a2).normalized().dot(n), 1 - 1e-8) << k << ", " << v;  // tangents 1e-6 beside the pole
      }
    }
  }
}

TEST(Sphere, RefinedAtItsPolesKeepsItsSurfaceAndVelocity) {
  auto plate = of_halves();
  plate->prepare(space());
  const Vec q = 0.1 * shaken(*plate), v = shaken(*plate);
  const auto elements = plate->mesh().basis.elements();
  std::vector<Vector3d> places, moved_places;
  const auto look = [&](const Vec& of, std::vector<Vector3d>& found) {
    for (int k = 0; k <= 20; ++k)
      for (const double patch : {0, 2}) found.push_back(point_of(*plate, patch + 0.05 * k, 1 - 0.02 * k, of));
  };
  look(q, places), look(v, moved_places);
  const double kinetic = plate->energy(0, q, v).kinetic;
  const auto transfer = plate->refine_elements_in({elements[21], elements[26]});
  Vec q2 = rest(*plate), v2 = q2;
  transfer->q(q, q2), transfer->v(v, v2);
  EXPECT_GT(q2.size(), q.size());
  std::vector<Vector3d> places2, moved_places2;
  look(q2, places2), look(v2, moved_places2);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_LT((places2[k] - places[k]).norm(), 1e-13) << k;
    EXPECT_LT((moved_places2[k] - moved_places[k]).norm(), 1e-13) << k;
  }
  EXPECT_NEAR(plate->energy(0, q2, v2).kinetic, kinetic,
              1e-3 * kinetic);  // the 4 Gauss points of elements of pi/4 x pi/6
}

TEST(Sphere, HasItsNearestPointBeyondAPole) {
  for (const bool two : {true, false}) {
    auto plate = two ? of_halves("16x6") : of_octants();
    plate->prepare(space());
    const double round = two ? 1e-4 : 1e-9;
    for (double longitude = 0; longitude < 6.2; longitude += 0.7)
      for (const double latitude : {-1.57, -1.3, 0.2, 1.4, 1.569, M_PI / 2}) {
        const Vector3d n(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                         std::sin(latitude));
        Eigen::Vector2d at;
        Vec3 point, normal;
        plate->nearest(0, rest(*plate), Vector3d(0.7 * n), at, point, normal);
        EXPECT_LT((Vector3d(point) - radius * n).norm(), round + 1e-6) << longitude << ", " << latitude;
        EXPECT_LT((Vector3d(normal) - n).norm(), 0.02 * two + 1e-5) << longitude << ", " << latitude;
        Motion motion;
        plate->motion_at(at, 0, rest(*plate), rest(*plate), motion);
        EXPECT_TRUE(motion.J.allFinite() && motion.x.allFinite() && motion.R.allFinite());
      }
  }
}

TEST(Sphere, HasMarkersAtItsPolesThatMoveAsTheySay) {
  auto plate = shell();
  plate->sole_patch = part_of_sphere(0, 1.5, 0, M_PI / 2, "2x2");
  plate->sole_patch.edge_v1 = "pole";
  plate->prepare(space());
  const Vec q = 0.2 * shaken(*plate), v = shaken(*plate);
  for (int i = 0; i < int(plate->markers().size()); ++i) {
    const auto along = [&](double t) { return trammel::test::motion(*plate, i, q + t * v, v); };
    const Motion m = along(0);
    const Vec rate = trammel::test::derivative([&](double t) -> Vec { return along(t).x; }, 0);
    EXPECT_LT((m.V.head(3) - rate).norm(), 1e-9) << plate->markers()[std::size_t(i)];
    const Vector3d omega = m.V.tail<3>();
    const Vector3d turned = trammel::test::derivative([&](double t) -> Vector3d { return along(t).R.col(2); }, 0);
    EXPECT_LT((omega.cross(Vector3d(m.R.col(2))) - turned).norm(), 1e-6) << plate->markers()[std::size_t(i)];
  }
}

TEST(Sphere, HasTheStressOfTheoryAtItsPolesToo) {
  auto plate = shell();
  plate->sole_patch = part_of_sphere(0, 1.5, 0, M_PI / 2, "2x2");
  plate->sole_patch.edge_v1 = "pole";
  plate->prepare(space());
  // Widened by a part eps: E/(1 - nu) eps in all directions.
  const double eps = 1e-6, stress = 1e6 / (1 - 0.3) * eps;
  const Vec q = moved(*plate, [&](const Vector3d& P) -> Vector3d { return eps * P; });
  for (const double v : {0.0, 0.5, 1.0})
    EXPECT_NEAR(von_mises(plate->stress_at(0.3, v, q).middle) / stress, 1, 1e-3) << v;
  EXPECT_NEAR(plate->observe(1, 0, q, q) / stress, 1, 1e-3);
}

std::string refusal(const std::function<void(TsplinePlate&)>& spoil) {
  auto plate = shell();
  plate->sole_patch = part_of_sphere(0, 1.5, 0, M_PI / 2, "2x2");
  plate->sole_patch.edge_v1 = "pole";
  spoil(*plate);
  return test::refusal(*plate);
}

TEST(Sphere, IsRefusedWhereItHasNoPole) {
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.sole_patch.north = 1.5; }),
            "edges.v1: pole: the edge is not one point, but 0.008826 m long or more");
  EXPECT_EQ(refusal([](TsplinePlate& p) { p.sole_patch.north = 1.5709; }),
            "geometry.north: found latitudes from 0 to 1.5709, expected -pi/2 <= south < north <= pi/2, at most 2.6 "
            "apart: join two patches for more");
}

}  // namespace
}  // namespace trammel::plate
