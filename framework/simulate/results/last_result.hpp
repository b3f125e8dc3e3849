// The result.json of a process that can build nothing any more: its memory is used up, it crashed, or a step does not return. Made
// ready when the run starts; without figures, but with status and reason.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace trammel::simulate {

class LastResult {
 public:
  // `head`: what every result.json of this run begins with.
  LastResult(const std::filesystem::path& folder, nlohmann::ordered_json head);

  // For a signal handler: no allocation, nothing thrown. What cannot be written is left out.
  void write(const char* status, std::string_view reason) const noexcept;

 private:
  std::string file_, temporary_, rest_;
};

}  // namespace trammel::simulate
