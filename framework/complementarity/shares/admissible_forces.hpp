// Of all forces with the same resultants the least ones that contacts can exert:
//
//     minimise |F|^2 / 2,    E F = lambda,    F in the friction cones: N >= 0,  |T| <= c N
//
// Its dual has no constraint: F = Pi(E^T y) with Pi the projection onto the cones, and y minimises |Pi(E^T y)|^2 / 2 -
// lambda . y, a convex function with a continuous gradient, E F - lambda, by Newton's method with the derivative of the
// piece that y is in.
// As springs of the same compliance, pushed by y, dependent contacts share this way. Where cones are thin, or no force
// is inside of them, y is far away or has no end, and Newton's method gets stuck: then an interior point method
// (cone_program.hpp) finds F.
#pragma once

#include <vector>

#include <trammel/types.hpp>

#include "complementarity/programs/cone_program.hpp"

namespace trammel::complementarity {

// A contact whose forces are shared: columns of E.
struct SharingContact {
  Eigen::Index normal = -1;            // -1: N is given
  std::vector<Eigen::Index> tangents;  // none, or those of E that belong to it
  double coefficient = 0;              // c
  double given = 0;                    // N, where `normal` is -1
};

// E F = lambda and the cones, of x = (N, T/c) of one contact after the other; G's last rows are what is given.
// Minimises |F|^2 / 2.
ConeProgram sharing_program(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda);

// Fills F; returns |E F - lambda|, round-off where there are such forces. `nearby`: y of a lambda nearby, or empty;
// returns that of this one.
double admissible_forces(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec& F,
                         Vec* nearby = nullptr);

}  // namespace trammel::complementarity
