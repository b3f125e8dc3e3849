// Studies as a user runs them: shards, resuming, failures, errors of the file; comparing folders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using cli::read_file;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;

// Ten pendulums; the last two have no length, which their scene refuses.
const char* const study = R"({
  "study": 1, "scene": "pendulum.json",
  "vary": {"parameters.L": [0.5, 1, 1.5, 2, 0], "parameters.m": [1, 2]},
  "reduce": {"lowest": {"observe": "tip_y", "as": "min"},
             "down": {"observe": "tip_x", "as": "first_crossing", "direction": "down"}}
})";

struct Folder : cli::TemporaryFolder {
  explicit Folder(const std::string& text = study) {
    cli::write_file(path() / "pendulum.json",
                    read_file(std::filesystem::path(TRAMMEL_SOURCE_DIR) / "scenes/tour/01_pendulum.json"));
    cli::write_file(path() / "study.json", text);
  }
  cli::Result run(std::vector<std::string> words) const {
    words.insert(words.begin(), "study");
    return trammel(words, {.folder = path()});
  }
  std::string file(const std::string& name) const { return read_file(path() / name); }
};

TEST(Study, WritesARowForEachCaseAndGoesOnAfterFailures) {
  const Folder folder;
  const auto result = folder.run({"study.json", "--out", "a", "--set", "set={\"simulate.until\": 0.8}"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json all = json::parse(folder.file("a/study.json"));
  EXPECT_EQ(all["done"], 8);
  EXPECT_EQ(all["failed"], 2);
  EXPECT_THAT(all["failures"][0]["reason"].get<std::string>(), HasSubstr("inertia"));
}

TEST(Study, OfShardsJoinsToTheBytesOfOneRun) {
  const Folder folder;
  ASSERT_EQ(folder.run({"study.json", "--out", "whole", "--jobs", "1"}).exit_code, 0);
  for (const char* shard : {"1/3", "2/3", "3/3"})
    ASSERT_EQ(folder.run({"study.json", "--out", std::string("s") + shard[0], "--shard", shard}).exit_code, 0);
  ASSERT_EQ(folder.run({"merge", "s1", "s2", "s3", "--out", "merged"}).exit_code, 0);
  EXPECT_EQ(folder.file("merged/study.csv"), folder.file("whole/study.csv"));
  EXPECT_EQ(folder.file("merged/study.npz"), folder.file("whole/study.npz"));
}

TEST(Study, NamesCasesThatAreMissing) {
  const Folder folder;
  ASSERT_EQ(folder.run({"study.json", "--out", "s1", "--shard", "1/3"}).exit_code, 0);
  ASSERT_EQ(folder.run({"study.json", "--out", "s3", "--shard", "3/3"}).exit_code, 0);
  const auto merged = folder.run({"merge", "s1", "s3", "--out", "merged"});
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_THAT(merged.out, HasSubstr("missing: 1, 4, 7"));
}

TEST(Study, RunsOnlyTheCasesThatAreMissing) {
  const Folder folder;
  ASSERT_EQ(folder.run({"study.json", "--out", "a"}).exit_code, 0);
  const std::string csv = folder.file("a/study.csv"), journal = folder.file("a/cases.ndjson");
  // Half of a line is lost, as after a kill, and one case.
  cli::write_file(folder.path() / "a/cases.ndjson", journal.substr(0, journal.size() - 40));
  ASSERT_EQ(folder.run({"study.json", "--out", "a"}).exit_code, 0);
  EXPECT_EQ(folder.file("a/study.csv"), csv);
  EXPECT_EQ(std::ranges::count(folder.file("a/cases.ndjson"), '\n'), 10);
}

TEST(Study, FailsWhenEveryCaseFailed) {
  const Folder folder(R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [0]}})");
  EXPECT_EQ(folder.run({"study.json"}).exit_code, 1);
}

