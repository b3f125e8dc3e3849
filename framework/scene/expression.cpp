#include "scene/expression.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "scene/laws/jet_code.hpp"
#include "scene/shortened.hpp"
#include "scene/suggestion.hpp"

namespace trammel::scene {

namespace {

using Code = JetCode;
using Op = Code::Op;

struct Function {
  const char* name;
  Op op;
  int arguments;
};

constexpr Function functions[] = {
    {"sin", Op::sin, 1},   {"cos", Op::cos, 1},     {"tan", Op::tan, 1},   {"asin", Op::asin, 1}, {"acos", Op::acos, 1},
    {"atan", Op::atan, 1}, {"atan2", Op::atan2, 2}, {"sinh", Op::sinh, 1}, {"cosh", Op::cosh, 1}, {"tanh", Op::tanh, 1},
    {"exp", Op::exp, 1},   {"log", Op::log, 1},     {"sqrt", Op::sqrt, 1}, {"abs", Op::abs, 1},   {"sign", Op::sign, 1},
    {"step", Op::step, 1}, {"floor", Op::floor, 1}, {"ceil", Op::ceil, 1}, {"min", Op::min, 2},   {"max", Op::max, 2},
    {"pow", Op::power, 2},
};

bool starts_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
}
bool continues_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

// Compiles by recursive descent over the grammar
//     sum: product {+- product}    product: unary {*/ unary}    unary: -unary | power    power: atom [^ unary]
class Compiler {
 public:
  // Called with a dotted name. True: it is a quantity, whose value is inserted before each evaluation.
  using Quantity = std::function<bool(std::string_view name, std::size_t instruction)>;

  Compiler(std::string_view text, const Lookup& lookup, bool with_time, Quantity quantity = {})
      : text_(text), lookup_(lookup), with_time_(with_time), quantity_(std::move(quantity)) {}

  Code compile() {
    sum();
    skip_space();
    if (at_ < text_.size()) fail(fmt::format("found '{}', expected an operator or the end", text_[at_]));
    return std::move(code_);
  }
  bool uses_time() const { return uses_time_; }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw ExpressionError(int(at_) + 1, message); }

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    skip_space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void emit(Op op, double number = 0) {
    code_.instructions.push_back({op, number});
    if (op == Op::number || op == Op::time) {
      if (++depth_ > int(Code::stack_size)) fail("the expression is too deeply nested");
    } else if (Code::is_binary(op)) {
      --depth_;
    }
  }

  void sum() {
    if (++nesting_ > 100) fail("the expression is too deeply nested");
    product();
    for (;;) {
      if (take('+')) {
        product();
        emit(Op::add);
      } else if (take('-')) {
        product();
        emit(Op::subtract);
      } else {
        break;
      }
    }
    --nesting_;
  }

  void product() {
    unary();
    for (;;) {
      if (take('*')) {
        unary();
        emit(Op::multiply);
      } else if (take('/')) {
        unary();
        emit(Op::divide);
      } else {
        return;
      }
    }
  }

  void unary() {
    int minus = 0;
    for (;;) {
      if (take('-'))
        ++minus;
      else if (!take('+'))
        break;
    }
    power();
    if (minus % 2) emit(Op::negate);
  }

  void power() {
    atom();
    if (!take('^')) return;
    if (++nesting_ > 100) fail("the expression is too deeply nested");
    unary();
    --nesting_;
    emit(Op::power);
  }

