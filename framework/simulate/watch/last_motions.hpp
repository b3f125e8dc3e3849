// What happened before a run cannot go on, for its message: the last step sizes, the events before and after, the
// bodies whose velocities change most in the step that failed, and the joints whose rows are met worst at its end.
#pragma once

#include <array>
#include <string>

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>

#include "simulate/results/contact_event.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class LastMotions {
 public:
  void take(double h);  // an accepted step [s]
  void take(const ContactEvent& event);
  // Of the trial from `now` to `next` with steps of h: sentences, each after "; ". A body's share is that of the
  // kinetic energy of h (a_next - a_now), dv^T M dv/2: a measure in which metres and radians add up.
  // `until` [s]: an event that is expected later is none of the run's.
  std::string say(model::AssembledSystem& system, const State& now, const State& next, double h, double until) const;
  void archive(Archive& a);
  bool fits(std::size_t contacts) const {  // what was read
    return event_contact_ < int(contacts) && event_kind_ >= 0 && event_kind_ <= int(ContactEvent::Kind::reversal);
  }

 private:
  std::string shares(model::AssembledSystem& system, const State& now, const State& next, double h) const;

  std::string worst_rows(model::AssembledSystem& system, const State& next) const;
  std::string next_closing(model::AssembledSystem& system, const State& now, double until) const;

  std::array<double, 3> steps_ = {};  // [s] the last ones, the latest first; 0: none
  double event_at_ = 0;
  int event_contact_ = -1, event_kind_ = 0;
};

}  // namespace trammel::simulate
