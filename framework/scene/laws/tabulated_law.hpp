// A law of time from a table: a measured or computed motion, such as an earthquake record.
//
// Quintic pieces interpolate value x, rate v and second derivative a at the rows (t_i, x_i, v_i, a_i), which follow
// from one column:
//
//     values          x_i given; v_i and a_i make the third and fourth derivatives continuous (quintic spline), with
//                     v = a = 0 in the first and the last row: the motion starts and ends at rest
//     accelerations   a_i given, interpolated by the natural cubic spline and integrated twice exactly; x = v = 0 in
//                     the first row. If the last row has v != 0, the record has a drift, which is not corrected.
//
// `Beyond` defines the column outside the rows:
//
//     hold     the value of the row at that end (for accelerations: a constant acceleration)
//     zero     0: values jump to 0; with accelerations the velocity remains constant
//     repeat   periodic: the last row is the first one of the next period. Values that end where they began are joined
//              by the periodic quintic spline, others jump. With accelerations the velocity gained in a period is kept.
//
// Source: de Boor, A Practical Guide to Splines (osculatory interpolation, end conditions).
#pragma once

#include <array>
#include <vector>

#include "scene/laws/law_code.hpp"

namespace trammel {

class TabulatedLaw final : public TimeFunction::Code {
 public:
  enum class Beyond { unsaid, hold, zero, repeat };  // unsaid: the law is defined between its first and last row only

  // t is strictly increasing; at least 3 rows.
  static TabulatedLaw of_values(std::vector<double> t, std::vector<double> x, Beyond beyond = Beyond::unsaid);
  static TabulatedLaw of_accelerations(std::vector<double> t, std::vector<double> a, Beyond beyond = Beyond::unsaid);

  TimeFunction::Jet jet(double t) const override;
  scene::Series enclose(const scene::Range& t, int n) const override;
  bool equals(const Code& other) const override;
  void branches(double t, std::vector<double>& way) const override;
  Span span() const override;

 private:
  TabulatedLaw() = default;
  // A quintic between two rows: x = sum c_k s^k, s from 0 to 1 over the length h.
  struct Piece {
    double h;
    std::array<double, 6> c;
  };
  Piece piece(std::size_t end) const;  // end: the later one of its rows
  TimeFunction::Jet between_rows(double t) const;
  TimeFunction::Jet held(std::size_t row, double t) const;
  TimeFunction::Jet repeated(double t) const;
  double period(double t) const;  // number of periods before t
  bool is_periodic() const;       // nothing jumps where periods meet
  scene::Series enclose_periods(const scene::Range& t, int n) const;
  scene::Series enclose_once(const scene::Range& t, int n) const;
  scene::Series enclose_beyond(const scene::Range& t, int n) const;
  scene::Series enclose_rows(const scene::Range& t, int n) const;
  scene::Series enclose_piece(std::size_t end, const scene::Range& t, int n) const;

  static constexpr int smooth_at_rows = 5;  // the fourth derivative is continuous

  Beyond beyond_ = Beyond::unsaid;
  bool of_accelerations_ = false;
  std::vector<double> t_, x_, v_, a_;
};

}  // namespace trammel
