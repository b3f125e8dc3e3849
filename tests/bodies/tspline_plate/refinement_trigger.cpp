#include "tspline_plate/shell/refinement_trigger.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "plates.hpp"

namespace trammel::plate {
namespace {

using namespace test;

// Deflections x^2/2 and x^3/6 times `size`: their control points are blossoms at the inner knots.
Vec bent(const TsplinePlate& plate, int power, double size) {
  Vec q = rest(plate);
  for (int i = 0; i < plate.mesh().basis.size(); ++i) {
    const auto& k = plate.mesh().basis.patch(0).anchors()[std::size_t(i)].knots[0];
    q(3 * i + 2) =
        power == 2 ? size / 2 * (k[1] * k[2] + k[1] * k[3] + k[2] * k[3]) / 3 : size / 6 * k[1] * k[2] * k[3];
  }
  return q;
}

double of_first_cell(const TsplinePlate& plate, Indicator indicator, const Vec& q) {
  CellVectors u;
  gather(plate.mesh().cells[0], q, u);
  return indicate(indicator, plate.mesh().cells[0], u);
}

constexpr double small = 1e-5;  // the linear theory to its square

TEST(Indicator, EnergyDensityOfConstantCurvatureIsThatOfTheory) {
  auto plate = rectangle_plate(1, 1, "4x4", 0.1, 1e3, 0.3);
  plate->prepare(space());
  const double D = 1e3 * 1e-3 / 12 / (1 - 0.09);
  EXPECT_NEAR(of_first_cell(*plate, Indicator::energy_density, bent(*plate, 2, small)) / (D * small * small / 2), 1,
              1e-7);
}

TEST(Indicator, CurvatureJumpIsTheChangeFromOnePointToTheOther) {
  auto plate = rectangle_plate(1, 1, "4x4", 0.1, 1e3, 0.3);
  plate->prepare(space());
  EXPECT_NEAR(of_first_cell(*plate, Indicator::curvature_jump, bent(*plate, 2, small)) / small, 0, 1e-7);
  // Three Gauss points: the outer ones lie sqrt(0.6) of the element's side apart.
  EXPECT_NEAR(of_first_cell(*plate, Indicator::curvature_jump, bent(*plate, 3, small)) / small, std::sqrt(0.6) / 4,
              1e-7);
}

// Refines until nothing is due; how often.
int refine_all(TsplinePlate& plate, const std::function<Vec(const TsplinePlate&)>& shape, const RefineCause& cause) {
  int times = 0;
  for (Vec q = shape(plate); plate.due(0, q, q, cause) && times < 20; q = shape(plate), ++times)
    EXPECT_TRUE(plate.refine(0, q, q, cause));
  return times;
}

double narrowest(const TsplinePlate& plate) {
  double least = 1;
  for (const auto& box : plate.mesh().basis.elements())
    least = std::min({least, box.high[0] - box.low[0], box.high[1] - box.low[1]});
  return least;
}

TEST(Indicator, SplitsUntilItIsBelowTheThreshold) {
  auto plate = rectangle_plate(1, 1, "4x4", 0.1, 1e3, 0.3);
  plate->indicator = Indicator::curvature_jump, plate->refine_threshold = 0.13 * small, plate->refine_levels = 9;
  plate->prepare(space());
  // 0.194, 0.097 of it on elements of a quarter, an eighth.
  EXPECT_EQ(refine_all(*plate, [](const TsplinePlate& p) { return bent(p, 3, small); }, {}), 1);
  EXPECT_EQ(plate->mesh().basis.patch(0).mesh().elements().size(), 64u);
}

TEST(Indicator, SplitsNoElementMoreOftenThanTheLevels) {
  auto plate = rectangle_plate(1, 1, "4x4", 0.1, 1e3, 0.3);
  plate->indicator = Indicator::energy_density, plate->refine_threshold = 0, plate->refine_levels = 2;
  plate->prepare(space());
  EXPECT_EQ(refine_all(*plate, [](const TsplinePlate& p) { return bent(p, 2, small); }, {}), 2);
  EXPECT_EQ(narrowest(*plate), 1.0 / 16);
}

TEST(Indicator, IsAskedAfterStepsNotAtContacts) {
  auto plate = rectangle_plate(1, 1, "4x4", 0.1, 1e3, 0.3);
  plate->indicator = Indicator::energy_density, plate->refine_threshold = 0;
  plate->prepare(space());
  const Vec q = bent(*plate, 2, small);
  EXPECT_FALSE(plate->due(0, q, q, {"ball", {}}));
  EXPECT_TRUE(plate->due(0, q, q, {}));
  EXPECT_FALSE(plate->due(0, rest(*plate), q, {})) << "nothing is bent";
}

TEST(RefinementNear, SplitsWhatLiesWithinTheDistanceAtEveryClosing) {
  auto plate = rectangle_plate(2, 2, "10x10", 0.1, 1e3, 0.3);
  plate->sole_patch.closure = Closure::none;
  plate->refine_on = "ball", plate->refine_near = 0.1, plate->refine_levels = 2;
  plate->prepare(space());
  const Vec q = rest(*plate);
  EXPECT_FALSE(plate->due(0, q, q, {"other", {0.5, 0.5}}));
  EXPECT_FALSE(plate->due(0, q, q, {}));
  ASSERT_TRUE(plate->refine(0, q, q, {"ball", {0.5, 0.5}}));
  EXPECT_EQ(plate->mesh().basis.patch(0).mesh().elements().size(), 112u);  // the four at the corner that was struck
  EXPECT_TRUE(plate->due(0, rest(*plate), rest(*plate), {"ball", {0.5, 0.5}}));
  EXPECT_TRUE(plate->due(0, rest(*plate), rest(*plate), {"ball", {0.12, 0.5}}));
}

TEST(RefinementNear, StopsAtItsLevels) {
  auto plate = rectangle_plate(2, 2, "5x5", 0.1, 1e3, 0.3);
  plate->refine_on = "ball", plate->refine_near = 0.1, plate->refine_levels = 3;
  plate->prepare(space());
  EXPECT_LT(refine_all(*plate, rest, {"ball", {0.5, 0.5}}), 6);  // by neighbours that come within the distance
  EXPECT_NEAR(narrowest(*plate), 0.2 / 8, 1e-12);
}

}  // namespace
}  // namespace trammel::plate
