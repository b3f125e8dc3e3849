// A law of time given by a table: a motion measured or computed elsewhere, such as an earthquake record.
//
// Quintic pieces with value x, rate v and second derivative a at the rows (t_i, x_i, v_i, a_i), made from one column:
//
//     values          x_i given; v_i and a_i such that the third and fourth derivatives are continuous too (the quintic
//                     spline), with v = a = 0 in the first and the last row: the motion comes from rest and goes to rest
//     accelerations   a_i given, joined by the natural cubic spline, whose two integrals are exact here; x = v = 0 in the
//                     first row. Where the last row has v != 0, the record has a drift that nothing corrects.
//
// Before the first row the law rests there; after the last it goes on with v of that row (0 for values). So it is twice
// continuously differentiable throughout if accelerations start and end with 0, and else has a jump of a there.
// Source: de Boor, A Practical Guide to Splines (osculatory interpolation, end conditions).
#pragma once

#include <vector>

#include "scene/law_code.hpp"

namespace trammel {

class TabulatedLaw final : public TimeFunction::Code {
 public:
  // t rises strictly; at least 2 rows.
  static TabulatedLaw of_values(std::vector<double> t, std::vector<double> x);
  static TabulatedLaw of_accelerations(std::vector<double> t, std::vector<double> a);

  TimeFunction::Jet jet(double t) const override;

 private:
  TabulatedLaw() = default;
  std::vector<double> t_, x_, v_, a_;
};

}  // namespace trammel
