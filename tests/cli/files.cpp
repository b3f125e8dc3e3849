// Files that are no scenes, and folders that cannot take results.
#include <fcntl.h>
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

const std::string kBounce = (fs::path(TRAMMEL_SOURCE_DIR) / "tests/cli/scenes/bounce.json").string();

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
  write("{\"include\": \"" + kBounce + "\", \"simulate\": {\"until\": \"=" + std::string(100000, '(') + "1" +
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
    const auto result = trammel({"run", kBounce, "--out", out}, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, StartsWith("trammel: cannot write results to " + std::string(out) + ": "));
  }
}

// A disk that is full stops a write in the middle; a limit on the size of files does the same without a disk.
TEST(Results, OnAFullDiskEndTheRunAndAreKeptSoFar) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", kBounce, "--out", "r", "--set", "simulate.until=20"},
                              {.folder = folder.path(), .file_size_limit = 20000});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("r/series.csv"));
  EXPECT_THAT(result.err, HasSubstr("File too large"));
  EXPECT_THAT(cli::read_file(folder.path() / "r/series.csv"), StartsWith("t,height,"));
}

TEST(Results, OnAFullStandardOutputAreAnError) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", kBounce, "--json"}, {.folder = folder.path(), .stdout_to = "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("standard output"));
}

}  // namespace
