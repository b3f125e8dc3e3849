// The postfix code of an expression of t.
#pragma once

#include <vector>

#include "scene/laws/law_code.hpp"

namespace trammel {

class JetCode final : public TimeFunction::Code {
 public:
  using Jet = TimeFunction::Jet;
  enum class Op {
    number,
    time,
    add,
    subtract,
    multiply,
    divide,
    power,
    atan2,
    min,
    max,
    negate,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    sinh,
    cosh,
    tanh,
    exp,
    log,
    sqrt,
    abs,
    sign,
    step,
    floor,
    ceil
  };
  static bool is_binary(Op op) { return op >= Op::add && op <= Op::max; }
  static bool switches(Op op) { return op == Op::min || op == Op::max || op >= Op::abs; }
  struct Instruction {
    Op op;
    double number = 0;
    bool operator==(const Instruction&) const = default;
  };

  static constexpr std::size_t stack_size = 64;  // the compiler refuses expressions that need more
  std::vector<Instruction> instructions;

  Jet jet(double t) const override;
  scene::Series enclose(const scene::Range& t, int n) const override;
  bool equals(const Code& other) const override {
    const auto* code = dynamic_cast<const JetCode*>(&other);
    return code && code->instructions == instructions;
  }
  void branches(double t, std::vector<double>& way) const override;

 private:
  Jet run(double t, std::vector<double>* way) const;
};

}  // namespace trammel
