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
  // libtrammel.so and the plugins are found here; the commands' library would have to be beside them.
  void SetUp() override {
    const fs::path built = fs::path(TRAMMEL_BUILD_DIR) / "lib";
    for (const char* name : {"libtrammel.so", "trammel"}) fs::create_symlink(built / name, folder_.path() / name);
  }
  cli::Result trammel_here(std::vector<std::string> words) const {
    return trammel(words, {.folder = folder_.path(), .environment = {{"LD_LIBRARY_PATH", folder_.path().string()}}});
  }
  void damage() const { cli::write_file(folder_.path() / "libtrammel_commands.so", "damaged"); }

 private:
  cli::TemporaryFolder folder_;
};

TEST_F(WithoutAnalyses, AScenesRunNeedsNone) {
  const auto run = trammel_here({"run", cli::bounce, "--report"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(trammel_here({"validate", cli::bounce}).exit_code, 0);
}

TEST_F(WithoutAnalyses, AnAnalysisNamesTheLibraryAndHowItIsMade) {
  for (const auto& words : {std::vector<std::string>{"modes", cli::bounce}, {"run", cli::bounce, "--verify"}}) {
    const auto result = trammel_here(words);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("libtrammel_commands.so is missing"));
    EXPECT_THAT(result.err, HasSubstr("tools/build"));
    EXPECT_EQ(result.out, "");  // in particular no run whose results would then not be verified
  }
  damage();
  const auto result = trammel_here({"modes", cli::bounce});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("cannot be loaded"));
}

TEST_F(WithoutAnalyses, HelpShowsTheOtherCommandsAndAMistakeItsNearest) {
  const auto help = trammel_here({"help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("trammel run SCENE"));
  EXPECT_THAT(help.out, HasSubstr("libtrammel_commands.so"));
  const auto mistake = trammel_here({"stduy"});
  EXPECT_EQ(mistake.exit_code, 2);
  EXPECT_THAT(mistake.err, HasSubstr("Did you mean \"study\"?"));
}

}  // namespace