TEST(Study, AsksForARequeueWhenItIsTerminated) {
  const Folder folder(R"({"study": 1, "scene": "pendulum.json", "set": {"integrator.step": 1e-4},
                          "vary": {"parameters.m": {"from": 1, "to": 2, "count": 1000}}})");
  const auto result =
      trammel({"study", "study.json", "--out", "a"},
              {.folder = folder.path(),
               .send_signal_when =
                   [&] {
                     std::error_code missing;
                     return std::filesystem::file_size(folder.path() / "a/cases.ndjson", missing) > 100 && !missing;
                   },
               .signal = SIGTERM});
  EXPECT_EQ(result.exit_code, 75) << result.err;
  EXPECT_EQ(json::parse(folder.file("a/study.json"))["status"], "interrupted");
}

TEST(Study, TellsAllErrorsOfItsFileAtOnce) {
  const Folder folder(R"({"study": 1, "scene": "pendulum.json", "seed": 3,
  "vary": {"parameters.L": {"from": 0.1, "to": 1, "counts": 3}},
  "reduce": {"lowest": {"observe": "tip_y", "as": "mni"}}
})");
  const auto result = folder.run({"study.json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("study.json:1:48: seed"));
  EXPECT_THAT(result.err, HasSubstr("Did you mean \"count\"?"));
  EXPECT_THAT(result.err, HasSubstr("Did you mean \"min\"?"));
}

TEST(Study, NamesThePathThatItsSceneDoesNotHave) {
  const Folder folder(R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.l": [1]},
  "reduce": {"a": {"observe": "angel", "as": "max"}}})");
  const auto result = folder.run({"study.json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("study.json:1:65: vary.parameters.l"));
  EXPECT_THAT(result.err, HasSubstr("Did you mean \"angle\"?"));
}

// Two scenes; what is kept of a case is what `trammel run` leaves.
const char* const kept = R"({"study": 1, "keep": true,
  "vary": {"scene": ["pendulum.json", "bounce.json"], "simulate.until": [0.5, 1]},
  "reduce": {"energy": {"observe": "energy_total", "as": "final"}}})";

struct KeptFolder : Folder {
  KeptFolder() : Folder(kept) { cli::write_file(path() / "bounce.json", read_file(cli::bounce)); }
};

TEST(Study, KeepsTheResultsOfItsCasesAsARunLeavesThem) {
  const KeptFolder folder;
  ASSERT_EQ(folder.run({"study.json", "--out", "a"}).exit_code, 0);
  ASSERT_EQ(
      trammel({"run", "bounce.json", "--set", "simulate.until=1", "--out", "b"}, {.folder = folder.path()}).exit_code,
      0);
  for (const char* file : {"series.csv", "events.csv", "animation.ndjson", "scene.resolved.json"})
    EXPECT_EQ(folder.file(std::string("a/cases/3/") + file), folder.file(std::string("b/") + file));
}

// A number is the same however it is written; null is a case that leaves the path as it is.
TEST(Study, DrawsTheFiguresThatItNames) {
  const Folder folder(R"({"study": 1, "scene": "pendulum.json", "keep": true, "set": {"simulate.until": 0.1},
    "vary": [{"parameters.L": 1, "parameters.m": 2}, {"parameters.L": 2, "parameters.m": 2}, {"parameters.L": 1}],
    "figures": [{"title": "Heavy", "observe": "angle", "cases": {"parameters.m": 2.0}},
                {"observe": ["energy_total", "tip_x"], "scale": "log", "time": "log",
                 "cases": [{"parameters.L": 1, "parameters.m": null}]}]})");
  ASSERT_EQ(folder.run({"study.json", "--out", "a"}).exit_code, 0);
  const json figures = json::parse(folder.file("a/study.json"))["page"]["figures"];
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0]["title"], "Heavy");
  ASSERT_EQ(figures[0]["curves"].size(), 2u);
  EXPECT_EQ(figures[0]["curves"][1]["name"], "L = 2");
  EXPECT_FALSE(figures[0]["curves"][1]["points"].empty());
  EXPECT_EQ(figures[1]["title"], "energy_total, tip_x");
  EXPECT_EQ(figures[1]["y"]["scale"], "logarithmic");
  ASSERT_EQ(figures[1]["curves"].size(), 2u);
  EXPECT_EQ(figures[1]["curves"][1]["name"], "tip_x");
  EXPECT_FALSE(figures[1]["curves"][1]["points"].empty());
  for (const json& point : figures[1]["curves"][1]["points"]) EXPECT_GT(point[0], 0);  // the start is off the axis
}

