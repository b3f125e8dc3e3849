#include "scene/shortened.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace trammel::scene {
namespace {

bool is_control(char c) {
  return (c >= 0 && c < 0x20) || c == 0x7f;
}

}  // namespace

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a character of UTF-8
  return std::string(text.substr(0, end)) + "...";
}

bool has_control_characters(std::string_view text, std::string_view other_than) {
  return std::any_of(text.begin(), text.end(),
                     [other_than](char c) { return is_control(c) && other_than.find(c) == other_than.npos; });
}

std::string printable(std::string_view text) {
  std::string shown;
  for (const char c : text) shown += is_control(c) && c != '\n' ? fmt::format("\\u{:04x}", int(c)) : std::string(1, c);
  return shown;
}

}  // namespace trammel::scene
