#include "scene/value.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/builder.hpp"
#include "scene/expression.hpp"
#include "scene/limits.hpp"
#include "scene/motion_table.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {

std::string Problem::text() const {
  std::string where = at.file;
  if (at.line > 0) where += fmt::format(":{}:{}", at.line, at.column);
  return where + ": " + (path.empty() ? "" : path + ": ") + message;
}

namespace {

std::string all_texts(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += (text.empty() ? "" : "\n") + problem.text();
  return text;
}

// A message may contain any names and texts of the scene.
Problem bounded(Problem problem) {
  problem.at.file = printable(shortened(problem.at.file, limits::message));
  problem.path = printable(shortened(problem.path, limits::path));
  problem.message = printable(shortened(problem.message, limits::message));
  return problem;
}

std::vector<Problem> bounded(std::vector<Problem> problems) {
  for (Problem& problem : problems) problem = bounded(std::move(problem));
  return problems;
}

}  // namespace

SceneError::SceneError(std::vector<Problem> problems)
    : std::runtime_error(all_texts(bounded(problems))), problems_(bounded(std::move(problems))) {}

void Problems::error(Problem problem) {
  if (errors_.size() == limits::problems) {
    errors_.push_back(
        {problem.at, "", fmt::format("{} problems are enough: what follows was not read", limits::problems)});
    throw_if_any();
  }
  errors_.push_back(bounded(std::move(problem)));
}
void Problems::warning(Problem problem) {
  if (warnings_.size() < limits::problems) warnings_.push_back(bounded(std::move(problem)));
}
void Problems::throw_if_any() const {
  if (!errors_.empty()) throw SceneError(errors_);
}

const std::string& Value::file() const {
  static const std::string none;
  return siblings_ ? siblings_->file : none;
}

std::string Value::path() const {
  if (!siblings_ || siblings_->path.empty()) return name_;
  return siblings_->path + (name_.starts_with('[') ? "" : ".") + name_;
}

Value::Type Value::type() const {
  return Type(content_.index());
}

const char* Value::type_name() const {
  static constexpr const char* names[] = {"null", "true or false", "a number", "a text", "an array", "an object"};
  return names[content_.index()];
}

const Value* Value::find(std::string_view key) const {
  if (type() != Type::object) return nullptr;
  const auto is_wanted = [key](const auto& member) { return member.first == key; };
  if (!by_name_) {
    const auto member = std::find_if(members().begin(), members().end(), is_wanted);
    return member == members().end() ? nullptr : &member->second;
  }
  const auto at = std::lower_bound(by_name_->begin(), by_name_->end(), key, [this](int i, std::string_view name) {
    return members()[std::size_t(i)].first < name;
  });
  return at != by_name_->end() && is_wanted(members()[std::size_t(*at)]) ? &members()[std::size_t(*at)].second
                                                                         : nullptr;
}

const Value* Value::at_path(std::string_view dotted) const {
  const Value* value = this;
  while (value && !dotted.empty()) {
    const auto dot = dotted.find('.');
    value = value->find(dotted.substr(0, dot));
    dotted = dot == std::string_view::npos ? std::string_view() : dotted.substr(dot + 1);
  }
  return value;
}

namespace {

bool is_expression(const Value& value) {
  return value.type() == Value::Type::text && !value.text().empty() && value.text()[0] == '=';
}

std::string found(const Value& value) {
  switch (value.type()) {
    case Value::Type::text:
      return fmt::format("found the text \"{}\"", shortened(value.text()));
    case Value::Type::boolean:
      return value.boolean() ? "found true" : "found false";
    default:
      return fmt::format("found {}", value.type_name());
  }
}

// The scene's parameters as a Lookup.
Lookup lookup_in(const Value::Parameters* parameters) {
  return [parameters](std::string_view name, int column) -> double {
    if (const auto* value = parameters ? find_parameter(*parameters, name) : nullptr) {
      if (const double* number = std::get_if<double>(value)) return *number;
      throw ExpressionError(column, fmt::format("the parameter \"{}\" is a text, expected a number", name));
    }
    std::vector<std::string> names = {"pi"};
    if (parameters)
      for (const auto& [key, value] : *parameters) names.push_back(key);
    throw ExpressionError(column, fmt::format("no parameter \"{}\"{}", shortened(name), did_you_mean(name, names)));
  };
}

// Runs `compile` on the expression after "="; a failure becomes a problem that quotes it.
template <class Compile>
auto compiled(const Value& value, Problems& problems, Compile compile)
    -> std::optional<decltype(compile(std::string_view()))> {
  try {
    return compile(std::string_view(value.text()).substr(1));
  } catch (const ExpressionError& error) {
    problems.error(value.problem(fmt::format("in the expression \"{}\", column {}: {}", shortened(value.text()),
                                             error.column() + 1, error.what())));
    return std::nullopt;
  }
}

}  // namespace

