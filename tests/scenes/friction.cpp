// The classic scenes of dry friction, scenes/friction, against their closed forms (tests/data/free_standing.json,
// unit_cases).
#include <cmath>
#include <numbers>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;
using std::numbers::pi;

constexpr double g = 9.81;

const json& reference() {
  static const json data =
      json::parse(std::ifstream(TRAMMEL_SOURCE_DIR "/tests/data/free_standing.json"))["unit_cases"];
  return data;
}

double number(const json& text) {
  return std::stod(text.get<std::string>());
}

std::string text(double x) {
  return fmt::format("{:.17g}", x);
}

TEST(InclineScene, RestsOrSlidesAsItsAngleSays) {
  for (const json& row : reference()["incline"]["rows"]) {
    const bool equal = row["case"] == "mu0=mu=0.6";
    const Finished run =
        run_file("friction/incline.json", {{"parameters.phi", text(std::atan(0.6 * number(row["tan_phi_over_mu0"])))},
                                           {"parameters.mu", equal ? "0.6" : "0.48"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(-run.end("s"), number(row["distance_after_1s"]), 1e-9) << row.dump();
    EXPECT_NEAR(run.end("friction") / g, number(row["friction_over_mg"]), 1e-9) << row.dump();
  }
}

TEST(InclineScene, BlockLaunchedUphillStopsAndStaysOrSlidesBack) {
  const json& stays = reference()["incline"]["upward_launch_then_stay"];
  const Finished flat =
      run_file("friction/incline.json", {{"parameters.phi", text(20 * pi / 180)}, {"parameters.v0", "2"}});
  EXPECT_NEAR(flat.end("s"), number(stays["distance"]), 1e-9);
  EXPECT_EQ(flat.of_kind("stick").size(), 1u);
  const json& back = reference()["incline"]["upward_launch_then_slide_back"];
  const Finished steep =
      run_file("friction/incline.json", {{"parameters.phi", text(35 * pi / 180)},
                                         {"parameters.v0", "2"},
                                         {"simulate.until", back["time_back_to_start"].get<std::string>()}});
  EXPECT_NEAR(steep.end("s"), 0, 1e-9);
  EXPECT_NEAR(-steep.end("v"), number(back["speed_at_start"]), 1e-9);
  EXPECT_TRUE(steep.of_kind("stick").empty());
}

TEST(StoppingScene, GoesItsDistanceAndThenStandsStill) {
  for (const json& row : reference()["stopping"]) {
    const double time = number(row["time"]);
    const Finished run = run_file("friction/stopping.json", {{"parameters.v0", row["v0"].get<std::string>()},
                                                             {"parameters.mu0", row["mu"].get<std::string>()},
                                                             {"parameters.mu", row["mu"].get<std::string>()},
                                                             {"simulate.until", text(2 * time)},
                                                             {"record.every", text(time / 100)}});
    EXPECT_NEAR(run.end("s"), number(row["distance"]), 1e-9 * number(row["distance"]));
    EXPECT_NEAR(run.end("v"), 0, 1e-15);
    ASSERT_EQ(run.of_kind("stick").size(), 1u);
    EXPECT_NEAR(run.of_kind("stick")[0].t, time, 1e-9 * time);
  }
}

TEST(ShakenTableScene, MovesTheBlockInItsThreeRegimes) {
  for (const json& row : reference()["shaken_table"]["rows"]) {
    const Finished run =
        run_file("friction/shaken_table.json", {{"parameters.ratio", row["a_over_g"].get<std::string>()},
                                                {"parameters.X", row["X"].get<std::string>()},
                                                {"parameters.mu0", row["mu0"].get<std::string>()},
                                                {"parameters.mu", row["mu"].get<std::string>()}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    for (const int period : {1, 2, 3, 4})  // 2 s each
      EXPECT_NEAR(run.series.at("u")[std::size_t(20 * period)], number(row["rel_at_periods"][std::size_t(period - 1)]),
                  2e-9)
          << row["label"] << " after " << period;
  }
}

TEST(PainlevesRodScene, IsPressedByItsUniqueForce) {
  const Finished run = run_file("friction/painleve_rod.json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.series.at("force")[0], 245.25, 1e-8);
}

TEST(RockingBlockScene, KeepsHousnersShareOfItsRate) {
  const Finished run = run_file("friction/rocking_block.json");
  const json& row = reference()["rocking_block"][0]["free_rocking"][1];
  ASSERT_FALSE(run.of_kind("impact").empty());
  EXPECT_NEAR(run.of_kind("impact")[0].t, number(row["quarter_period_nonlinear"]), 1e-9);
  ASSERT_FALSE(run.of_kind("contact_open").empty());
  EXPECT_NEAR(run.of_kind("contact_open")[0].detail.at("separation") / 0.5, number(row["omega_after_first_impact"]),
              1e-9);
}

TEST(DiskScene, RollsFromTheMomentItsLowestPointRests) {
  const auto rolls = [](double v0, double omega0) {
    const Finished run =
        run_file("friction/disk.json", {{"parameters.v0", text(v0)}, {"parameters.omega0", text(omega0)}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    ASSERT_EQ(run.of_kind("stick").size(), 1u);
    EXPECT_NEAR(run.of_kind("stick")[0].t, std::abs(v0 + 0.2 * omega0) / (3 * 0.25 * g), 1e-10);
    EXPECT_NEAR(run.end("v"), (2 * v0 - 0.2 * omega0) / 3, 1e-9);
    EXPECT_NEAR(run.end("v") + 0.2 * run.end("omega"), 0, 1e-9);
    EXPECT_NEAR(run.result["energy_drift"].get<double>(), 0, 1e-9);
  };
  rolls(3, 0);
  rolls(1, 15);  // comes back: it spins backwards
}

TEST(DiskScene, RollsDownAnInclineWithTwoThirdsOfTheSlope) {
  const Finished run = run_file("friction/disk.json", {{"parameters.phi", "0.5"}, {"parameters.v0", "0"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("v"), -2.0 / 3 * g * std::sin(0.5), 1e-9);
  EXPECT_NEAR(run.end("s"), -1.0 / 3 * g * std::sin(0.5), 1e-9);
}

TEST(DiskScene, RollsOnATableThatShakesUnderIt) {
  // Rolling, m x'' = F and J omega' = F R with x' + R omega = X': x'' = X''/3, so a third of the table's way.
  const Finished run =
      run_file("friction/disk.json",
               {{"parameters.v0", "0"}, {"bodies.floor.x", "=0.1*(1 - cos(3*t))"}, {"record.observe.x", "disk.com.x"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("x"), 0.1 * (1 - std::cos(3.0)) / 3, 1e-9);
}

TEST(BilliardBallScene, BendsItsPathAndRolls) {
  const Finished run = run_file("friction/billiard_ball.json");
  ASSERT_EQ(run.of_kind("stick").size(), 1u) << run.report.reason;
  EXPECT_NEAR(run.of_kind("stick")[0].t, 2 * std::hypot(2, 2) / (7 * 0.2 * g), 1e-9);
  EXPECT_NEAR(run.end("vx"), 1 + 4 / 7., 1e-9);
  EXPECT_NEAR(run.end("vy"), -4 / 7., 1e-9);
}

TEST(AcrossInclineScene, StopsWhereItsFormulaSays) {
  const Finished run = run_file("friction/across_incline.json");
  ASSERT_EQ(run.of_kind("stick").size(), 1u) << run.report.reason;
  EXPECT_NEAR(run.of_kind("stick")[0].t, 4 / (3 * g * std::sin(10 * pi / 180)), 1e-9);
}

TEST(CurlingTableScene, EndsOnOneFoot) {
  const Finished run = run_file("friction/curling_table.json");
  const auto stops = run.of_kind("stick");
  ASSERT_EQ(stops.size(), 3u) << run.report.reason;
  EXPECT_EQ(stops[0].contact, "contacts.foot1");
  EXPECT_NEAR(stops[0].t, 0.495950, 1e-6);  // as its comment says
  EXPECT_NEAR(stops[1].t, 0.506102, 1e-6);
  EXPECT_NEAR(run.end("x"), 0.2947990, 1e-7);
  EXPECT_NEAR(run.end("y"), 0.0752361, 1e-7);
}

TEST(StickingDrawerScene, OpensBelowItsOverhangAndJamsBeyond) {
  const Finished opens = run_file("friction/sticking_drawer.json");
  ASSERT_TRUE(opens.done()) << opens.report.reason;
  EXPECT_NEAR(opens.end("x"), 0.025, 1e-9);
  const Finished jams = run_file("friction/sticking_drawer.json", {{"parameters.a", "=1.01*L/(2*mu)"}});
  EXPECT_NEAR(jams.end("x"), 0, 1e-12);
  EXPECT_EQ(jams.end("sticks"), 1);
}

TEST(JournalBearingScene, ComesToRestWithItsWeightInTheFrictionCircle) {
  const Finished run = run_file("friction/journal_bearing.json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.end("sticks"), 1);
  EXPECT_LE(0.5 * std::abs(std::sin(run.end("angle"))), 0.4 * 0.05);
  EXPECT_NEAR(run.end("load"), g, 1e-9);
}

}  // namespace
}  // namespace trammel::test
