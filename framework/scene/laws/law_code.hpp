// The implementation of a TimeFunction that is not constant: an expression (JetCode) or a table (TabulatedLaw).
#pragma once

#include <limits>
#include <vector>

#include <trammel/time_function.hpp>

#include "scene/laws/series.hpp"

namespace trammel {

class TimeFunction::Code {
 public:
  virtual ~Code() = default;
  virtual Jet jet(double t) const = 0;
  // Ranges of the law and its derivatives over an interval of time, up to the n-th.
  virtual scene::Series enclose(const scene::Range& t, int n) const = 0;
  virtual bool equals(const Code& other) const = 0;
  // The branch of each switch of the law (step, abs, max, ...) at t. If the list is equal at two times, no switching
  // between them is detected.
  virtual void branches(double /*t*/, std::vector<double>& way) const { way.clear(); }
  // [s] The interval where the law is defined. Outside it is evaluated only for differences at an end.
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
