// The program's commands, its exit codes and what it prints where.
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kPendulum = (cli::scenes / "pendulum.json").string();

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

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
      {{"validate", kPendulum, "--set", "simulate.until=0.1"},
       "next: trammel run " + kPendulum + " --set simulate.until=0.1"},
      {{"explain", kPendulum}, "next: trammel run " + kPendulum},
      {{"list"}, "next: trammel describe NAME"},
      {{"describe", "newmark"}, "next: trammel trade SCENE"},
      {{"describe", "revolute"}, "next: trammel validate SCENE"},
      {{"run", kPendulum, "--set", "simulate.until=0.1", "--out", "a"}, "next: trammel report a"},
      {{"compare", "a", "a"}, "next: trammel report a a"},
      {{"report", "a"}, "next: xdg-open a/report.html"},
      {{"modes", kPendulum, "--out", "m"}, "next: trammel report m"},
      {{"static", kPendulum, "--out", "s"}, "next: trammel report s"},
      {{"stability", "newmark"}, "next: trammel check newmark"},
  };
  for (const auto& [words, next] : commands) {
    const auto result = trammel(words, {.folder = folder.path()});
    ASSERT_FALSE(lines(result.out).empty()) << words.front() << result.err;
    EXPECT_EQ(lines(result.out).back(), next);
  }
}

// Libraries are looked for by the names of components.
TEST(Commands, AnswerAComponentWhoseNameIsTooLongForAFile) {
  const std::string name(1000, 'x');
  const auto described = trammel({"describe", name});
  EXPECT_EQ(described.exit_code, 2) << described.err;
  EXPECT_THAT(described.err, HasSubstr("no component \"xxx"));
  const auto validated = trammel({"validate", kPendulum, "--set", "integrator.type=" + name});
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
  const auto scene = trammel({"study", kPendulum});
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
    const auto result = trammel({"trade", kPendulum, "--jobs", jobs});
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

TEST(Static, LetsAPendulumHangAndWritesIt) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"static", kPendulum, "--json"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json written = json::parse(cli::read_file(folder.path() / "out/pendulum_static/result.json"));
  EXPECT_EQ(json::parse(result.out), written);
  EXPECT_EQ(written["analysis"], "static");
  EXPECT_EQ(written["load_steps"].size(), 11u);
  const std::string last = lines(cli::read_file(folder.path() / "out/pendulum_static/series.csv")).back();
  ASSERT_THAT(last, StartsWith("0.5,-"));
  EXPECT_NEAR(std::stod(last.substr(4)), -1, 1e-12) << "bottom_y";
}

TEST(Modes, WritesATableAndShapes) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"modes", kPendulum, "--json", "--count", "1"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json written = json::parse(cli::read_file(folder.path() / "out/pendulum_modes/modes.json"));
  EXPECT_EQ(json::parse(result.out), written);
  EXPECT_EQ(written["analysis"], "modes");
  EXPECT_EQ(written["modes"].size(), 1u);
  EXPECT_THAT(lines(cli::read_file(folder.path() / "out/pendulum_modes/modes.csv")).front(),
              "mode,kind,frequency_hz,frequency_rad_s,damping_ratio,real,imaginary");
  EXPECT_THAT(cli::read_file(folder.path() / "out/pendulum_modes/shapes.csv"), StartsWith("mode,point,x,y,x_re,"));
}

