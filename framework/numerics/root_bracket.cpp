#include "numerics/root_bracket.hpp"

#include <cstdint>

#include <boost/math/tools/toms748_solve.hpp>

namespace trammel::numerics {

RootBracket narrow(const std::function<double(double)>& f, RootBracket bracket, double resolution) {
  if (bracket.f_low == 0) return {bracket.low, bracket.low, 0, 0};
  if (bracket.f_high == 0) return {bracket.high, bracket.high, 0, 0};
  std::uintmax_t evaluations = 200;  // bisection from any bracket of doubles to its last bit takes far fewer
  const auto narrow_enough = [resolution](double low, double high) { return high - low <= resolution; };
  const auto [low, high] = boost::math::tools::toms748_solve(f, bracket.low, bracket.high, bracket.f_low,
                                                             bracket.f_high, narrow_enough, evaluations);
  // The values at the ends are not handed out; evaluating again would cost a step each, and only the signs are of use.
  return {low, high, bracket.f_low, bracket.f_high};
}

}  // namespace trammel::numerics
