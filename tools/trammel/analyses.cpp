#include "analyses.hpp"

#include <dlfcn.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plugin/registry.hpp"

namespace trammel::tool {

namespace {

namespace fs = std::filesystem;

const Analyses& load() {
  const fs::path file = plugin::libraries_folder() / "libtrammel_commands.so";
  std::error_code error;
  if (!fs::exists(file, error))
    throw AnalysesMissing(fmt::format("{} is missing, with the commands {}; tools/build makes it", file.string(),
                                      fmt::join(kAnalyses, ", ")));
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const offered = library ? ::dlsym(library, "trammel_analyses") : nullptr;
  if (!offered) throw AnalysesMissing(fmt::format("the commands' library cannot be loaded: {}", ::dlerror()));
  return *reinterpret_cast<const Analyses* (*)()>(offered)();
}

}  // namespace

const Analyses& analyses() {
  static const Analyses& loaded = load();
  return loaded;
}

}  // namespace trammel::tool
