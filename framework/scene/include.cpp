#include <filesystem>

#include <fmt/format.h>

#include "scene/builder.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {

namespace {

bool another_type(const Value& base, const Value& over) {
  const Value *a = base.find("type"), *b = over.find("type");
  return a && b && a->type() == Value::Type::text && b->type() == Value::Type::text && a->text() != b->text();
}

using Chain = std::vector<std::pair<std::string, std::filesystem::path>>;  // as written, and made unique

Value resolve(Value&& root, const std::string& file, Chain& chain);

Value included(const Value& entry, const std::string& file, Chain& chain) {
  if (entry.type() != Value::Type::text)
    throw SceneError({entry.problem(fmt::format("found {}, expected the name of a file", entry.type_name()))});
  const auto next = std::filesystem::path(file).parent_path() / entry.text();
  std::error_code error;
  const auto unique = std::filesystem::weakly_canonical(next, error);
  for (const auto& [name, known] : chain)
    if (known == unique) {
      std::string text = "includes go round in a circle: ";
      for (const auto& link : chain) text += link.first + " -> ";
      throw SceneError({entry.problem(text + next.string())});
    }
  std::string text;
  try {
    text = read_file(next.string());
  } catch (const SceneError& problem) {
    throw SceneError({entry.problem(fmt::format("cannot include \"{}\": {}", entry.text(), problem.what()))});
  }
  chain.emplace_back(next.string(), unique);
  Value resolved = resolve(parse_text(text, next.string()), next.string(), chain);
  chain.pop_back();
  return resolved;
}

Problem nothing_to_remove(const Value& base, const std::string& name, const Value& null) {
  std::vector<std::string> names;
  for (const auto& [other, value] : base.members()) names.push_back(other);
  return {null.position(), name,
          fmt::format("null removes a member of what is included, which has no \"{}\" here{}", name,
                      did_you_mean(name, names))};
}

Value resolve(Value&& root, const std::string& file, Chain& chain) {
  Value* include = Builder::find(root, "include");
  if (!include) return std::move(root);
  Builder::finish(*include, "include", nullptr);
  Value base = Builder::make(Members(), root.position());
  if (include->type() == Value::Type::array) {
    for (const Value& entry : include->items()) merge(base, included(entry, file, chain));
  } else {
    merge(base, included(*include, file, chain));
  }
  std::erase_if(Builder::members(root), [](const auto& member) { return member.first == "include"; });
  merge(base, std::move(root));
  return base;
}

}  // namespace

void merge(Value& base, Value&& over) {
  if (base.type() != Value::Type::object || over.type() != Value::Type::object || another_type(base, over)) {
    base = std::move(over);
    return;
  }
  for (auto& [name, member] : Builder::members(over)) {
    Value* present = Builder::find(base, name);
    if (member.type() == Value::Type::null) {
      if (!present) throw SceneError({nothing_to_remove(base, name, member)});
      std::erase_if(Builder::members(base), [&](const auto& other) { return other.first == name; });
    } else if (present) {
      merge(*present, std::move(member));
    } else {
      Builder::members(base).emplace_back(name, std::move(member));
    }
  }
}

Value resolve_includes(Value&& root, const std::string& file) {
  std::error_code error;
  Chain chain = {{file, std::filesystem::weakly_canonical(file, error)}};
  return resolve(std::move(root), file, chain);
}

}  // namespace trammel::scene
