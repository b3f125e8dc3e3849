#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/builder.hpp"
#include "scene/expression.hpp"
#include "scene/limits.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {

namespace {

using Result = Value::Parameter;

// Evaluates parameters in the order of their dependencies.
class Evaluation {
 public:
  Evaluation(const Value& block, Problems& problems) : block_(block), problems_(problems) {}

  const Result* value_of(const std::string& name, const Value& value) {
    if (const auto known = done_.find(name); known != done_.end()) return known->second ? &*known->second : nullptr;
    open_.push_back(name);
    std::optional<Result> result = result_of(value);
    open_.pop_back();
    auto& slot = done_[name] = std::move(result);
    return slot ? &*slot : nullptr;
  }

 private:
  std::optional<Result> result_of(const Value& value) {
    if (value.type() == Value::Type::number) return *value.read_number(problems_);
    if (value.type() == Value::Type::object) return choice(value);
    if (value.type() != Value::Type::text) {
      problems_.error(value.problem(
          fmt::format("found {}, expected a number, a text, an expression or a choice", value.type_name())));
      return std::nullopt;
    }
    if (value.text().empty() || value.text()[0] != '=') return value.text();
    return expression(value);
  }

  // {"by": "=mesh", "values": {"coarse": 4, "fine": 16}, "otherwise": 8}: selects by the text value of
  // another parameter.
  std::optional<Result> choice(const Value& value) {
    const Value *by = value.find("by"), *values = value.find("values"), *otherwise = value.find("otherwise");
    if (!by || !values || values->type() != Value::Type::object) {
      problems_.error(
          value.problem("found an object, expected a choice {\"by\": \"=NAME\", \"values\": {TEXT: VALUE, ...}, "
                        "\"otherwise\": VALUE}"));
      return std::nullopt;
    }
    const std::optional<Result> key = result_of(*by);
    if (!key) return std::nullopt;
    const std::string* text = std::get_if<std::string>(&*key);
    std::vector<std::string> names;
    for (const auto& [name, member] : values->members()) {
      if (text && name == *text) return result_of(member);
      names.push_back(name);
    }
    if (otherwise) return result_of(*otherwise);
    problems_.error(by->problem(text ? fmt::format("found \"{}\", expected one of {}{}", *text, fmt::join(names, ", "),
                                                   did_you_mean(*text, names))
                                     : fmt::format("found a number, expected one of {}", fmt::join(names, ", "))));
    return std::nullopt;
  }

  std::optional<Result> expression(const Value& value) {
    const std::string_view text = std::string_view(value.text()).substr(1);
    try {
      if (is_name(text))
        if (const Value* other = find(text)) {
          const Result* result = need(std::string(text), *other, 1);
          if (!result) return std::nullopt;
          return *result;
        }
      if (!prepare(text)) return std::nullopt;  // reported already
      return evaluate(text, [this](std::string_view name, int column) { return number(name, column); });
    } catch (const ExpressionError& error) {
      problems_.error(value.problem(fmt::format("in the expression \"{}\", column {}: {}", shortened(value.text()),
                                                error.column() + 1, error.what())));
      return std::nullopt;
    }
  }

  // Evaluates the parameters that the text uses, so that compiling it evaluates no others. False: one of them has no
  // value.
  bool prepare(std::string_view text) {
    for (const std::string_view name : names_in(text)) {
      const auto end = std::size_t(name.data() - text.data()) + name.size();
      const auto next = text.find_first_not_of(" \t\r\n", end);
      if (next != text.npos && text[next] == '(') continue;  // a function
      const Value* other = find(name);
      if (other && !need(std::string(name), *other, int(name.data() - text.data()) + 1)) return false;
    }
    return true;
  }

  double number(std::string_view name, int column) {
    const Value* other = find(name);
    if (!other) {
      std::vector<std::string> names = {"pi"};
      for (const auto& [key, value] : block_.members()) names.push_back(key);
      throw ExpressionError(column, fmt::format("no parameter \"{}\"{}", shortened(name), did_you_mean(name, names)));
    }
    const Result* result = need(std::string(name), *other, column);
    if (!result) throw ExpressionError(column, fmt::format("the parameter \"{}\" has no value", name));
    if (const double* x = std::get_if<double>(result)) return *x;
    throw ExpressionError(column, fmt::format("the parameter \"{}\" is a text, expected a number", name));
  }

  const Result* need(const std::string& name, const Value& value, int column) {
    for (const std::string& waiting : open_)
      if (waiting == name) {
        std::string circle;
        for (const std::string& link : open_) circle += link + " -> ";
        throw ExpressionError(column, "parameters go round in a circle: " + circle + name);
      }
    if (open_.size() >= limits::nested)
      throw ExpressionError(column, fmt::format("parameters use one another more than {} deep: {} -> ... -> {}",
                                                limits::nested, open_.front(), name));
    return value_of(name, value);
  }

  const Value* find(std::string_view name) const { return block_.find(name); }

  const Value& block_;
  Problems& problems_;
  std::map<std::string, std::optional<Result>> done_;
  std::vector<std::string> open_;
};

}  // namespace

std::shared_ptr<const Value::Parameters> evaluate_parameters(const Value& root) {
  auto parameters = std::make_shared<Value::Parameters>();
  const Value* block = root.find("parameters");
  if (!block) return parameters;
  Problems problems;
  if (block->type() != Value::Type::object)
    throw SceneError({block->problem(fmt::format("found {}, expected an object of named values", block->type_name()))});
  Evaluation evaluation(*block, problems);
  for (const auto& [name, value] : block->members()) {
    if (!is_name(name) || name == "t" || name == "pi")
      problems.error(
          value.problem(fmt::format("\"{}\" cannot name a parameter: letters, digits and _, not t or pi", name)));
    else if (const Result* result = evaluation.value_of(name, value))
      parameters->emplace_back(name, *result);
  }
  problems.throw_if_any();
  std::sort(parameters->begin(), parameters->end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return parameters;
}

const Value::Parameter* find_parameter(const Value::Parameters& parameters, std::string_view name) {
  const auto at = std::lower_bound(parameters.begin(), parameters.end(), name,
                                   [](const auto& parameter, std::string_view key) { return parameter.first < key; });
  return at != parameters.end() && at->first == name ? &at->second : nullptr;
}

}  // namespace trammel::scene
