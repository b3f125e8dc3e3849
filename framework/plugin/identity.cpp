#include "plugin/identity.hpp"

#include <array>
#include <fstream>

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

std::string sdk_of(const std::filesystem::path& library) try {
  const std::string section = library_section(library, ".trammel").value_or("");
  constexpr std::string_view key = "\nsdk=";
  const std::size_t begin = section.find(key);
  if (begin == std::string::npos) return "";
  return section.substr(begin + key.size(), section.find('\n', begin + 1) - begin - key.size());
} catch (const PluginError&) {
  return "";  // the file was replaced after it was loaded
}

}  // namespace

Identity identify(const std::filesystem::path& library) {
  return {library.string(), sdk_of(library), hash_of(library)};
}

}  // namespace trammel::plugin
