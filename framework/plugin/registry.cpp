#include "plugin/registry.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>
#include <cstdlib>
#include <new>
#include <tuple>

#include "plugin/breadcrumb.hpp"
#include "plugin/fingerprint.hpp"
#include "plugin/library_section.hpp"
#include "plugin/process/left_out.hpp"
#include "plugin/process/place.hpp"
#include "plugin/process/settings.hpp"
#include "plugin/rehearsal.hpp"
#include "plugin/seal.hpp"
#include "scene/files.hpp"
#include "scene/no_memory.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::plugin {

namespace fs = std::filesystem;

namespace {

constexpr const char* extension = ".so";

std::string full_path(const fs::path& file) {
  std::error_code error;
  const fs::path path = fs::canonical(file, error);
  scene::require_memory(error.value());
  return (error ? fs::absolute(file) : path).string();
}

// <prefix>/lib/trammel beside <prefix>/lib/libtrammel.so; the same in a build folder.
fs::path installed_folder() {
  return libraries_folder() / "trammel";
}

// Empty if there is none.
fs::path users_folder() {
  const char *data = std::getenv("XDG_DATA_HOME"), *home = std::getenv("HOME");
  if (data && fs::path(data).is_absolute()) return fs::path(data) / "trammel/plugins";
  return home && fs::path(home).is_absolute() ? fs::path(home) / ".local/share/trammel/plugins" : fs::path();
}

// Executes the library's code.
const Declarations& open(const std::string& file, const char* call) {
  namespace dll = boost::dll;
  const Origin origin{file, "", ""};
  const Breadcrumb goes_on(origin, call);  // may still end the process here, in spite of the rehearsal
  const ProcessSettings settings;
  const ProcessPlace place;
  dll::shared_library library;
  boost::dll::fs::error_code failed;
  library.load(file, dll::load_mode::rtld_now | dll::load_mode::rtld_local, failed);
  if (failed) {
    const char* text = ::dlerror();  // Boost.DLL's text is an unrelated errno
    if (text && tells_of_no_memory(text)) throw std::bad_alloc();
    throw PluginError(file, text ? text : "cannot be loaded");
  }
  // The library is never unloaded: its objects, exceptions and texts may outlive every handle.
  ::dlopen(file.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  if (!library.has(entry_point))
    throw PluginError(file, fmt::format("it exports no function {}; is it hidden by a linker script?", entry_point));
  try {
    return *library.get<const Declarations*()>(entry_point)();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw PluginError(file, fmt::format("it threw while declaring its components: {}", e.what()));
  } catch (...) {
    throw PluginError(file, "it threw something that is no std::exception while declaring its components");
  }
}

bool is_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return ('a' <= c && c <= 'z') || ('0' <= c && c <= '9') || c == '_';
  });
}

const char* article(std::string_view kind) {
  return kind.starts_with('i') ? "an" : "a";
}

// Checks errors in declarations that the builder's types cannot exclude.
void require_sound(const Declaration& declaration, const std::string& file) {
  const auto refuse = [&](const std::string& cause) {
    throw PluginError(
        file, fmt::format("{} \"{}\": {}", to_string(declaration.kind), scene::shortened(declaration.name), cause));
  };
  if (!is_name(declaration.name)) refuse("a component's name has lower-case letters, digits and _ only");
  for (auto p = declaration.parameters.begin(); p != declaration.parameters.end(); ++p) {
    if (p->name.empty()) refuse("a parameter has no name");
    for (auto other = declaration.parameters.begin(); other != p; ++other)
      if (other->name == p->name || other->name.starts_with(p->name + ".") || p->name.starts_with(other->name + "."))
        refuse(fmt::format("parameters \"{}\" and \"{}\" would share a key", other->name, p->name));
  }
}

std::vector<fs::path> libraries_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  const fs::directory_iterator items(folder, error);
  scene::require_memory(error.value());
  for (const auto& item : items)
    if (item.path().extension() == extension && !item.is_directory(error)) files.push_back(item.path());
  std::sort(files.begin(), files.end());  // the same order on every machine
  return files;
}

}  // namespace

