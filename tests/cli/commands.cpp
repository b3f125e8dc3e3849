// The commands together: their help, their mistakes, the command that each names next.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Commands, HelpNamesEachOfThem) {
  const auto result = trammel({"help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* name : {"run", "static", "modes", "validate", "explain", "list", "describe", "schema", "seal"})
    EXPECT_THAT(result.out, HasSubstr("trammel " + std::string(name)));
  EXPECT_EQ(result.err, "");
}

TEST(Commands, NameTheNextInTheirLastLine) {
  const cli::TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> commands = {
      {{"validate", cli::pendulum, "--set", "simulate.until=0.1"},
       "next: trammel run " + cli::pendulum + " --set simulate.until=0.1"},
      {{"explain", cli::pendulum}, "next: trammel run " + cli::pendulum},
      {{"list"}, "next: trammel describe NAME"},
      {{"describe", "newmark"}, "next: trammel trade SCENE"},
      {{"describe", "revolute"}, "next: trammel validate SCENE"},
      {{"run", cli::pendulum, "--set", "simulate.until=0.1", "--out", "a"}, "next: trammel report a"},
      {{"compare", "a", "a"}, "next: trammel report a a"},
      {{"report", "a"}, "next: xdg-open a/report.html"},
      {{"modes", cli::pendulum, "--out", "m"}, "next: trammel report m"},
      {{"static", cli::pendulum, "--out", "s"}, "next: trammel report s"},
      {{"stability", "newmark"}, "next: trammel check newmark"},
  };
  for (const auto& [words, next] : commands) {
    const auto result = trammel(words, {.folder = folder.path()});
    ASSERT_FALSE(cli::lines(result.out).empty()) << words.front() << result.err;
    EXPECT_EQ(cli::lines(result.out).back(), next);
  }
}

// Libraries are looked for by the names of components.
TEST(Commands, AnswerAComponentWhoseNameIsTooLongForAFile) {
  const std::string name(1000, 'x');
  const auto described = trammel({"describe", name});
  EXPECT_EQ(described.exit_code, 2) << described.err;
  EXPECT_THAT(described.err, HasSubstr("no component \"xxx"));
  const auto validated = trammel({"validate", cli::pendulum, "--set", "integrator.type=" + name});
  EXPECT_EQ(validated.exit_code, 2) << validated.err;
  EXPECT_THAT(validated.err, HasSubstr("integrator.type: no integrator \"xxx"));
}

TEST(Commands, NameAFileOfAnotherKind) {
  const cli::TemporaryFolder folder;
  cli::write_file(folder.path() / "study.json", R"({"study": 1, "scene": "x.json", "vary": {"parameters.L": [1, 2]}})");
  cli::write_file(folder.path() / "result.json", R"({"trammel_result": 1, "plugins": [{"name": "x"}]})");
  for (const char* command : {"run", "validate", "explain", "static", "modes"}) {
    const auto of_study = trammel({command, "study.json"}, {.folder = folder.path()});
    EXPECT_EQ(of_study.exit_code, 2) << command;
    EXPECT_THAT(of_study.err, HasSubstr("study.json:1:11: study: this file is a study, and no scene")) << command;
    const auto of_result = trammel({command, "result.json"}, {.folder = folder.path()});
    EXPECT_EQ(of_result.exit_code, 2) << command;
    EXPECT_THAT(of_result.err, HasSubstr("this file is the result of a run, and no scene")) << command;
  }
  const auto scene = trammel({"study", cli::pendulum});
  EXPECT_EQ(scene.exit_code, 2);
  EXPECT_THAT(scene.err, HasSubstr("this file is a scene, and no study: trammel run takes it"));
}

TEST(Commands, AnswerAMethodThatThereIsNotAsBadInput) {
  const auto result = trammel({"stability", "hht"});
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("Did you mean \"hht_alpha\""));
}

TEST(Commands, DescribeNamesTheNearestPage) {
  EXPECT_THAT(trammel({"describe", "marker"}).err, HasSubstr("Did you mean \"markers\""));
  EXPECT_THAT(trammel({"describe", "tabel"}).err, HasSubstr("Did you mean \"table\""));
  EXPECT_THAT(trammel({"describe", "simulation"}).err, HasSubstr("Did you mean \"simulate\""));
  EXPECT_THAT(trammel({"describe", "lod"}).err, HasSubstr("Did you mean \"load\""));
}

TEST(Commands, TradeTakesAWholeNumberOfProcesses) {
  for (const char* jobs : {"0", "-1", "0.5", "2.5", "1e12", "two"}) {
    const auto result = trammel({"trade", cli::pendulum, "--jobs", jobs});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("--jobs " + std::string(jobs) + ": expected a whole number"));
  }
}