TEST(Study, SaysTheSameOfCasesThatItKeeps) {
  const KeptFolder folder;
  ASSERT_EQ(folder.run({"study.json", "--out", "a"}).exit_code, 0);
  std::string text = kept;
  cli::write_file(folder.path() / "other.json", text.replace(text.find("true"), 4, "false"));
  ASSERT_EQ(folder.run({"other.json", "--out", "b"}).exit_code, 0);
  EXPECT_EQ(folder.file("a/study.csv"), folder.file("b/study.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b/cases"));
}

TEST(Study, OfShardsBringsTheKeptResultsTogether) {
  const KeptFolder folder;
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(folder.run({"study.json", "--out", std::string("s") + shard[0], "--shard", shard}).exit_code, 0);
  ASSERT_EQ(folder.run({"merge", "s1", "s2", "--out", "merged"}).exit_code, 0);
  for (const char* number : {"0", "1", "2", "3"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "merged/cases" / number / "result.json")) << number;
}

TEST(Study, LeavesTheKeptResultsOfAnotherShardInItsFolder) {
  const KeptFolder folder;
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(folder.run({"study.json", "--out", "a", "--shard", shard}).exit_code, 0);
  for (const char* number : {"0", "1", "2", "3"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "a/cases" / number / "result.json")) << number;
}

// A study that keeps its cases replaces cases/ and what is in it.
TEST(Study, LeavesSomebodysOwnFolderOfCases) {
  const KeptFolder folder;
  std::filesystem::create_directories(folder.path() / "a/cases/1");
  cli::write_file(folder.path() / "a/cases/1/notes.txt", "mine");
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(folder.run({"study.json", "--out", std::string("s") + shard[0], "--shard", shard}).exit_code, 0);
  for (const auto& words :
       {std::vector<std::string>{"study.json", "--out", "a"}, {"merge", "s1", "s2", "--out", "a"}}) {
    const auto result = folder.run(words);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr("it has a folder cases/"));
    EXPECT_EQ(folder.file("a/cases/1/notes.txt"), "mine");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a/study.json"));
  }
}

