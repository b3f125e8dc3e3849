#include "plugin/identity.hpp"

#include <array>
#include <fstream>

#include "plugin/fingerprint.hpp"
#include "plugin/library_section.hpp"
#include "plugin/plugin_error.hpp"
#include "scene/fnv_hash.hpp"

namespace trammel::plugin {
namespace {

std::uint64_t hash_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  scene::FnvHash hash;
  std::array<char, 1 << 16> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0) hash.bytes(block.data(), std::size_t(in.gcount()));
  return in.eof() && !in.bad() ? hash.value() : 0;
}

std::string section_of(const std::filesystem::path& library) try {
  return library_section(library, ".trammel").value_or("");
} catch (const PluginError&) {
  return "";  // the file was replaced after it was loaded
}

}  // namespace

Identity identify(const std::filesystem::path& library) {
  const std::string section = section_of(library);
  const auto line = [&](const char* key) { return std::string(fingerprint_value(section, key)); };
  return {library.string(), line("sdk"), line("compiler"), hash_of(library)};
}

}  // namespace trammel::plugin
