#include "analyses.hpp"

#include <dlfcn.h>

#include <fmt/format.h>

namespace trammel::tool {

const Analyses& analyses() {
  static const Analyses& loaded = []() -> const Analyses& {
    // Found through the program's run path: beside libtrammel.so.
    void* const library = ::dlopen("libtrammel_commands.so", RTLD_NOW | RTLD_LOCAL);
    void* const offered = library ? ::dlsym(library, "trammel_analyses") : nullptr;
    if (!offered)
      throw AnalysesMissing(fmt::format(
          "this command is in libtrammel_commands.so, which cannot be loaded: {}. In a clone of the sources, "
          "tools/build makes it.",
          ::dlerror()));
    return *reinterpret_cast<const Analyses* (*)()>(offered)();
  }();
  return loaded;
}

}  // namespace trammel::tool
