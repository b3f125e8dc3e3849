// Which values of event functions count as 0 (`noise`), and which deficits are too small to be events (`little`).
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "simulate/event/event_function.hpp"
#include "simulate/settling/contact_mode.hpp"

namespace trammel::simulate {

// Of deficits, by kind. At the system's point.
void set_thresholds(std::vector<EventFunction>& functions, model::AssembledSystem& system, const ContactScale& scale,
                    const ContactModes& modes);
// The force of an idle contact that nothing loads (blocks that stand side by side) is the round-off of the others', and
// so is that of a sliding contact which the least forces of its group leave without a load. Where nothing presses
// (discs that touch in free fall), so is every force.
void allow_for_round_off(std::vector<EventFunction>& functions, model::AssembledSystem& system,
                         const ContactScale& scale, const Vec& forces);
// A contact begins to stick at its bound where its normal force begins at 0, and where mu = mu_0.
void allow_for_friction_at_bounds(std::vector<EventFunction>& functions, model::AssembledSystem& system,
                                  const ContactScale& scale);

// [m, rad] A gap below this happens at the same instant. Where a truss unfolds into its singular position, the rows
// that keep its cells alike have double roots, so their round-off determines the cells only to half of the digits.
// Latches tied by such rows lock as one; otherwise nothing could move for the late ones.
double same_instant(const model::AssembledSystem& system, int contact, const Scale& scale);

}  // namespace trammel::simulate
