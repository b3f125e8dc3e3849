// trammel static and trammel modes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using cli::trammel;
using nlohmann::json;
using testing::StartsWith;

TEST(Static, LetsAPendulumHangAndWritesIt) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"static", cli::pendulum, "--json"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json written = json::parse(cli::read_file(folder.path() / "out/pendulum_static/result.json"));
  EXPECT_EQ(json::parse(result.out), written);
  EXPECT_EQ(written["analysis"], "static");
  EXPECT_EQ(written["load_steps"].size(), 11u);
  const std::string last = cli::lines(cli::read_file(folder.path() / "out/pendulum_static/series.csv")).back();
  ASSERT_THAT(last, StartsWith("0.5,-"));
  EXPECT_NEAR(std::stod(last.substr(4)), -1, 1e-12) << "bottom_y";
}

TEST(Modes, WritesATableAndShapes) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"modes", cli::pendulum, "--json", "--count", "1"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json written = json::parse(cli::read_file(folder.path() / "out/pendulum_modes/modes.json"));
  EXPECT_EQ(json::parse(result.out), written);
  EXPECT_EQ(written["analysis"], "modes");
  EXPECT_EQ(written["modes"].size(), 1u);
  EXPECT_THAT(cli::lines(cli::read_file(folder.path() / "out/pendulum_modes/modes.csv")).front(),
              "mode,kind,frequency_hz,frequency_rad_s,damping_ratio,real,imaginary");
  EXPECT_THAT(cli::read_file(folder.path() / "out/pendulum_modes/shapes.csv"), StartsWith("mode,point,x,y,x_re,"));
}

TEST(Modes, OfACheckpointAreThoseOfItsTime) {
  const cli::TemporaryFolder folder;
  const cli::Setting there{.folder = folder.path()};
  ASSERT_EQ(trammel({"run", cli::pendulum, "--set", "simulate.until=0.3", "--quiet"}, there).exit_code, 0);
  const auto from = trammel({"modes", cli::pendulum, "--json", "--from", "out/pendulum"}, there);
  const auto at = trammel({"modes", cli::pendulum, "--json", "--at", "0.3"}, there);
  EXPECT_EQ(from.exit_code, 0) << from.err;
  EXPECT_EQ(at.exit_code, 0) << at.err;
  EXPECT_EQ(json::parse(from.out)["modes"], json::parse(at.out)["modes"]);
}

}  // namespace