  void atom() {
    skip_space();
    if (at_ >= text_.size()) fail("the expression ends where a number, a name or '(' was expected");
    const char c = text_[at_];
    if (c == '(') {
      ++at_;
      sum();
      if (!take(')')) fail("expected ')'");
    } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      number();
    } else if (starts_name(c)) {
      name();
    } else {
      fail(
          fmt::format("found '{}', expected a number, a name or '('{}", c, c == '*' ? "; a power is written x^2" : ""));
    }
  }

  void number() {
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fail("the number is too large, too small or malformed");
    at_ = std::size_t(end - text_.data());
    emit(Op::number, value);
  }

  void name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (continues_name(text_[at_]) || (quantity_ && text_[at_] == '.'))) ++at_;
    const std::string_view word = text_.substr(start, at_ - start);
    const int column = int(start) + 1;
    if (take('(')) return call(word, column);
    if (word == "pi") return emit(Op::number, std::numbers::pi);
    if (word == "t") {
      if (!with_time_) throw ExpressionError(column, "`t` stands only where a law of time is expected");
      uses_time_ = true;
      return emit(Op::time);
    }
    if (quantity_ && quantity_(word, code_.instructions.size())) return emit(Op::number);
    emit(Op::number, lookup_(word, column));
  }

  void call(std::string_view word, int column) {
    std::vector<std::string> names;
    for (const Function& f : functions) {
      if (word != f.name) {
        names.push_back(f.name);
        continue;
      }
      for (int i = 0; i < f.arguments; ++i) {
        if (i > 0 && !take(',')) fail(fmt::format("{} takes {} arguments; expected ','", f.name, f.arguments));
        sum();
      }
      if (!take(')'))
        fail(fmt::format("{} takes {} argument{}; expected ')'", f.name, f.arguments, f.arguments > 1 ? "s" : ""));
      return emit(f.op);
    }
    throw ExpressionError(column, fmt::format("no function \"{}\"{}", shortened(word), did_you_mean(word, names)));
  }

  std::string_view text_;
  const Lookup& lookup_;
  bool with_time_;
  Quantity quantity_;
  Code code_;
  std::size_t at_ = 0;
  int depth_ = 0, nesting_ = 0;
  bool uses_time_ = false;
};

void require_finite(double value) {
  if (std::isnan(value)) throw ExpressionError(1, "the value is not a number (0/0, sqrt(-1), ...)");
  if (std::isinf(value)) throw ExpressionError(1, fmt::format("the value is {}, expected a finite number", value));
}

}  // namespace

TimeFunction compile_time_function(std::string_view text, const Lookup& lookup) {
  Compiler compiler(text, lookup, true);
  auto code = std::make_shared<const Code>(compiler.compile());
  const TimeFunction law(code, std::string(text));
  if (compiler.uses_time()) return law;
  const double value = law(0);
  require_finite(value);
  return TimeFunction(value);
}

double evaluate(std::string_view text, const Lookup& lookup) {
  Compiler compiler(text, lookup, false);
  const double value = TimeFunction(std::make_shared<const Code>(compiler.compile()), std::string(text))(0);
  require_finite(value);
  return value;
}

Formula::Formula(std::string_view text, const std::vector<std::string>& names, const Lookup& lookup) {
  const Compiler::Quantity quantity = [&](std::string_view name, std::size_t instruction) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return false;
    const int index = int(found - names.begin());
    const auto used = std::find(uses_.begin(), uses_.end(), index);
    slots_.emplace_back(instruction, std::size_t(used - uses_.begin()));
    if (used == uses_.end()) uses_.push_back(index);
    return true;
  };
  code_ = std::make_shared<const Code>(Compiler(text, lookup, false, quantity).compile());
}

double Formula::operator()(const std::vector<double>& values) const {
  auto code = std::make_shared<JetCode>(*code_);
  for (const auto& [instruction, value] : slots_) code->instructions[instruction].number = values[value];
  return TimeFunction(std::move(code), "")(0);
}

std::vector<std::string> function_signatures() {
  std::vector<std::string> all;
  for (const Function& f : functions) all.push_back(fmt::format("{}({})", f.name, f.arguments == 1 ? "x" : "x, y"));
  return all;
}

bool is_name(std::string_view text) {
  if (text.empty() || !starts_name(text[0])) return false;
  for (const char c : text)
    if (!continues_name(c)) return false;
  return true;
}

std::vector<std::string_view> names_in(std::string_view text) {
  std::vector<std::string_view> names;
  for (std::size_t at = 0, start = 0; at < text.size(); start = at) {
    if (starts_name(text[at])) {
      while (at < text.size() && (continues_name(text[at]) || text[at] == '.')) ++at;
      names.push_back(text.substr(start, at - start));
    } else if (std::isdigit(static_cast<unsigned char>(text[at]))) {
      double number = 0;  // 1e5 contains no name
      at = std::size_t(std::from_chars(text.data() + at, text.data() + text.size(), number).ptr - text.data());
    } else {
      ++at;
    }
  }
  return names;
}

}  // namespace trammel::scene
