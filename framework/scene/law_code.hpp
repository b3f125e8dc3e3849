// What stands behind a TimeFunction that is no constant: an expression (JetCode) or a table (TabulatedLaw).
#pragma once

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

 protected:
  Code() = default;
  Code(const Code&) = default;
  Code& operator=(const Code&) = default;
};

}  // namespace trammel
