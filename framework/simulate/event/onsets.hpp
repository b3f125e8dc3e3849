// Which gaps that close begin to touch, of those that are near 0 where an event was located.
//
// Grazes: gaps that only touch and open again by their own acceleration before they are as deep as what counts as
// touching. Contacts that depend on each other leave such rates. A box that tips about its feet moves its lowest corner
// against a wall until it lands, by a distance that nothing resolves: an impact would move the feet, and their friction
// would restore the rate, again and again. The side of a box that turns upright between floor and ceiling touches both
// for an instant, where its base lands, or a little earlier by the drift of the corner that slides: an impact would
// wedge the side in, by impulses that stop the box.
//
// Together: gaps that would close at the same instant if the steps had left no drifts in the rows of joints and of
// closed contacts. A bar that falls flat about its resting end strikes with its middle and with its other end. By the
// drift of the end that rests one of them comes earlier; as an impact of its own it would throw the bar up.
//
//     q' = q - M^-1 G^T (G M^-1 G^T)^-1 g        the least change that takes the drifts out, to first order
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
// Then sets `together` of approaches of rigid contacts that close together with that of `first`, which was located.
void mark_together(std::vector<EventFunction>& functions, const EventFunction& first, model::AssembledSystem& system,
                   const ContactScale& scale, const State& next);

}  // namespace trammel::simulate
