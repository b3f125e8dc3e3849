#include "arguments.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "scene/suggestion.hpp"

namespace trammel::tool {

namespace {

const Option& find_option(const Command& command, std::string_view name) {
  const auto found = std::find_if(command.options.begin(), command.options.end(),
                                  [&](const Option& option) { return option.name == name; });
  if (found != command.options.end()) return *found;
  std::vector<std::string> names;
  for (const Option& option : command.options) names.emplace_back(option.name);
  throw UsageError(
      fmt::format("'trammel {}' has no option {}{}", command.name, name, scene::did_you_mean(name, names)));
}

}  // namespace

std::string Command::help() const {
  std::string text = fmt::format("trammel {}{}{}{}\n  {}\n", name, operand.empty() ? "" : " ", operand,
                                 options.empty() ? "" : " [options]", summary);
  for (const Option& option : options)
    text += fmt::format("\n  {:<18} {}", fmt::format("{} {}", option.name, option.value), option.help);
  return text + "\n";
}

Arguments::Arguments(const Command& command, std::span<const std::string> words, std::string program)
    : program_(std::move(program)), words_{std::string(command.name)} {
  words_.insert(words_.end(), words.begin(), words.end());
  bool options_ended = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (options_ended || word.size() < 2 || word[0] != '-') {
      operands_.push_back(word);
      continue;
    }
    if (word == "--") {
      options_ended = true;
      continue;
    }
    const auto equals = word.find('=');
    const Option& option = find_option(command, std::string_view(word).substr(0, equals));
    auto& values = values_[std::string(option.name)];
    if (option.value.empty()) {
      if (equals != word.npos) throw UsageError(fmt::format("{} takes no value, found '{}'", option.name, word));
      values.emplace_back();
    } else if (equals != word.npos) {
      values.push_back(word.substr(equals + 1));
    } else if (i + 1 < words.size()) {
      values.push_back(words[++i]);
    } else {
      throw UsageError(fmt::format("{} needs a value: {} {}", option.name, option.name, option.value));
    }
  }

  if (command.operand.empty() && !operands_.empty())
    throw UsageError(fmt::format("'trammel {}' takes no argument, found '{}'", command.name, operands_.front()));
  if (!command.operand.empty() && operands_.empty())
    throw UsageError(fmt::format("'trammel {}' needs a {}: trammel {} {}", command.name, command.operand, command.name,
                                 command.operand));
  if (operands_.size() > std::max<std::size_t>(1, command.most_operands))
    throw UsageError(fmt::format("'trammel {}' takes {} {}, found also '{}'", command.name,
                                 command.most_operands == 1 ? "one" : "no more than", command.operand,
                                 operands_[command.most_operands]));
}

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view harmless = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(harmless) == word.npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> Arguments::command_line() const {
  std::vector<std::string> all = {program_};
  all.insert(all.end(), words_.begin(), words_.end());
  return all;
}

const std::string& Arguments::last(std::string_view option) const {
  return values_.find(option)->second.back();
}

std::vector<std::string> Arguments::all(std::string_view option) const {
  const auto found = values_.find(option);
  return found == values_.end() ? std::vector<std::string>{} : found->second;
}

}  // namespace trammel::tool