std::optional<double> Value::read_number(Problems& problems) const {
  if (type() == Type::number) return std::get<double>(content_);
  if (is_expression(*this))
    return compiled(*this, problems, [&](auto text) { return evaluate(text, lookup_in(parameters())); });
  problems.error(problem(found(*this) + ", expected a number" +
                         (type() == Type::text ? " (an expression starts with \"=\")" : "")));
  return std::nullopt;
}

std::optional<int> Value::read_integer(Problems& problems) const {
  const auto number = read_number(problems);
  if (!number) return std::nullopt;
  if (*number != std::floor(*number)) {
    problems.error(problem(fmt::format("found {}, expected a whole number", *number)));
    return std::nullopt;
  }
  if (std::abs(*number) > 2147483647.0) {
    problems.error(problem(fmt::format("found {}, expected a whole number of at most 9 digits", *number)));
    return std::nullopt;
  }
  return int(*number);
}

std::optional<bool> Value::read_boolean(Problems& problems) const {
  if (type() == Type::boolean) return boolean();
  problems.error(problem(found(*this) + ", expected true or false"));
  return std::nullopt;
}

std::optional<std::string> Value::read_text(Problems& problems) const {
  if (type() != Type::text) {
    problems.error(problem(found(*this) + ", expected a text"));
    return std::nullopt;
  }
  if (!is_expression(*this)) return text();
  const std::string_view name = std::string_view(text()).substr(1);
  if (const auto* value = parameters() ? find_parameter(*parameters(), name) : nullptr)
    if (const std::string* named = std::get_if<std::string>(value)) return *named;
  std::vector<std::string> names;
  if (parameters())
    for (const auto& [key, value] : *parameters())
      if (std::holds_alternative<std::string>(value)) names.push_back(key);
  problems.error(problem(fmt::format("found the expression \"{}\", expected a text or the name of a text parameter{}",
                                     shortened(text()), did_you_mean(name, names))));
  return std::nullopt;
}

std::optional<std::vector<double>> Value::read_numbers(Problems& problems) const {
  if (type() != Type::array) {
    problems.error(problem(found(*this) + ", expected an array of numbers"));
    return std::nullopt;
  }
  std::vector<double> numbers;
  bool good = true;
  for (const Value& item : items()) {
    const auto number = item.read_number(problems);
    good = good && number.has_value();
    numbers.push_back(number.value_or(0));
  }
  if (!good) return std::nullopt;
  return numbers;
}

std::optional<TimeFunction> Value::read_time_function(Problems& problems) const {
  if (type() == Type::object) return read_motion_table(*this, problems);
  if (is_expression(*this))
    return compiled(*this, problems, [&](auto text) { return compile_time_function(text, lookup_in(parameters())); });
  const auto number = read_number(problems);
  if (!number) return std::nullopt;
  return TimeFunction(*number);
}

std::optional<Formula> Value::read_formula(const std::vector<std::string>& names, Problems& problems) const {
  return compiled(*this, problems, [&](std::string_view text) {
    return Formula(text, names, [&](std::string_view name, int column) -> double {
      if (name.find('.') == name.npos) return lookup_in(parameters())(name, column);
      throw ExpressionError(column, fmt::format("no quantity \"{}\"{}", shortened(name), did_you_mean(name, names)));
    });
  });
}

}  // namespace trammel::scene
