// Expressions in scenes: "2*pi*E*I/L" over named parameters, and laws of time such as "0.2*sin(2*pi*5*t)".
//
// Compiled once to a postfix code that works on jets (value, first and second derivative by t), so that a law of time has
// exact rates. Operators + - * / ^ with the usual precedence (^ binds tighter than a leading minus, and to the right),
// parentheses, numbers, `pi`, parameters by name, `t` where a law of time is expected, and the functions listed in
// expression.cpp.
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

// A value of quantities that change from call to call: "atan2(bob.point.x, -bob.point.y)" over dotted names.
class Formula {
 public:
  // `names`: the quantities there are; what is none of them is looked up once. Throws ExpressionError.
  Formula(std::string_view text, const std::vector<std::string>& names, const Lookup& lookup);

  // Those it uses, as indices into `names`, each once; `values` in the same order.
  const std::vector<int>& uses() const { return uses_; }
  double operator()(const std::vector<double>& values) const;

 private:
  std::shared_ptr<const JetCode> code_;
  std::vector<std::pair<std::size_t, std::size_t>> slots_;  // instruction, index into uses_
  std::vector<int> uses_;
};

// "sin(x)", "atan2(x, y)", ...: all functions there are.
std::vector<std::string> function_signatures();

// True when the whole text is one name.
bool is_name(std::string_view text);

// All names in it, of parameters and functions and dotted ones; what is no expression may hold some too.
std::vector<std::string_view> names_in(std::string_view text);

}  // namespace trammel::scene
