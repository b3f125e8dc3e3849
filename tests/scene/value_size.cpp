// What the values of a scene take: scenes may have 30 million.
#include <malloc.h>

#include <gtest/gtest.h>

#include "scene/builder.hpp"

namespace trammel::scene {
namespace {

std::size_t allocated() {
  const struct mallinfo2 now = mallinfo2();
  return now.uordblks + now.hblkhd;
}

double bytes_of_a_value(const std::string& text) {
  const std::size_t before = allocated();
  const Scene scene = Scene::parse(text, "a folder of scenes/of a project with a long name/and a scene.json");
  return double(allocated() - before) / double(Builder::size(scene.root()));
}

// 112 bytes of a value itself, whatever the lengths of the file's name and of the paths. As many numbers as the array
// has room for.
TEST(ValueSize, OfNumbersIsThatOfAValue) {
  std::string text = R"({"trammel": 1, "bodies": {"a_body": {"a_long_list": [1)";
  for (int i = 1; i < 1 << 16; ++i) text += ",1";
  EXPECT_LT(bytes_of_a_value(text + "]}}}"), 115);
}

// Behind each value its key, before it what an object's members have in common.
TEST(ValueSize, OfRepeatedUnitsIsThatOfAValueAndItsKey) {
  const std::string text = R"({"trammel": 1, "bodies": {"strut_{i}": {"for": {"i": 4096}, "type": "bar",
    "from": ["={i}*0.1", 0], "to": ["=({i}+1)*0.1", 0], "area": 1e-4, "youngs_modulus": 1e9, "density": 1}}})";
  EXPECT_LT(bytes_of_a_value(text), 260);
}

TEST(ValueSize, DoesNotCostItsPlaceAndPath) {
  const Scene scene =
      Scene::parse("{\"trammel\": 1,\n \"bodies\": {\"a\": {\"list\": [1, {\"k\": 2}]}}}", "scene.json");
  const Value copy = *scene.root().at_path("bodies.a.list");
  EXPECT_EQ(copy.path(), "bodies.a.list");
  EXPECT_EQ(copy.items()[1].path(), "bodies.a.list[1]");
  EXPECT_EQ(copy.items()[1].find("k")->problem("wrong").text(), "scene.json:2:37: bodies.a.list[1].k: wrong");
  EXPECT_EQ(scene.root().path(), "");
}

}  // namespace
}  // namespace trammel::scene
