// Interval arithmetic: where values may be, for arguments anywhere in given intervals.
//
// Ends are rounded to nearest, so enclosures hold up to round-off. A quantity that occurs twice in a formula counts as
// two: x - x of [0, 1] is [-1, 1]. Such an enclosure exceeds the set of values in proportion to the interval's length.
// Division by an interval with 0 inside gives all numbers.
#pragma once

#include <algorithm>
#include <cmath>

#include <boost/numeric/interval.hpp>

namespace trammel::scene {

namespace rounding = boost::numeric::interval_lib;
using Range =
    boost::numeric::interval<double,
                             rounding::policies<rounding::save_state_nothing<rounding::rounded_transc_exact<double>>,
                                                rounding::checking_base<double>>>;

inline double largest(const Range& x) {  // absolute value
  return std::max(std::abs(x.lower()), std::abs(x.upper()));
}
inline double half_width(const Range& x) {
  return (x.upper() - x.lower()) / 2;
}
inline bool is_zero(const Range& x) {
  return x.lower() == 0 && x.upper() == 0;
}
inline bool has_zero(const Range& x) {
  return x.lower() <= 0 && 0 <= x.upper();
}

}  // namespace trammel::scene
