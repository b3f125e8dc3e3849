// An event of a contact, as written to events.csv.
#pragma once

#include <trammel/types.hpp>

namespace trammel::simulate {

struct ContactEvent {
  enum class Kind {
    impact,    // velocities jumped
    close,     // a row or a force became active
    latch,     // velocities jumped and a row became active permanently
    open,      // closed until now; the force would pull
    lift,      // after an impact without rebound the gap accelerates apart: it stays open
    stick,     // friction holds it from now on
    slip,      // slides from now on
    reversal,  // it slid through rest: from now on the other way
  };
  double t = 0;  // [s]
  Kind kind = Kind::impact;
  int contact = 0;
  double impulse = 0;      // [N s] >= 0
  double approach = 0;     // [m/s] = -gap_rate before
  double separation = 0;   // [m/s] = gap_rate after
  double energy_lost = 0;  // [J] kinetic energy lost through this contact
  // In the plane along the tangent (1 entry), in space in world axes (3).
  Vec3 friction = Vec3::Zero(1);   // impact: impulse [N s]; stick, slip, reversal: the force on A [N]
  Vec3 direction = Vec3::Zero(1);  // slip, reversal: of the slip velocity, of length 1
};

inline const char* to_string(ContactEvent::Kind kind) {
  switch (kind) {
    case ContactEvent::Kind::impact:
      return "impact";
    case ContactEvent::Kind::close:
      return "contact_close";
    case ContactEvent::Kind::latch:
      return "latch";
    case ContactEvent::Kind::open:
      return "contact_open";
    case ContactEvent::Kind::lift:
      return "lift";
    case ContactEvent::Kind::stick:
      return "stick";
    case ContactEvent::Kind::slip:
      return "slip";
    case ContactEvent::Kind::reversal:
      return "reversal";
  }
  return "";
}

}  // namespace trammel::simulate
