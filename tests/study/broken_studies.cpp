// Study files that are wrong, each in its way: the error has the place, what was found and the nearest valid name.
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/study_file.hpp"

#include "support/run_scene.hpp"

namespace trammel::study {
namespace {

using testing::HasSubstr;

struct Broken {
  const char* name;
  const char* text;
  std::vector<std::string> expected;  // parts of the error
};

void PrintTo(const Broken& broken, std::ostream* out) {
  *out << broken.name;
}

class BrokenStudy : public testing::TestWithParam<Broken> {};

TEST_P(BrokenStudy, IsRefusedAtThePlaceOfTheFault) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path());
  std::filesystem::copy_file(TRAMMEL_SOURCE_DIR "/scenes/tour/01_pendulum.json", folder.path() / "pendulum.json");
  std::ofstream(folder.path() / "measured.csv") << "t,angle\n0,1\n";
  const std::string file = folder.path() / "study.json";
  std::ofstream(file) << GetParam().text;
  try {
    Study::load(file);
    FAIL() << "it was accepted";
  } catch (const scene::SceneError& e) {
    for (const std::string& part : GetParam().expected) EXPECT_THAT(e.what(), HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenStudy,
    testing::Values(
        Broken{"Key",
               R"({"study": 1, "scene": "pendulum.json",
 "vray": {"parameters.L": [1]}})",
               {"study.json:2:10: vray", "Did you mean \"vary\"?", "has no \"vary\""}},
        Broken{"Comma",
               R"({"study": 1, "scene": "pendulum.json"
 "vary": {"parameters.L": [1]}})",
               {"study.json:1:38", "comma"}},
        Broken{"Version",
               R"({"study": 2, "scene": "pendulum.json", "vary": {"parameters.L": [1]}})",
               {"study.json:1:11: study", "expected \"study\": 1"}},
        Broken{"Scene",
               R"({"study": 1, "scene": "pendulm.json", "vary": {"parameters.L": [1]}})",
               {"study.json:1:23: scene", "no such file", "pendulm.json"}},
        Broken{"SceneOfACase",
               R"({"study": 1, "vary": [{"scene": "pendulum.json"},
 {"scene": 5}]})",
               {"study.json:2:12: vary[1].scene", "found 5, expected a file's name"}},
        Broken{"Mode",
               R"({"study": 1, "scene": "pendulum.json", "mode": "gird", "vary": {"parameters.L": [1]}})",
               {"study.json:1:48: mode", "found \"gird\"", "Did you mean \"grid\"?"}},
        Broken{"Path",
               R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.l": [1]}})",
               {"vary.parameters.l", "Did you mean"}},
        Broken{"Range",
               R"({"study": 1, "scene": "pendulum.json",
 "vary": {"parameters.L": {"from": 0, "to": 1, "count": 3, "scale": "log"}}})",
               {"study.json:2:27: vary.parameters.L", "a logarithmic scale needs \"from\" and \"to\" above 0"}},
        Broken{"Zip",
               R"({"study": 1, "scene": "pendulum.json", "mode": "zip",
 "vary": {"parameters.L": [1, 2], "parameters.m": [1]}})",
               {"study.json:2:51: vary.parameters.m", "has 1 values, \"parameters.L\" has 2"}},
        Broken{"Reduction",
               R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]},
 "reduce": {"swing": {"observe": "angel", "as": "max"}}})",
               {"study.json:2:34: reduce.swing.observe", "observes no \"angel\"", "Did you mean \"angle\"?"}},
        Broken{"Way",
               R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]},
 "reduce": {"swing": {"observe": "angle", "as": "max_ab", "level": 1}}})",
               {"study.json:2:49: reduce.swing.as", "Did you mean \"max_abs\"?", "reduce.swing.level",
                "only \"first_crossing\" has one"}},
        Broken{"Reference",
               R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]},
 "reduce": {"e": {"observe": "angle", "as": "rms", "reference": {"file": "measured.csv", "column": "angel"}}}})",
               {"reduce.e.reference", "measured.csv has no column \"angel\"", "Did you mean \"angle\"?"}},
        Broken{"Keep",
               R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]}, "keep": "all"})",
               {"study.json:1:79: keep", "found the text \"all\", expected true or false"}},
        Broken{
            "Figure",
            R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]}, "keep": true,
 "figures": [{"observe": "angel", "scale": "lin"}, {"observe": "angle", "cases": {"parameters.l": 1}},
 {"observe": "angle", "cases": [{"parameters.L": 2}]}, {"titel": "a"}]})",
            {"study.json:2:44: figures[0].scale", "found \"lin\"; known: linear, log", "figures[1].cases.parameters.l",
             "Did you mean \"parameters.L\"?", "study.json:3:32: figures[2].cases: no case has these values",
             "figures[3].titel", "has no \"observe\""}},
        Broken{"FigureOfAColumn",
               R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]}, "keep": true,
 "figures": [{"observe": ["energy_total", "angel"]}]})",
               {"study.json:2:26: figures[0].observe", "observes no \"angel\"", "Did you mean \"angle\"?"}},
        Broken{"FigureOfCasesThatAreNotKept",
               R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]},
 "figures": [{"observe": "angle"}]})",
               {"study.json:2:13: figures", "add \"keep\": true"}}),
    [](const auto& broken) { return broken.param.name; });

