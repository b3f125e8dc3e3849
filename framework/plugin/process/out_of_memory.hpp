// Lack of memory, with the requested size. The program's operator new throws it; Eigen throws std::bad_alloc without a
// size.
#pragma once

#include <cstdio>
#include <new>

namespace trammel::plugin {

class OutOfMemory final : public std::bad_alloc {
 public:
  explicit OutOfMemory(std::size_t size) noexcept {
    constexpr double mebibyte = 1 << 20;
    if (double(size) >= mebibyte)
      std::snprintf(text_, sizeof text_, "out of memory: %.0f MiB more were asked for", double(size) / mebibyte);
    else
      std::snprintf(text_, sizeof text_, "out of memory: %zu bytes more were asked for", size);
  }
  const char* what() const noexcept override { return text_; }

 private:
  char text_[80];  // needs no allocation
};

// From here on a crash counts as its consequence: an Eigen matrix that could not grow frees its old block twice.
void note_lack_of_memory() noexcept;
bool lacked_memory() noexcept;

inline const char* out_of_memory_message(const std::bad_alloc& error) noexcept {
  return dynamic_cast<const OutOfMemory*>(&error) ? error.what() : "out of memory";
}

}  // namespace trammel::plugin
