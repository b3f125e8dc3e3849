// What stands behind a TimeFunction that is no constant: an expression (JetCode) or a table (TabulatedLaw).
#pragma once

#include <limits>
#include <vector>

#include <trammel/time_function.hpp>

namespace trammel {

class TimeFunction::Code {
 public:
  virtual ~Code() = default;
  virtual Jet jet(double t) const = 0;
  // Which way each switch of the law (step, abs, max, ...) is thrown at t. Where the list is the same at two times, no
  // switch was seen between them.
  virtual void branches(double /*t*/, std::vector<double>& way) const { way.clear(); }
  // [s] Where the law says what it is. Outside it may be asked for nothing but differences at an end.
  struct Span {
    double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
  };
  virtual Span span() const { return {}; }

 protected:
  Code() = default;
  Code(const Code&) = default;
  Code& operator=(const Code&) = default;
};

}  // namespace trammel