Origin Entry::origin(std::string scene_path) const {
  return {file, fmt::format("{} {}", to_string(declaration.kind), declaration.name), std::move(scene_path)};
}

fs::path libraries_folder() {
  return fs::path(boost::dll::this_line_location().parent_path().string());
}

Registry::Registry(Start start) {
  if (start == Start::empty) return;
  std::error_code error;
  for (const fs::path& folder : {installed_folder(), users_folder()})
    if (fs::is_directory(folder, error)) folders_.push_back(folder);
  const char* variable = std::getenv("TRAMMEL_PLUGIN_PATH");
  std::string_view paths = variable ? variable : "";
  while (!paths.empty()) {
    const std::string_view path = paths.substr(0, paths.find(':'));
    if (!path.empty()) search(path);
    paths.remove_prefix(std::min(paths.size(), path.size() + 1));
  }
}

void Registry::search(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return load(path);
  folders_.push_back(path);
  names_looked_for_.clear();
  folders_loaded_ = false;
}

void Registry::search_scene(const scene::Value& root, scene::Problems& problems) {
  const scene::Value* plugins = root.find("plugins");
  if (!plugins) return;
  if (plugins->type() != scene::Value::Type::array) {
    problems.error(
        plugins->problem(fmt::format("expected an array of files and folders, found {}", plugins->type_name())));
    return;
  }
  for (const scene::Value& item : plugins->items()) {
    const auto path = item.read_text(problems);
    if (!path) continue;
    const fs::path file = fs::path(item.position().file).parent_path() / *path;
    if (std::error_code error; !fs::exists(file, error))
      problems.error(item.problem(fmt::format("no such file or folder: {}", file.string())));
    else if (scene_plugins_allowed_ || is_trusted(file))
      search(file);
    else
      problems.error(item.problem(fmt::format(
          "{} is not loaded: code of a library that the scene names would run. --allow-scene-plugins allows "
          "it; so does a folder of yours that holds it, given by --plugin or TRAMMEL_PLUGIN_PATH",
          full_path(file))));
  }
}

bool Registry::is_trusted(const fs::path& path) const {
  return std::find(files_.begin(), files_.end(), full_path(path)) != files_.end() ||
         std::any_of(folders_.begin(), folders_.end(),
                     [&](const fs::path& folder) { return scene::is_within(folder, path); });
}

void Registry::load(const fs::path& library) {
  load(library, "loading it");
}

void Registry::load(const fs::path& library, const char* call) {
  const std::string file = full_path(library);
  if (std::find(files_.begin(), files_.end(), file) != files_.end()) return;
  const auto section = library_section(file, ".trammel");
  if (!section) throw PluginError(file, "not a Trammel plugin: it has no .trammel section (TRAMMEL_PLUGIN makes it)");
  if (const std::string differences = mismatch(*section, host_fingerprint()); !differences.empty())
    throw PluginError(file, fmt::format("built for another program: {}", differences));
  if (const std::string missing = missing_extensions(*section); !missing.empty()) throw PluginError(file, missing);
  require_seal(file, *section);
  rehearse(file);
  add(open(file, call), file);
  files_.push_back(file);
}

void Registry::add(const Declarations& declarations, const std::string& file) {
  if (declarations.empty()) throw PluginError(file, "it declares no component");
  for (auto d = declarations.begin(); d != declarations.end(); ++d) {
    require_sound(*d, file);
    const auto same = [&](const Declaration& other) { return other.kind == d->kind && other.name == d->name; };
    if (std::any_of(declarations.begin(), d, same))
      throw PluginError(file, fmt::format("it declares {} \"{}\" twice", to_string(d->kind), d->name));
    if (const Entry* other = loaded(d->kind, d->name))
      throw PluginError(file, fmt::format("it declares {} \"{}\", which {} declares already", to_string(d->kind),
                                          d->name, other->file));
  }
  for (const Declaration& declaration : declarations)
    entries_.push_back(std::make_unique<Entry>(Entry{declaration, file}));
}

