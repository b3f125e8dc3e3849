// The reader of scenes: any text is read, or refused with a SceneError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "scene/expression.hpp"
#include "scene/value.hpp"

namespace {

using namespace trammel::scene;

// As components ask for it.
void read_all(const Value& value, Problems& problems) {
  value.read_number(problems), value.read_integer(problems), value.read_boolean(problems);
  value.read_text(problems), value.read_numbers(problems);
  if (const auto law = value.read_time_function(problems)) (*law)(0.5);
  if (value.type() == Value::Type::array) {
    for (const Value& item : value.items()) read_all(item, problems);
  } else if (value.type() == Value::Type::object) {
    for (const auto& [name, member] : value.members()) read_all(member, problems);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    // In a folder that is not there: what it includes is missing.
    const Scene scene = Scene::parse(text, "/no such folder/scene.json");
    Problems problems;
    read_all(scene.root(), problems);
  } catch (const SceneError&) {
  }
  return 0;
}
