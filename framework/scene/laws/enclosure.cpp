// Ranges of laws of time and of their derivatives over an interval of time.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/laws/jet_code.hpp"
#include "scene/laws/tabulated_law.hpp"

namespace trammel {
namespace {

using scene::Range;
using scene::Series;

double sign_of(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}
double step_of(double x) {
  return x < 0 ? 0 : 1;
}

Series enclosure(JetCode::Op op, const Series& u) {
  using Op = JetCode::Op;
  switch (op) {
    case Op::negate:
      return -u;
    case Op::sin:
      return sin(u);
    case Op::cos:
      return cos(u);
    case Op::tan:
      return tan(u);
    case Op::asin:
      return asin(u);
    case Op::acos:
      return acos(u);
    case Op::atan:
      return atan(u);
    case Op::sinh:
      return sinh(u);
    case Op::cosh:
      return cosh(u);
    case Op::tanh:
      return tanh(u);
    case Op::exp:
      return exp(u);
    case Op::log:
      return log(u);
    case Op::sqrt:
      return power(u, 0.5);
    case Op::abs:
      return abs(u);
    case Op::sign:
      return piecewise_constant(sign_of, u);
    case Op::step:
      return piecewise_constant(step_of, u);
    case Op::floor:
      return piecewise_constant(std::floor, u);
    case Op::ceil:
      return piecewise_constant(std::ceil, u);
    default:
      return u;
  }
}

Series enclosure(JetCode::Op op, const Series& a, const Series& b) {
  using Op = JetCode::Op;
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a * inverse(b);
    case Op::power:
      return power(a, b);
    case Op::atan2:
      return atan2(a, b);
    case Op::min:
      return least(a, b);
    case Op::max:
      return greatest(a, b);
    default:
      return a;
  }
}

// Not initialised, because clearing it would cost more than most laws.
union SeriesStack {
  SeriesStack() {}
  std::array<Series, JetCode::stack_size> all;
};

}  // namespace

Series JetCode::enclose(const Range& t, int n) const {
  SeriesStack room;
  auto& stack = room.all;
  std::size_t top = 0;  // one past the last
  for (const Instruction& i : instructions) {
    if (i.op == Op::number) {
      stack[top++] = scene::constant(i.number, n);
    } else if (i.op == Op::time) {
      stack[top++] = scene::variable(t, n);
    } else if (is_binary(i.op)) {
      --top;
      stack[top - 1] = enclosure(i.op, stack[top - 1], stack[top]);
    } else {
      stack[top - 1] = enclosure(i.op, stack[top - 1]);
    }
  }
  return stack[0];
}

Series TabulatedLaw::enclose(const Range& t, int n) const {
  Series all = beyond_ == Beyond::repeat ? enclose_periods(t, n) : enclose_once(t, n);
  if (singleton(t)) {
    const TimeFunction::Jet at = jet(t.lower());
    all.c[0] = at.value, all.c[1] = at.rate, all.c[2] = at.second / 2;
  }
  return all;
}

// Values and rates of accelerations that repeat grow from period to period: they are left open.
Series TabulatedLaw::enclose_periods(const Range& t, int n) const {
  const double length = t_.back() - t_.front(), before = period(t.lower()), after = period(t.upper());
  const double begin = t.lower() - before * length, end = t.upper() - after * length;
  Series all = before == after ? enclose_rows({begin, end}, n)
                               : hull(enclose_rows({begin, t_.back()}, n), enclose_rows({t_.front(), end}, n));
  if (after > before + 1) all = hull(all, enclose_rows({t_.front(), t_.back()}, n));
  if (after > before) all.smooth = of_accelerations_ ? 2 : is_periodic() ? smooth_at_rows : 0;
  if (of_accelerations_) all.c[0] = all.c[1] = Range::whole();
  return all;
}

Series TabulatedLaw::enclose_once(const Range& t, int n) const {
  const double begin = std::max(t.lower(), t_.front()), end = std::min(t.upper(), t_.back());
  if (begin == t.lower() && end == t.upper()) return enclose_rows(t, n);
  Series all = enclose_beyond(t, n);
  if (!(begin < end)) return all;
  const int smooth = beyond_ != Beyond::zero ? 3 : of_accelerations_ ? 2 : 0;
  all = hull(all, enclose_rows({begin, end}, n));
  all.smooth = std::min(all.smooth, smooth);
  return all;
}

// Both ends of t are beyond rows, or one is; constant value or acceleration there.
Series TabulatedLaw::enclose_beyond(const Range& t, int n) const {
  const double from = t.lower() < t_.front() ? t.lower() : t.upper(),
               to = t.upper() > t_.back() ? t.upper() : t.lower();
  Series all = scene::constant(0, n);
  const TimeFunction::Jet a = jet(from), b = jet(to);
  all.c[0] = of_accelerations_ ? Range::whole() : Range::hull(a.value, b.value);
  if (n > 0) all.c[1] = of_accelerations_ ? Range::whole() : Range(0.0);
  if (n > 1) all.c[2] = 0.5 * Range::hull(a.second, b.second);
  return all;
}

// Within the rows, or beyond them by round-off.
Series TabulatedLaw::enclose_rows(const Range& t, int n) const {
  std::size_t j = std::size_t(std::upper_bound(t_.begin() + 1, t_.end() - 1, t.lower()) - t_.begin());
  Series all = enclose_piece(j, t, n);
  while (j + 1 < t_.size() && t_[j] < t.upper()) all = hull(all, enclose_piece(++j, t, n));
  all.smooth = smooth_at_rows;
  return all;
}

// The part of t between two rows. Derivatives of the quintic in s, highest first.
Series TabulatedLaw::enclose_piece(std::size_t end, const Range& t, int n) const {
  const Piece x = piece(end);
  const double begin = t_[end - 1];
  const auto place = [&](double time) { return (std::clamp(time, begin, t_[end]) - begin) / x.h; };
  const Range s(place(t.lower()), place(t.upper()));
  Series all = scene::constant(0, n);
  double over = 1;  // 1 / h^k
  for (int k = 0; k <= n && k <= 5; ++k, over /= x.h) {
    Range sum;
    for (int i = 5; i >= k; --i) {
      double binomial = 1;  // of i over k
      for (int m = 0; m < k; ++m) binomial *= double(i - m) / (m + 1);
      sum = s * sum + binomial * x.c[std::size_t(i)];
    }
    all.c[std::size_t(k)] = over * sum;
  }
  return all;
}

}  // namespace trammel
