// Files that are no scenes, and folders that cannot take results.
#include <fcntl.h>
#include <sys/mount.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using testing::HasSubstr;
using testing::StartsWith;

class SceneFile : public testing::Test {
 protected:
  // Validates scene.json of the test's folder: exit code 2, one line that begins with the file's name.
  std::string error_of(const std::string& file = "scene.json") {
    const auto result = trammel({"validate", file}, {.folder = folder.path(), .time_limit = 10});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, StartsWith(file + ":"));
    return result.err;
  }
  void write(const std::string& text) { cli::write_file(folder.path() / "scene.json", text); }

  cli::TemporaryFolder folder;
};

TEST_F(SceneFile, ThatIsMissingIsNamed) {
  EXPECT_THAT(error_of("no_such.json"), HasSubstr("no such file"));
}

TEST_F(SceneFile, ThatIsADirectoryIsRefused) {
  fs::create_directory(folder.path() / "scene.json");
  EXPECT_THAT(error_of(), HasSubstr("directory"));
}

TEST_F(SceneFile, ThatIsADeviceIsRefusedAndNotReadForever) {
  const auto result = trammel({"validate", "/dev/zero"}, {.time_limit = 10});
  EXPECT_EQ(result.exit_code, 2) << result.err;
}

TEST_F(SceneFile, OfBinaryDataIsRefused) {
  write(
      std::string("\x7f"
                  "ELF\x02\x01\x01\0\0\0\xff\xfe\x80garbage",
                  21));
  error_of();
}

TEST_F(SceneFile, WithTextThatIsNoUtf8IsRefusedOrReadButNeverBreaksTheJsonOutput) {
  write("{\"title\": \"caf\xe9\", \"bodys\xff\": {}}");
  const auto result = trammel({"validate", "scene.json", "--json"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(result.out)["status"], "error");
}

TEST_F(SceneFile, NestedAHundredThousandDeepIsRefusedAtTheLimit) {
  write("{\"bodies\": " + std::string(100000, '[') + std::string(100000, ']') + "}");
  EXPECT_THAT(error_of(), HasSubstr("100"));
  write(std::string(100000, '{'));
  error_of();
}

TEST_F(SceneFile, NestedExpressionsDoNotOverflowTheStack) {
  write("{\"include\": \"" + cli::bounce + "\", \"simulate\": {\"until\": \"=" + std::string(100000, '(') + "1" +
        std::string(100000, ')') + "\"}}");
  EXPECT_THAT(error_of(), HasSubstr("simulate.until"));
}

TEST_F(SceneFile, OfAGigabyteIsRefusedByItsSize) {
  write("{");
  fs::resize_file(folder.path() / "scene.json", 1ull << 30);  // sparse: takes no room on the disk
  EXPECT_THAT(error_of(), HasSubstr("64 MiB"));
}

TEST_F(SceneFile, IncludedInACycleNamesTheFiles) {
  write("{\"include\": \"other.json\"}");
  cli::write_file(folder.path() / "other.json", "{\"include\": \"scene.json\"}");
  const auto result = trammel({"validate", "scene.json"}, {.folder = folder.path(), .time_limit = 10});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("other.json"));
  EXPECT_THAT(result.err, HasSubstr("scene.json"));
}

TEST(Results, CannotGoBelowAFile) {
  const cli::TemporaryFolder folder;
  cli::write_file(folder.path() / "file", "");
  for (const char* out : {"file", "file/below", "/proc/trammel"}) {
    const auto result = trammel({"run", cli::bounce, "--out", out}, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, StartsWith("trammel: cannot write results to " + std::string(out) + ": "));
  }
}

// A disk that is full stops a write in the middle; a limit on the size of files does the same without a disk.
TEST(Results, OnAFullDiskEndTheRunAndAreKeptSoFar) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce, "--out", "r", "--set", "simulate.until=20"},
                              {.folder = folder.path(), .file_size_limit = 20000});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("r/series.csv"));
  EXPECT_THAT(result.err, HasSubstr("File too large"));
  EXPECT_THAT(cli::read_file(folder.path() / "r/series.csv"), StartsWith("t,height,"));
}

TEST(Results, OfWhichOneFileMeetsItsLimitKeepTheOthersWholeAndSayWhatIsMissing) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce, "--out", "r", "--set", "simulate.until=20"},
                              {.folder = folder.path(), .file_size_limit = 20000});
  EXPECT_THAT(result.err, testing::ContainsRegex("series.csv lacks its last [0-9]+ lines"));
  const std::string series = cli::read_file(folder.path() / "r/series.csv");
  EXPECT_LE(series.size(), 20000u);
  EXPECT_EQ(series.back(), '\n');
  EXPECT_GT(cli::read_file(folder.path() / "r/events.csv").size(), 100u);
  const auto found = nlohmann::json::parse(cli::read_file(folder.path() / "r/result.json"));
  EXPECT_EQ(found["status"], "failed");
  EXPECT_THAT(std::string(found["reason"]), HasSubstr("series.csv"));
}

// A disk of its own, where the tests may mount one.
class SmallDisk : public testing::Test {
 protected:
  static constexpr const char* size = "size=700k";
  void SetUp() override {
    fs::create_directory(disk);
    if (mount("tmpfs", disk.c_str(), "tmpfs", 0, size) != 0) GTEST_SKIP() << "no right to mount a small disk";
    mounted = true;
  }
  void TearDown() override {
    if (mounted) umount(disk.c_str());
  }
  cli::TemporaryFolder folder;
  fs::path disk = folder.path() / "disk";
  bool mounted = false;
};

TEST_F(SmallDisk, ThatFillsUpLosesNothingAndTheRunGoesOnOnceThereIsRoom) {
  const std::vector<std::string> finely = {"--set", "simulate.until=5", "--set", "record.every=1e-4"};
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), finely.begin(), finely.end());
    return trammel(words, {.folder = folder.path()});
  };
  const auto full = run({"run", cli::bounce, "--out", "disk/r"});
  EXPECT_EQ(full.exit_code, 1) << full.err;
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  EXPECT_THAT(full.err, HasSubstr("--resume"));
  EXPECT_EQ(nlohmann::json::parse(cli::read_file(disk / "r/result.json"))["status"], "failed");

  ASSERT_EQ(mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=64m"), 0);
  EXPECT_EQ(run({"run", cli::bounce, "--resume", "disk/r"}).exit_code, 0);
  EXPECT_EQ(run({"run", cli::bounce, "--out", "whole"}).exit_code, 0);
  for (const char* file : {"series.csv", "events.csv"})
    EXPECT_TRUE(cli::read_file(disk / "r" / file) == cli::read_file(folder.path() / "whole" / file)) << file;
}

TEST_F(SmallDisk, ThatIsFullFromTheStartIsRefusedBeforeTheRun) {
  cli::write_file(disk / "much", std::string(600000, 'x'));
  const auto result = trammel({"run", cli::bounce, "--out", "disk/r"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("KiB must be free"));
}

TEST(Results, OnAFullStandardOutputAreAnError) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce, "--json"}, {.folder = folder.path(), .stdout_to = "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("standard output"));
}

}  // namespace
