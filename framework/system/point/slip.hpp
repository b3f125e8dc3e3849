// Slip in the tangents of a contact: one in the plane, two in space.
//
//     s [m/s]  slip velocity of A over B          F_t = -mu F_n e     sliding friction
//     e = s/|s|  where s is not 0                  d     the direction of s at the beginning of the step
//
// With x = s . d and y = s . p, p perpendicular to d (in the plane y = 0 and d = +1 or -1),
//
//     e = (X d + y p) / |X d + y p|,   X = max(|x|, least)
//
// e equals s/|s| while the slip turns by less than a right angle in the step, x > least. If the step goes beyond that,
// friction still acts against d, as in the plane, so that x decreases through 0 and its zero can be located. There the
// contact either is at rest, |y| <= least, or the slip has turned and d is set again (contact_mode.hpp). `least` [m/s]
// also bounds the stiffness mu F_n / |s| across the slip.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace trammel::model {

// Components along the tangents of a contact, which are fixed in B; in the plane the second is 0.
using Tangential = Eigen::Vector2d;

class SlipDirection {
 public:
  SlipDirection(const Tangential& s, const Tangential& d, double least)
      : d_(d), p_(-d[1], d[0]), x_(s.dot(d)), y_(s.dot(p_)), least_(least), X_(std::max(std::abs(x_), least)) {}

  double along() const { return x_; }
  double across() const { return y_; }
  Tangential unit() const {
    if (y_ == 0) return d_;
    return (X_ * d_ + y_ * p_) / std::hypot(X_, y_);
  }
  // de/ds [s/m]
  Eigen::Matrix2d slope() const {
    const double R = std::hypot(X_, y_);
    if (R == 0) return Eigen::Matrix2d::Zero();
    const double X_x = std::abs(x_) > least_ ? std::copysign(1.0, x_) : 0;
    return (y_ * d_ - X_ * p_) * (y_ * X_x * d_ - X_ * p_).transpose() / (R * R * R);
  }

 private:
  Tangential d_, p_;
  double x_, y_, least_, X_;
};

}  // namespace trammel::model
