// Too little memory: exit code 1 with a message that gives the size requested, wherever it ends; never a signal, nor a
// blamed plugin.
#include <gmock/gmock.h>

#include <string>

#include "program.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;

// Runs trammel with these arguments and this address space [KiB].
cli::Result within(long kibibytes, const std::string& words, const std::filesystem::path& folder) {
  const std::string program = TRAMMEL_BUILD_DIR "/bin/trammel";
  return cli::run_program("/bin/sh",
                          {"-c", "ulimit -v " + std::to_string(kibibytes) + "; exec " + program + " " + words},
                          {.folder = folder});
}

class OutOfMemory : public testing::TestWithParam<const char*> {};

TEST_P(OutOfMemory, IsAnErrorWithASize) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer takes more address space than these limits leave";
#endif
  const cli::TemporaryFolder folder;
  int ended = 0;
  // From what the program itself takes to a few times as much: reading, set-up and the run meet the limit, each
  // somewhere.
  for (const long limit : {200000L, 250000L, 300000L, 400000L}) {
    const cli::Result result =
        within(limit, std::string(GetParam()) + " --out out" + std::to_string(limit), folder.path());
    if (result.exit_code == 0) continue;
    EXPECT_EQ(result.exit_code, 1) << limit << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr("out of memory")) << limit;
    EXPECT_THAT(result.err, Not(HasSubstr("plugin"))) << limit;
    ended += 1;
  }
  EXPECT_GE(ended, 2);
}

const char* const large[] = {
    "run " TRAMMEL_SOURCE_DIR "/scenes/truss/S2c.json --set parameters.n=100000",
    "run " TRAMMEL_SOURCE_DIR "/scenes/benchmarks/chain.json --set parameters.links=20000 --set simulate.until=1e-6",
};
INSTANTIATE_TEST_SUITE_P(Of, OutOfMemory, testing::ValuesIn(large));

}  // namespace
