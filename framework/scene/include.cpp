#include <filesystem>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "scene/builder.hpp"
#include "scene/files.hpp"
#include "scene/limits.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {

namespace {

namespace fs = std::filesystem;

bool another_type(const Value& base, const Value& over) {
  const Value *a = base.find("type"), *b = over.find("type");
  return a && b && a->type() == Value::Type::text && b->type() == Value::Type::text && a->text() != b->text();
}

// A file outside the scene's folder may be any file that this user can read: it is accepted only if it is a scene.
bool is_scene(const Value& root) {
  for (const char* key : {"trammel", "parameters", "bodies", "joints", "forces", "contacts", "integrator", "simulate"})
    if (root.find(key)) return true;
  return false;
}

class Includes {
 public:
  explicit Includes(const std::string& file) : folder_(fs::path(file).parent_path()) { enter(file); }

  Value resolve(Value&& root, const std::string& file) {
    Value* include = Builder::find(root, "include");
    if (!include) return std::move(root);
    Builder::finish(*include, "include", nullptr);
    Value base = Builder::make(Members(), root.position());
    if (include->type() == Value::Type::array) {
      for (const Value& entry : include->items()) merge(base, included(entry, file));
    } else {
      merge(base, included(*include, file));
    }
    std::erase_if(Builder::members(root), [](const auto& member) { return member.first == "include"; });
    merge(base, std::move(root));
    return base;
  }

 private:
  struct Link {
    std::string name;  // as written
    fs::path unique;
  };

  Value included(const Value& entry, const std::string& file) {
    if (entry.type() != Value::Type::text)
      throw SceneError({entry.problem(fmt::format("found {}, expected the name of a file", entry.type_name()))});
    const std::string next = (fs::path(file).parent_path() / entry.text()).string();
    enter(next, &entry);
    Value resolved = resolve(read(entry, next), next);
    chain_.pop_back();
    if (!is_within(folder_, next) && !is_scene(resolved))
      refuse(entry, "it lies outside this scene's folder and is no scene");
    return resolved;
  }

  void enter(const std::string& file, const Value* entry = nullptr) {
    std::error_code error;
    const fs::path unique = fs::weakly_canonical(file, error);
    for (const Link& link : chain_)
      if (link.unique == unique) {
        std::string text = "includes go round in a circle: ";
        for (const Link& known : chain_) text += known.name + " -> ";
        throw SceneError({entry->problem(text + file)});
      }
    if (chain_.size() > limits::nested)
      throw SceneError({entry->problem(fmt::format("includes are nested deeper than {} files", limits::nested))});
    if (files_++ > limits::files)
      throw SceneError({entry->problem(
          fmt::format("the scene includes more than {} files, each counted as often as it is named", limits::files))});
    chain_.push_back({file, unique});
  }

  Value read(const Value& entry, const std::string& file) {
    std::string text;
    try {
      text = read_named_file(file);
    } catch (const SceneError& problem) {
      refuse(entry, problem.what());
    }
    if ((bytes_ += text.size()) > limits::bytes)
      refuse(entry, fmt::format("with it, the scene's files have more than {} bytes (64 MiB)", limits::bytes));
    Value root = parsed(entry, text, file);
    if ((values_ += Builder::size(root)) > limits::values)
      refuse(entry, fmt::format("with it, the scene has more than {} values", limits::values));
    return root;
  }

  // Nothing is quoted from a file outside the scene's folder: the author of the scene may not be allowed to read it.
  Value parsed(const Value& entry, const std::string& text, const std::string& file) {
    if (is_within(folder_, file)) return parse_text(text, file);
    Position at;
    try {
      return parse_text(text, file);
    } catch (const SceneError& error) {
      at = error.problems().front().at;
    }
    refuse(entry, fmt::format("it is no scene, see its line {}, which is not quoted because the file lies outside this "
                              "scene's folder",
                              at.line));
  }

  [[noreturn]] static void refuse(const Value& entry, const std::string& why) {
    throw SceneError({entry.problem(fmt::format("cannot include \"{}\": {}", shortened(entry.text()), why))});
  }

  fs::path folder_;          // of the scene
  std::vector<Link> chain_;  // the files being read, each included by the one before
  int files_ = 0;
  std::size_t bytes_ = 0, values_ = 0;
};

Problem nothing_to_remove(const Value& base, const std::string& name, const Value& null) {
  std::vector<std::string> names;
  for (const auto& [other, value] : base.members()) names.push_back(other);
  return {null.position(), name,
          fmt::format("null removes a member of what is included, which has no \"{}\" here{}", name,
                      did_you_mean(name, names))};
}

}  // namespace

void merge(Value& base, Value&& over) {
  if (base.type() != Value::Type::object || over.type() != Value::Type::object || another_type(base, over)) {
    base = std::move(over);
    return;
  }
  Members& members = Builder::members(base);
  std::unordered_map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < members.size(); ++i) places.emplace(members[i].first, i);
  std::unordered_set<std::string> removed;
  for (auto& [name, member] : Builder::members(over)) {
    const auto present = places.find(name);
    if (member.type() == Value::Type::null) {
      if (present == places.end()) throw SceneError({nothing_to_remove(base, name, member)});
      removed.insert(name);
    } else if (present != places.end()) {
      merge(members[present->second].second, std::move(member));
    } else {
      members.emplace_back(name, std::move(member));
    }
  }
  if (!removed.empty()) std::erase_if(members, [&](const auto& member) { return removed.contains(member.first); });
}

Value resolve_includes(Value&& root, const std::string& file) {
  return Includes(file).resolve(std::move(root), file);
}

}  // namespace trammel::scene
