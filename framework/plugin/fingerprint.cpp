#include "plugin/fingerprint.hpp"

#include <fmt/format.h>

#include <charconv>
#include <trammel/plugin.hpp>
#include <utility>
#include <vector>

namespace trammel::plugin {

namespace {

using Lines = std::vector<std::pair<std::string_view, std::string_view>>;

Lines parse(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (const auto equals = line.find('='); equals != line.npos)
      lines.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return lines;
}

std::string_view value_of(const Lines& lines, std::string_view key) {
  for (const auto& [name, value] : lines)
    if (name == key) return value;
  return "nothing";
}

// Converts "0.1" to {0, 1}; returns {-1, -1} for anything that is not a version.
std::pair<int, int> version(std::string_view text) {
  int major = -1, minor = -1;
  const char* end = text.data() + text.size();
  const auto dot = std::from_chars(text.data(), end, major).ptr;
  if (dot != end && *dot == '.') std::from_chars(dot + 1, end, minor);
  return {major, minor};
}

bool sdk_fits(std::string_view plugin, std::string_view host) {
  const auto [major, minor] = version(plugin);
  const auto [host_major, host_minor] = version(host);
  return major == host_major && 0 <= minor && minor <= host_minor;
}

}  // namespace

std::string_view host_fingerprint() {
  return TRAMMEL_FINGERPRINT;
}

std::string mismatch(std::string_view plugin, std::string_view host) {
  if (!plugin.starts_with(TRAMMEL_MAGIC "\n")) return "its .trammel section does not start with \"" TRAMMEL_MAGIC "\"";
  const Lines plugin_lines = parse(plugin);
  std::string text;
  for (const auto& [key, expected] : parse(host)) {
    const std::string_view found = value_of(plugin_lines, key);
    if (key == "sdk" ? sdk_fits(found, expected) : found == expected) continue;
    text += fmt::format("{}{}: the plugin has {}, this program {}", text.empty() ? "" : "; ", key, found, expected);
  }
  return text;
}

}  // namespace trammel::plugin
