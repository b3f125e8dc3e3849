#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "scene/value.hpp"

namespace trammel::scene {
namespace {

std::string error_of(const std::string& text) {
  try {
    Scene::parse(text, "scene.json");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_file(const std::string& file) {
  try {
    Scene::load(file);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

class TemporaryFile {
 public:
  TemporaryFile()
      : path_(std::filesystem::temp_directory_path() / ("trammel_scene_test_" + std::to_string(::getpid()))) {}
  ~TemporaryFile() { std::filesystem::remove_all(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

TEST(SceneReader, KnowsWhereEachValueStands) {
  const Scene scene =
      Scene::parse("{\n  // a comment\n  \"a\": {\"b\": [1, 22.5]},\n  \"c\": \"x\\\"y\"\n}", "scene.json");
  const Value& item = scene.root().at_path("a.b")->items()[1];
  EXPECT_EQ(item.path(), "a.b[1]");
  EXPECT_EQ(item.position().line, 3);
  EXPECT_EQ(item.position().column, 18);
  EXPECT_EQ(scene.root().find("c")->position().line, 4);
  EXPECT_EQ(scene.root().find("c")->position().column, 8);
}

TEST(SceneReader, FindsEachOfManyMembersAlsoAfterSomeWereChanged) {
  std::string text = "{\"bodies\": {\"kept\": 0";
  for (int i = 0; i < 300; ++i) text += ", \"link" + std::to_string(i) + "\": " + std::to_string(i);
  const Scene scene = Scene::parse(text + "}}", "scene.json", {{"bodies.link7", "null"}, {"bodies.link9", "99"}});
  Problems problems;
  const auto number = [&](const std::string& name) {
    const Value* value = scene.root().at_path("bodies." + name);
    return value ? value->read_number(problems) : std::nullopt;
  };
  for (int i = 0; i < 300; ++i)
    if (i != 7 && i != 9) {
      EXPECT_EQ(number("link" + std::to_string(i)), i);
    }
  EXPECT_EQ(number("link9"), 99);
  for (const char* name : {"link7", "link300", "", "a", "z"}) EXPECT_EQ(number(name), std::nullopt) << name;
}

TEST(SceneReader, RefusesADuplicateKeyAtItsSecondPlace) {
  EXPECT_EQ(error_of("{\"a\": {\"k\": 1,\n \"k\": 2}}"),
            "scene.json:2:2: a.k: the key \"k\" stands here a second time; each key may stand once");
}

TEST(SceneReader, RefusesNumbersThatOverflowOrVanish) {
  EXPECT_EQ(error_of("{\"a\": 1e999}"), "scene.json:1:7: a: 1e999 is too large for a number");
  EXPECT_EQ(error_of("{\"a\": 1e-400}"), "scene.json:1:7: a: 1e-400 is too small for a number, it would become 0");
}

TEST(SceneReader, RefusesNaN) {
  EXPECT_NE(error_of("{\"a\": NaN}").find("scene.json:1:7: a: not valid JSON"), std::string::npos);
}

TEST(SceneReader, RefusesAHundredThousandLevelsAtTheHundredAndFirst) {
  const std::string deep = "{\"a\": " + std::string(100000, '[') + std::string(100000, ']') + "}";
  EXPECT_NE(error_of(deep).find("scene.json:1:106: a[0][0]"), std::string::npos);
  EXPECT_NE(error_of(deep).find("nested deeper than 100 levels"), std::string::npos);
}

TEST(SceneReader, SaysWhereTheSyntaxBreaks) {
  const std::string error = error_of("{\"a\": 1,\n \"b\" true}");
  EXPECT_NE(error.find("scene.json:2:5: b: not valid JSON: a colon is missing here"), std::string::npos) << error;
}

TEST(SceneReader, RefusesTextsThatAreNoObject) {
  EXPECT_EQ(error_of(""), "scene.json: is empty, expected a JSON object");
  EXPECT_EQ(error_of("[1]"), "scene.json:1:1: found an array, expected an object");
  EXPECT_EQ(error_of(std::string("\x7f"
                                 "ELF\0\0",
                                 6)),
            "scene.json: holds binary data, expected a JSON text");
  EXPECT_NE(error_of("{\"a\": \"\xff\"}").find("not valid JSON"), std::string::npos);
}

TEST(SceneReader, NamesAMissingFileAndADirectory) {
  EXPECT_EQ(error_of_file("/nowhere/x.json"), "/nowhere/x.json: no such file");
  EXPECT_EQ(error_of_file("/tmp"), "/tmp: is a directory, expected a scene file");
}

TEST(SceneReader, RefusesAGigabyteWithoutReadingIt) {
  TemporaryFile file;
  std::ofstream(file.path()) << "{}";
  std::filesystem::resize_file(file.path(), 1ull << 30);  // sparse
  EXPECT_EQ(error_of_file(file.path()), file.path() + ": has 1073741824 bytes; a scene has at most 67108864 (64 MiB)");
}

TEST(SceneReader, TypedReadersSayWhatWasFoundAndExpected) {
  const Scene scene = Scene::parse("{\"n\": \"3\", \"i\": 3.7, \"b\": 1, \"t\": [], \"v\": [1, true]}", "s");
  Problems problems;
  const Value& root = scene.root();
  EXPECT_FALSE(root.find("n")->read_number(problems));
  EXPECT_FALSE(root.find("i")->read_integer(problems));
  EXPECT_FALSE(root.find("b")->read_boolean(problems));
  EXPECT_FALSE(root.find("t")->read_text(problems));
  EXPECT_FALSE(root.find("v")->read_numbers(problems));
  ASSERT_EQ(problems.errors().size(), 5u);
  EXPECT_EQ(problems.errors()[0].message, "found the text \"3\", expected a number (an expression starts with \"=\")");
  EXPECT_EQ(problems.errors()[1].message, "found 3.7, expected a whole number");
  EXPECT_EQ(problems.errors()[2].message, "found a number, expected true or false");
  EXPECT_EQ(problems.errors()[3].message, "found an array, expected a text");
  EXPECT_EQ(problems.errors()[4].path, "v[1]");
}

TEST(SceneHash, IgnoresCommentsSpaceAndOrder) {
  EXPECT_EQ(Scene::parse("{\"a\": 1, \"b\": [2, 3]}", "x").hash(),
            Scene::parse("{ /* note */ \"b\": [2, 3.0],\n\"a\": 1}", "y").hash());
  EXPECT_NE(Scene::parse("{\"a\": 1}", "x").hash(), Scene::parse("{\"a\": 2}", "x").hash());
  EXPECT_NE(Scene::parse("{\"a\": [1, 2]}", "x").hash(), Scene::parse("{\"a\": [2, 1]}", "x").hash());
}

}  // namespace
}  // namespace trammel::scene
