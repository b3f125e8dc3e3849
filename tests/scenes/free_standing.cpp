// The free-standing body on a moving base against tests/data/free_standing.json, by an independent code with 80-bit
// numbers.
//
// Tolerances are the event-driven ones of that file. Cases 2a and 3h are not in it; the digits here are those on which
// two methods and tolerances a hundred times apart agree (tools/reproduce free_standing shows them).
#include <algorithm>
#include <cmath>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

const json& reference() {
  static const json data = json::parse(std::ifstream(TRAMMEL_SOURCE_DIR "/tests/data/free_standing.json"));
  return data;
}

Finished free_standing(const std::string& name, const char* until) {
  return run_file("free_standing/" + name + ".json", {{"simulate.until", until}});
}

double number(const json& text) {
  return std::stod(text.get<std::string>());
}

double x_xd(const Finished& run, double t) {
  return run.series.at("x_xd").at(std::size_t(std::lround(t / 0.1)));
}

TEST(FreeStandingDrop, TouchesAndLiftsWhenTheClosedFormSays) {
  const Finished run = free_standing("drop", "1.2");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const std::vector<Event> touches = run.of_kind("contact_close"), lifts = run.of_kind("contact_open");
  ASSERT_EQ(touches.size(), 4u) << "two bounces of two feet";
  ASSERT_EQ(lifts.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(touches[i].t, number(reference()["drop"]["touch_times"][i / 2]), 1e-9);
    EXPECT_NEAR(lifts[i].t, number(reference()["drop"]["liftoff_times"][i / 2]), 1e-9);
    EXPECT_NEAR(touches[i].detail.at("approach"), number(reference()["drop"]["v_impact"]), 1e-9);
  }
}

TEST(FreeStandingDrop, ReturnsToItsHeightAndConservesItsEnergy) {
  const Finished run = free_standing("drop", "1.2");
  const double standing = run.series.at("y")[0] - 0.4;
  for (const auto& [t, height] : reference()["drop"]["height_of_feet_at_t (None = in contact)"].items()) {
    if (std::stod(t) > 1.15) break;
    EXPECT_NEAR(run.series.at("y")[std::size_t(std::lround(std::stod(t) / 0.1))] - standing, number(height), 1e-9) << t;
  }
  EXPECT_NEAR(run.result["energy_drift"].get<double>() / run.result["energy_start"].get<double>(), 0, 1e-10);
}

TEST(FreeStandingEquilibrium, IsTheReferencesOwn) {
  const Finished run = run_file("free_standing/1a.json", {{"simulate.until", "0"},
                                                          {"record.observe.left_angle", "left.angle"},
                                                          {"record.observe.right_angle", "right.angle"},
                                                          {"record.observe.vx", "main.com.vx"}});
  const json& start = reference()["cases"]["1a"]["initial_u_relative"];
  const json& data = reference()["cases"]["1a"]["parameters"];
  EXPECT_NEAR(run.end("y") - data["h0"].get<double>() - 2 * data["l0"].get<double>(), start["yp"], 1e-15 * 6);
  EXPECT_NEAR(run.end("theta"), start["th1"], 1e-15);
  EXPECT_NEAR(run.end("left_angle"), start["th2"], 1e-15);
  EXPECT_NEAR(run.end("right_angle"), start["th3"], 1e-15);
  EXPECT_NEAR(run.end("vx"), 0.8 * std::acos(-1), 1e-12) << "at rest relative to the base";
}

struct Expected {
  const char *name, *until;
  double tolerance;
};
void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.name;
}

class FreeStandingCase : public testing::TestWithParam<Expected> {};

