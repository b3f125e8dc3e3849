// Expressions in scenes: "2*pi*E*I/L" over named parameters, and laws of time such as "0.2*sin(2*pi*5*t)".
//
// An expression is compiled once to postfix code that operates on jets (value, first and second derivative by t), so
// that laws of time have exact rates. The language has the operators + - * / ^ with the usual precedence (^ binds
// tighter than a leading minus and is right-associative), parentheses, numbers, `pi`, parameters by name, `t` where a
// law of time is expected, and the functions listed in expression.cpp.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <trammel/time_function.hpp>

#include "scene/value.hpp"

namespace trammel {
class JetCode;
}

namespace trammel::scene {

class ExpressionError : public std::runtime_error {
 public:
  ExpressionError(int column, const std::string& message) : std::runtime_error(message), column_(column) {}
  int column() const { return column_; }  // in the expression, from 1

 private:
  int column_;
};

// Looks up a parameter's number; throws ExpressionError.
using Lookup = std::function<double(std::string_view name, int column)>;

// `text` without the leading "=". Throws ExpressionError.
TimeFunction compile_time_function(std::string_view text, const Lookup& lookup);
double evaluate(std::string_view text, const Lookup& lookup);  // finite, free of t

// An expression of quantities that change from call to call, with dotted names: "atan2(bob.point.x, -bob.point.y)".
class Formula {
 public:
  // `names`: the available quantities; other names are looked up once. Throws ExpressionError.
  Formula(std::string_view text, const std::vector<std::string>& names, const Lookup& lookup);

  // The quantities that the expression uses, each once, as indices into `names`; `values` have the same order.
  const std::vector<int>& uses() const { return uses_; }
  double operator()(const std::vector<double>& values) const;

 private:
  std::shared_ptr<const JetCode> code_;
  std::vector<std::pair<std::size_t, std::size_t>> slots_;  // instruction, index into uses_
  std::vector<int> uses_;
};

// All functions: "sin(x)", "atan2(x, y)", ...
std::vector<std::string> function_signatures();

// True if the whole text is one name.
bool is_name(std::string_view text);

// All names in a text: parameters, functions and dotted names. The text need not be a valid expression.
std::vector<std::string_view> names_in(std::string_view text);

}  // namespace trammel::scene
