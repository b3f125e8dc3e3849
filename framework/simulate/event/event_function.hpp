// An event function: what it watches, its values in the step examined, and what earlier steps and events have shown of
// it. It is positive until its event and 0 at it:
//
//     approach   open contact                    gap
//     leave      compliant contact in touch      -gap
//     press      closed contact (Restitution)    its normal force N; a locked one has none
//     hold       sticking contact                mu_0 N - |T|, T the friction that holds it
//     idle       closed without a force          minus the force that it would carry as a spring
//     unload     contacts that share rows        their spare load, by the springs that hold (rule 15)
//     follow     contacts that share rows        a small acceleration minus that of an implied direction
//     lean       contacts that share rows        how far the rows in g are from depending on each other
//     span       contacts that share rows        a small part of a row minus that which does not follow from the others
//     slide      sliding contact                 slip velocity along its direction where the step began
//     load       bearing of a joint that rubs    its load, on the side on which it presses (signed_loads.hpp)
//
// If rows are redundant, lambda is not unique: contacts that share rows have one function, their spare load
// (AssembledSystem::spare_load), and the complementarity problem decides which of them opens (contact_mode.hpp). If one
// of them slides, its share affects the motion, and each has its own. An implied direction has no row in g, so nothing
// holds it once it no longer follows from the basis: a support moves by a law of its own, or bodies turn out of a
// singular position. This shows first in its acceleration.
#pragma once

#include <optional>
#include <tuple>

#include "simulate/event/cubic.hpp"
#include "simulate/event/undirected_slip.hpp"

namespace trammel::simulate {

using numerics::ValueAndSlope;

// Relative to the bound of an event's force. Below vanished_force a force counts as 0: it is round-off of its sum. A
// force within critical_force of its bound is no event: that is an error of loads.
inline constexpr double vanished_force = 1e-12, critical_force = 1e-9;
inline constexpr double jumps_of_shares = 10;  // of vanished_force: shares follow the motion in small jumps
// Where forces are looked at in the first step after a change: a part of it.
inline constexpr double place_inside = 0.3819660112501051;

struct EventFunction {
  enum class Kind { approach, leave, press, hold, slide, idle, unload, follow, lean, span, load };
  int contact;
  Kind kind;
  bool at_ends = false;         // judged at the ends of steps only, never located
  double noise = 0;             // values up to this one count as 0 at first, and just after the event
  int group = -1;               // in Modes::shared; -1: none
  int bearing = -1;             // load: index among the bearings with a signed load
  double side = 1;              // load: 1 or -1
  double little = 0;            // smaller deficits are ignored: [N] unload, press, idle, hold, [m/s^2] follow, [1] span
  double bound = 0;             // [N] at the last evaluation: the bound of friction, or the largest force of a group
  double steepest = 0;          // slide: largest rate of change of the slip since it began [m/s^2]
  bool reported = false;        // it had the last event
  bool grazed = false;          // approach: at the instant located last it only touched
  bool together = false;        // approach: but for drifts it closed at that instant too
  UndirectedSlip undirected{};  // slide in space

  ValueAndSlope now{}, next{};  // at the ends of the step examined; slopes of forces and accelerations are not known
  double before = 0;            // one step before now
  // Of a force, where they are needed: its value within the first step after a change, its slopes at the ends.
  std::optional<double> inside{}, slope_now{}, slope_next{};

  bool by_force() const {
    return kind == Kind::press || kind == Kind::hold || kind == Kind::idle || kind == Kind::unload ||
           kind == Kind::load;
  }
  bool of_rows() const { return kind == Kind::follow || kind == Kind::lean || kind == Kind::span; }
  bool is_gap() const { return kind == Kind::approach || kind == Kind::leave; }
  bool has_slope() const { return is_gap() || kind == Kind::slide; }
  bool is_shared_force() const { return kind == Kind::idle || (kind == Kind::press && group >= 0); }
  bool just_handled() const { return now.f <= noise; }

  // What it watches, whatever its place among the others is: kind, contact or group, bearing. A basis of rows has its
  // group, whichever of them are implied. A contact that becomes idle is watched by the same force, that of a spring.
  using Watched = std::tuple<Kind, int, int>;
  Watched watched() const { return {kind == Kind::idle ? Kind::press : kind, of_rows() ? group : contact, bearing}; }
};

}  // namespace trammel::simulate
