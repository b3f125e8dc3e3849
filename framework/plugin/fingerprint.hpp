// The properties that must agree in plugin and host before they may exchange C++ objects, as key=value lines
// (trammel/plugin.hpp).
#pragma once

#include <string>
#include <string_view>

namespace trammel::plugin {

std::string_view host_fingerprint();

// Returns "" if a plugin with this fingerprint can be used, else a text that names each difference with both values:
//     eigen_align: the plugin has 32, this program 16
// The SDK's major numbers must be equal, and the plugin's minor number must not be newer than the host's. The compiler
// may be another one: GCC and clang follow the same Itanium C++ ABI. So may the release of libstdc++: since GCC 5 its
// ABI is the same for each value of string_abi, and the loader checks the additions of newer releases by symbol
// versions. Another set of extensions is no difference, because Eigen's alignment is pinned.
std::string mismatch(std::string_view plugin, std::string_view host);

// Returns "" if this processor has every extension that the plugin's code may use, else what is missing:
//     its code needs avx512f avx512vl, which this processor does not have; build it with -march=x86-64
std::string missing_extensions(std::string_view plugin);

// The value of a line, "" if there is none: value("trammel plugin\ncompiler=gcc 12\n", "compiler") is "gcc 12".
std::string_view fingerprint_value(std::string_view fingerprint, std::string_view key);

}  // namespace trammel::plugin
