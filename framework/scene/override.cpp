#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scene/builder.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {

namespace {

void place_everywhere(Value& value, const Position& at) {
  if (value.type() == Value::Type::array) {
    for (Value& item : Builder::items(value)) place_everywhere(item, at);
  } else if (value.type() == Value::Type::object) {
    for (auto& [name, member] : Builder::members(value)) place_everywhere(member, at);
  }
  Builder::place(value, at);
}

// JSON where it reads as JSON, else the bare text.
Value parse_value(const std::string& text, const Position& at) {
  const std::string wrapped = "{\"value\":" + text + "\n}";
  if (!nlohmann::json::accept(text, true)) return Builder::make(text, at);
  Value root = parse_text(wrapped, at.file);
  Value value = std::move(*Builder::find(root, "value"));
  place_everywhere(value, at);
  return value;
}

}  // namespace

void apply(const Override& override, Value& root) {
  const Position at = {fmt::format("--set {}={}", override.path, override.value), 0, 0};
  const auto fail = [&](std::string path, std::string message) {
    throw SceneError({{at, std::move(path), std::move(message)}});
  };
  Value* value = &root;
  std::string walked, rest = override.path;
  for (;;) {
    const auto dot = rest.find('.');
    std::string key = rest.substr(0, dot);
    std::optional<std::size_t> index;
    if (const auto bracket = key.find('['); bracket != std::string::npos && key.back() == ']') {
      const std::string digits = key.substr(bracket + 1, key.size() - bracket - 2);
      if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string::npos)
        fail(override.path, fmt::format("found the index \"{}\", expected a whole number from 0", digits));
      index = std::stoul(digits);
      key.resize(bracket);
    }
    if (key.empty()) fail(override.path, "found an empty name in the path; write --set path.to.value=VALUE");
    if (value->type() != Value::Type::object)
      fail(walked, fmt::format("is {}, it has no member \"{}\"", value->type_name(), key));
    const bool last = dot == std::string::npos;
    Value* next = Builder::find(*value, key);
    const bool parameter = walked == "parameters";  // one that the scene does not declare would act on nothing
    if (!next && (index || parameter || (!last && value != &root))) {
      std::vector<std::string> names;
      for (const auto& [name, member] : value->members()) names.push_back(name);
      fail(walked, fmt::format("has no member \"{}\"{}", key, did_you_mean(key, names)));
    }
    if (!next) {
      Builder::members(*value).emplace_back(key, Builder::make(Members(), at));
      next = &Builder::members(*value).back().second;
    }
    walked += (walked.empty() ? "" : ".") + key;
    if (index) {
      if (next->type() != Value::Type::array || *index >= next->items().size())
        fail(walked, fmt::format("has no element [{}]", *index));
      next = &Builder::items(*next)[*index];
      walked += fmt::format("[{}]", *index);
    }
    value = next;
    if (last) break;
    rest = rest.substr(dot + 1);
  }
  *value = parse_value(override.value, at);
}

}  // namespace trammel::scene
