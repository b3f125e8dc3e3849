// What happened to a contact, as events.csv tells it.
#pragma once

namespace trammel::simulate {

struct ContactEvent {
  enum class Kind {
    impact,  // velocities jumped
    close,   // a row or a force became active
    open,    // it ended: the contact would pull
    lift,    // after an impact without rebound the gap accelerates apart: it stays open
  };
  double t = 0;  // [s]
  Kind kind = Kind::impact;
  int contact = 0;
  double impulse = 0;      // [N s] >= 0
  double approach = 0;     // [m/s] = -gap_rate before
  double separation = 0;   // [m/s] = gap_rate after
  double energy_lost = 0;  // [J] kinetic, through this contact
};

inline const char* to_string(ContactEvent::Kind kind) {
  switch (kind) {
    case ContactEvent::Kind::impact:
      return "impact";
    case ContactEvent::Kind::close:
      return "contact_close";
    case ContactEvent::Kind::open:
      return "contact_open";
    case ContactEvent::Kind::lift:
      return "lift";
  }
  return "";
}

}  // namespace trammel::simulate
