// Text cases: every file in tests/cli/cases is a scene whose leading comments say how to call trammel on it and what
// must come of it.
//
//     // $ trammel validate SCENE          the command, run in tests/cli/cases; SCENE stands for this file
//     // exit 2                           its exit code
//     // > misspelt_key.json:8:3: ...     a text within a line of standard error
//
// Each `>` text must appear, and each line of standard error must hold one of them: no problem is missed, none made up.
#include <filesystem>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(TRAMMEL_SOURCE_DIR) / "tests/cli/cases";

struct Case {
  std::vector<std::string> words;  // after "trammel"
  int exit_code = -1;
  std::vector<std::string> expected;
};

Case read_case(const fs::path& file) {
  Case found;
  std::istringstream in(cli::read_file(file));
  for (std::string line; std::getline(in, line) && line.starts_with("// ");) {
    std::istringstream words(line.substr(3));
    std::string mark;
    words >> mark;
    if (mark == "$") {
      words >> mark;
      for (std::string word; words >> word;) found.words.push_back(word == "SCENE" ? file.filename().string() : word);
    } else if (mark == "exit") {
      words >> found.exit_code;
    } else if (mark == ">") {
      found.expected.push_back(line.substr(5));
    }
  }
  return found;
}

std::vector<std::string> case_names() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".json") names.insert(entry.path().stem().string());
  return {names.begin(), names.end()};
}

class BadInput : public testing::TestWithParam<std::string> {};

TEST_P(BadInput, GetsAClearError) {
  const Case expected = read_case(kFolder / (GetParam() + ".json"));
  ASSERT_FALSE(expected.words.empty()) << "the case has no '// $ trammel ...' line";
  ASSERT_FALSE(expected.expected.empty()) << "the case has no '// > ...' line";

  const cli::Result result = cli::trammel(expected.words, {.folder = kFolder});
  EXPECT_EQ(result.exit_code, expected.exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  for (const std::string& text : expected.expected)
    EXPECT_NE(result.err.find(text), std::string::npos) << "missing: " << text << "\nfound:\n" << result.err;
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line);) {
    bool wanted = false;
    for (const std::string& text : expected.expected) wanted = wanted || line.find(text) != std::string::npos;
    EXPECT_TRUE(wanted) << "not expected: " << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, BadInput, testing::ValuesIn(case_names()), [](const auto& test) { return test.param; });

}  // namespace
