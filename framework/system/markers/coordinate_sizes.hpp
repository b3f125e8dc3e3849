// The size of each coordinate: the change of it over which a scene changes. A small change of a coordinate is a part of
// its size, in any unit of length and at any place of the scene.
//
// From the initial state:
//
//     L       the extent of the body's markers, or the distance to what a joint or force connects it to, if larger;
//             in place of 0: the largest L of the scene, else the distance of markers from the origin, else 1 m
//     size_i  of coordinate i: the smallest of L / |dx/dq_i| and 1 rad / |dtheta/dq_i| of the body's markers
//
// Hence a place has the size L, and an angle the size 1 rad. The steps of central differences are parts of these sizes,
// too: eps^(1/3), where round-off and truncation balance; for coordinates far from the origin eps is the round-off of
// the place relative to the size.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/types.hpp>

namespace trammel::model {

inline constexpr double difference_share = 6e-6;  // of a size

// Step for a place or angle `at` that changes other numbers through a body's motion.
inline double difference_step(double size, double at = 0) {
  const double round_off = std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(at) / size);
  return size * std::max(difference_share, std::cbrt(round_off));
}

// Step for a place that enters a function exactly: at least 512 units of its round-off.
inline double exact_difference_step(double size, double at) {
  return std::max(difference_share * size, 512 * std::numeric_limits<double>::epsilon() * std::abs(at));
}

struct CoordinateSizes {
  Vec of;  // by velocity coordinate [m, rad]
  // A row's entry for a coordinate that turns a body is a lever. By velocity coordinate: the body's extent [m] if it
  // turns the body, 1 otherwise.
  Vec levers;
  double length = 1;  // [m] of the scene
  // Largest coordinate in units of its size, at least 1: reference of round-off.
  double place = 1;

  // Largest change in units of the sizes.
  double largest(const Vec& dq) const { return dq.size() > 0 ? dq.cwiseQuotient(of).lpNorm<Eigen::Infinity>() : 0; }
  // [N m] Largest work of a force over the size of a coordinate.
  double largest_work(const Vec& f) const { return f.size() > 0 ? f.cwiseProduct(of).lpNorm<Eigen::Infinity>() : 0; }
  // The factor that makes dq a step of a central difference.
  double difference_step(const Vec& dq) const { return model::difference_step(1, place) / largest(dq); }
};

}  // namespace trammel::model
