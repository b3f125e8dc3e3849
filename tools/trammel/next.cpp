#include "next.hpp"

#include <exception>
#include <string>

#include "input.hpp"

namespace trammel::tool {

namespace {

std::string as_given(const Arguments& arguments, const Option& option) {
  const std::string name(option.name);
  if (option.value.empty()) return arguments.has(name) ? " " + name : "";
  std::string text;
  for (const std::string& value : arguments.all(name)) text += " " + name + " " + shell_quoted(value);
  return text;
}

}  // namespace

void print_next(const Arguments& arguments, std::initializer_list<std::string_view> words,
                std::initializer_list<Option> carried) noexcept {
  if (arguments.has(kJson.name) || arguments.has("--quiet")) return;
  try {
    std::string line = "next:";
    for (const std::string_view word : words) line += " " + shell_quoted(std::string(word));
    for (const Option& option : carried) line += as_given(arguments, option);
    print_line(line);
  } catch (const std::exception&) {
  }
}

}  // namespace trammel::tool