TEST(Modes, OfACheckpointAreThoseOfItsTime) {
  const cli::TemporaryFolder folder;
  const cli::Setting there{.folder = folder.path()};
  ASSERT_EQ(trammel({"run", kPendulum, "--set", "simulate.until=0.3", "--quiet"}, there).exit_code, 0);
  const auto from = trammel({"modes", kPendulum, "--json", "--from", "out/pendulum"}, there);
  const auto at = trammel({"modes", kPendulum, "--json", "--at", "0.3"}, there);
  EXPECT_EQ(from.exit_code, 0) << from.err;
  EXPECT_EQ(at.exit_code, 0) << at.err;
  EXPECT_EQ(json::parse(from.out)["modes"], json::parse(at.out)["modes"]);
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
      {{"run", cli::bounce, kPendulum}, "'trammel run' takes one SCENE, found also"},
      {{"modes", kPendulum, "--count", "0"}, "--count 0: expected a whole number of modes from 1 to 100000"},
      {{"modes", kPendulum, "--count", "1.5"}, "--count 1.5: expected a whole number"},
      {{"modes", kPendulum, "--at", "later"}, "--at later: expected a time in s"},
      {{"modes", kPendulum, "--at", "nan"}, "--at nan: expected a time in s"},
      {{"modes", kPendulum, "--from", "nowhere"}, "there is no nowhere/checkpoint.cbor"},
      {{"modes", kPendulum, "--from", "a", "--at", "1"}, "--at and --from exclude each other"},
      {{"modes", kPendulum, "--stedy"}, "Did you mean \"--steady\"?"},
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
    EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

TEST(List, NamesTheComponentsOfEveryKind) {
  const auto result = trammel({"list"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* name : {"hht_alpha", "runge_kutta_4", "assumed_mode_beam", "rigid_body", "revolute", "spring_damper",
                           "constraint_method", "continuous_force"})
    EXPECT_THAT(result.out, HasSubstr(name));
  EXPECT_EQ(result.err, "");
}

TEST(List, GivesJsonWithTheLibraryOfEachComponent) {
  const json all = json::parse(trammel({"list", "--json"}).out);
  EXPECT_EQ(all["status"], "done");
  bool found = false;
  for (const json& component : all["components"]) {
    found = found || component["name"] == "hht_alpha";
    EXPECT_TRUE(fs::exists(component["file"].get<std::string>())) << component;
  }
  EXPECT_TRUE(found);
}

TEST(Describe, ShowsParametersWithRangeAndDefault) {
  const auto result = trammel({"describe", "constraint_method"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("restitution"));
  EXPECT_THAT(result.out, HasSubstr("0 to 1"));
  EXPECT_THAT(result.out, HasSubstr("capture_speed"));
  EXPECT_THAT(result.out, HasSubstr("m/s"));
}

TEST(Describe, KnowsThePartsOfASceneThatTheProgramReads) {
  for (const auto& [part, keys] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"step", {"tolerance", "relative", "absolute", "initial", "min", "max"}},
           {"simulate",
            {"start", "until", "contact_hold", "chatter_steps", "event_limit", "default 1000000", "Chatter:"}},
           {"integrator", {"step", "contact_step", "'trammel describe step'"}},
           {"initial", {"check", "project", "equilibrium"}},
           {"record", {"every", "fields", "observe"}},
           {"static", {"steps", "tolerance", "iterations", "arc_length"}}}) {
    const auto result = trammel({"describe", part});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const std::string& key : keys) EXPECT_THAT(result.out, HasSubstr(key)) << part;
  }
}

TEST(Describe, SaysThatErrorControlledAdamsIsMostlyItsStart) {
  EXPECT_THAT(trammel({"describe", "adams_baumgarte"}).out, HasSubstr("runge_kutta_4"));
}

TEST(Schema, DescribesWhatTheProgramReads) {
  const json schema = json::parse(trammel({"schema"}).out);
  const json simulate = schema["properties"]["simulate"]["properties"];
  for (const char* key : {"until", "contact_hold", "chatter_steps", "event_limit"})
    EXPECT_NE(simulate[key].value("description", ""), "") << key;
  EXPECT_EQ(simulate["chatter_steps"]["default"], 3);
}

TEST(Schema, RequiresWhatASceneOfItsOwnMustHave) {
  const json schema = json::parse(trammel({"schema"}).out);
  EXPECT_EQ(schema["if"]["required"], json({"include"}));  // what is included may hold it
  EXPECT_EQ(schema["else"]["anyOf"][0]["required"], json({"simulate"}));
  EXPECT_EQ(schema["else"]["properties"]["simulate"]["required"], json({"until"}));
  bool beam = false;
  for (const json& one : schema["else"]["properties"]["bodies"]["additionalProperties"]["allOf"])
    if (one["if"]["properties"]["type"]["const"] == "assumed_mode_beam") {
      beam = true;
      EXPECT_THAT(one["then"]["required"].dump(), HasSubstr("length"));
    }
  EXPECT_TRUE(beam);
}

TEST(Schema, IsAJsonSchemaThatKnowsTheComponents) {
  const auto result = trammel({"schema"});
  EXPECT_EQ(result.exit_code, 0);
  const json schema = json::parse(result.out);
  EXPECT_THAT(schema["$schema"].get<std::string>(), HasSubstr("json-schema.org"));
  EXPECT_TRUE(schema["$defs"].contains("body.assumed_mode_beam"));
}

TEST(Validate, AcceptsEveryCommittedScene) {
  int scenes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(TRAMMEL_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".json" && entry.path().parent_path().filename() != "studies") {
      ++scenes;
      const auto result = trammel({"validate", entry.path().string()});
      EXPECT_EQ(result.exit_code, 0) << result.err;
    }
  EXPECT_GT(scenes, 0);
}

