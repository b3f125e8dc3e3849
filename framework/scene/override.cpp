#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scene/builder.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {

namespace {

void place_everywhere(Value& value, const Value& at) {
  if (value.type() == Value::Type::array) {
    for (Value& item : Builder::items(value)) place_everywhere(item, at);
  } else if (value.type() == Value::Type::object) {
    for (auto& [name, member] : Builder::members(value)) place_everywhere(member, at);
  }
  Builder::place(value, at);
}

// nan, 1e999: numbers in C, but not in a scene.
bool not_finite(const std::string& text) {
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  return !text.empty() && end == text.c_str() + text.size() && !std::isfinite(x);
}

// The keys of these objects are names that the scene defines: an unknown key is a spelling mistake.
bool keyed_by_name(std::string_view path) {
  return path == "bodies" || path == "joints" || path == "forces" || path == "contacts" || path == "parameters";
}

// Settings that become an object if the path continues into them: "step": 1e-3 and integrator.step.tolerance. Their
// readers check the member.
bool scalar(const Value& value) {
  using Type = Value::Type;
  return value.type() == Type::number || value.type() == Type::text || value.type() == Type::boolean;
}

// The value as JSON if it is valid JSON, else as a text.
Value parse_value(const std::string& text, const Position& at) {
  const std::string wrapped = "{\"value\":" + text + "\n}";
  if (!nlohmann::json::accept(text, true)) return Builder::make(text, at);
  Value root = parse_text(wrapped, at.file);
  Value value = std::move(*Builder::find(root, "value"));
  place_everywhere(value, Builder::make({}, at));
  return value;
}

}  // namespace

void apply(const Override& override, Value& root) {
  const Position at = {fmt::format("--set {}={}", override.path, shortened(override.value)), 0, 0};
  const auto fail = [&](std::string path, std::string message) {
    throw SceneError({{at, std::move(path), std::move(message)}});
  };
  if (not_finite(override.value))
    fail(override.path, fmt::format("found {}, expected a finite number (a text of these letters: '\"{}\"')",
                                    override.value, override.value));
  Value *value = &root, *owner = nullptr;
  bool present = true;
  std::string last_key;
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
    if (scalar(*value) && owner != &root && !index) *value = Builder::make(Members(), at);
    if (value->type() != Value::Type::object)
      fail(walked, fmt::format("is {}, it has no member \"{}\"", value->type_name(), key));
    const bool last = dot == std::string::npos;
    Value* next = Builder::find(*value, key);
    // A parameter that the scene does not declare would have no effect.
    if (!next && (index || walked == "parameters" || (!last && keyed_by_name(walked)))) {
      std::vector<std::string> names;
      for (const auto& [name, member] : value->members()) names.push_back(name);
      fail(walked, fmt::format("has no member \"{}\"{}", key, did_you_mean(key, names)));
    }
    present = next != nullptr;
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
    owner = index ? nullptr : value, last_key = key;
    value = next;
    if (last) break;
    rest = rest.substr(dot + 1);
  }
  Value given = parse_value(override.value, at);
  const bool was_number = walked.starts_with("parameters.") && value->type() == Value::Type::number;
  if (was_number && given.type() == Value::Type::text && !given.text().starts_with("="))
    fail(
        walked,
        fmt::format("found the text \"{}\", expected a number or an expression (\"=...\"): it is a number in the scene",
                    shortened(given.text())));
  const bool removes = owner && given.type() == Value::Type::null;
  if (removes && !present) fail(walked, "null removes a member, and there is none");
  if (removes)
    std::erase_if(Builder::members(*owner), [&](const auto& member) { return member.first == last_key; });
  else
    *value = std::move(given);
}

}  // namespace trammel::scene
