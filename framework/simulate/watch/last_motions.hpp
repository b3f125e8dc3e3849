// What happened before a run could not go on, for its message: the last step sizes, the events before and after, the
// bodies with the largest part of the error or residual of the failed step, or with the largest change of velocity in
// it, and the joints whose rows are violated most at its end.
#pragma once

#include <array>
#include <string>

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>

#include "simulate/results/contact_event.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// The step that failed, from `now` to `next` with steps of h [s].
struct LastTrial {
  const State& now;
  const State& next;
  double h;
  const Vec& error_parts;  // (nv) Tolerance::parts of its error; empty: it was not rejected for its error
  bool iterated;           // the method iterates and did not converge: `next` is its last iterate
};

class LastMotions {
 public:
  void take(double h);  // an accepted step [s]
  void take(const ContactEvent& event);
  // Sentences about the trial, each after "; ". An event expected after `until` [s] is not mentioned.
  std::string say(model::AssembledSystem& system, const LastTrial& trial, double until) const;
  void archive(Archive& a);
  bool fits(std::size_t contacts) const {  // the archive that was read
    return event_contact_ < int(contacts) && event_kind_ >= 0 && event_kind_ <= int(ContactEvent::Kind::reversal);
  }

 private:
  std::string contributors(model::AssembledSystem& system, const LastTrial& trial) const;
  std::string worst_rows(model::AssembledSystem& system, const State& next) const;
  std::string next_closing(model::AssembledSystem& system, const State& now, double until) const;

  std::array<double, 3> steps_ = {};  // [s] the last ones, the latest first; 0: none
  double event_at_ = 0;
  int event_contact_ = -1, event_kind_ = 0;
};

}  // namespace trammel::simulate
