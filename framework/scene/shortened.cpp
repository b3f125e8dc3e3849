#include "scene/shortened.hpp"

namespace trammel::scene {

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a character of UTF-8
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace trammel::scene
