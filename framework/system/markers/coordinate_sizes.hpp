// The sizes on which a scene changes, by coordinate: what counts as a small change of a coordinate is a part of its
// size, whatever the unit of lengths and wherever the scene stands.
//
// Where the scene starts:
//
//     L: the largest extent of the body by its markers, or distance to what a joint or force ties it to; without one
//        the scene's largest, without that the place of its markers, without that 1 m
//     size of coordinate i: the smallest of L / |dx/dq_i| and 1 rad / |dtheta/dq_i| of the body's markers
//
// A place has L, an angle 1 rad. Central differences, too, step by parts of these: of eps^(1/3), where round-off and
// truncation balance; of coordinates far from the origin eps is the round-off of the place against the size.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/types.hpp>

namespace trammel::model {

inline constexpr double difference_share = 6e-6;  // of a size

// Of a place or angle `at` that changes other numbers by way of a body's motion.
inline double difference_step(double size, double at = 0) {
  const double round_off = std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(at) / size);
  return size * std::max(difference_share, std::cbrt(round_off));
}

// Of a place that is moved by an exact number: no less than its digits.
inline double exact_difference_step(double size, double at) {
  return std::max(difference_share * size, 512 * std::numeric_limits<double>::epsilon() * std::abs(at));
}

struct CoordinateSizes {
  Vec of;  // by velocity coordinate [m, rad]
  // What one row has of a coordinate that turns a body is a lever; the body's extent [m], 1 of other coordinates.
  Vec levers;
  double length = 1;  // the scene's [m]
  double place = 1;  // the largest coordinate of a place or angle in its sizes, 1 at least: what round-off is a part of

  // In sizes.
  double largest(const Vec& dq) const { return dq.size() > 0 ? dq.cwiseQuotient(of).lpNorm<Eigen::Infinity>() : 0; }
  // Of a force: the work over a size [N m].
  double largest_work(const Vec& f) const { return f.size() > 0 ? f.cwiseProduct(of).lpNorm<Eigen::Infinity>() : 0; }
  // By which dq is multiplied to be a step of a central difference.
  double difference_step(const Vec& dq) const { return model::difference_step(1, place) / largest(dq); }
};

}  // namespace trammel::model
