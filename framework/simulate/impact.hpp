// Newton's impact law for all contacts that touch, solved together.
//
//     M (v+ - v-) + G_b^T L_b = sum_i n_i L_i,       u_i = gap rate [m/s], negative when closing;  bilateral rows keep theirs
//     0 <= L_i  complementary to  u_i+ + e_i u_i- >= 0     for contacts that were open
//     0 <= L_i  complementary to  u_i+ - u_i-     >= 0     for contacts that were closed (they keep u-, 0 but for round-off)
//
// L_i [N s] are the impulses, e_i the restitution of the contact's law at approach speed -u_i-; slower than the law's
// capture_speed e_i = 0. With D the Delassus matrix, u+ = u- + D L makes it a linear complementarity problem in L. Several
// contacts at once are one problem; nature may answer otherwise (Pfeiffer, Glocker 1996), and a chain of equal balls does.
// Energy lost through contact i is -L_i (u_i- + u_i+)/2; the sum is the loss of kinetic energy if no row depends on time.
#pragma once

#include <vector>

#include "model/assembled_system.hpp"

namespace trammel::simulate {

struct TouchingContact {
  int contact = 0;
  bool was_closed = false;
  double before = 0;       // u- [m/s]
  double restitution = 0;  // e
  double impulse = 0;      // L [N s]
  double after = 0;        // u+ [m/s]
  double energy_lost() const { return -0.5 * impulse * (before + after); }
};

class Impact {
 public:
  // At the system's current point. `before` and `was_closed` of each are filled in; the jump of v is returned in `dv`.
  // False: the problem has no solution.
  [[nodiscard]] bool solve(model::AssembledSystem& system, std::vector<TouchingContact>& touching, Vec& dv);

 private:
  std::vector<int> contacts_;
  Mat jump_, delassus_;
  Vec q_, impulses_, slack_;
};

}  // namespace trammel::simulate
