// Identity of a library: what a result must record to be reproducible.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace trammel::plugin {

struct Identity {
  std::string file;
  std::string sdk;         // version of the SDK that it was built against, "2.0"
  std::string compiler;    // "gcc 12"
  std::uint64_t hash = 0;  // of the whole file (fnv_hash.hpp); 0: no longer readable
};

Identity identify(const std::filesystem::path& library);

}  // namespace trammel::plugin
