#include "scene/value.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include <fmt/format.h>

#include "scene/builder.hpp"
#include "scene/expression.hpp"
#include "scene/fnv_hash.hpp"
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

Value Builder::make(Content content, const Position& at) {
  Value value;
  value.content_ = std::move(content);
  value.siblings_ = std::make_shared<const Value::Siblings>(Value::Siblings{at.file, "", nullptr});
  value.line_ = at.line, value.column_ = at.column;
  return value;
}

Value Builder::make(Content content, const Value& in_file, int line, int column) {
  Value value;
  value.content_ = std::move(content);
  value.siblings_ = in_file.siblings_;
  value.line_ = line, value.column_ = column;
  return value;
}

void Builder::place(Value& value, const Value& at) {
  value.siblings_ = at.siblings_;
  value.line_ = at.line_, value.column_ = at.column_;
}

Value Builder::like(const Value& other, Content content) {
  Value value = other;
  value.content_ = std::move(content);
  value.by_name_.reset();
  return value;
}

Value* Builder::find(Value& object, std::string_view key) {
  return const_cast<Value*>(std::as_const(object).find(key));
}

namespace {

// A long text takes the memory of several values.
std::size_t excess(std::size_t bytes) {
  return bytes / limits::bytes_of_a_value;
}

}  // namespace

std::size_t Builder::size(const Value& value) {
  std::size_t sum = 1 + excess(value.file().size());
  if (value.type() == Value::Type::text) {
    const std::string& text = value.text();
    sum += excess(text.size()) + std::size_t(std::count(text.begin(), text.end(), '{'));
  } else if (value.type() == Value::Type::array) {
    for (const Value& item : value.items()) sum += size(item);
  } else if (value.type() == Value::Type::object) {
    for (const auto& [name, member] : value.members()) sum += excess(name.size()) + size(member);
  }
  return sum;
}

void Builder::finish(Value& value, const std::string& path,
                     const std::shared_ptr<const Value::Parameters>& parameters) {
  std::size_t sum = 0;
  std::shared_ptr<const Value::Siblings> alone;
  finish(value, {"", parameters}, path, alone, sum);
}

// `siblings`: those of the previous value; they are shared if both values are in the same file.
void Builder::finish(Value& value, const Family& family, std::string name,
                     std::shared_ptr<const Value::Siblings>& siblings, std::size_t& size) {
  if (!siblings || siblings->file != value.file())
    siblings = std::make_shared<const Value::Siblings>(Value::Siblings{value.file(), family.path, family.parameters});
  value.siblings_ = siblings;
  value.name_ = std::move(name);
  const Family own{value.path(), family.parameters};
  size += 1 + excess(own.path.size()) + excess(value.file().size());
  if (size > limits::values)
    throw SceneError({value.problem(fmt::format(
        "the scene grows beyond {} values here; long names and deep nesting count as more", limits::values))});
  std::shared_ptr<const Value::Siblings> of_children;
  if (value.type() == Value::Type::array) {
    int i = 0;
    for (Value& item : items(value)) finish(item, own, fmt::format("[{}]", i++), of_children, size);
  } else if (value.type() == Value::Type::object) {
    for (auto& [key, member] : members(value)) finish(member, own, key, of_children, size);
    order_by_name(value);
  }
}

void Builder::order_by_name(Value& object) {
  constexpr std::size_t large = 64;  // the index does not speed up smaller objects
  const Members& members = object.members();
  if (members.size() < large) return;
  std::vector<int> order(members.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return members[std::size_t(a)].first < members[std::size_t(b)].first; });
  object.by_name_ = std::make_shared<const std::vector<int>>(std::move(order));
}

std::uint64_t Builder::hash(const Value& value) {
  FnvHash h;
  h.number(int(value.type()));
  switch (value.type()) {
    case Value::Type::null:
      break;
    case Value::Type::boolean:
      h.number(value.boolean());
      break;
    case Value::Type::number:
      h.number(std::get<double>(value.content_) + 0.0);
      break;  // -0 is 0
    case Value::Type::text:
      h.text(value.text());
      break;
    case Value::Type::array:
      for (const Value& item : value.items()) h.number(hash(item));
      break;
    case Value::Type::object: {
      std::vector<std::uint64_t> each;
      for (const auto& [name, member] : value.members()) {
        FnvHash pair;
        pair.text(name);
        pair.number(hash(member));
        each.push_back(pair.value());
      }
      std::sort(each.begin(), each.end());
      for (const std::uint64_t x : each) h.number(x);
    }
  }
  return h.value();
}

}  // namespace trammel::scene
