// The one progress bar: on a terminal it stands while a command works and is gone afterwards; a file gets a line a
// minute, and --json nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace {

using cli::trammel;
using testing::ContainsRegex;

const char* const swing = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"mass": {"type": "point_mass", "mass": 1, "position": [0, 2]}},
  "forces": {"spring": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 1, "length": 1}},
  "integrator": {"type": "hht_alpha", "step": 1e-2},
  "simulate": {"until": 2}, "static": {"steps": 20},
  "record": {"every": 0.1, "observe": {"y": "mass.point.y"}}
})";
const char* const study = R"({"study": 1, "scene": "swing.json", "vary": {"forces.spring.stiffness": [1, 2, 3, 4]},
                              "reduce": {"lowest": {"observe": "y", "as": "min"}}})";

struct Waiting {
  std::string name;
  std::vector<std::string> words;
  std::string what;  // stands behind the bar
};
void PrintTo(const Waiting& w, std::ostream* out) {
  *out << w.name;
}

class Progress : public testing::TestWithParam<Waiting> {
 protected:
  Progress() {
    cli::write_file(folder.path() / "swing.json", swing);
    cli::write_file(folder.path() / "study.json", study);
  }
  cli::Result run(bool terminal, const char* option = nullptr) const {
    std::vector<std::string> words = GetParam().words;
    if (option) words.push_back(option);
    return trammel(words, {.folder = folder.path(), .terminal = terminal, .time_limit = 300});
  }
  cli::TemporaryFolder folder;
};

TEST_P(Progress, IsABarOnATerminalAndIsRemoved) {
  const std::string err = run(true).err;
  EXPECT_THAT(err, ContainsRegex("\\[#*\\.*\\] +[0-9]+ %  " + GetParam().what));
  EXPECT_THAT(err, testing::EndsWith("\r\033[K"));
}

TEST_P(Progress, IsNothingInAFileForTheFirstMinute) {
  EXPECT_EQ(run(false).err, "");
}

TEST_P(Progress, IsNothingBesideJson) {
  EXPECT_EQ(run(true, "--json").err, "");
}

INSTANTIATE_TEST_SUITE_P(
    Commands, Progress,
    testing::Values(Waiting{"run", {"run", "swing.json"}, "t = .* s, [0-9]+ steps of .* s, 0 impacts"},
                    Waiting{"static", {"static", "swing.json"}, "t = .* s, [0-9]+ steps"},
                    Waiting{"study", {"study", "study.json"}, "[0-9] of 4 cases"},
                    Waiting{
                        "trade", {"trade", "swing.json", "--target", "1e-2", "--budget", "2"}, "[a-z ]+, [0-9]+ runs"},
                    Waiting{"check", {"check", "spring_damper"}, "[0-9]+ of [0-9]+ checks"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
