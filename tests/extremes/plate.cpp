// Plates at the edge: thin and thick, incompressible, slender and repeated lines, one element, eight levels at one
// point, refined in every phase, struck at a corner or too fast, by any stiffness, and past the load under which they
// buckle.
#include <algorithm>
#include <cmath>

#include "support/run_in_pieces.hpp"
#include "outcome.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;

// A clamped square of side 1 and D = 1 under a load so small that nothing but D matters.
const std::string square = R"({
  "trammel": 1, "space": "spatial", "gravity": [0, 0, 0], "parameters": {"h": 0.01, "nu": 0.3, "q": "=1e-4*h"},
  "bodies": {"plate": {"type": "tspline_plate", "geometry": {"along_u": [1, 0, 0], "along_v": [0, 1, 0]},
    "mesh": {"elements": "8x8"}, "thickness": "=h", "density": 1, "youngs_modulus": "=12*(1-nu^2)/h^3",
    "poissons_ratio": "=nu", "quadrature": 4, "load": [0, 0, "=q"],
    "edges": {"u0": "clamped", "u1": "clamped", "v0": "clamped", "v1": "clamped"}}},
  "static": {"steps": 1},
  "record": {"observe": {"w": "plate.centre.z"}}})";
constexpr double on_8x8 = 0.0012651457, exactly = 0.00126531908749;  // q L^4/D: of the reference's mesh; by Ritz

double deflection(const std::string& text, const Overrides& overrides, double q) {
  const Finished run = run_static(text, overrides);
  EXPECT_TRUE(run.done()) << run.report.reason;
  return run.done() ? run.end("w") / q : 0;
}

class Thickness : public testing::TestWithParam<double> {};

TEST_P(Thickness, DoesNotMatterInUnitsOfTheBendingStiffness) {
  const double h = GetParam();
  EXPECT_NEAR(deflection(square, {{"parameters.h", fmt::format("{}", h)}}, 1e-4 * h) / on_8x8, 1, 1e-7) << h;
}

INSTANTIATE_TEST_SUITE_P(OfTheSide, Thickness, testing::Values(1e-1, 1e-2, 1e-3, 1e-4, 1e-5),
                         [](const auto& h) { return fmt::format("n{}", h.index); });

TEST(PoissonsRatio, FromNothingToNearlyAHalfChangesNothingButTheBendingStiffness) {
  for (const char* nu : {"0", "0.3", "0.4999"})
    EXPECT_NEAR(deflection(square, {{"parameters.nu", nu}}, 1e-6) / on_8x8, 1, 1e-7) << nu;
}

TEST(RepeatedKnots, LeaveAPlateAtLeastAsGood) {
  const Overrides repeated = {{"bodies.plate.mesh", R"({"u": [0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1],
    "v": [0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1]})"}};
  const double on_4x4 = deflection(square, {{"bodies.plate.mesh.elements", "4x4"}}, 1e-6);
  EXPECT_LT(std::abs(deflection(square, repeated, 1e-6) - exactly), std::abs(on_4x4 - exactly));
}

TEST(SlenderElements, OfAspectTenThousandLeaveAPlateAsGood) {
  const Overrides slender = {
      {"bodies.plate.mesh", R"({"u": [0, 0.125, 0.25, 0.375, 0.5, 0.500025, 0.625, 0.75, 0.875, 1],
    "v": [0, 0.25, 0.5, 0.75, 1]})"}};
  const double on_8x4 = deflection(square, {{"bodies.plate.mesh.elements", "8x4"}}, 1e-6);
  EXPECT_LE(std::abs(deflection(square, slender, 1e-6) - exactly), std::abs(on_8x4 - exactly) * (1 + 1e-6));
}

