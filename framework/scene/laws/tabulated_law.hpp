// A law of time given by a table: a motion measured or computed elsewhere, such as an earthquake record.
//
// Quintic pieces with value x, rate v and second derivative a at the rows (t_i, x_i, v_i, a_i), made from one column:
//
//     values          x_i given; v_i and a_i such that the third and fourth derivatives are continuous too (the quintic
//                     spline), with v = a = 0 in the first and the last row: the motion comes from rest and goes to rest
//     accelerations   a_i given, joined by the natural cubic spline, whose two integrals are exact here; x = v = 0 in the
//                     first row. Where the last row has v != 0, the record has a drift that nothing corrects.
//
// Beyond its rows a law is what `Beyond` says of the column:
//
//     hold     it keeps the value of the row at that end (of accelerations: a constant acceleration)
//     zero     it is 0 there: values jump to it, accelerations leave the velocity as it is
//     repeat   it begins anew: the last row is the first one of the next period. Values that end where they began are joined by
//              the periodic quintic spline, others jump. Of accelerations the velocity gained in a period stays.
//
// Source: de Boor, A Practical Guide to Splines (osculatory interpolation, end conditions).
#pragma once

#include <vector>

#include "scene/laws/law_code.hpp"

namespace trammel {

class TabulatedLaw final : public TimeFunction::Code {
 public:
  enum class Beyond { unsaid, hold, zero, repeat };  // unsaid: the law is known between its first and last row only

  // t rises strictly; at least 3 rows.
  static TabulatedLaw of_values(std::vector<double> t, std::vector<double> x, Beyond beyond = Beyond::unsaid);
  static TabulatedLaw of_accelerations(std::vector<double> t, std::vector<double> a, Beyond beyond = Beyond::unsaid);

  TimeFunction::Jet jet(double t) const override;
  void branches(double t, std::vector<double>& way) const override;
  Span span() const override;

 private:
  TabulatedLaw() = default;
  TimeFunction::Jet between_rows(double t) const;
  TimeFunction::Jet held(std::size_t row, double t) const;
  TimeFunction::Jet repeated(double t) const;
  double period(double t) const;  // how many periods have passed

  Beyond beyond_ = Beyond::unsaid;
  bool of_accelerations_ = false;
  std::vector<double> t_, x_, v_, a_;
};

}  // namespace trammel
