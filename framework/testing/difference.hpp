// Derivatives by differences with an estimate of their error, and claims compared with them.
//
//     D_0j = (f(h_j) - f(-h_j))/(2 h_j),  h_j = h/2^j,    D_ij = (4^i D_(i-1)j - D_(i-1)(j-1))/(4^i - 1)
//
// per entry the D_ij that differs least from its two parents, by that difference. Source: Ridders 1982, Adv. Eng.
// Software 4(2), 75-76.
#pragma once

#include <functional>
#include <string>

#include <trammel/testing/measurements.hpp>

namespace trammel {

struct Difference {
  Vec value, error;  // error: of the extrapolation, per entry
  double size = 0;   // largest entry of f
  double h = 0;      // largest step
  Vec round_off;     // of f over the step that was best
};
// f'(0) from steps `h` downwards.
Difference difference(const std::function<Vec(double)>& f, double h);

// One claim, checked in many places; the worst is reported.
class Comparison {
 public:
  explicit Comparison(std::string claim) : claim_(std::move(claim)) {}

  // Entry by entry within the differences' error; `noise` is the uncertainty of `claimed` itself.
  void derivative(const Vec& claimed, const Difference& d, const std::string& where, double noise = 0);
  void within(double found, double expected, double allowed, const std::string& where);
  void within(const Mat& found, const Mat& expected, double allowed, const std::string& where);
  void holds(bool true_, const std::string& found);
  Report report() const;

 private:
  void keep(double ratio, const std::function<std::string()>& text);

  std::string claim_, worst_text_;
  double worst_ = 0;  // error over what is allowed
};

// A report of one claim, from a function that fills its comparison.
Report compare(const std::string& claim, const std::function<void(Comparison&)>& fill);

}  // namespace trammel
