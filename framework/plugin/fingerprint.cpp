#include "plugin/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <trammel/plugin.hpp>
#include <utility>
#include <vector>

namespace trammel::plugin {

namespace {

constexpr std::string_view nothing = "nothing";

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
  return nothing;
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

// "libstdc++ 12" and "libstdc++ 13" are one library; releases of libc++ carry their ABI in their number.
bool library_fits(std::string_view plugin, std::string_view host) {
  constexpr std::string_view gnu = "libstdc++ ";
  return plugin == host || (plugin.starts_with(gnu) && host.starts_with(gnu));
}

bool fits(std::string_view key, std::string_view plugin, std::string_view host) {
  if (key == "sdk") return sdk_fits(plugin, host);
  if (key == "standard_library") return library_fits(plugin, host);
  return key == "compiler" || key == "extensions" || plugin == host;
}

#if defined(__x86_64__)
bool processor_has(std::string_view extension) {
  __builtin_cpu_init();
  const std::pair<std::string_view, bool> known[] = {{"base", true},
                                                     {"ssse3", __builtin_cpu_supports("ssse3") != 0},
                                                     {"sse4.1", __builtin_cpu_supports("sse4.1") != 0},
                                                     {"sse4.2", __builtin_cpu_supports("sse4.2") != 0},
                                                     {"popcnt", __builtin_cpu_supports("popcnt") != 0},
                                                     {"avx", __builtin_cpu_supports("avx") != 0},
                                                     {"avx2", __builtin_cpu_supports("avx2") != 0},
                                                     {"fma", __builtin_cpu_supports("fma") != 0},
                                                     {"bmi", __builtin_cpu_supports("bmi") != 0},
                                                     {"bmi2", __builtin_cpu_supports("bmi2") != 0},
                                                     {"avx512f", __builtin_cpu_supports("avx512f") != 0},
                                                     {"avx512vl", __builtin_cpu_supports("avx512vl") != 0},
                                                     {"avx512dq", __builtin_cpu_supports("avx512dq") != 0},
                                                     {"avx512bw", __builtin_cpu_supports("avx512bw") != 0},
                                                     {"avx512cd", __builtin_cpu_supports("avx512cd") != 0}};
  return std::any_of(std::begin(known), std::end(known),
                     [&](const auto& one) { return one.first == extension && one.second; });
}
#else
bool processor_has(std::string_view extension) {
  return extension == "base";
}
#endif

}  // namespace

std::string_view fingerprint_value(std::string_view fingerprint, std::string_view key) {
  const std::string_view value = value_of(parse(fingerprint), key);
  return value.data() == nothing.data() ? "" : value;
}

std::string missing_extensions(std::string_view plugin) {
  std::string missing;
  std::string_view needed = fingerprint_value(plugin, "extensions");
  while (!needed.empty()) {
    const std::string_view one = needed.substr(0, needed.find(' '));
    needed.remove_prefix(std::min(needed.size(), one.size() + 1));
    if (!processor_has(one)) missing += fmt::format("{}{}", missing.empty() ? "" : " ", one);
  }
  if (missing.empty()) return "";
  return fmt::format("its code needs {}, which this processor does not have; build it with -march=x86-64", missing);
}

std::string_view host_fingerprint() {
  return TRAMMEL_FINGERPRINT;
}

std::string mismatch(std::string_view plugin, std::string_view host) {
  if (!plugin.starts_with(TRAMMEL_MAGIC "\n")) return "its .trammel section does not start with \"" TRAMMEL_MAGIC "\"";
  const Lines plugin_lines = parse(plugin);
  std::string text;
  for (const auto& [key, expected] : parse(host)) {
    const std::string_view found = value_of(plugin_lines, key);
    if (fits(key, found, expected)) continue;
    text += fmt::format("{}{}: the plugin has {}, this program {}", text.empty() ? "" : "; ", key, found, expected);
  }
  return text;
}

}  // namespace trammel::plugin
