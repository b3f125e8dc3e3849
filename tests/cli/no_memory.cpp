// A lack of memory at any place of a run: exit code 1 and one message that blames nobody, or no harm at all; never an
// abort, and no result that claims success.
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

// Sanitizers have allocators of their own.
#if !defined(__SANITIZE_ADDRESS__)

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;

// The n-th allocation fails, and with `for_good` all after it.
void expect_no_harm(const fs::path& folder, int n, bool for_good) {
  SCOPED_TRACE("allocation " + std::to_string(n) + (for_good ? " and all after it" : ""));
  fs::remove_all(folder / "out");
  cli::Setting setting{
      .folder = folder,
      .environment = {{"LD_PRELOAD", std::string(TRAMMEL_BUILD_DIR) + "/tests/plugins/no_memory.preload"},
                      {"TRAMMEL_TEST_ALLOCATION", std::to_string(n)}}};
  if (for_good) setting.environment.push_back({"TRAMMEL_TEST_FOR_GOOD", "1"});
  const auto result = trammel({"run", cli::bounce, "--out", "out", "--set", "simulate.until=0.6"}, setting);
  const fs::path written = folder / "out/result.json";
  if (result.exit_code == 0) {  // the allocation was not needed, or never came
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(json::parse(cli::read_file(written))["status"], "done");
    return;
  }
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.err, testing::StartsWith("trammel: "));
  EXPECT_THAT(result.err, HasSubstr("out of memory"));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("plugin")));
  // Not in the first moments of a run, before its folder is there.
  if (!fs::exists(written)) return;
  const json status = json::parse(cli::read_file(written));
  EXPECT_EQ(status["status"], "failed");
  EXPECT_THAT(status["reason"].get<std::string>(), HasSubstr("out of memory"));
}

// Each of the first allocations, and some of the later ones.
constexpr int first = 1, every = 320, block = 40, further = 20;

class NoMemory : public testing::TestWithParam<int> {};

TEST_P(NoMemory, AtOnePlaceDoesNoHarm) {
  const cli::TemporaryFolder folder;
  for (int n = GetParam(); n < GetParam() + block; ++n) expect_no_harm(folder.path(), n, false);
}

TEST_P(NoMemory, FromOnePlaceOnDoesNoHarm) {
  const cli::TemporaryFolder folder;
  for (int n = GetParam(); n < GetParam() + block; ++n) expect_no_harm(folder.path(), n, true);
}

INSTANTIATE_TEST_SUITE_P(From, NoMemory, testing::Range(first, every, block));

class NoMemoryLater : public testing::TestWithParam<int> {};

TEST_P(NoMemoryLater, DoesNoHarm) {
  const cli::TemporaryFolder folder;
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  for (int i = 0; i < further; ++i) expect_no_harm(folder.path(), every + int(random() % 3000), i % 2 == 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, NoMemoryLater, testing::Range(1, 7));

}  // namespace

#endif
