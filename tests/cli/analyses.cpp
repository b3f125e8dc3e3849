// The library of commands that do more than run a scene: loaded only when one of them is asked for.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using testing::HasSubstr;

class WithoutAnalyses : public testing::Test {
 protected:
  // The loader looks here first, and what it finds is no library.
  void SetUp() override { cli::write_file(folder_.path() / "libtrammel_commands.so", "damaged"); }
  cli::Result with_damaged_library(std::vector<std::string> words) const {
    return trammel(words, {.folder = folder_.path(), .environment = {{"LD_LIBRARY_PATH", folder_.path().string()}}});
  }

 private:
  cli::TemporaryFolder folder_;
};

TEST_F(WithoutAnalyses, AScenesRunNeedsNone) {
  const auto run = with_damaged_library({"run", cli::bounce, "--report"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(with_damaged_library({"validate", cli::bounce}).exit_code, 0);
}

TEST_F(WithoutAnalyses, AnAnalysisNamesTheLibraryAndHowItIsMade) {
  const auto verified = std::vector<std::string>{"run", cli::bounce, "--verify"};
  for (const auto& words : {std::vector<std::string>{"modes", cli::bounce}, verified}) {
    const auto result = with_damaged_library(words);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("libtrammel_commands.so"));
    EXPECT_THAT(result.err, HasSubstr("tools/build"));
    EXPECT_EQ(result.out, "");  // in particular no run whose results would then not be verified
  }
}

TEST_F(WithoutAnalyses, HelpShowsTheOtherCommands) {
  const auto help = with_damaged_library({"help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("trammel run SCENE"));
  EXPECT_THAT(help.out, HasSubstr("libtrammel_commands.so"));
}

}  // namespace
