// Fowler, Noll, Vo: FNV-1a, 64 bits. Finds damage, not intent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trammel::simulate {

class Checksum {
 public:
  void bytes(const void* data, std::size_t size) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3ULL;
  }
  void text(std::string_view s) {
    number(s.size());
    bytes(s.data(), s.size());
  }
  void number(std::uint64_t x) { bytes(&x, sizeof x); }
  std::uint64_t value() const { return value_; }
  static Checksum from(std::uint64_t value) {
    Checksum sum;
    sum.value_ = value;
    return sum;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace trammel::simulate
