// trammel new KIND NAME: a folder with a complete plugin to change.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "arguments.hpp"
#include "plugin/registry.hpp"
#include "plugin_templates.hpp"  // written by CMake from templates/
#include "scene/suggestion.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

constexpr Option kInto{"--out", "DIR", "where the folder NAME is made; the current folder if left out"};

struct KindOfPlugin {
  std::string name, header, use;
};
const std::vector<KindOfPlugin>& kinds() {
  static const std::vector<KindOfPlugin> all = {
      {"integrator", "integrator.hpp", "\"integrator\": {\"type\": \"my_component\", \"step\": 1e-3}"},
      {"body", "body.hpp", "\"bodies\": {\"a\": {\"type\": \"my_component\"}}"},
      {"joint", "joint.hpp", "\"joints\": {\"a\": {\"type\": \"my_component\", \"between\": [A, B]}}"},
      {"force", "force.hpp", "\"forces\": {\"a\": {\"type\": \"my_component\", \"between\": [A, B]}}"},
      {"contact", "contact.hpp",
       "\"contacts\": {\"a\": {\"type\": \"my_component\", \"between\": [A, {\"plane\": ...}]}}"},
      {"friction", "friction.hpp", "\"friction\": {\"type\": \"my_component\"} inside a contact or joint"},
      {"correction", "correction.hpp", "\"corrections\": {\"position\": \"my_component\"}"},
  };
  return all;
}

const KindOfPlugin& kind_of(const std::string& name) {
  std::vector<std::string> names;
  for (const KindOfPlugin& kind : kinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw UsageError(fmt::format("there is no kind of plugin '{}'{}", name, scene::did_you_mean(name, names)));
}

// Component, file, target and (without its underscores) class have this name.
void require_name(const std::string& name) {
  const bool starts = !name.empty() && 'a' <= name.front() && name.front() <= 'z';
  const bool allowed =
      std::ranges::all_of(name, [](char c) { return ('a' <= c && c <= 'z') || ('0' <= c && c <= '9') || c == '_'; });
  if (!starts || !allowed)
    throw UsageError(
        fmt::format("'{}' cannot name a component: expected a lower-case letter, then lower-case letters, digits "
                    "and _, such as my_method",
                    name));
  if (name == "test" || name == "all" || name == "clean" || name == "install" || name == "trammel")
    throw UsageError(fmt::format("'{}' cannot name a component: CMake has a target of that name", name));
  plugin::Registry registry;
  for (const plugin::Entry* entry : registry.all())
    if (entry->declaration.name == name)
      throw UsageError(fmt::format("'{}' is {} {} of {}; choose another name", name,
                                   entry->declaration.kind == Kind::integrator ? "an" : "a",
                                   to_string(entry->declaration.kind), entry->file));
}

// my_method: MyMethod
std::string class_name(const std::string& name) {
  std::string text;
  bool capital = true;
  for (const char c : name) {
    if (c != '_') text += capital ? char(std::toupper(static_cast<unsigned char>(c))) : c;
    capital = c == '_';
  }
  return text;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string filled_in(std::string text, const KindOfPlugin& kind, const std::string& name) {
  replace_all(text, "USE", kind.use);
  replace_all(text, "my_component", name);
  replace_all(text, "my_" + kind.name, name);
  replace_all(text, class_name("my_" + kind.name), class_name(name));
  replace_all(text, "KIND", kind.name);
  replace_all(text, "HEADER", kind.header);
  replace_all(text, ", to change", "");
  return text;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: {}", file.string(), std::strerror(errno)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error))
    throw UsageError(
        fmt::format("{} exists already; expected a name that is free, or --out for another place", folder.string()));
  if (!fs::create_directories(folder, error)) throw UsageError(fmt::format("{}: {}", folder.string(), error.message()));
}

Exit make_plugin(const Arguments& a) {
  if (a.operands().size() != 2)
    throw UsageError(
        fmt::format("'trammel new' takes a KIND and a NAME, found {} words: trammel new integrator my_method",
                    a.operands().size()));
  const KindOfPlugin& kind = kind_of(a.operands()[0]);
  const std::string& name = a.operands()[1];
  require_name(name);
  const fs::path folder = fs::path(a.has("--out") ? a.last("--out") : ".") / name;
  make_folder(folder);
  for (const PluginTemplate& file : plugin_templates)
    if (file.folder == kind.name || file.folder == "common") {
      const std::string text = filled_in(std::string(file.text), kind, name);
      write(folder / filled_in(std::string(file.name), kind, name), text);
    }
  const std::string quoted = shell_quoted(folder.lexically_normal().string());
  fmt::print(
      "{} holds a complete {} to change: {}.cpp, CMakeLists.txt, test.cpp, README.md\n"
      "next: cd {} && cmake -B build && cmake --build build && trammel check build/{}.so\n",
      quoted, kind.name, name, quoted, name);
  return Exit::done;
}

}  // namespace

Command new_command() {
  return {
      "new",
      "KIND NAME",
      "Write a folder with a complete plugin to change: integrator, body, joint, force, contact, friction, correction.",
      {kInto},
      make_plugin,
      2};
}

}  // namespace trammel::tool