TEST(Commands, EachShowsItsOptions) {
  for (const char* name : {"run", "static", "modes", "validate", "explain", "list", "describe", "schema"}) {
    const auto result = trammel({name, "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, StartsWith("trammel " + std::string(name)));
    EXPECT_THAT(result.out, HasSubstr("--plugin LIB"));
  }
}

TEST(Commands, VersionIsPrinted) {
  const auto result = trammel({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, testing::MatchesRegex("trammel [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

// A mass on a spring: Runge-Kutta's limit is 2.83 sqrt(m/k).
TEST(Commands, StabilityTriesEveryCombinationOfTheValuesOver) {
  const cli::TemporaryFolder folder;
  const std::string scene = (folder.path() / "spring.json").string();
  cli::write_file(scene, R"({"trammel": 1, "space": "planar", "gravity": [0, 0], "parameters": {"m": 1, "k": 100},
  "bodies": {"mass": {"type": "point_mass", "mass": "=m", "position": [1.1, 0]}},
  "forces": {"spring": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": "=k", "length": 1}},
  "integrator": {"type": "runge_kutta_4", "step": 1e-3}, "simulate": {"until": 60}})");
  const std::vector<std::string> words = {"stability", "runge_kutta_4", "--scene", scene, "--json"};
  const auto with = [&](const std::string& first, const std::string& second) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--over", first, "--over", second});
    return trammel(all);
  };
  const auto result = with("parameters.m=1,4", "parameters.k=100,400");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json page = json::parse(result.out)["page"], rows = page["tables"][0]["rows"];
  EXPECT_EQ(page["figures"][0]["x"]["label"], "parameters.k");
  EXPECT_EQ(page["figures"][0]["curves"].size(), 4u);  // measured and theory, for each mass
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"1", "100"}, {"1", "400"}, {"4", "100"}, {"4", "400"}};
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& [m, k] = expected[i];
    EXPECT_EQ(rows[i][0], m);
    EXPECT_EQ(rows[i][1], k);
    // Growth at the limit is slow, and the search ends within a hundredth.
    EXPECT_NEAR(std::stod(rows[i][2].get<std::string>()) / (2.8284 * std::sqrt(std::stod(m) / std::stod(k))), 1, 0.03);
  }
  const auto twice = with("parameters.m=1", "parameters.m=4");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.out, HasSubstr("--over parameters.m is given twice"));
}

struct Mistake {
  std::vector<std::string> words;
  std::string message;
};

TEST(CommandLine, MistakesExitWith2AndNameTheNearest) {
  const std::vector<Mistake> mistakes = {
      {{"rnu", cli::bounce}, "Did you mean \"run\"?"},
      {{"run", cli::bounce, "--ot", "x"}, "Did you mean \"--out\"?"},
      {{"run", cli::bounce, "--jsno"}, "Did you mean \"--json\"?"},
      {{"run", cli::bounce, "--out"}, "--out needs a value: --out DIR"},
      {{"run", cli::bounce, "--quiet=yes"}, "--quiet takes no value, found '--quiet=yes'"},
      {{"run"}, "'trammel run' needs a SCENE"},
      {{"run", cli::bounce, cli::pendulum}, "'trammel run' takes one SCENE, found also"},
      {{"modes", cli::pendulum, "--count", "0"}, "--count 0: expected a whole number of modes from 1 to 100000"},
      {{"modes", cli::pendulum, "--count", "1.5"}, "--count 1.5: expected a whole number"},
      {{"modes", cli::pendulum, "--at", "later"}, "--at later: expected a time in s"},
      {{"modes", cli::pendulum, "--at", "nan"}, "--at nan: expected a time in s"},
      {{"modes", cli::pendulum, "--from", "nowhere"}, "there is no nowhere/checkpoint.cbor"},
      {{"modes", cli::pendulum, "--from", "a", "--at", "1"}, "--at and --from exclude each other"},
      {{"modes", cli::pendulum, "--stedy"}, "Did you mean \"--steady\"?"},
      {{"list", "integrators"}, "'trammel list' takes no argument, found 'integrators'"},
      {{"run", cli::bounce, "--out", "a", "--resume", "b"}, "--out and --resume exclude each other"},
      {{"run", cli::bounce, "--resume", "nowhere"}, "there is no nowhere/checkpoint.cbor to continue from"},
      {{"describe", "hht_alfa"}, "Did you mean \"hht_alpha\"?"},
      {{"describe", "hht"}, "Did you mean \"hht_alpha\"?"},
  };
  for (const Mistake& mistake : mistakes) {
    const auto result = trammel(mistake.words);
    EXPECT_EQ(result.exit_code, 2) << mistake.message;
    EXPECT_THAT(result.err, StartsWith("trammel: "));
    EXPECT_THAT(result.err, HasSubstr(mistake.message));
    EXPECT_EQ(cli::lines(result.err).size(), 1u) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

}  // namespace
