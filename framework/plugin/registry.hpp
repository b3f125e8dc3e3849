// Which component comes from which shared library.
//
// Libraries are looked for in the search path: what `search` was given, TRAMMEL_PLUGIN_PATH, the user's own folder
// ($XDG_DATA_HOME/trammel/plugins, by default ~/.local/share/trammel/plugins) and the installed folder; never in the current one.
// A library of the search path is loaded at once; a folder is looked into when a name is asked for: the component NAME
// is expected in NAME.so, and only if it is not there are the folder's other libraries loaded to look for it. So a run
// loads the libraries its scene names and no others. Loaded libraries stay: objects, exceptions and texts may outlive
// the Registry.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <trammel/plugin.hpp>

#include "plugin/plugin_error.hpp"
#include "scene/value.hpp"

namespace trammel::plugin {

// A component and the library it comes from.
struct Entry {
  const Declaration& declaration;
  std::string file;
  Origin origin(std::string scene_path) const;
};

// No component has this name. what() names the nearest.
class UnknownComponent : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Registry {
 public:
  enum class Start { installed, empty };
  // installed: TRAMMEL_PLUGIN_PATH, the user's folder and the one beside libtrammel are searched from the start.
  explicit Registry(Start start = Start::installed);

  // Adds a library or a folder of libraries. Throws PluginError if it is neither, or if the library cannot be used.
  void search(const std::filesystem::path& path);
  // The scene's own "plugins": ["my_method.so", "../plugins"], relative to the scene file. Their code runs even when a scene is only
  // checked, so whoever wrote the scene does not decide that: they must lie in a folder that is searched anyway, or the user
  // has allowed them.
  void search_scene(const scene::Value& root, scene::Problems& problems);
  void allow_scene_plugins() { scene_plugins_allowed_ = true; }

  // Loads one library: pre-flight of the file, comparison of the fingerprint and of the seal, then its code, in a child process
  // first. Throws PluginError.
  // Loading a file again does nothing.
  void load(const std::filesystem::path& library);

  // Throws UnknownComponent, or PluginError if the library that should hold it cannot be used.
  const Entry& find(Kind kind, std::string_view name);
  // The same for a name in a scene: reports an unknown one to `problems` and returns nullptr.
  const Entry* find(Kind kind, const scene::Value& name, scene::Problems& problems);

  // Every component of every kind with this name, as for `trammel describe`. Throws UnknownComponent if there is none.
  std::vector<const Entry*> find_any(std::string_view name);
  // All components of the search path, by kind and name; loads every library.
  std::vector<const Entry*> all();
  // Libraries of searched folders that could not be used, found by `all` or while looking for a name.
  const std::vector<PluginError>& failures() const { return failures_; }
  // The libraries loaded so far, in order.
  const std::vector<std::string>& files() const { return files_; }

 private:
  const Entry* loaded(Kind kind, std::string_view name) const;
  void look_for(std::string_view name);
  void load_folders();
  bool is_trusted(const std::filesystem::path& path) const;
  void add(const Declarations& declarations, const std::string& file);
  std::string unknown(std::string_view what, std::string_view name, const Kind* kind) const;

  std::vector<std::filesystem::path> folders_;
  std::vector<std::unique_ptr<Entry>> entries_;
  std::vector<std::string> files_;  // canonical
  std::set<std::string, std::less<>> names_looked_for_;
  bool folders_loaded_ = false, scene_plugins_allowed_ = false;
  std::vector<PluginError> failures_;
};

}  // namespace trammel::plugin
