// The least forces with given resultants that contacts can exert:
//
//     minimise |F|^2 / 2,    E F = lambda,    F in the friction cones: N >= 0,  |T| <= c N
//
// The dual has no constraint: F = Pi(E^T y) with the projection Pi onto the cones, where y minimises |Pi(E^T y)|^2 / 2
// - lambda . y. This function is convex with a continuous gradient, E F - lambda; Newton's method takes the derivative
// of the present piece. Dependent contacts share in this way like springs of equal compliance that y pushes. If cones
// are thin, or contain no such force in their interior, y is far away or infinite and Newton's method fails; then an
// interior point method (cone_program.hpp) finds F.
#pragma once

#include <optional>
#include <vector>

#include <trammel/types.hpp>

#include "complementarity/programs/cone_program.hpp"
#include "complementarity/shares/spring.hpp"

namespace trammel::complementarity {

// A contact whose forces are shared: columns of E.
struct SharingContact {
  Eigen::Index normal = -1;            // column; -1: N is given
  std::vector<Eigen::Index> tangents;  // columns of its tangents; may be empty
  double coefficient = 0;              // c
  double given = 0;                    // N, where `normal` is -1
  bool carries = true;                 // false: spare_load does not unload it (a slack, or a contact that slides)
  Spring spring = Spring::undecided;   // springs_at_rest.hpp
  std::optional<double> push = {};     // complementarity/spring_motion.hpp: known where contacts can be wedged in
};

// The program of E F = lambda and the cones for x = (N, T/c), contact after contact, that minimises |F|^2 / 2; the last
// rows of G are the given normal forces.
ConeProgram sharing_program(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda);

// The forces F (`columns` of them) that such an x stands for.
Vec forces_of(const std::vector<SharingContact>& contacts, const Vec& x, Eigen::Index columns);

// Fills F; returns |E F - lambda|, which is round-off if such forces exist. `nearby`: y for a lambda nearby, or empty;
// on return y for this lambda.
double admissible_forces(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec& F,
                         Vec* nearby = nullptr);

}  // namespace trammel::complementarity
