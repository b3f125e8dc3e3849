// The analyses: commands that do more with a scene than run it once. They are in a library of their own,
// libtrammel_commands.so beside libtrammel.so, which is loaded when one of them is asked for: a run neither loads what
// it does not need, nor waits until that is built.
#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "arguments.hpp"
#include "commands/simulation.hpp"

namespace trammel::tool {

// Known without the library.
inline constexpr std::array<std::string_view, 8> kAnalyses{"static", "modes",   "explain", "study",
                                                           "trade",  "compare", "check",   "stability"};

struct Analyses {
  std::vector<Command> commands;  // as named above
  // What `trammel run` may do after its run: --verify, and after a failure what to change.
  void (*verify)(const Arguments& arguments, plugin::Registry& registry, const scene::Scene& scene,
                 const std::filesystem::path& folder, bool quiet);
  void (*find_remedy)(const Arguments& arguments, plugin::Registry& registry, simulate::RunReport& report,
                      const std::filesystem::path& folder);
};

// The library is not built, or cannot be loaded.
struct AnalysesMissing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Loads the library at the first call. Throws AnalysesMissing.
const Analyses& analyses();

}  // namespace trammel::tool
