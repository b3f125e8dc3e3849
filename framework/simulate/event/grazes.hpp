// Gaps that touch and open again by their own acceleration before they are as deep as what counts as touching.
//
// Contacts that depend on each other leave such rates. A box that tips about its feet moves its lowest corner against a
// wall until it lands, by a distance that nothing resolves: an impact would move the feet, and their friction would
// restore the rate, again and again. The side of a box that turns upright between floor and ceiling touches both for an
// instant, where its base lands, or a little earlier by the drift of the corner that slides: an impact would wedge the
// side in, by impulses that stop the box.
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "simulate/event/event_values.hpp"

namespace trammel::simulate {

// `acceleration` [m/s^2] of the gap; `noise` [m]: up to this depth it only touches.
bool grazes(const ValueAndSlope& gap, double acceleration, double noise);

// Sets `grazed` of approaches of rigid contacts at `next`, where an event was located, and their noise: twice the
// largest gap of a closed rigid contact of their island counts as touching too, since an open gap is known no better.
void mark_grazes(std::vector<EventFunction>& functions, model::AssembledSystem& system, const ContactScale& scale,
                 EventValues& values, const State& next);

}  // namespace trammel::simulate