// A cantilever 1000 to 1e5 times as long as wide: its end is that of beam theory, q L^4/(8 D). Bending along it is
// (L/b)^4 times as soft as across, 1e12 to 1e20: from 1e16 the stiffness matrix has no digits left for it, but forces
// have.
class Strip : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Strip, IsTheCantileverOfBeamTheory) {
  const auto& [aspect, elements] = GetParam();
  const double w = deflection(square,
                              {{"parameters.nu", "0"},
                               {"bodies.plate.mesh.elements", elements},
                               {"bodies.plate.geometry.along_v", fmt::format("[0, {}, 0]", 1 / std::stod(aspect))},
                               {"bodies.plate.edges", R"({"u0": "clamped"})"},
                               {"record.observe.w", "plate.u1v0.z"}},
                              1e-6);
  EXPECT_NEAR(w / 0.125, 1, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(OfAspect, Strip,
                         testing::Values(std::pair{"1e3", "1x1"}, std::pair{"1e4", "1x1"}, std::pair{"1e4", "2x1"},
                                         std::pair{"1e4", "8x1"}, std::pair{"1e4", "16x2"}, std::pair{"1e5", "1x1"}),
                         [](const auto& strip) {
                           return fmt::format("{}_of_{}", strip.param.first, strip.param.second);
                         });

// The load grows with time: no equilibrium at the start shows that K is inaccurate.
TEST(SlenderStrip, OfAspectTenThousandBendsStepByStep) {
  const Finished run = run_static(square, {{"parameters.nu", "0"},
                                           {"bodies.plate.mesh.elements", "1x1"},
                                           {"bodies.plate.geometry.along_v", "[0, 1e-4, 0]"},
                                           {"bodies.plate.edges", R"({"u0": "clamped"})"},
                                           {"bodies.plate.load_factor", "=t"},
                                           {"static.steps", "4"},
                                           {"record.observe.w", "plate.u1v0.z"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto& w = run.series.at("w");
  ASSERT_EQ(w.size(), 5u);
  for (std::size_t i = 0; i < w.size(); ++i) EXPECT_NEAR(w[i], 0.125e-6 * double(i) / 4, 1e-13) << i;
}

Finished bent_far(const char* width, const char* q, const char* steps) {
  return run_static(square, {{"parameters.nu", "0"},
                             {"parameters.h", "1e-3"},
                             {"parameters.q", q},
                             {"bodies.plate.mesh.elements", "4x1"},
                             {"bodies.plate.geometry.along_v", fmt::format("[0, {}, 0]", width)},
                             {"bodies.plate.edges", R"({"u0": "clamped"})"},
                             {"bodies.plate.load_factor", "=t"},
                             {"static.steps", steps},
                             {"record.observe.w", "plate.u1v0.z"}});
}

// A third of its length, far beyond its thickness. Without Poisson's ratio the width does not matter.
TEST(SlenderStrip, OfAspectTenThousandBendsAsFarAsOneOfAHundred) {
  const Finished wide = bent_far("1e-2", "4", "10"), slender = bent_far("1e-4", "4", "10");
  ASSERT_TRUE(wide.done() && slender.done()) << slender.report.reason;
  EXPECT_GT(wide.end("w"), 0.3);
  EXPECT_NEAR(slender.end("w"), wide.end("w"), 1e-8);
  EXPECT_TRUE(wide.result["warnings"].empty());
  EXPECT_THAT(slender.result["warnings"].dump(), HasSubstr("static.tolerance"));
}

// Forces' parts of a load step are halved like any others.
TEST(SlenderStrip, OfAspectTenThousandBendsAsFarInTenStepsAsInAHundred) {
  const Finished ten = bent_far("1e-4", "40", "10"), hundred = bent_far("1e-4", "40", "100");
  ASSERT_TRUE(ten.done() && hundred.done()) << ten.report.reason;
  EXPECT_GT(ten.end("w"), 0.7);
  EXPECT_NEAR(ten.end("w"), hundred.end("w"), 1e-10);
}

// A ball of 3 kg and 0.1 m over a plate of 1 m and 20 kg, its lowest point 0.2 mm above.
std::string struck(const std::string& more, const std::string& elements = "4x4") {
  return R"({
  "trammel": 1, "space": "spatial", "gravity": [0, 0, -10],
  "bodies": {
    "plate": {"type": "tspline_plate", "geometry": {"along_u": [1, 0, 0], "along_v": [0, 1, 0]},
              "mesh": {"elements": ")" +
         elements + R"("}, "thickness": 0.02, "density": 1000, "youngs_modulus": 1e8,
              "poissons_ratio": 0.3, "quadrature": 6, "edges": {"u0": "clamped", "u1": "clamped"})" +
         more + R"(},
    "ball": {"type": "point_mass", "mass": 3, "position": [0.3, 0.4, 0.1102], "velocity": [0, 0, -1]}},
  "contacts": {"ball": {"type": "penalty", "between": ["ball.com", {"surface": "plate"}], "radius": 0.1, "stiffness": 1e7}},
  "integrator": {"type": "generalized_alpha", "rho_inf": 1, "step": 1e-3},
  "simulate": {"until": 0.03},
  "record": {"every": 0.001, "observe": {"x": "ball.com.x", "z": "ball.com.z", "vz": "ball.com.vz",
             "force": "contacts.ball.force", "gap": "contacts.ball.gap", "elements": "plate.elements"}}
})";
}
constexpr double energy_of_ball = 1.5;  // [J]

void expect_refinements_to_keep(const std::vector<Event>& refinements) {
  for (const Event& event : refinements) {
    const auto& detail = event.detail;
    EXPECT_NEAR(detail.at("mass_after"), 20, 1e-11 * 20);
    EXPECT_NEAR(detail.at("momentum_z_after"), detail.at("momentum_z_before"),
                1e-11 * std::abs(detail.at("momentum_z_before")) + 1e-14);
    EXPECT_NEAR(detail.at("kinetic_after"), detail.at("kinetic_before"), 1e-11 * detail.at("kinetic_before") + 1e-20);
  }
}

// What the ball and plate had, or a warning says that it is not so.
void expect_energy(const Finished& run, double share, double of = energy_of_ball) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  expect_finite(run);
  EXPECT_LT(std::abs(double(run.result["energy_drift"])), share * of);
}

// A light ball bounces on one place and splits the elements there each time: from 250 mm to 1 mm, of a plate 20 mm
// thick.
TEST(RefinementLevels, EightAtOnePointKeepMassMomentumAndKineticEnergy) {
  const Finished run = run_text(struck(R"(, "refine": {"on_contact": "ball", "near": 1e-6, "levels": 8})"),
                                {{"bodies.plate.quadrature", "3"},
                                 {"bodies.ball.mass", "0.03"},
                                 {"gravity", "[0, 0, -100]"},
                                 {"contacts.ball.stiffness", "1e9"},
                                 {"integrator.step", "2e-4"},
                                 {"integrator.rho_inf", "0.8"},
                                 {"simulate.until", "0.15"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  expect_finite(run);
  const auto refinements = run.of_kind("refine");
  ASSERT_EQ(refinements.size(), 8u);
  expect_refinements_to_keep(refinements);
  EXPECT_LT(std::abs(double(run.result["energy_of_refinements"])), 1e-3 * 0.3);  // 3 Gauss points, of 0.3 J
}

// Elements far smaller than what flies by in a step: their accelerations are large, to and fro, and no guide to where
// they go. With them as Newton's first guess 23 of 51 steps were rejected, in 611 iterations.
TEST(RefinementLevels, ByThePressureOfAContactLeaveTheStepItsLength) {
  const Finished run =
      run_text(struck(R"(, "refine": {"indicator": "contact_pressure", "threshold": 1e4, "levels": 5})"),
               {{"bodies.plate.quadrature", "3"},
                {"integrator.rho_inf", "0.9"},
                {"bodies.ball.position", "[0.3, 0.4, 0.1102]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  expect_finite(run);
  const auto refinements = run.of_kind("refine");
  EXPECT_GE(refinements.size(), 5u);
  expect_refinements_to_keep(refinements);
  EXPECT_EQ(run.result["counts"]["rejected"], 0);
  EXPECT_LT(run.result["counts"]["newton_iterations"], 300);
}

TEST(RefinementTime, MayBeTheVeryStepOfAnImpact) {
  const std::string at_impact = R"(, "refine": {"on_contact": "ball", "elements": [5, 6, 9, 10]})";
  const Finished run = run_text(
      struck(at_impact),
      {{"bodies.ball.position", "[0.5, 0.5, 0.1202]"},
       {"contacts.ball", R"({"type": "constraint_method", "restitution": 0.5, "between": ["ball.com", "plate.centre"],
         "reaches": {"type": "distance", "length": 0.12}})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto refinements = run.of_kind("refine"), impacts = run.of_kind("impact");
  ASSERT_EQ(refinements.size(), 1u);
  expect_refinements_to_keep(refinements);
  const Event& impact = impacts.at(0);
  EXPECT_EQ(refinements[0].t, impact.t);
  EXPECT_NEAR(impact.detail.at("separation") / impact.detail.at("approach"), 0.5, 1e-9);
}

TEST(RefinementTime, MayBeAFreePhase) {
  const Finished run =
      run_text(struck(R"(, "refine": {"at": 0.005, "elements": [5]})"),
               {{"contacts.ball.stiffness", "1e10"}, {"integrator.step", "1e-4"}, {"simulate.until", "0.02"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto opened = run.of_kind("contact_open"), closed = run.of_kind("contact_close"),
             refinements = run.of_kind("refine");
  ASSERT_EQ(refinements.size(), 1u);
  expect_refinements_to_keep(refinements);
  EXPECT_GT(refinements[0].t, opened.at(0).t);
  EXPECT_LT(refinements[0].t, closed.at(1).t);
}

// Two plates, each refined by its own ball, 0.3 ms apart in one step of 1 ms.
TEST(RefinementTime, MayBeTwiceInOneStep) {
  const auto body = [](const char* z, const char* name) {
    return fmt::format(R"({{"type": "tspline_plate", "geometry": {{"origin": [0, 0, {}], "along_u": [1, 0, 0],
      "along_v": [0, 1, 0]}}, "mesh": {{"elements": "4x4"}}, "thickness": 0.02, "density": 1000, "youngs_modulus": 1e8,
      "edges": {{"u0": "clamped"}}, "refine": {{"on_contact": "{}", "near": 0.05, "levels": 2}}}})",
                       z, name);
  };
  const Finished run =
      run_text(struck(""),
               {{"bodies.plate", body("0", "ball")},
                {"bodies.below", body("-1", "other")},
                {"bodies.stone",
                 R"({"type": "point_mass", "mass": 3, "position": [0.3, 0.4, -0.8895], "velocity": [0, 0, -1]})"},
                {"contacts.other", R"({"type": "penalty", "between": ["stone.com", {"surface": "below"}], "radius": 0.1,
          "stiffness": 1e7})"},
                {"bodies.ball.position", "[0.3, 0.4, 0.1102]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto refinements = run.of_kind("refine");
  ASSERT_GE(refinements.size(), 2u);
  EXPECT_NE(refinements[0].t, refinements[1].t);
  EXPECT_EQ(std::floor(1e3 * refinements[0].t), std::floor(1e3 * refinements[1].t));
  expect_refinements_to_keep(refinements);
}

// One plate, struck by two balls 0.3 ms apart in one step of 1 ms, and refined near the first or the second of them.
class StruckTwice : public testing::TestWithParam<std::string> {};

TEST_P(StruckTwice, InOneStepIsRefinedAtItsOwnTime) {
  const std::string& contact = GetParam();
  const Finished run = run_text(
      struck(fmt::format(R"(, "refine": {{"on_contact": "{}", "near": 0.05, "levels": 2}})", contact)),
      {{"bodies.stone", R"({"type": "point_mass", "mass": 3, "position": [0.7, 0.6, 0.1105], "velocity": [0, 0, -1]})"},
       {"contacts.stone", R"({"type": "penalty", "between": ["stone.com", {"surface": "plate"}], "radius": 0.1,
          "stiffness": 1e7})"}});
  expect_energy(run, 5e-3, 2 * energy_of_ball);  // steps of 1 ms leave 2.5e-3 without a refinement
  const auto refinements = run.of_kind("refine"), closed = run.of_kind("contact_close");
  ASSERT_GE(closed.size(), 2u);
  EXPECT_NEAR(closed[0].t, 0.2e-3, 1e-6);
  EXPECT_NEAR(closed[1].t, 0.5e-3, 1e-6);
  ASSERT_GE(refinements.size(), 1u);
  EXPECT_EQ(refinements[0].t, contact == "ball" ? closed[0].t : closed[1].t);
  expect_refinements_to_keep(refinements);
}

INSTANTIATE_TEST_SUITE_P(By, StruckTwice, testing::Values("ball", "stone"), [](const auto& by) { return by.param; });

// A ball that is pressed on and bounces in steps of 5 ms, on a plate that may be refined twice.
Finished run_bouncing(const char* chatter_steps) {
  return run_text(
      struck(R"(, "refine": {"on_contact": "ball", "near": 0.01, "levels": 2})"),
      {{"bodies.ball.position", "[0.5, 0.5, 0.1202]"},
       {"contacts.ball", R"({"type": "constraint_method", "restitution": 0.5, "between": ["ball.com", "plate.centre"],
         "reaches": {"type": "distance", "length": 0.12}})"},
       {"forces", R"({"down": {"type": "load", "on": "ball.com", "force": {"x": 0, "y": 0, "z": -3000}}})"},
       {"integrator.step", "5e-3"},
       {"simulate", fmt::format(R"({{"until": 5e-3, "chatter_steps": {}}})", chatter_steps)}});
}

TEST(RefinementTime, MayBeTwiceInOneStepOfOnePlate) {
  const Finished run = run_bouncing("0.01");
  ASSERT_TRUE(run.done()) << run.report.reason;
  expect_finite(run);
  const auto refinements = run.of_kind("refine"), impacts = run.of_kind("impact");
  ASSERT_EQ(refinements.size(), 2u);
  expect_refinements_to_keep(refinements);
  ASSERT_GE(impacts.size(), 3u);
  for (const std::size_t i : {0u, 1u}) EXPECT_EQ(refinements[i].t, impacts[i].t);
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_LT(impacts[i].t, 5e-3);
    EXPECT_NEAR(impacts[i].detail.at("separation") / impacts[i].detail.at("approach"), 0.5, 1e-9) << i;
  }
  EXPECT_GE(run.series.at("elements").back(), 16 + 12 + 12) << "four at the centre, and four there again";
}

TEST(RefinementTime, IsOnceWhereAContactStaysClosedAfterItsImpact) {
  const Finished run = run_bouncing("3");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("impact").size(), 1u);
  EXPECT_EQ(run.of_kind("contact_close").size(), 1u);
  EXPECT_EQ(run.of_kind("refine").size(), 1u);
}

class Place : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Place, AtTheBorderIsStruckWithTheEnergyKept) {
  const Finished run = run_text(struck(""), {{"bodies.ball.position", GetParam().second},
                                             {"bodies.plate.edges", R"({"u0": "clamped"})"},
                                             {"integrator.step", "1e-4"},
                                             {"simulate.until", "0.02"}});
  expect_energy(run, 1e-3);
  EXPECT_GE(run.of_kind("contact_close").size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Of, Place,
                         testing::Values(std::pair{"edge", "[0.5, 0, 0.1102]"},
                                         std::pair{"held_edge", "[0, 0.5, 0.1102]"},
                                         std::pair{"corner", "[1, 1, 0.1102]"},
                                         std::pair{"held_corner", "[0, 1, 0.1102]"},
                                         std::pair{"beyond_the_edge", "[0.5, 1.03, 0.1102]"},
                                         std::pair{"beyond_the_corner", "[1.02, 1.02, 0.1102]"}),
                         [](const auto& place) { return std::string(place.param.first); });

TEST(Ball, BesideThePlateDoesNotTouchIt) {
  const Finished run =
      run_text(struck(""), {{"bodies.ball.position", "[0.5, 1.12, 0.1102]"}, {"simulate.until", "0.3"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.events.empty());
}

// In a step of 1 ms one and a half thicknesses of the plate and more; at 300 m/s from one side of it to the other.
class Fast : public testing::TestWithParam<const char*> {};

TEST_P(Fast, ABallIsNotOverlooked) {
  const double speed = std::stod(GetParam());
  const Finished run = run_text(struck(""), {{"bodies.ball.velocity", fmt::format("[0, 0, {}]", -speed)},
                                             {"bodies.ball.mass", "1e-4"},
                                             {"bodies.ball.position", "[0.5, 0.5, 0.4]"},
                                             {"simulate.until", "0.01"}});
  const auto closed = run.of_kind("contact_close");
  ASSERT_EQ(closed.size(), 1u) << run.report.reason;
  EXPECT_NEAR(closed[0].t, (0.4 - 0.11) / speed, 1e-6);
  if (!run.done()) return expect_clear_failure(run);
  expect_finite(run);
}

INSTANTIATE_TEST_SUITE_P(MetresPerSecond, Fast, testing::Values("30", "100", "200", "300", "1000"),
                         [](const auto& speed) { return std::string("n") + speed.param; });

TEST(Ball, RestingAtTheStartSinksInWithThePlate) {
  const Finished run = run_text(struck(""), {{"bodies.ball.position", "[0.5, 0.5, 0.11]"},
                                             {"bodies.ball.velocity", "[0, 0, 0]"},
                                             {"integrator.step", "5e-4"}});
  expect_energy(run, 1e-3);
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events[0].kind, "contact_close");
  EXPECT_EQ(run.events[0].t, 0);
  EXPECT_LT(run.end("z"), 0.11);
}

TEST(Ball, PressedInAtTheStartIsThrownOff) {
  const Finished run =
      run_text(struck(""), {{"bodies.ball.position", "[0.5, 0.5, 0.108]"}, {"bodies.ball.velocity", "[0, 0, 0]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GT(run.series.at("force").front(), 0);
}

class PenaltyStiffness : public testing::TestWithParam<const char*> {};

TEST_P(PenaltyStiffness, GivesAResultOrSaysWhyNot) {
  for (const char* step : {"1e-3", "1e-4"}) {
    const Finished run = run_text(
        struck(""), {{"contacts.ball.stiffness", GetParam()}, {"integrator.step", step}, {"simulate.until", "0.02"}});
    if (!run.done()) {
      expect_clear_failure(run);
      continue;
    }
    expect_finite(run);
    const double drift = std::abs(run.result["energy_drift"].get<double>());
    EXPECT_TRUE(drift < 0.05 * energy_of_ball || !run.result["warnings"].empty()) << step << ": " << drift;
  }
}

INSTANTIATE_TEST_SUITE_P(K, PenaltyStiffness, testing::Values("1e2", "1e4", "1e6", "1e8", "1e10", "1e12", "1e14"),
                         [](const auto& K) { return std::string(K.param); });

TEST(OneElement, IsStruckWithItsEnergyKept) {
  const Finished run = run_text(
      struck("", "1x1"),
      {{"integrator.step", "1e-4"}, {"bodies.plate.edges", R"({"u0": "clamped"})"}, {"simulate.until", "0.005"}});
  expect_energy(run, 1e-3);
  EXPECT_GE(run.of_kind("contact_close").size(), 1u);
}

// A shallow roof on two hinged edges, pressed in at its top: the load rises to 2.2 kN, falls and rises again.
const std::string roof = R"({
  "trammel": 1, "space": "spatial", "gravity": [0, 0, 0], "parameters": {"P": 4000},
  "bodies": {"roof": {"type": "tspline_plate", "geometry": {"shape": "cylinder", "axis": [0, -1, 0], "start": [1, 0, 0],
    "radius": 2.54, "length": 0.508, "from": "=pi/2-0.1", "to": "=pi/2+0.1"}, "mesh": {"elements": "6x6"},
    "thickness": 0.0127, "density": 1, "youngs_modulus": 3.10275e9, "poissons_ratio": 0.3, "quadrature": 4,
    "edges": {"u0": "hinged", "u1": "hinged"}}},
  "forces": {"top": {"type": "load", "on": "roof.centre", "force": {"x": 0, "y": 0, "z": "=-P*t"}}},
  "static": {"steps": 20, "arc_length": true},
  "record": {"observe": {"w": {"of": "roof.centre.z", "relative_to": "ground", "since_start": true},
                         "membrane": "roof.energy_membrane", "bending": "roof.energy_bending"}}})";

TEST(Buckling, StopsThereWithAHintUnlessArcLengthIsAllowed) {
  for (const char* steps : {"8", "20"}) {
    const Finished run = run_static(roof, {{"static.arc_length", "false"}, {"static.steps", steps}});
    EXPECT_FALSE(run.done()) << steps;
    EXPECT_THAT(run.report.reason, HasSubstr("arc_length")) << steps;
  }
}

TEST(Buckling, IsJumpedOverByAllOfTheLoadAtOnceToThePlaceAlongThePath) {
  const Finished at_once = run_static(roof, {{"static.arc_length", "false"}, {"static.steps", "1"}});
  ASSERT_TRUE(at_once.done()) << at_once.report.reason;
  EXPECT_NEAR(at_once.end("w"), run_static(roof).end("w"), 1e-6);
}

TEST(Buckling, IsFollowedPastTheLimitPointWithTheWorkOfTheLoadAsEnergy) {
  const Finished run = run_static(roof);
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto &t = run.series.at("t"), &w = run.series.at("w");
  double work = 0;
  bool fell = false;
  for (std::size_t i = 1; i < t.size(); ++i) {
    work -= 4000 * (t[i] + t[i - 1]) / 2 * (w[i] - w[i - 1]);
    fell = fell || t[i] < t[i - 1];
  }
  EXPECT_TRUE(fell) << "the load has a limit";
  EXPECT_NEAR(work / (run.end("membrane") + run.end("bending")), 1, 0.01);
  EXPECT_EQ(run.end("t"), 1);
}

TEST(Mechanism, OfAPlateThatItsEdgesDoNotHoldIsNamed) {
  const Finished run = run_static(square, {{"bodies.plate.edges", R"({"u0": "hinged"})"}});
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("bodies.plate is a mechanism"));
}

}  // namespace
}  // namespace trammel::test