TEST(Study, MergesIntoTheFolderOfOneOfItsShards) {
  const KeptFolder folder;
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(folder.run({"study.json", "--out", std::string("s") + shard[0], "--shard", shard}).exit_code, 0);
  const auto result = folder.run({"merge", "s1", "s2", "--out", "s1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(folder.file("s1/study.json"))["missing"], json::array());
  for (const char* number : {"0", "1", "2", "3"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "s1/cases" / number / "result.json")) << number;
}

TEST(Study, NamesADamagedOneThatItIsToMerge) {
  const Folder folder;
  ASSERT_EQ(folder.run({"study.json", "--out", "s1", "--shard", "1/2"}).exit_code, 0);
  const json sound = json::parse(folder.file("s1/study.json"));
  for (const char* key : {"definition", "file", "scene_hash"})
    for (const json& value : {json(), json(7), json("zz")}) {
      if (std::string(key) != "scene_hash" && value == "zz") continue;
      json damaged = sound;
      damaged[key] = value;
      cli::write_file(folder.path() / "s1/study.json", damaged.dump());
      const auto result = folder.run({"merge", "s1", "--out", "m"});
      EXPECT_EQ(result.exit_code, 2) << key << value;
      EXPECT_THAT(result.err, HasSubstr("s1/study.json is damaged")) << key << value;
      EXPECT_FALSE(std::filesystem::exists(folder.path() / "m")) << key << value;
    }
}

TEST(Study, RunsACaseAgainWhoseKeptResultsAreGone) {
  const KeptFolder folder;
  ASSERT_EQ(folder.run({"study.json", "--out", "a"}).exit_code, 0);
  std::filesystem::remove_all(folder.path() / "a/cases/2");
  std::filesystem::create_directories(folder.path() / "a/cases/17");  // of an older, longer study
  ASSERT_EQ(folder.run({"study.json", "--out", "a"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a/cases/2/result.json"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a/cases/17"));
}

TEST(Study, NamesTheCaseWhoseSceneHasNoSuchPath) {
  const KeptFolder folder;
  cli::write_file(folder.path() / "study.json", R"({"study": 1, "vary": [
    {"scene": "pendulum.json", "parameters.L": 1},
    {"scene": "bounce.json", "parameters.L": 1}]})");
  const auto result = folder.run({"study.json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("study.json:3:46: vary[1].parameters.L"));
  cli::write_file(folder.path() / "study.json", R"({"study": 1, "vary": [{"scene": "pendulum.json"}, {}]})");
  EXPECT_THAT(folder.run({"study.json"}).err, HasSubstr("has no \"scene\""));
}

TEST(Study, ProposesShardsOfAMinuteEach) {
  const Folder folder;
  const auto result = folder.run({"study.json", "--estimate", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["shards"], 1);
}

TEST(Compare, TellsTheFirstRowAndColumnThatDifferAndByHowManyDigits) {
  const Folder folder;
  const auto run = [&](const char* out, const char* set) {
    ASSERT_EQ(
        trammel({"run", "pendulum.json", "--out", out, "--quiet", "--set", set}, {.folder = folder.path()}).exit_code,
        0);
  };
  run("a", "integrator.step=0.001"), run("b", "integrator.step=0.001"), run("c", "integrator.step=0.0005");
  EXPECT_EQ(trammel({"compare", "a", "b"}, {.folder = folder.path()}).exit_code, 0);
  const auto differs = trammel({"compare", "a", "c"}, {.folder = folder.path()});
  EXPECT_EQ(differs.exit_code, 1);
  EXPECT_THAT(differs.out, HasSubstr("series.csv: first at row 2 (t = 0.01"));
  EXPECT_THAT(differs.out, HasSubstr("digits agree"));
  EXPECT_THAT(differs.out, HasSubstr("made with another scene"));
  EXPECT_THAT(differs.out, HasSubstr("scene.resolved.json: first at integrator.step: 0.001 and 0.0005"));
  EXPECT_EQ(differs.out.find("series.csv"), 0u);  // the records first
}

// Bytes that are no text, or none at all: a difference like others, with the file's name.
TEST(Compare, NamesADamagedFile) {
  const Folder folder;
  for (const char* out : {"a", "b"})
    ASSERT_EQ(trammel({"run", "pendulum.json", "--out", out, "--quiet"}, {.folder = folder.path()}).exit_code, 0);
  const std::string whole = folder.file("b/series.csv");
  for (const std::string& damaged :
       {std::string("\xff\xfe") + whole.substr(2), whole.substr(0, whole.size() / 2) + "\xc3\x28\n", std::string()}) {
    cli::write_file(folder.path() / "b/series.csv", damaged);
    for (const char* form : {"--json", ""}) {
      std::vector<std::string> words = {"compare", "a", "b"};
      if (*form) words.push_back(form);
      const auto result = trammel(words, {.folder = folder.path()});
      EXPECT_EQ(result.exit_code, 1);
      EXPECT_THAT(result.err, testing::Not(HasSubstr("exception")));
      EXPECT_THAT(result.out, HasSubstr("series.csv"));
    }
  }
}

}  // namespace
