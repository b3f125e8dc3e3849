// Writes the result.json of a process that can no longer allocate: its memory is exhausted, it crashed, or a step does
// not return. Prepared at the start of the run; it contains status and reason and no figures.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace trammel::simulate {

class LastResult {
 public:
  // `head`: the beginning of every result.json of this run.
  LastResult(const std::filesystem::path& folder, nlohmann::ordered_json head);

  // Safe in a signal handler: no allocation, no exception. Text that cannot be written is left out.
  void write(const char* status, std::string_view reason) const noexcept;

 private:
  std::string file_, temporary_, rest_;
};

}  // namespace trammel::simulate