TEST(Validate, WarnsOfAParameterThatIsSetInVain) {
  const auto result =
      trammel({"validate", cli::bounce, "--set", "contacts.floor.restitution=0.5", "--set", "parameters.e=0.3"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "warning: --set parameters.e=0.3: parameters.e: has no effect: nothing in this scene uses it\n");
}

TEST(Explain, NamesTheIntegratorAndTheBodies) {
  const auto result = trammel({"explain", kPendulum});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* text : {"hht_alpha", "rigid_body", "revolute"}) EXPECT_THAT(result.out, HasSubstr(text));
}

TEST(Explain, NamesTheIntegratorThatASceneWithoutOneGets) {
  const auto result = trammel({"explain", TRAMMEL_SOURCE_DIR "/tests/cli/scenes/no_integrator.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("integrator dop853: step error-controlled, relative 1e-09"));
}
TEST(Explain, ShowsTheWarningsOfASceneToo) {
  EXPECT_THAT(trammel({"explain", cli::bounce}).out, Not(HasSubstr("Warnings")));
  const auto vain =
      trammel({"explain", cli::bounce, "--set", "contacts.floor.restitution=0.5", "--set", "parameters.e=0.3"});
  EXPECT_THAT(vain.out, HasSubstr("Warnings\n  --set parameters.e=0.3"));
}

TEST(Run, SumsUpWhatFrictionTook) {
  const cli::TemporaryFolder folder;
  const fs::path scene = fs::path(TRAMMEL_SOURCE_DIR) / "scenes/friction/stopping.json";
  const auto result = trammel({"run", scene.string()}, {.folder = folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("lost to friction of sole 0.5 J"));
}

TEST(Run, CountsTouchesOfACompliantContact) {
  const cli::TemporaryFolder folder;
  const auto result = trammel(
      {"run", cli::bounce, "--set",
       R"(contacts.floor={"type": "continuous_force", "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}], "stiffness": 1e5, "exponent": 1.5, "restitution": 1})"},
      {.folder = folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 touch, 2 events in all"));  // it falls for 0.45 s, rises for as long
  EXPECT_THAT(result.out, Not(HasSubstr("impacts")));
}

TEST(Run, WritesIntoOutAndTheScenesNameByDefault) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce}, {.folder = folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("out/bounce"));
  for (const char* file : {"series.csv", "events.csv", "result.json", "scene.resolved.json", "checkpoint.cbor"})
    EXPECT_TRUE(fs::exists(folder.path() / "out/bounce" / file)) << file;
}

TEST(Run, HasTheColumnsOfTheContract) {
  const cli::TemporaryFolder folder;
  ASSERT_EQ(trammel({"run", cli::bounce, "--out", "r"}, {.folder = folder.path()}).exit_code, 0);
  EXPECT_EQ(lines(cli::read_file(folder.path() / "r/series.csv")).front(),
            "t,height,energy_kinetic,energy_potential,energy_elastic,energy_total,energy_supplied,"
            "energy_dissipated,constraint_position,constraint_velocity,constraint_acceleration,steps");
  EXPECT_EQ(lines(cli::read_file(folder.path() / "r/events.csv")).front(),
            "t,kind,component,impulse,approach,separation,energy_lost,friction,direction");
}

// Rows that are redundant for an instant: what moved, steps and events are in the reason, the remedy beside it.
TEST(Run, OfAFailureSaysWhatMovedAndARemedyThatWorks) {
  const cli::TemporaryFolder folder;
  const std::string scene = (folder.path() / "storm.json").string(), out = (folder.path() / "out").string();
  cli::write_file(scene, R"({"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {"ball": {"type": "point_mass", "mass": 0.1, "position": [0, 1e-6], "velocity": [0.5, 0]}},
  "contacts": {"floor": {"type": "constraint_method", "restitution": 0.999,
                         "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
  "integrator": {"type": "dop853", "step": {"tolerance": 1e-9}}, "simulate": {"until": 0.7, "event_limit": 2},
  "record": {"every": 0.01}})");
  const auto result = trammel({"run", scene, "--out", out, "--json"});
  EXPECT_EQ(result.exit_code, 1);
  const json report = json::parse(result.out);
  EXPECT_EQ(report, json::parse(cli::read_file(folder.path() / "out/result.json")));
  for (const std::string& text : {result.err, report["reason"].get<std::string>()}) {
    EXPECT_THAT(text, HasSubstr("; the steps before took "));
    EXPECT_THAT(text, HasSubstr("; the last event is impact of contacts.floor at t = "));
  }
  EXPECT_THAT(result.err, HasSubstr("Tried from t = "));
  ASSERT_TRUE(report["remedy"]["found"]);
  std::vector<std::string> again = {"run", scene, "--out", out, "--json"};
  for (const auto& [path, value] : report["remedy"]["set"].items()) {
    EXPECT_THAT(result.err, HasSubstr("--set " + path + "=" + value.get<std::string>()));
    again.insert(again.end(), {"--set", path + "=" + value.get<std::string>()});
  }
  EXPECT_GE(json::parse(trammel(again).out)["t_end"], report["remedy"]["passes"]);
}

TEST(Run, DrawsNoProgressBarIntoAFile) {
  const cli::TemporaryFolder folder;
  EXPECT_EQ(trammel({"run", cli::bounce}, {.folder = folder.path()}).err, "");
}

TEST(Run, DrawsAProgressBarOnATerminalAndRemovesIt) {
  const cli::TemporaryFolder folder;
  const std::string scene = (cli::scenes / "long_bounce.json").string();
  // A million steps: more than a minute under sanitizers on a busy machine.
  const auto result = trammel({"run", scene}, {.folder = folder.path(), .terminal = true, .time_limit = 600});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, testing::ContainsRegex(
                              "\\[#*\\.*\\] +[0-9]+ %  t = .* s, [0-9]+ steps( of [-0-9.e]+ s)?, [0-9]+ impacts"));
  EXPECT_THAT(result.err, testing::EndsWith("\r\033[K"));
}

