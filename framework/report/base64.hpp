// Numbers as text that a script turns back into an array: their bytes, little-endian, in base 64.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace trammel::report {

std::string base64(std::span<const std::byte> bytes);

template <class T>
std::string base64_of(const std::vector<T>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

}  // namespace trammel::report
