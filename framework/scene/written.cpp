// Writes a tree of values as one scene file that needs no other scene file.
#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "scene/builder.hpp"

namespace trammel::scene {
namespace {

using json = nlohmann::ordered_json;

// Whole numbers without ".0", as people write them.
json number(double x) {
  constexpr double exact = 9007199254740992.0;  // 2^53
  const bool whole = x == std::trunc(x) && std::abs(x) < exact && !(x == 0 && std::signbit(x));
  return whole ? json(static_cast<long long>(x)) : json(x);
}

std::string absolute(const Value& name) {
  const std::filesystem::path folder = std::filesystem::path(name.position().file).parent_path();
  return std::filesystem::absolute(folder / name.text()).lexically_normal().string();
}

bool is_plain_text(const Value& value) {
  return value.type() == Value::Type::text && !value.text().starts_with("=");
}

// True for "table": FILE of a law of time, not for a parameter or column of that name.
bool names_a_table(const Value& value, const std::string& key) {
  const std::string& path = value.path();
  return key == "table" && is_plain_text(value) && !path.starts_with("record.") && !path.starts_with("parameters.");
}

json written_value(const Value& value) {
  switch (value.type()) {
    case Value::Type::null:
      return nullptr;
    case Value::Type::boolean:
      return value.boolean();
    case Value::Type::number:
      return number(value.number());
    case Value::Type::text:
      return value.text();
    case Value::Type::array: {
      json items = json::array();
      for (const Value& item : value.items()) {
        const bool library = value.path() == "plugins" && is_plain_text(item);
        items.push_back(library ? json(absolute(item)) : written_value(item));
      }
      return items;
    }
    case Value::Type::object: {
      json members = json::object();
      for (const auto& [key, member] : value.members())
        members[key] = names_a_table(member, key) ? json(absolute(member)) : written_value(member);
      return members;
    }
  }
  return nullptr;
}

}  // namespace

std::string written(const Value& root) {
  return written_value(root).dump(2) + "\n";
}

}  // namespace trammel::scene
