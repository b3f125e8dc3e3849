// A law of time with its first two derivatives, from a scene expression such as "=0.2*sin(2*pi*5*t)" or from a table.
#pragma once

#include <memory>
#include <string>

namespace trammel {

class TimeFunction {
 public:
  // Value, first and second derivative by t.
  struct Jet {
    double value = 0, rate = 0, second = 0;
  };
  class Code;  // compiled expression, or table

  TimeFunction() = default;  // the constant 0
  TimeFunction(double constant) : constant_(constant) {}
  explicit TimeFunction(std::shared_ptr<const Code> code, std::string text)
      : code_(std::move(code)), text_(std::move(text)) {}

  bool is_constant() const { return !code_; }
  double operator()(double t) const { return code_ ? jet(t).value : constant_; }
  Jet jet(double t) const;
  std::string text() const;  // as written in the scene
  const Code* code() const { return code_.get(); }  // null for a constant; for the framework

 private:
  std::shared_ptr<const Code> code_;
  std::string text_;
  double constant_ = 0;
};

}  // namespace trammel
