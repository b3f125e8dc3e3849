#include "scene/laws/jet_code.hpp"

#include <array>
#include <cmath>

namespace trammel {

namespace {

using Jet = TimeFunction::Jet;
using Code = JetCode;

// f(u) by the chain rule: f, f' and f'' at u.
Jet chain(const Jet& u, double f, double df, double ddf) {
  return {f, df * u.rate, ddf * u.rate * u.rate + df * u.second};
}

Jet multiply(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.second * b.value + 2 * a.rate * b.rate + a.value * b.second};
}

Jet inverse(const Jet& u) {
  const double y = 1 / u.value;
  return chain(u, y, -y * y, 2 * y * y * y);
}

bool constant(const Jet& u) {
  return u.rate == 0 && u.second == 0;
}

// u^w. A constant exponent permits u <= 0; a varying one is evaluated as exp(w log u).
Jet power(const Jet& u, const Jet& w) {
  const double p = w.value, y = std::pow(u.value, p);
  if (constant(w)) {
    if (constant(u)) return {y, 0, 0};
    const double dy = p == 0 ? 0 : p * std::pow(u.value, p - 1);
    const double ddy = p == 0 || p == 1 ? 0 : p * (p - 1) * std::pow(u.value, p - 2);
    return chain(u, y, dy, ddy);
  }
  const double l = std::log(u.value);
  const Jet exponent = multiply(w, chain(u, l, 1 / u.value, -1 / (u.value * u.value)));
  return chain(exponent, y, y, y);
}

Jet atan2(const Jet& y, const Jet& x) {
  const double r2 = x.value * x.value + y.value * y.value;
  const double rate = (x.value * y.rate - y.value * x.rate) / r2;
  const double r2_rate = 2 * (x.value * x.rate + y.value * y.rate);
  return {std::atan2(y.value, x.value), rate, (x.value * y.second - y.value * x.second - rate * r2_rate) / r2};
}

Jet apply(Code::Op op, const Jet& u) {
  const double x = u.value;
  switch (op) {
    case Code::Op::negate:
      return {-u.value, -u.rate, -u.second};
    case Code::Op::sin:
      return chain(u, std::sin(x), std::cos(x), -std::sin(x));
    case Code::Op::cos:
      return chain(u, std::cos(x), -std::sin(x), -std::cos(x));
    case Code::Op::tan: {
      const double y = std::tan(x), d = 1 + y * y;
      return chain(u, y, d, 2 * y * d);
    }
    case Code::Op::asin: {
      const double d = 1 / std::sqrt(1 - x * x);
      return chain(u, std::asin(x), d, x * d * d * d);
    }
    case Code::Op::acos: {
      const double d = -1 / std::sqrt(1 - x * x);
      return chain(u, std::acos(x), d, x * d * d * d);
    }
    case Code::Op::atan: {
      const double d = 1 / (1 + x * x);
      return chain(u, std::atan(x), d, -2 * x * d * d);
    }
    case Code::Op::sinh:
      return chain(u, std::sinh(x), std::cosh(x), std::sinh(x));
    case Code::Op::cosh:
      return chain(u, std::cosh(x), std::sinh(x), std::cosh(x));
    case Code::Op::tanh: {
      const double y = std::tanh(x), d = 1 - y * y;
      return chain(u, y, d, -2 * y * d);
    }
    case Code::Op::exp:
      return chain(u, std::exp(x), std::exp(x), std::exp(x));
    case Code::Op::log:
      return chain(u, std::log(x), 1 / x, -1 / (x * x));
    case Code::Op::sqrt: {
      const double y = std::sqrt(x);
      return constant(u) ? Jet{y, 0, 0} : chain(u, y, 0.5 / y, -0.25 / (y * x));
    }
    case Code::Op::abs:
      return x < 0 ? Jet{-u.value, -u.rate, -u.second} : u;
    case Code::Op::sign:
      return {x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0, 0, 0};
    case Code::Op::step:
      return {x < 0 ? 0.0 : 1.0, 0, 0};
    case Code::Op::floor:
      return {std::floor(x), 0, 0};
    case Code::Op::ceil:
      return {std::ceil(x), 0, 0};
    default:
      return u;
  }
}

Jet apply(Code::Op op, const Jet& a, const Jet& b) {
  switch (op) {
    case Code::Op::add:
      return {a.value + b.value, a.rate + b.rate, a.second + b.second};
    case Code::Op::subtract:
      return {a.value - b.value, a.rate - b.rate, a.second - b.second};
    case Code::Op::multiply:
      return multiply(a, b);
    case Code::Op::divide:
      return multiply(a, inverse(b));
    case Code::Op::power:
      return power(a, b);
    case Code::Op::atan2:
      return atan2(a, b);
    case Code::Op::min:
      return b.value < a.value ? b : a;
    case Code::Op::max:
      return b.value > a.value ? b : a;
    default:
      return a;
  }
}

// The branch of a switch with one argument or two.
double way_of(Code::Op op, const Jet& u) {
  switch (op) {
    case Code::Op::floor:
      return std::floor(u.value);
    case Code::Op::ceil:
      return std::ceil(u.value);
    case Code::Op::sign:
      return u.value > 0 ? 1 : u.value < 0 ? -1 : 0;
    default:
      return u.value < 0 ? 0 : 1;
  }
}
double way_of(Code::Op op, const Jet& a, const Jet& b) {
  return op == Code::Op::min ? b.value < a.value : b.value > a.value;
}

}  // namespace

Jet JetCode::jet(double t) const {
  return run(t, nullptr);
}

void JetCode::branches(double t, std::vector<double>& way) const {
  way.clear();
  run(t, &way);
}

namespace {

// Not initialised, because clearing it would cost more than most laws.
union Stack {
  Stack() {}
  std::array<Jet, JetCode::stack_size> jets;
};

}  // namespace

Jet JetCode::run(double t, std::vector<double>* way) const {
  Stack room;
  auto& stack = room.jets;
  std::size_t top = 0;  // one past the last
  for (const Instruction& i : instructions) {
    const bool noted = way && switches(i.op);
    if (i.op == Op::number) {
      stack[top++] = {i.number, 0, 0};
    } else if (i.op == Op::time) {
      stack[top++] = {t, 1, 0};
    } else if (is_binary(i.op)) {
      --top;
      if (noted) way->push_back(way_of(i.op, stack[top - 1], stack[top]));
      stack[top - 1] = apply(i.op, stack[top - 1], stack[top]);
    } else {
      if (noted) way->push_back(way_of(i.op, stack[top - 1]));
      stack[top - 1] = apply(i.op, stack[top - 1]);
    }
  }
  return stack[0];
}

namespace {

// Smaller values and derivatives of laws count as 0, so that squares and products of loads do not underflow: a gaussian
// is 1e-300 far from its middle, and friction needs the direction of what it drives.
constexpr double least_value = 1e-100;

double or_zero(double x) {
  return std::abs(x) < least_value ? 0 : x;
}

}  // namespace

Jet TimeFunction::jet(double t) const {
  if (!code_) return {constant_, 0, 0};
  const Jet all = code_->jet(t);
  return {or_zero(all.value), or_zero(all.rate), or_zero(all.second)};
}

std::string TimeFunction::text() const {
  return code_ ? text_ : std::to_string(constant_);
}

}  // namespace trammel
