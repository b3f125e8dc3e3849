// The postfix code behind a TimeFunction.
#pragma once

#include <vector>

#include <trammel/time_function.hpp>

namespace trammel {

class TimeFunction::Code {
 public:
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
  struct Instruction {
    Op op;
    double number = 0;
  };

  static constexpr std::size_t stack_size = 64;  // the compiler refuses expressions that need more
  std::vector<Instruction> instructions;
};

}  // namespace trammel
