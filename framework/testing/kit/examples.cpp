#include "testing/kit/examples.hpp"

#include <nlohmann/json.hpp>

#include "kit_examples.hpp"  // examples.json as text, written by CMake

namespace trammel::kit {

Example example_of(const std::string& kind, const std::string& name) {
  using Json = nlohmann::ordered_json;
  static const Json all = Json::parse(examples_text);
  Example example;
  const auto of_kind = all.find(kind);
  if (of_kind == all.end()) return example;
  const auto found = of_kind->find(name);
  if (found == of_kind->end()) return example;
  const Json entries = found->value("entries", Json::array());
  for (const Json& entry : entries) {
    Json object = {{"type", name}};
    object.update(entry);
    example.entries.push_back(object.dump());
  }
  const Json expected = found->value("expected", Json::object());
  for (const auto& [check, reason] : expected.items()) example.expected[check] = reason.get<std::string>();
  return example;
}

}  // namespace trammel::kit
