// Plugins that misbehave: exit code 3, one line that names the library and the cause, results so far kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "plugin/library_section.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const fs::path kPlugins = fs::path(TRAMMEL_BUILD_DIR) / "tests/plugins";

class Plugin : public testing::Test {
 protected:
  // Runs the bouncing point with a library, and with what names its component in the scene.
  cli::Result run(const fs::path& library, const std::vector<std::string>& settings = {}) {
    std::vector<std::string> words = {"run", cli::bounce, "--plugin", library.string()};
    for (const std::string& setting : settings) {
      words.push_back("--set");
      words.push_back(setting);
    }
    return trammel(words, {.folder = folder.path()});
  }

  void expect_refused(const fs::path& library, const std::string& cause,
                      const std::vector<std::string>& settings = {}) {
    const auto result = run(library, settings);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, StartsWith("trammel: plugin "));
    EXPECT_THAT(result.err, HasSubstr(library.filename().string()));
    EXPECT_THAT(result.err, HasSubstr(cause));
  }

  // The bouncing point in a long flight, with an integrator that fails in step 1000.
  void expect_blamed_in_step_1000(const std::string& how, const std::string& cause) {
    expect_refused(kPlugins / "spoilt_step.so", cause, spoilt(how));
    const auto result = run(kPlugins / "spoilt_step.so", spoilt(how));
    EXPECT_THAT(result.err, HasSubstr("spoilt_step.so: integrator spoilt_step (integrator): step"));
    EXPECT_THAT(result.err, HasSubstr("at t = 0.999"));
    EXPECT_THAT(result.err, HasSubstr("step 1000: "));
    const std::string series = cli::read_file(folder.path() / "out/bounce/series.csv");
    EXPECT_EQ(std::count(series.begin(), series.end(), '\n'), 1 + 100);  // header; rows at 0, 0.01, ..., 0.99
  }
  std::string recorded_status() {
    return json::parse(cli::read_file(folder.path() / "out/bounce/result.json"))["status"];
  }
  static std::vector<std::string> spoilt(const std::string& how) {
    return {"integrator.type=spoilt_step", "integrator.how=" + how, "bodies.ball.position=[0,100]", "simulate.until=3"};
  }

  cli::TemporaryFolder folder;
};

