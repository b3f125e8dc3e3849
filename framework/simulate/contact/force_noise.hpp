// Which forces along contacts' directions are round-off, each judged by what acts on its own contact:
//
//     |F_i| <= part * s_i    or    |F_i| D_ii <= no_acceleration,       s_i = sum_j |D_ij F_j| / D_ii   [N]
//
// D is the Delassus matrix of the directions. A solution for F is off by a part of s_i, the forces that the others are
// felt as along i; bodies that act on nothing there add nothing, however heavy they are.
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct Judged {
  Vec scale;  // s_i [N]
  Vec noise;  // [N] no force, whatever `scale` is
};
// F [N] along directions of closed contacts, at the system's point.
Judged judge_forces(model::AssembledSystem& system, const std::vector<model::ContactDirection>& directions,
                    const Vec& F, const ContactScale& scale);

}  // namespace trammel::simulate
