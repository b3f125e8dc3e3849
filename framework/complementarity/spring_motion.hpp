// How contacts at rest that can be wedged in follow their loads.
//
// Forces that are in balance with each other inside the friction cones (a strut between floor and ceiling) depend on
// the way of the loads: stiff springs wedge a body in by a small motion y, in which a contact slips only against its
// friction, and sticks where the loads turn back. With p = E_n^T y [N] before, the force of a spring, or minus its
// slack, a change dy gives
//
//     N = max(0, p + E_n^T dy),    E F = lambda,    |T| <= c N,    T = c N (E_t^T dy) / |E_t^T dy| where it slips
//
// which is a problem of contacts (programs/contact_point.hpp) with w = A F + b: let bodies yield by dy = s (r - E F),
//
//     w_n = N - p - E_n^T dy,    w_t = -E_t^T dy,    A = s E^T E + diag(1 for normals, 0)
//
// and r is raised by what E F misses of lambda until nothing is missed (method of multipliers). In the modes found,
// which a change of load as small as round-off of s lambda may not show, the conditions are linear: they are solved
// without yielding, and contacts that do not obey then change their modes. This is tried from the springs as they are,
// first of all. Where no dy exists, the contacts let go, whatever other forces could still hold them. There may be
// several solutions: the one near the springs as they are is sought first, with friction that holds them there if it
// can.
//
// Where contacts come to rest out of sliding, their springs are pushed as they were while they slid: a slip that ends
// moves no spring. Friction changes at once, then, from mu N to what holds beside these normal forces, if it can;
// otherwise the springs move on from there.
#pragma once

#include <optional>
#include <vector>

#include "complementarity/shares/admissible_forces.hpp"

namespace trammel::complementarity {

struct SpringMotion {
  Vec F;
  std::vector<std::optional<double>> push;  // by contact: p + E_n^T dy; none where the normal force is given
  double missed = 0;                        // |E F - lambda|
  double violated = 0;                      // [N] by how far F is not that of springs and friction
  bool carries(const Vec& lambda) const;
  SpringsThatHold springs() const;
};

// From SharingContact::push. Nothing: not all of them are known, or the search gives up.
std::optional<SpringMotion> follow_loads(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda);

// How far springs are pushed that have the normal forces N [N] (by contact, 0 where none), whatever friction does. The
// least slacks are taken where these forces leave them open. None is known where nothing can be wedged in.
std::vector<std::optional<double>> pushes_of(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& N);

}  // namespace trammel::complementarity