TEST_P(FreeStandingCase, GoesWhereTheReferenceGoes) {
  const auto& [name, until, tolerance] = GetParam();
  const Finished run = free_standing(name, until);
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (const json& sample : reference()["cases"][name]["samples"]) {
    const double t = sample[0];
    if (t > std::stod(until)) break;
    EXPECT_NEAR(x_xd(run, t), sample[1].get<double>(), tolerance) << "t = " << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, FreeStandingCase,
                         testing::Values(Expected{"1a", "10", 1e-6}, Expected{"1s", "10", 1e-6},
                                         Expected{"2s", "3", 1e-8}, Expected{"3v", "10", 1e-5}),
                         [](const auto& expected) { return "Case" + std::string(expected.param.name); });

TEST(FreeStanding1a, FirstSlipsWhenTheReferenceSays) {
  const Finished run = free_standing("1a", "0.3");
  for (const auto& [foot, t] : {std::pair{"left_foot", 0.1684774860}, std::pair{"right_foot", 0.2522452773}}) {
    const std::vector<Event> slips = run.of_kind("slip");
    const auto first = std::find_if(slips.begin(), slips.end(),
                                    [&](const Event& e) { return e.contact == std::string("contacts.") + foot; });
    ASSERT_NE(first, slips.end());
    EXPECT_NEAR(first->t, t, 1e-6) << foot;
  }
}

TEST(FreeStanding1a, ByThePapersSchemeSlipsInTheStepInWhichTheReferenceDoes) {
  // A stuck foot lets go at the end of a step, so up to h late; the force before it has the order 4 of the method.
  const double h = 1e-5;
  const Finished run =
      run_file("free_standing/paper_scheme.json", {{"simulate.until", "0.3"}, {"parameters.h", "1e-5"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (const auto& [foot, t] : {std::pair{"left_foot", 0.1684774860}, std::pair{"right_foot", 0.2522452773}}) {
    const std::vector<Event> slips = run.of_kind("slip");
    const auto first = std::find_if(slips.begin(), slips.end(),
                                    [&](const Event& e) { return e.contact == std::string("contacts.") + foot; });
    ASSERT_NE(first, slips.end());
    EXPECT_NEAR(first->t, t, h) << foot;
  }
}

TEST(FreeStanding1a, DriftsByTheSameWayInEachPeriodOnceSettled) {
  const Finished run = free_standing("1a", "14");
  EXPECT_NEAR(x_xd(run, 12) - x_xd(run, 10), 0.0472290625, 1e-8);
  EXPECT_NEAR(x_xd(run, 14) - x_xd(run, 12), 0.0472290625, 1e-8);
}

TEST(FreeStanding1a, CountsWhatFrictionAndContactsDissipate) {
  const Finished run = free_standing("1a", "4");
  const auto& dissipated = run.result["energy_dissipated"];
  EXPECT_GT(dissipated["friction_total"].get<double>(), 1);
  EXPECT_GT(dissipated["contact_damping"].get<double>(), 1e-9);
  // What Simpson's rule in the steps of the method makes of some 10 J.
  EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-4);
}

// Not in the reference: digits on which dop853 and dormand_prince agree at errors a hundred times apart.
TEST(FreeStanding2a, MovesSidewaysByTheConvergedWay) {
  const Finished run = free_standing("2a", "3");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(x_xd(run, 1), -1.02279609e-4, 1e-11);
  EXPECT_NEAR(x_xd(run, 2), -8.0930845e-5, 1e-11);
  EXPECT_NEAR(x_xd(run, 3), -5.9582080e-5, 1e-11);
}

TEST(FreeStanding3h, GoesTheConvergedWay) {
  const Finished run = free_standing("3h", "10");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(x_xd(run, 2), -1.0338415463, 1e-8);
  EXPECT_NEAR(x_xd(run, 6), -0.5638418469, 1e-8);
  EXPECT_NEAR(x_xd(run, 10), -0.7244849671, 1e-8);
}

TEST(FreeStanding1s, NeverLiftsAFoot) {
  const Finished run = free_standing("1s", "10");
  EXPECT_TRUE(run.of_kind("contact_open").empty());
  for (const double t : {6.0, 8.0, 10.0}) EXPECT_NEAR(x_xd(run, t), 0.0493438689, 1e-8);
}

TEST(FreeStanding3v, ContactForcesAreTheReferences) {
  // Where the solution changes least: until its first flights. 0.1 % of the weight.
  const Finished run = free_standing("3v", "1");
  const double weight = 1.4 * 9.81;
  for (const json& sample : reference()["cases"]["3v"]["samples"]) {
    const double t = sample[0];
    if (t > 1) break;
    const auto row = std::size_t(std::lround(t / 0.1));
    EXPECT_NEAR(run.series.at("left_force")[row], sample[3].get<double>(), 1e-3 * weight) << t;
    EXPECT_NEAR(run.series.at("right_force")[row], sample[4].get<double>(), 1e-3 * weight) << t;
    EXPECT_NEAR(run.series.at("right_friction")[row], sample[6].get<double>(), 1e-3 * weight) << t;
  }
}

}  // namespace
}  // namespace trammel::test
