// A latch: when its gap closes, it locks permanently in a perfectly inelastic impact.
//
//     M (v+ - v-) + G^T L = 0,   G v+ = 0 with the gap's row in G;   energy lost |v+ - v-|_M^2 / 2 (Carnot)
//
// The gap is usually a joint's row ("reaches"): the distance of two hubs, the bend of a hinge.
#include <trammel/contact.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Latch : Restitution {
  double coefficient(double) const override { return 0; }
  Treatment treatment() const override { return {.release = Release::never}; }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::contact<Latch>("latch", "locks for good where it closes, in an inelastic impact")
        .source("F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts, 1996: e = 0, bilateral"))