const std::vector<Identity>& Registry::identities() {
  while (identities_.size() < files_.size()) identities_.push_back(identify(files_[identities_.size()]));
  return identities_;
}

const Entry* Registry::loaded(Kind kind, std::string_view name) const {
  for (const auto& entry : entries_)
    if (entry->declaration.kind == kind && entry->declaration.name == name) return entry.get();
  return nullptr;
}

// NAME.so of every folder, not only of the first: two libraries with the same name are an error.
void Registry::look_for(std::string_view name) {
  if (!is_name(name) || !names_looked_for_.emplace(name).second) return;
  std::error_code error;  // a component's name may be too long for a file name
  for (const fs::path& folder : folders_)
    if (const fs::path file = folder / (std::string(name) + extension); fs::exists(file, error)) load(file);
}

void Registry::load_folders() {
  if (folders_loaded_) return;
  folders_loaded_ = true;
  failures_.clear();
  for (const fs::path& folder : folders_)
    for (const fs::path& file : libraries_in(folder)) try {
        if (!library_section(file, ".trammel")) continue;  // a folder may contain other libraries, too
        if (is_left_out(full_path(file)))
          throw PluginError(full_path(file), "it ends the program when it is loaded, though not when it is tried out");
        load(file, loading_with_its_folder());
      } catch (const PluginError& e) {
        failures_.push_back(e);
      }
}

const Entry& Registry::find(Kind kind, std::string_view name) {
  look_for(name);
  if (const Entry* entry = loaded(kind, name)) return *entry;
  load_folders();
  if (const Entry* entry = loaded(kind, name)) return *entry;
  throw UnknownComponent(unknown(to_string(kind), name, &kind));
}

const Entry* Registry::find(Kind kind, const scene::Value& name, scene::Problems& problems) {
  const auto text = name.read_text(problems);
  if (!text) return nullptr;
  try {
    return &find(kind, *text);
  } catch (const UnknownComponent& e) {
    problems.error(name.problem(e.what()));
    return nullptr;
  }
}

std::vector<const Entry*> Registry::find_any(std::string_view name) {
  look_for(name);
  load_folders();
  std::vector<const Entry*> found = all();
  std::erase_if(found, [&](const Entry* entry) { return entry->declaration.name != name; });
  if (found.empty()) throw UnknownComponent(unknown("component", name, nullptr));
  return found;
}

std::vector<const Entry*> Registry::all() {
  load_folders();
  std::vector<const Entry*> entries;
  for (const auto& entry : entries_) entries.push_back(entry.get());
  std::sort(entries.begin(), entries.end(), [](const Entry* a, const Entry* b) {
    return std::tie(a->declaration.kind, a->declaration.name) < std::tie(b->declaration.kind, b->declaration.name);
  });
  return entries;
}

// no body "rigid_bdy". Did you mean "rigid_body"?
std::string Registry::unknown(std::string_view what, std::string_view name, const Kind* kind) const {
  std::vector<std::string> names;
  std::string other_kind;
  for (const auto& entry : entries_) {
    const Declaration& declaration = entry->declaration;
    if (!kind || declaration.kind == *kind)
      names.push_back(declaration.name);
    else if (declaration.name == name)
      other_kind = to_string(declaration.kind);
  }
  std::string text = fmt::format("no {} \"{}\"", what, name);
  if (!other_kind.empty()) text += fmt::format("; \"{}\" is {} {}", name, article(other_kind), other_kind);
  text += names.empty() ? fmt::format("; no {} was found at all", what) : scene::did_you_mean(name, names);
  if (names.empty() && folders_.empty())
    text += " (no plugin folder is searched: give --plugin or TRAMMEL_PLUGIN_PATH)";
  for (const PluginError& failure : failures_) text += fmt::format("; not searched: {}", failure.what());
  return text;
}

}  // namespace trammel::plugin