// A measured column that holds anything but numbers is no reference: read as 0, or left out, it would be one all the
// same.
TEST(BrokenReference, IsRefusedAtItsLineAndColumn) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path());
  std::filesystem::copy_file(TRAMMEL_SOURCE_DIR "/scenes/tour/01_pendulum.json", folder.path() / "pendulum.json");
  const std::string study = folder.path() / "study.json", table = folder.path() / "measured.csv";
  std::ofstream(study) << R"({"study": 1, "scene": "pendulum.json", "vary": {"parameters.L": [1]},
 "reduce": {"e": {"observe": "angle", "as": "rms", "reference": {"file": "measured.csv", "column": "angle"}}}})";
  const auto said = [&](const std::string& rows) -> std::string {
    std::ofstream(table) << "t,angle,v\n" << rows;
    try {
      Study::load(study);
    } catch (const scene::SceneError& e) {
      return e.what();
    }
    return "";
  };
  const auto at = [&](int line, int column) {
    return fmt::format("measured.csv:{}:{}: reduce.e.reference", line, column);
  };
  EXPECT_EQ(said("0,1,2\n0.1,1.5,2\n"), "");
  EXPECT_EQ(said("0, +1, 2\n0.1 ,1.5e0, 2\n"), "");
  EXPECT_EQ(said("0,1,2\r\n0.1,1.5,2\r\n\r\n"), "");
  for (const char* cell : {"n/a", "", " ", "1.5m", "nan", "1e999", "0x10"}) {
    const std::string error = said(fmt::format("0,1,2\n0.25,{},2\n", cell));
    EXPECT_THAT(error, HasSubstr(at(3, 6))) << cell;
    EXPECT_THAT(error, HasSubstr("expected a number")) << cell;
  }
  EXPECT_THAT(said("0,1,2\nsoon,1.5,2\n"), testing::AllOf(HasSubstr(at(3, 1)), HasSubstr("found \"soon\"")));
  EXPECT_THAT(said("0,1,2\n0.25\n"),
              testing::AllOf(HasSubstr(at(3, 1)), HasSubstr("found 1 cells, expected at least 2")));
  EXPECT_THAT(said("0,1,2\n0.2,1,2\n0.1,1,2\n"),
              testing::AllOf(HasSubstr(at(4, 1)), HasSubstr("less than the one in the row before")));
}

// The limit of cases holds for a grid: lists of 4000 values zip to 4000 cases.
TEST(Study, ZipsListsThatWouldMakeTooLargeAGrid) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path());
  std::filesystem::copy_file(TRAMMEL_SOURCE_DIR "/scenes/tour/01_pendulum.json", folder.path() / "pendulum.json");
  const std::string file = folder.path() / "study.json", range = R"({"from": 1, "to": 2, "count": 4000})";
  const auto study = [&](const char* mode) {
    std::ofstream(file) << fmt::format(R"({{"study": 1, "scene": "pendulum.json", "mode": "{}",
 "vary": {{"parameters.L": {}, "parameters.m": {}}}}})",
                                       mode, range, range);
    return Study::load(file);
  };
  EXPECT_EQ(study("zip").size(), 4000u);
  EXPECT_THROW(study("grid"), scene::SceneError);
}

}  // namespace
}  // namespace trammel::study