TEST_F(Plugin, ThatIsSoundIsUsed) {
  const auto result = run(kPlugins / "good.so", {"integrator.type=good", "integrator.damping=0.1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  bool listed = false;
  const json found = json::parse(cli::read_file(folder.path() / "out/bounce/result.json"));
  for (const json& plugin : found["plugins"]) listed = listed || plugin.dump().find("good.so") != std::string::npos;
  EXPECT_TRUE(listed);
}

TEST_F(Plugin, ThatIsSoundIsFoundInThePluginPath) {
  const auto result =
      trammel({"run", cli::bounce, "--set", "integrator.type=good"},
              {.folder = folder.path(), .environment = {{"TRAMMEL_PLUGIN_PATH", (kPlugins / "good.so").string()}}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Plugin, ThatIsMissingIsNamed) {
  expect_refused("no_such_library.so", "no such file");
}

TEST_F(Plugin, ThatIsTruncatedIsRefusedBeforeItIsLoaded) {
  const fs::path copy = folder.path() / "half.so";
  fs::copy_file(kPlugins / "good.so", copy);
  fs::resize_file(copy, fs::file_size(copy) / 2);
  expect_refused(copy, "truncated");
}

TEST_F(Plugin, ThatIsATextFileIsRefused) {
  const fs::path file = folder.path() / "text.so";
  cli::write_file(file, "this is no library\n");
  expect_refused(file, "not a shared library");
}

TEST_F(Plugin, ThatIsAnotherLibraryIsRefused) {
  expect_refused(kPlugins / "not_a_plugin.so", "not a Trammel plugin");
}

TEST_F(Plugin, OfAnotherAbiIsRefusedWithBothValues) {
  expect_refused(kPlugins / "other_abi.so", "the plugin has 32, this program 64");
}

TEST_F(Plugin, ThatThrowsWhileItIsLoadedIsReported) {
  expect_refused(kPlugins / "throws_at_load.so", "no licence found");
}

TEST_F(Plugin, ThatCrashesWhileItIsLoadedDoesNotTakeTheProgramWithIt) {
  expect_refused(kPlugins / "crashes_at_load.so", "while it is loaded");
}

TEST_F(Plugin, ThatThrowsInItsConstructorIsReported) {
  expect_refused(kPlugins / "throws_in_constructor.so", "out of luck", {"corrections.position=throws_in_constructor"});
}

TEST_F(Plugin, ThatThrowsInStep1000KeepsTheResultsSoFar) {
  expect_blamed_in_step_1000("text", "one step too many");
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, ThatThrowsNoStdExceptionInStep1000IsNamedLikeOneThatThrowsOne) {
  expect_blamed_in_step_1000("number", "it threw something that is no std::exception");
  EXPECT_EQ(recorded_status(), "failed");
  expect_blamed_in_step_1000("text", "it threw: one step too many");
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, ThatReturnsAStateOfAnotherSizeEndsWithBothSizes) {
  expect_blamed_in_step_1000("size", "it returned q with 3 entries; expected 2");
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, WhoseStepIsNotFiniteHoweverShortIsNamed) {
  expect_blamed_in_step_1000("not_finite", "it returned q[0] = nan; expected finite numbers");
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, ThatEndsTheProgramInStep1000IsNoSuccessAndRecordsAreKept) {
  for (const char* how : {"exit", "quick_exit", "_exit"})
    expect_blamed_in_step_1000(how, "it ended the program (exit)");
}

// Commands that run no scene call plugins too: to see what an integrator costs, or where the bodies are.
TEST_F(Plugin, ThatFailsInAnotherCommandThanRunIsNamedThereToo) {
  const auto explain = [&](const std::string& how) {
    std::vector<std::string> words = {
        "explain", cli::bounce, "--plugin", (kPlugins / "spoilt_step.so").string(), "--set", "integrator.after=0"};
    for (const std::string& setting : spoilt(how)) words.insert(words.end(), {"--set", setting});
    return trammel(words, {.folder = folder.path()});
  };
  for (const auto& [how, cause] : {std::pair{"text", "it threw: one step too many"},
                                   {"number", "it threw something that is no std::exception"},
                                   {"size", "it returned q with 3 entries; expected 2"},
                                   {"exit", "it ended the program (exit)"}}) {
    const auto result = explain(how);
    EXPECT_EQ(result.exit_code, 3) << how << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr("spoilt_step.so: integrator spoilt_step (integrator): step"));
    EXPECT_THAT(result.err, HasSubstr(cause));
  }
}

TEST_F(Plugin, ThatEndsTheProgramInItsConstructorIsNamed) {
  const auto result =
      trammel({"describe", "ends_in_constructor", "--plugin", (kPlugins / "ends_in_constructor.so").string()});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.err,
              HasSubstr("ends_in_constructor.so: it ends the program with code 0 in the constructor of correction"));
}

// Numbers would be wrong from then on without a word.
TEST_F(Plugin, ThatChangesTheRoundingOfNumbersInStep1000IsNamed) {
  const auto result = run(kPlugins / "spoilt_step.so", spoilt("rounding"));
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("spoilt_step.so: integrator spoilt_step (integrator): step at t = "));
  EXPECT_THAT(result.err, HasSubstr("numbers are no longer rounded to nearest"));
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, ThatChangesTheRoundingWhileItIsLoadedChangesNoResult) {
  ASSERT_EQ(trammel({"run", cli::bounce, "--out", "plain"}, {.folder = folder.path()}).exit_code, 0);
  const auto result = run(kPlugins / "changes_arithmetic.so", {"corrections.position=changes_arithmetic"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(cli::read_file(folder.path() / "out/bounce/series.csv"),
            cli::read_file(folder.path() / "plain/series.csv"));
}

// Results go where they would go without it, and can be read.
TEST_F(Plugin, ThatChangesTheWorkingFolderWhileItIsLoadedMovesNoResult) {
  const auto result = run(kPlugins / "changes_process.so", {"corrections.position=changes_process"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(recorded_status(), "done");
  const auto access = fs::status(folder.path() / "out/bounce/series.csv").permissions();
  EXPECT_NE(access & fs::perms::owner_read, fs::perms::none);
}

TEST_F(Plugin, ThatPrintsLeavesTheOutputOfJsonAlone) {
  const std::string library = (kPlugins / "changes_process.so").string();
  for (const auto& words :
       {std::vector<std::string>{"run", cli::bounce, "--set", "corrections.position=changes_process"},
        {"validate", cli::bounce, "--set", "corrections.position=changes_process"},
        {"list"}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--json", "--plugin", library});
    const auto result = trammel(all, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out, nullptr, false).value("status", ""), "done") << result.out;
    EXPECT_THAT(result.err, HasSubstr("loaded"));
  }
}

// A library whose rehearsal succeeds may still end the process when it is loaded for the run: by a crash, or by an exit
// that skips the functions of atexit.
TEST_F(Plugin, ThatFailsTheSecondTimeItIsLoadedIsNamed) {
  for (const auto& [name, how] : {std::pair{"ends_the_second_time.so", "it ended the program (exit)"},
                                  {"crashes_the_second_time.so", "SIGSEGV"}}) {
    const auto result = trammel({"run", cli::bounce, "--plugin", (kPlugins / name).string()},
                                {.folder = folder.path(), .environment = {{"TRAMMEL_TEST_FILE", "mark"}}});
#if defined(__SANITIZE_ADDRESS__)
    if (result.err.find("AddressSanitizer") != std::string::npos) continue;  // reports crashes by itself
#endif
    EXPECT_THAT(result.err, HasSubstr(name));
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr("loading it: "));
    EXPECT_THAT(result.err, HasSubstr(how));
  }
}

#if !defined(__SANITIZE_ADDRESS__)
// A library that a folder brings along costs only its own components.
TEST_F(Plugin, ThatFailsTheSecondTimeItIsLoadedDoesNotStopItsFolder) {
  const fs::path libraries = folder.path() / "libraries";
  fs::create_directory(libraries);
  for (const char* name : {"ends_the_second_time.so", "crashes_the_second_time.so", "changes_process.so"})
    fs::copy_file(kPlugins / name, libraries / name);
  for (const bool as_json : {false, true}) {
    std::vector<std::string> words = {"list", "--plugin", libraries.string()};
    if (as_json) words.push_back("--json");
    const auto listed = trammel(words, {.folder = folder.path(), .environment = {{"TRAMMEL_TEST_FILE", "mark"}}});
    EXPECT_EQ(listed.exit_code, 0) << listed.err;
    EXPECT_THAT(listed.out, HasSubstr("changes_process"));
    EXPECT_THAT(listed.out, HasSubstr("rigid_body"));
    EXPECT_THAT(listed.out, Not(HasSubstr("fails_the_second_time")));
    EXPECT_TRUE(!as_json || json::accept(listed.out)) << listed.out;
    for (const char* name : {"ends_the_second_time.so", "crashes_the_second_time.so"})
      EXPECT_THAT(as_json ? listed.out + listed.err : listed.err, HasSubstr(name));
  }
}

// Eigen leaves a vector that could not grow with the address of a block that is free, and what destroys it crashes.
TEST_F(Plugin, ThatAsksForTooMuchMemoryEndsTheRunWithThatMessage) {
  const auto result = run(kPlugins / "spoilt_correction.so",
                          {R"(corrections={"position": {"type": "spoilt_correction", "how": "memory"}})"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("out of memory"));
  EXPECT_THAT(result.err, Not(HasSubstr("SIG")));
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, WhoseGlobalsCrashAtTheEndSpoilsNoResult) {
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{}, {"corrections.position=crashes_at_the_end"}}) {
    const auto result = run(kPlugins / "crashes_at_the_end.so", settings);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(recorded_status(), "done");
  }
}

TEST_F(Plugin, WhoseCorrectionFailsIsNamedAndNotTheIntegrator) {
  for (const auto& [how, cause] : {std::pair{"crash", "SIGSEGV"}, {"throw", "it threw: no way back"}}) {
    const auto result = run(kPlugins / "never_returns.so",
                            {R"(corrections.position={"type": "never_returns", "how": ")" + std::string(how) + "\"}"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err,
                HasSubstr("never_returns.so: correction never_returns (corrections.position): apply at t = "));
    EXPECT_THAT(result.err, HasSubstr("step 501: "));  // the impact split one step in two
    EXPECT_THAT(result.err, HasSubstr(cause));
    EXPECT_EQ(recorded_status(), "failed");
  }
}

// One of them ends there: both would write into the same files.
TEST_F(Plugin, WhoseCallReturnsInTwoProcessesRunsOnce) {
  const auto plain = trammel({"run", cli::bounce, "--out", "plain"}, {.folder = folder.path()});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  const auto result =
      run(kPlugins / "never_returns.so",
          {R"(corrections.position={"type": "never_returns", "how": "fork", "from": 0.99})", "simulate.until=1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string series = cli::read_file(folder.path() / "out/bounce/series.csv");
  EXPECT_EQ(cli::read_file(folder.path() / "plain/series.csv").substr(0, series.size()), series);
  EXPECT_EQ(recorded_status(), "done");
}

// Only plugins start threads, and nobody knows which one: not the call that is in progress.
TEST_F(Plugin, WhoseThreadCrashesIsNotTakenForTheIntegrator) {
  const auto result =
      run(kPlugins / "never_returns.so", {R"(corrections.position={"type": "never_returns", "how": "thread"})"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a thread that a plugin started ended the program at t = "));
  EXPECT_EQ(result.err.find("integrator"), result.err.npos) << result.err;
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, ThatThrowsWhereItIsArchivedIsNamed) {
  const auto result =
      run(kPlugins / "never_returns.so", {R"(corrections.position={"type": "never_returns", "how": "archive"})"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("correction never_returns (corrections.position): archive at t = "));
  EXPECT_THAT(result.err, HasSubstr("nothing to keep"));
}

TEST_F(Plugin, ThatEndsAProcessOfAStudyFailsItsCase) {
  cli::write_file(folder.path() / "of_two.json",
                  R"({"study": 1, "scene": ")" + cli::bounce +
                      R"(", "vary": {"corrections.position": [false, {"type": "never_returns", "how": "exit"}]}})");
  const auto result =
      trammel({"study", "of_two.json", "--out", "s", "--plugin", (kPlugins / "never_returns.so").string()},
              {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 of 2 cases are done, 1 failed"));
  EXPECT_THAT(result.out, HasSubstr("exit code 0, as if a plugin had called exit"));
}
#endif

// In a folder of libraries, sound ones and damaged ones, `list` and a run find what is sound.
TEST_F(Plugin, ThatIsDamagedDoesNotKeepOthersFromBeingListed) {
  const fs::path libraries = folder.path() / "libraries";
  fs::create_directory(libraries);
  fs::copy_file(kPlugins / "good.so", libraries / "m.so");
  const std::vector<std::string> bad = {
      "crashes_at_load",      "exits_at_load",       "throws_at_load", "crashes_while_declaring",
      "ends_while_declaring", "ends_in_constructor", "other_abi",      "leaves_a_process"};
  for (const std::string& name : bad) fs::copy_file(kPlugins / (name + ".so"), libraries / (name + ".so"));
  fs::copy_file(kPlugins / "same_name.so", libraries / "damaged.so");
  ASSERT_EQ(trammel({"seal", (libraries / "damaged.so").string()}).exit_code, 0);
  std::string bytes = cli::read_file(libraries / "damaged.so");
  bytes[*::trammel::plugin::library_section_offset(libraries / "damaged.so", ".text") + 100] ^= 1;
  cli::write_file(libraries / "damaged.so", bytes);
  const auto listed = trammel({"list", "--json", "--plugin", "libraries"}, {.folder = folder.path()});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const json found = json::parse(listed.out);
  EXPECT_EQ(found["unusable"].size(), bad.size() + 1);
  EXPECT_THAT(found["unusable"].dump(), HasSubstr("damaged: its code has the checksum"));
  EXPECT_THAT(found["components"].dump(), HasSubstr("good_contact"));
  EXPECT_EQ(run(libraries, {"integrator.type=good"}).exit_code, 0);
}

TEST_F(Plugin, ThatHangsWhileItIsTriedOutIsRefusedInTime) {
  expect_refused(kPlugins / "hangs_while_declaring.so", "it did not finish within 10000 ms while it declares");
}

TEST_F(Plugin, ThatReturnsNanIsNamedWithTheTime) {
  const std::string scene = R"({"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {"p": {"type": "spoilt_force"}}, "integrator": {"type": "runge_kutta_4", "step": 1e-3},
    "simulate": {"until": 1}})";
  cli::write_file(folder.path() / "nan.json", scene);
  const auto result =
      trammel({"run", "nan.json", "--plugin", (kPlugins / "spoilt_force.so").string()}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("body spoilt_force"));
  EXPECT_THAT(result.err, HasSubstr("force"));
  EXPECT_THAT(result.err, HasSubstr("t = 0.5"));
}

// Every call that throws, whichever component made it: a joint calls motion() of bodies, a contact its friction law.
TEST_F(Plugin, ThatThrowsIsNamedInEveryCallOfEveryInterface) {
  const std::string scene = R"({"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {"b": {"type": "throwing_body"}, "c": {"type": "throwing_body"}, "p": {"type": "point_mass", "mass": 1, "velocity": [1, -0.1]}},
    "joints": {"j": {"type": "throwing_joint", "between": ["ground", "b.point"]}},
    "forces": {"f": {"type": "throwing_force", "between": ["ground", "c.point"]}},
    "contacts": {"k": {"type": "throwing_contact", "friction": {"type": "throwing_friction"},
                       "between": ["p.point", {"plane": {"point": [0, -1e-6], "normal": [0, 1]}}]}},
    "integrator": {"type": "hht_alpha", "alpha": -0.1, "step": 1e-3}, "simulate": {"until": 0.01}})";
  cli::write_file(folder.path() / "throws.json", scene);
  struct Case {
    const char *path, *kind, *call, *when = "";
  };
  for (const Case& c : {Case{"bodies.b", "body throwing_body", "mass"},
                        {"bodies.b", "body throwing_body", "force"},
                        {"bodies.b", "body throwing_body", "energy"},
                        {"bodies.b", "body throwing_body", "power"},
                        {"bodies.b", "body throwing_body", "motion"},
                        {"bodies.c", "body throwing_body", "motion"},
                        {"bodies.b", "body throwing_body", "add_tangent"},
                        {"bodies.b", "body throwing_body", "add_reaction_derivative"},
                        {"joints.j", "joint throwing_joint", "rows"},
                        {"forces.f", "force throwing_force", "wrench"},
                        {"forces.f", "force throwing_force", "potential"},
                        {"forces.f", "force throwing_force", "power"},
                        {"contacts.k", "contact throwing_contact", "normal"},
                        {"contacts.k", "contact throwing_contact", "normal", " at rest"},
                        {"contacts.k", "contact throwing_contact", "potential"},
                        {"contacts.k", "contact throwing_contact", "slope"},
                        {"contacts.k.friction", "friction throwing_friction", "ratio"},
                        {"contacts.k.friction", "friction throwing_friction", "slope"}}) {
    const auto result = trammel({"run", "throws.json", "--plugin", (kPlugins / "throws_in.so").string(), "--set",
                                 std::string(c.path) + ".in=" + c.call + c.when},
                                {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 3) << c.path << ", " << c.call << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(std::string(c.kind) + " (" + c.path + "): " + c.call)) << result.err;
  }
}

// A sanitizer reports crashes by itself, so the program leaves them to it.
#if !defined(__SANITIZE_ADDRESS__)
TEST_F(Plugin, ThatCrashesInAnotherCommandThanRunIsNamedThereToo) {
  const std::string step = (kPlugins / "spoilt_step.so").string(), force = (kPlugins / "spoilt_force.so").string();
  const auto steps = trammel({"explain", cli::bounce, "--plugin", step, "--set", "integrator.type=spoilt_step", "--set",
                              "integrator.how=memory", "--set", "integrator.after=0"});
  EXPECT_EQ(steps.exit_code, 3) << steps.err;
  EXPECT_THAT(steps.err, HasSubstr("spoilt_step.so: integrator spoilt_step (integrator): step"));
  EXPECT_THAT(steps.err, HasSubstr("SIGSEGV"));
  cli::write_file(folder.path() / "crash.json", R"({"trammel": 1, "space": "planar",
      "bodies": {"p": {"type": "spoilt_force", "how": "memory", "from": 0}},
      "integrator": {"type": "runge_kutta_4", "step": 1e-3}, "simulate": {"until": 1}})");
  for (const char* command : {"explain", "static", "modes"}) {
    const auto forces = trammel({command, "crash.json", "--plugin", force}, {.folder = folder.path()});
    EXPECT_EQ(forces.exit_code, 3) << command << ": " << forces.err;
    EXPECT_THAT(forces.err, HasSubstr("spoilt_force.so: body spoilt_force (bodies.p): force at t = 0 s")) << command;
  }
}

// The name of the library is part of the message.
TEST_F(Plugin, ThatCrashesIsReportedInJsonWhateverItsNameIs) {
  const fs::path library = folder.path() / "two\nlines \"quoted\".so";
  fs::copy_file(kPlugins / "spoilt_step.so", library);
  const auto result =
      trammel({"run", cli::bounce, "--json", "--plugin", library.string(), "--set", "integrator.type=spoilt_step",
               "--set", "integrator.how=memory", "--set", "integrator.after=0"},
              {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 3);
  const json reported = json::parse(result.out, nullptr, false);
  ASSERT_FALSE(reported.is_discarded()) << result.out;
  EXPECT_THAT(reported["problems"][0]["message"].get<std::string>(), HasSubstr("two lines \"quoted\".so"));
}

TEST_F(Plugin, ThatCrashesIsNamedWithTheCallAndTheTimeAndRecordsAreKept) {
  for (const auto& [how, signal] :
       {std::pair{"memory", "SIGSEGV"}, std::pair{"stack", "SIGSEGV"}, std::pair{"abort", "SIGABRT"}}) {
    const std::string scene = R"({"trammel": 1, "space": "planar", "gravity": [0, -9.81],
      "bodies": {"p": {"type": "spoilt_force", "how": ")" +
                              std::string(how) + R"("}},
      "integrator": {"type": "runge_kutta_4", "step": 1e-3}, "simulate": {"until": 1}, "record": {"every": 0.01}})";
    cli::write_file(folder.path() / "crash.json", scene);
    const std::string library = (kPlugins / "spoilt_force.so").string();
    const auto result = trammel({"run", "crash.json", "--plugin", library}, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, StartsWith("trammel: plugin "));
    EXPECT_THAT(result.err, HasSubstr("spoilt_force.so: body spoilt_force (bodies.p): force at t = 0.49"));
    EXPECT_THAT(result.err, HasSubstr(signal));
    const std::string series = cli::read_file(folder.path() / "out/crash/series.csv");
    EXPECT_EQ(std::count(series.begin(), series.end(), '\n'), 1 + 50);  // header; 0 to 0.49 s
    const auto json_result = trammel({"run", "crash.json", "--json", "--plugin", library}, {.folder = folder.path()});
    EXPECT_EQ(json::parse(json_result.out)["status"], "error");
  }
}
#endif

TEST_F(Plugin, ErrorWithJsonIsOneObject) {
  const auto result =
      trammel({"run", cli::bounce, "--json", "--plugin", "no_such_library.so"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(json::parse(result.out)["status"], "error");
}

}  // namespace
