// Finds components in shared libraries.
//
// The search path consists of the arguments of `search`, TRAMMEL_PLUGIN_PATH, the user's folder
// ($XDG_DATA_HOME/trammel/plugins, by default ~/.local/share/trammel/plugins) and the installed folder; never the
// current folder. A library in the search path is loaded immediately. A folder is searched when a component is
// requested: component NAME is expected in NAME.so; the folder's other libraries are loaded only if it is not found
// there. Thus a run loads only the libraries that its scene names. Libraries are never unloaded, because objects,
// exceptions and texts may outlive the Registry.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <trammel/plugin.hpp>

#include "plugin/identity.hpp"
#include "plugin/plugin_error.hpp"
#include "scene/value.hpp"

namespace trammel::plugin {

// A component and its library.
struct Entry {
  const Declaration& declaration;
  std::string file;
  Origin origin(std::string scene_path) const;
};

// No component has this name. what() suggests the nearest name.
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
  // The scene's "plugins": ["my_method.so", "../plugins"], relative to the scene file. Their code is executed even if a
  // scene is only validated. Therefore they must be in a folder of the search path, or the user must have allowed them.
  void search_scene(const scene::Value& root, scene::Problems& problems);
  void allow_scene_plugins() { scene_plugins_allowed_ = true; }

  // Loads one library: checks the file, compares fingerprint and seal, then executes its code, first in a child
  // process. Throws PluginError. Loading a file again does nothing.
  void load(const std::filesystem::path& library);

  // Throws UnknownComponent, or PluginError if the library NAME.so cannot be used.
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
  // Their identities. Each file is read only when this is first called after it was loaded: many scenes of one process
  // do not read it again.
  const std::vector<Identity>& identities();

 private:
  const Entry* loaded(Kind kind, std::string_view name) const;
  void load(const std::filesystem::path& library, const char* call);
  void look_for(std::string_view name);
  void load_folders();
  bool is_trusted(const std::filesystem::path& path) const;
  void add(const Declarations& declarations, const std::string& file);
  std::string unknown(std::string_view what, std::string_view name, const Kind* kind) const;

  std::vector<std::filesystem::path> folders_;
  std::vector<std::unique_ptr<Entry>> entries_;
  std::vector<std::string> files_;    // canonical
  std::vector<Identity> identities_;  // of the first files in files_
  std::set<std::string, std::less<>> names_looked_for_;
  bool folders_loaded_ = false, scene_plugins_allowed_ = false;
  std::vector<PluginError> failures_;
};

// Where libtrammel.so is, and with it the other libraries of the program.
std::filesystem::path libraries_folder();

}  // namespace trammel::plugin
