// Plugins that misbehave: exit code 3, one line that names the library and the cause, results so far kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;
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

  // The bouncing point, long in the air, with an integrator that goes wrong in step 1000.
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

TEST_F(Plugin, ThatReturnsAStateOfAnotherSizeIsToldTheSizes) {
  expect_blamed_in_step_1000("size", "it returned q with 3 entries; expected 2");
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, WhoseStepIsNotFiniteHoweverShortIsNamed) {
  expect_blamed_in_step_1000("not_finite", "it returned q[0] = nan; expected finite numbers");
  EXPECT_EQ(recorded_status(), "failed");
}

TEST_F(Plugin, ThatEndsTheProgramInStep1000IsNoSuccessAndRecordsAreKept) {
  for (const char* how : {"exit", "quick_exit"}) expect_blamed_in_step_1000(how, "it ended the program (exit)");
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
              HasSubstr("ends_in_constructor.so: correction ends_in_constructor: its constructor: it ended"));
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
