// Decides which forces along contacts' directions are round-off, by the forces that act on the contact itself:
//
//     |F_i| <= part * s_i    or    |F_i| D_ii <= no_acceleration,       s_i = sum_j |D_ij F_j| / D_ii   [N]
//
// D is the Delassus matrix of the directions. The error of a solution for F_i is a part of s_i, the sum of the forces
// that the others exert along i. Bodies that exert no force there do not enter, however heavy they are. Methods that
// stabilise rows (by beta^2 g) turn the rounding of places into accelerations, which count as none, too.
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct Judged {
  Vec scale;  // s_i [N]
  Vec noise;  // [N] smaller is no force, whatever `scale` is
  Vec speed;  // [m/s] that forces of this scale give over the scene's length
};
// F [N] along directions of closed contacts, at the system's point.
Judged judge_forces(model::AssembledSystem& system, const std::vector<model::ContactDirection>& directions,
                    const Vec& F, const ContactScale& scale);

// [N] A smaller friction force counts as none: it accelerates the contact less than `no_acceleration`.
double friction_noise(model::AssembledSystem& system, const ContactScale& scale, int contact);
// [N] Forces of this size along all of these directions at once accelerate no contact more than that, or a force is as
// large that holds a contact against its rounded place.
double force_noise(model::AssembledSystem& system, const ContactScale& scale,
                   const std::vector<model::ContactDirection>& directions);

}  // namespace trammel::simulate
