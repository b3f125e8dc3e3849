// Friction as an impact meets it.
//
//     Coulomb's law      mu_0, and mu at a slip
//     a smooth law       mu_0 = mu = ratio(max(|s|, U))
//     U [m/s]            the fastest approach among the contacts that act on each other; of an impact without
//                        collision, their fastest slip
//
// Under impulses P a smooth law brakes a slip by ds/dP = A_tn - A_tt ratio(|s|) s/|s|. It drives none: a slip ends at
// the creep whose ratio suffices to hold it. That is far below the rates of an impact which has reached the law's
// bound, so the law counts as Coulomb's with that bound, and its slip may end, stay ended or begin within the impact.
// An impact moves slips by as much as gaps, so it has reached the law's ratio at U, whatever the slip before. The rates
// after it are off by no more than the speeds in which the law rises.
#pragma once

#include <vector>

#include "simulate/impact/impact.hpp"

namespace trammel::simulate {

struct ImpactFriction {
  double mu_0 = 0, mu = 0;
};

// At a slip [m/s]; `speed` of `c` is known.
ImpactFriction friction_in_impact(const model::ContactEntry& contact, const TouchingContact& c, double slip);

// `islands`: for each of those that touch, equal for those that act on each other. Fills in `island` and `speed`; what
// the impact begins with is known.
void take_islands(const std::vector<std::size_t>& islands, std::vector<TouchingContact>& touching);

}  // namespace trammel::simulate
