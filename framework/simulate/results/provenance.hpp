// How a result was made: by which program, on which machine, from which command.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "plugin/identity.hpp"
#include "scene/value.hpp"

namespace trammel::simulate {

struct BuildInfo {
  std::string version;          // "0.1.0"
  std::string commit;           // of the sources, "-dirty" if they were changed; "unknown" outside of a git checkout
  std::string build_type;       // "Release"
  std::string instruction_set;  // for which the program was compiled: "x86-64-v3"
  std::string compiler;         // "gcc 12.2.0"
  std::string flags;            // that affect numbers: "-O3 -DNDEBUG -fno-math-errno"
};
BuildInfo build_info();
// The program as JSON, for result.json and `trammel --version --json`.
nlohmann::ordered_json program_json();
// Each with name, file, SDK, compiler and hash.
nlohmann::ordered_json libraries_json(const std::vector<plugin::Identity>& plugins);
// The highest level of this machine's processor, "x86-64-v4"; "unknown" if it is not x86-64.
std::string host_instruction_set();
std::string utc_now();  // "2026-11-24T18:19:00Z"

// "made": {"command", "set", "date", "program", "host"}; "versions"; "plugins" with file, SDK and hash of each.
nlohmann::ordered_json provenance(const scene::Scene& scene, const std::vector<std::string>& command,
                                  const std::vector<plugin::Identity>& plugins);

}  // namespace trammel::simulate
