// Coefficients of friction in an impact.
//
//     Coulomb's law      mu_0, and mu at a slip
//     a smooth law       mu_0 = mu = ratio(max(|s|, U))
//     U [m/s]            the fastest approach among the contacts that act on each other; of an impact without
//                        collision, their fastest slip
//
// Under impulses P a smooth law brakes a slip by ds/dP = A_tn - A_tt ratio(|s|) s/|s| and drives none: the slip ends at
// the creep whose ratio suffices to hold it. This creep is far slower than the rates of an impact that has reached the
// law's bound. So the law counts as Coulomb's with that bound: its slip may end, stay ended or begin within the impact.
// An impact changes slips as much as gaps, so it reaches the law's ratio at U, whatever the slip before. The rates
// after it are wrong by at most the speeds over which the law rises.
#pragma once

#include <vector>

#include "simulate/impact/impact.hpp"

namespace trammel::simulate {

struct ImpactFriction {
  double mu_0 = 0, mu = 0;
};

// At a slip [m/s]; c.speed is known.
ImpactFriction friction_in_impact(const model::ContactEntry& contact, const TouchingContact& c, double slip);

// `islands`: by contact, equal for contacts that act on each other. Sets `island` and `speed`; the initial rates are
// known.
void take_islands(const std::vector<std::size_t>& islands, std::vector<TouchingContact>& touching);

}  // namespace trammel::simulate