TEST(Run, DrawsNoProgressBarWithJsonOrWhenQuiet) {
  const cli::TemporaryFolder folder;
  for (const char* option : {"--json", "--quiet"})
    EXPECT_EQ(trammel({"run", cli::bounce, option}, {.folder = folder.path(), .terminal = true}).err, "");
}

TEST(Run, IsSilentWhenQuiet) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce, "--quiet"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST(Run, OverwritesAnEarlierResultWithNothingLeftBehind) {
  const cli::TemporaryFolder folder;
  ASSERT_EQ(trammel({"run", cli::bounce, "--out", "twice"}, {.folder = folder.path()}).exit_code, 0);
  for (const char* out : {"twice", "once"})
    ASSERT_EQ(
        trammel({"run", cli::bounce, "--out", out, "--set", "simulate.until=0.3"}, {.folder = folder.path()}).exit_code,
        0);
  // The other files contain CPU time.
  for (const char* file : {"series.csv", "events.csv", "animation.ndjson"})
    EXPECT_EQ(cli::read_file(folder.path() / "twice" / file), cli::read_file(folder.path() / "once" / file)) << file;
  const auto count = [&](const char* out) {
    return std::distance(fs::directory_iterator(folder.path() / out), fs::directory_iterator());
  };
  EXPECT_EQ(count("twice"), count("once"));
}

TEST(Set, ChangesAValueByItsPath) {
  const cli::TemporaryFolder folder;
  ASSERT_EQ(
      trammel({"run", cli::bounce, "--out", "r", "--set", "bodies.ball.position=[0, 5]", "--set=simulate.until=0"},
              {.folder = folder.path()})
          .exit_code,
      0);
  EXPECT_THAT(lines(cli::read_file(folder.path() / "r/series.csv")).at(1), StartsWith("0,5,"));
}

TEST(Json, OfARunIsOneObjectAndNothingElse) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce, "--json"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0);
  const json object = json::parse(result.out);  // throws on anything after the object
  EXPECT_TRUE(object.is_object());
  EXPECT_EQ(object, json::parse(cli::read_file(folder.path() / "out/bounce/result.json")));
  EXPECT_EQ(object["status"], "done");
  EXPECT_EQ(result.err, "");
}

TEST(Json, OfBadInputHoldsEveryProblemWithItsPlace) {
  const auto result =
      trammel({"validate", "several_problems.json", "--json"}, {.folder = cli::scenes.parent_path() / "cases"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "");
  const json object = json::parse(result.out);
  EXPECT_EQ(object["status"], "error");
  EXPECT_EQ(object["problems"].size(), 4u);
  for (const json& problem : object["problems"]) {
    EXPECT_EQ(problem["file"], "several_problems.json");
    EXPECT_GT(problem["line"], 1);
    EXPECT_GT(problem["column"], 1);
    EXPECT_NE(problem["path"], "");
    EXPECT_NE(problem["message"], "");
  }
}

TEST(Json, OfAMistakeOnTheCommandLineIsAnObjectToo) {
  const auto result = trammel({"run", cli::bounce, "--json", "--ot", "x"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(json::parse(result.out)["status"], "error");
  EXPECT_EQ(result.err, "");
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

}  // namespace
