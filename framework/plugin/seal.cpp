#include "plugin/seal.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <string>

#include "plugin/library_section.hpp"
#include "plugin/plugin_error.hpp"

namespace trammel::plugin {

namespace {

constexpr const char* section_name = ".trammel";
constexpr std::string_view key = "\ncode=", unsealed = "----------------";

// Offset of the checksum in the section; npos: this library has no space for one.
std::size_t place_in(std::string_view section) {
  const std::size_t begin = section.find(key);
  return begin == section.npos || begin + key.size() + unsealed.size() > section.size() ? section.npos
                                                                                        : begin + key.size();
}

std::string checksum(const std::filesystem::path& library) {
  return fmt::format("{:016x}", library_checksum(library, section_name));
}

}  // namespace

void seal(const std::filesystem::path& library) {
  const auto section = library_section(library, section_name);
  if (!section) throw PluginError(library.string(), "not a Trammel plugin: it has no .trammel section");
  const std::size_t place = place_in(*section);
  if (place == section->npos) throw PluginError(library.string(), "it has no room for a seal: build it with this SDK");
  const std::uint64_t begin = *library_section_offset(library, section_name) + place;
  const std::string sum = checksum(library);
  std::fstream file(library, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(begin));
  file.write(sum.data(), static_cast<std::streamsize>(sum.size()));
  if (!file.flush()) throw PluginError(library.string(), "its seal cannot be written");
}

void require_seal(const std::filesystem::path& library, std::string_view section) {
  const std::size_t place = place_in(section);
  if (place == section.npos) return;
  const std::string_view sealed = section.substr(place, unsealed.size());
  if (sealed == unsealed) return;
  if (const std::string found = checksum(library); found != sealed)
    throw PluginError(library.string(),
                      fmt::format("damaged: its code has the checksum {}, it was built with {}; build it again, or "
                                  "'trammel seal' it if it was changed on purpose",
                                  found, sealed));
}

}  // namespace trammel::plugin
