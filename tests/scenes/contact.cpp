// The scenes of scenes/contact against what statics says of them, and at sizes that try the search for events and
// forces.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// On a slow machine a run may warn how much CPU time it leaves to go, which is no matter of its result.
void expect_trusted(const Finished& run) {
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (const auto& warning : run.result["warnings"])
    EXPECT_NE(warning.get<std::string>().find("of CPU time to go"), std::string::npos) << warning;
}

TEST(PileScene, ComesToRestAndIsCarried) {
  const Finished run = run_file("contact/pile.json", {{"parameters.n", "20"}});
  expect_trusted(run);
  EXPECT_LT(run.end("energy_kinetic"), 1e-9);
  EXPECT_LT(run.events.size(), 20u * 500);
}

TEST(DominoRow, FallsOneByOneAndComesToRest) {
  constexpr int n = 20;
  const Finished run = run_file("contact/dominoes.json", {{"parameters.n", std::to_string(n)}});
  expect_trusted(run);
  EXPECT_NEAR(run.end("last"), -std::numbers::pi / 2, 1e-9);
  EXPECT_LT(run.end("first"), -1);
  EXPECT_LT(run.end("energy_kinetic"), 1e-12 * run.end("energy_potential"));
  std::vector<double> struck;
  for (int i = 2; i <= n; ++i) {
    const auto first = std::find_if(run.events.begin(), run.events.end(), [&](const Event& e) {
      return e.kind == "impact" && e.contact == fmt::format("contacts.hit_{}", i);
    });
    ASSERT_NE(first, run.events.end()) << i;
    struck.push_back(first->t);
  }
  // One after the other, soon at the same intervals (Stronge 1987: the speed of the wave settles within some five
  // dominoes).
  EXPECT_TRUE(std::is_sorted(struck.begin(), struck.end()));
  const double late = struck[18] - struck[17], before = struck[12] - struck[11];
  EXPECT_NEAR(late / before, 1, 0.02);
}

// Each domino moves the one behind it by some half as much: the first of 34 slip by 1e-9 of what the last one does. A
// slip as slow is a motion, which must not end with those of others.
TEST(DominoRow, KeepsTheSpeedOfItsWaveHoweverLongItIs) {
  const Finished run =
      run_file("contact/dominoes.json", {{"parameters.n", "34"}, {"simulate.until", "0.96"}, {"record.every", "0.05"}});
  expect_trusted(run);
  std::vector<double> struck;
  for (const Event& event : run.events)
    if (event.kind == "impact") struck.push_back(event.t);
  ASSERT_EQ(struck.size(), 33u);
  for (std::size_t i = 25; i < struck.size(); ++i)
    EXPECT_NEAR((struck[i] - struck[i - 1]) / (struck[24] - struck[23]), 1, 1e-3) << i;
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-6 * run.end("energy_potential"));
}

TEST(TowerScene, StandsInAnEarthquakeThatItsWidthCarries) {
  // 0.319 g against w/(5 h) = 0.4.
  const Finished run = run_file("contact/tower.json");
  expect_trusted(run);
  EXPECT_TRUE(run.of_kind("contact_open").empty());
  EXPECT_TRUE(run.of_kind("slip").empty());
  EXPECT_NEAR(run.end("left") + run.end("right"), 5 * 9.81, 1e-8);
}

TEST(TowerScene, RocksInStrongerOnesAndComesToRest) {
  for (const char* n : {"2", "5", "10"})
    for (const char* intensity : {"1.5", "3"}) {
      const Finished run = run_file("contact/tower.json", {{"parameters.n", n}, {"parameters.intensity", intensity}});
      ASSERT_TRUE(run.done()) << n << " x " << intensity << ": " << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
      // All its energy comes from the table: friction and impacts only dissipate.
      EXPECT_GE(run.result["energy_dissipated"]["friction_total"], 0) << n << " x " << intensity;
    }
}

TEST(TowerScene, OfTwentyKnocksWithoutCascades) {
  // From the third knock on, of 2e-4 m/s, contacts that carry 180 N slipped and parted for some 1e-7 s: 20 instants.
  const Finished run = run_file(
      "contact/tower.json", {{"parameters.n", "20"}, {"parameters.intensity", "1.5"}, {"simulate.until", "1.4242"}});
  expect_trusted(run);
  std::set<double> instants;
  for (const Event& event : run.events) instants.insert(event.t);
  EXPECT_LT(instants.size(), 15u);
}

TEST(CardHouse, StandsByTheFrictionOfItsFeet) {
  const double needed = 2.0 / 3 * std::tan(0.35);  // of scenes/contact/card_house.json
  const Finished stands =
      run_file("contact/card_house.json", {{"parameters.mu", fmt::format("{:.17g}", 1.001 * needed)}});
  expect_trusted(stands);
  EXPECT_NEAR(stands.end("head"), 0.09 * std::cos(0.35), 1e-14);
  EXPECT_NEAR(stands.end("foot"), 1.5 * 0.002 * 9.81, 1e-12);
  const Finished falls = run_file("contact/card_house.json", {{"parameters.mu", fmt::format("{:.17g}", 0.999 * needed)},
                                                              {"simulate.until", "0.2"}});
  expect_trusted(falls);
  EXPECT_LT(falls.end("head"), 0.09 * std::cos(0.35) - 1e-5);
}

TEST(ArchScene, StandsOrFallsByItsThickness) {
  const Finished stands = run_file("contact/arch.json");
  expect_trusted(stands);
  EXPECT_NEAR(stands.end("crown"), stands.series.at("crown")[0], 1e-12);
  const Finished falls = run_file("contact/arch.json", {{"parameters.thickness", "0.09"}});
  expect_trusted(falls);
  EXPECT_LT(falls.end("crown"), falls.series.at("crown")[0] - 1e-3);
}

TEST(ChannelScene, SlowsByFrictionOfTheFloorAlone) {
  for (const char* clearance : {"0", "1e-9"}) {
    const Finished run = run_file("contact/channel.json", {{"parameters.clearance", clearance}});
    expect_trusted(run);
    EXPECT_NEAR(run.end("v"), 0.4, 1e-9) << clearance;
    EXPECT_NEAR(run.end("ceiling"), 0, 1e-9) << clearance;
  }
}

}  // namespace
}  // namespace trammel::test
