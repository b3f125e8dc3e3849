#include "study/cases/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace trammel::study {

std::string json_text(const scene::Value& value) {
  std::string text;
  switch (value.type()) {
    case scene::Value::Type::null:
      return "null";
    case scene::Value::Type::boolean:
      return value.boolean() ? "true" : "false";
    case scene::Value::Type::number:
      return fmt::format("{}", value.number());
    case scene::Value::Type::text:
      return nlohmann::json(value.text()).dump();
    case scene::Value::Type::array:
      for (const scene::Value& item : value.items()) text += (text.empty() ? "" : ",") + json_text(item);
      return "[" + text + "]";
    case scene::Value::Type::object:
      for (const auto& [name, member] : value.members())
        text += (text.empty() ? "" : ",") + nlohmann::json(name).dump() + ":" + json_text(member);
      return "{" + text + "}";
  }
  return text;
}

std::string without_quotes(const std::string& json_text) {
  const auto parsed = nlohmann::json::parse(json_text, nullptr, false);
  return parsed.is_string() ? parsed.get<std::string>() : json_text;
}

}  // namespace trammel::study
