// FNV-1a with 64 bits (Fowler, Noll, Vo): finds damage and changes. It is no protection against forgery.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trammel::scene {

class FnvHash {
 public:
  void bytes(const void* data, std::size_t size) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3ULL;
  }
  void text(std::string_view s) {
    number(s.size());
    bytes(s.data(), s.size());
  }
  template <class T>
  void number(T x) {
    bytes(&x, sizeof x);
  }
  std::uint64_t value() const { return value_; }
  static FnvHash from(std::uint64_t value) {
    FnvHash hash;
    hash.value_ = value;
    return hash;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace trammel::scene
