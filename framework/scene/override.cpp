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

// One step of a path: "key" or "key[2]".
struct PathStep {
  std::string key;
  std::optional<std::size_t> index;
};

// Walks along the path from the root, by objects that it creates where there are none, and sets the value at its end.
class Overriding {
 public:
  Overriding(const Override& override, Value& root)
      : override_(override),
        at_{fmt::format("--set {}={}", override.path, shortened(override.value)), 0, 0},
        root_(root),
        value_(&root) {}

  void apply() {
    if (not_finite(override_.value))
      fail(override_.path, fmt::format("found {}, expected a finite number (a text of these letters: '\"{}\"')",
                                       override_.value, override_.value));
    std::string rest = override_.path;
    for (bool last = false; !last;) {
      const auto dot = rest.find('.');
      last = dot == std::string::npos;
      enter(parse_step(rest.substr(0, dot)), last);
      if (!last) rest = rest.substr(dot + 1);
    }
    replace_or_remove();
  }

 private:
  [[noreturn]] void fail(std::string path, std::string message) const {
    throw SceneError({{at_, std::move(path), std::move(message)}});
  }

  PathStep parse_step(std::string key) const {
    std::optional<std::size_t> index;
    if (const auto bracket = key.find('['); bracket != std::string::npos && key.back() == ']') {
      const std::string digits = key.substr(bracket + 1, key.size() - bracket - 2);
      if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string::npos)
        fail(override_.path, fmt::format("found the index \"{}\", expected a whole number from 0", digits));
      index = std::stoul(digits);
      key.resize(bracket);
    }
    if (key.empty()) fail(override_.path, "found an empty name in the path; write --set path.to.value=VALUE");
    return {key, index};
  }

  void enter(const PathStep& step, bool last) {
    if (scalar(*value_) && owner_ != &root_ && !step.index) *value_ = Builder::make(Members(), at_);
    if (value_->type() != Value::Type::object)
      fail(walked_, fmt::format("is {}, it has no member \"{}\"", value_->type_name(), step.key));
    Value* next = Builder::find(*value_, step.key);
    present_ = next != nullptr;
    if (!present_ && must_exist(step, last)) fail_absent(step.key);
    if (!present_) {
      Builder::members(*value_).emplace_back(step.key, Builder::make(Members(), at_));
      next = &Builder::members(*value_).back().second;
    }
    walked_ += (walked_.empty() ? "" : ".") + step.key;
    if (step.index) next = &element(*next, *step.index);
    owner_ = step.index ? nullptr : value_, last_key_ = step.key;
    value_ = next;
  }

  // A parameter that the scene does not declare would have no effect.
  bool must_exist(const PathStep& step, bool last) const {
    return step.index || walked_ == "parameters" || (!last && keyed_by_name(walked_));
  }

  [[noreturn]] void fail_absent(const std::string& key) const {
    std::vector<std::string> names;
    for (const auto& [name, member] : value_->members()) names.push_back(name);
    fail(walked_, fmt::format("has no member \"{}\"{}", key, did_you_mean(key, names)));
  }

  Value& element(Value& list, std::size_t index) {
    if (list.type() != Value::Type::array || index >= list.items().size())
      fail(walked_, fmt::format("has no element [{}]", index));
    walked_ += fmt::format("[{}]", index);
    return Builder::items(list)[index];
  }

  void replace_or_remove() {
    Value given = parse_value(override_.value, at_);
    const bool was_number = walked_.starts_with("parameters.") && value_->type() == Value::Type::number;
    if (was_number && given.type() == Value::Type::text && !given.text().starts_with("="))
      fail(walked_, fmt::format("found the text \"{}\", expected a number or an expression (\"=...\"): it is a number "
                                "in the scene",
                                shortened(given.text())));
    const bool removes = owner_ && given.type() == Value::Type::null;
    if (removes && !present_) fail(walked_, "null removes a member, and there is none");
    if (removes)
      std::erase_if(Builder::members(*owner_), [&](const auto& member) { return member.first == last_key_; });
    else
      *value_ = std::move(given);
  }

  const Override& override_;
  const Position at_;
  Value& root_;
  Value *value_, *owner_ = nullptr;  // where the walk has arrived, and the object that has it as a member
  bool present_ = true;              // the scene has this member
  std::string last_key_, walked_;
};

}  // namespace

void apply(const Override& override, Value& root) {
  Overriding(override, root).apply();
}

}  // namespace trammel::scene
