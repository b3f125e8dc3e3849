// Finds the first event of a contact inside a trial step, and shortens the step to it.
//
// Each contact has event functions, which are positive until their event:
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
// In space a slip without a direction that other contacts hold back has also stopped, although it crosses no zero
// (`stalls`). An event shows in three ways: the function is negative at the step's end; it is positive at both ends and
// negative between them (the cubic through values and slopes of both ends shows where to look); or, just after an event
// that left it at the round-off of 0, the parabola at its start returns to 0 within the step. The event is located by
// repeating the step with other lengths, so to the accuracy of the method itself, down to the rounding of t; the
// earliest event counts. For an event that was just handled only round-off is ignored (ContactScale), and an approach
// that ends by itself within a gap that is round-off.
//
// Error control sees the effect of time on these functions only through the motion: it sees none where everything is
// held, or where a table shakes under a ball in flight. Therefore a controlled step is too long if a function departs
// so far from the form assumed here that it could have crossed 0 unseen. Gaps are compared with their cubic at an
// irrational part of the step, forces with their tangent one step ahead. A jump of a law of time leaves a difference
// that steps too short to matter pass over.
//
// Nor may forces pass infinity within a controlled step. For sliding contacts this need not show at the ends of the
// step, but the determinant of their equations changes its sign there, where it is known (AssembledSystem::find_signs).
// Contacts that do not act on each other have determinants of their own.
//
// A shortened step still has a length of at least 4 units in the last place of t, so every event advances time.
//
// Forces come from the equations of motion at the step's end. Methods that satisfy neither position nor velocity rows
// work on the level of accelerations: there lambda itself, with their stabilisation, is that force. If rows are
// redundant, lambda is not unique: contacts that share rows have one function, their spare load
// (AssembledSystem::spare_load), and the complementarity problem decides which of them opens (contact_mode.hpp). If one
// of them slides, its share affects the motion, and each has its own. An implied direction has no row in g,
// so nothing holds it once it no longer follows from the basis: a support moves by a law of its own, or bodies turn out
// of a singular position. This shows first in its acceleration.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include <trammel/integrator.hpp>

#include "linear/dense/block_signs.hpp"
#include "run/contact_scale.hpp"
#include "simulate/event/root_bracket.hpp"
#include "simulate/settling/contact_mode.hpp"
#include "system/between_states.hpp"

namespace trammel::simulate {

// Relative to the bound of an event's force. Below vanished_force a force counts as 0: it is round-off of its sum. A
// force within critical_force of its bound is no event: that is an error of loads.
inline constexpr double vanished_force = 1e-12, critical_force = 1e-9;

class EventLocation {
 public:
  EventLocation(model::AssembledSystem& system, Integrator& integrator, ContactModes& modes, const ContactScale& scale);

  bool has_contacts() const { return !system_.model().contacts.empty(); }
  void restart(const State& now);  // modes or state changed

  // Fixed steps are taken whatever they hide. A controlled one is refused if forces pass infinity in it, and, unless
  // hardly any shorter one is left, if it is too long to show events.
  enum class Steps { fixed, controlled, nearly_shortest };
  enum class Found { nothing, event, step_refused, step_too_long, passes_infinity, not_finite };
  // Examines the trial now -> next over h. Found::event: h and next are shortened to the event, `changes` are the
  // changes there. Found::not_finite: a gap or a force at next is not finite, though the state may be (a law of time
  // that ended under a body). next must not be accepted after Found::step_too_long (Steps::controlled only) and
  // Found::passes_infinity (not Steps::fixed).
  Found examine(const State& now, double& h, State& next, Steps steps);
  const ContactChanges& changes() const { return changes_; }
  // [s] Limit of the next step: `swings` (longest_step_in_contact), or more if every closed contact slides so fast
  // that a longer step takes at most a quarter of its slip, which then has no zero to pass over.
  double longest_step(double swings) const;
  long long steps_tried() const { return steps_tried_; }
  void accept(double h, const State& next);  // next became the solution

  void archive(Archive& a);

 private:
  enum class Kind { approach, leave, press, hold, slide, idle, unload, follow, lean, span, load };
  struct EventFunction {
    int contact;
    Kind kind;
    bool at_ends = false;       // judged at the ends of steps only, never located
    double noise = 0;           // values up to this one count as 0 at first, and just after the event
    double force_before = 0;    // one step before now
    double bound = 0;           // [N] at the last evaluation: the bound of friction, or the largest force of a group
    double steepest = 0;        // slide: largest rate of change of the slip since it began [m/s^2]
    bool reported = false;      // it had the last event
    int group = -1;             // in Modes::shared; -1: none
    double little = 0;          // smaller deficits are ignored: [N] unload, press, idle, hold, [m/s^2] follow, [1] span
    int bearing = -1;           // load: index among the bearings with a signed load
    double side = 1;            // load: 1 or -1
    double undirected_for = 0;  // [s] slide in space: how long it has been without a direction (system/point/slip.hpp)
    double pushed = 0;          // [m/s^2] slide in space: its largest acceleration in that time
    double patience = 10;       // slide in space: as many times longer than that acceleration needs it may have none
    bool stalled = false;       // slide in space: the last event was that it has had none for longer
  };
  using Value = numerics::ValueAndSlope;  // slopes of forces and accelerations are not known
  struct Suspect {
    int function;
    double high;       // [s] length of a step after which the event has happened
    Value at_high;     // the function there
    double about = 0;  // [s] estimate of the crossing
  };
  struct Cubic;
  // What a function watches, whatever its place among the others is: kind, contact or group, bearing.
  using Watched = std::tuple<Kind, int, int>;
  Watched watched(const EventFunction& f) const;

  void set_up_functions();
  void add_functions(int contact);
  bool unloads(int group) const;
  static bool is_shared_force(const EventFunction& f) {
    return f.kind == Kind::idle || (f.kind == Kind::press && f.group >= 0);
  }
  void add_unload(int contact, int group);
  void add_friction(int contact, bool as_one);
  void add_loads(int contact);
  void set_thresholds();
  void keep_what_was_learnt(const std::map<Watched, EventFunction>& before);
  void allow_for_friction_at_bounds();
  void allow_for_round_off(const State& now);
  void choose_sides(const std::map<Watched, EventFunction>& before);
  bool by_force(int k) const {
    const Kind kind = functions_[k].kind;
    return kind == Kind::press || kind == Kind::hold || kind == Kind::idle || kind == Kind::unload ||
           kind == Kind::load;
  }
  bool has_slope(int k) const { return !by_force(k) && !of_rows(k); }
  bool of_rows(int k) const {
    const Kind kind = functions_[k].kind;
    return kind == Kind::follow || kind == Kind::lean || kind == Kind::span;
  }
  bool lacks_direction(const EventFunction& function);
  bool stalls(double h, const State& next, int k);
  void measure_undirected(double h, const State& next, EventFunction& function);
  double force(EventFunction& function, double t, const Vec& lambda);
  std::vector<double> little_forces();
  double little_friction(int contact);
  Value slide(int contact, const Vec& a);
  bool evaluate(const State& state, std::vector<Value>& values);  // true if a_ and lambda_ were needed
  void evaluate(const State& state, std::vector<Value>& values, numerics::BlockSigns& signs);
  Value value(int k, const State& state, bool& accelerated);
  bool just_handled(int k) const { return now_[k].f <= functions_[k].noise; }
  bool happened(const State& now, int k, const Value& end);
  bool grazes(const State& now, int k);
  double gap_acceleration(const State& now, int k);
  Value step_to(const State& now, double h, int k);
  bool hides(const State& now, double h, const State& next);
  bool swings_matter(const std::vector<Value>& values, double h) const;
  bool hides_motion(const State& now, double h, const State& next);
  double gap_or_slip(int k);
  double resolution_of_motion(int k) const;
  double resolution_of_force(int k);
  bool hides_force(const State& now, double h, const State& next);
  bool dips(const State& now, double h, const State& next, int k, Suspect& suspect);
  bool returns(const State& now, double h, int k, Suspect& suspect);
  bool worth_slopes(int k, double h) const;
  double force_slope(const State& state, double dt, int k);
  double slope_at_end(const State& state, double dt, int k, double h, std::vector<double>& slopes);
  template <class Each>
  void force_slopes(const State& state, double dt, Each&& each);
  void find_suspects(const State& now, double h, const State& next);
  void earliest_first(std::vector<Suspect>& suspects) const;
  struct Located {
    int function;
    double h;  // [s] length of the step to its event
  };
  Located locate_first(const State& now, double h);
  double locate(const State& now, const Suspect& suspect);
  void shorten(const State& now, double h_event, double& h, State& next);
  void forget_trials();
  double same_instant(int contact) const;
  void collect();
  bool happens_with_others(int k);
  void report(int k);
  void wait_longer(const EventFunction& before, int k);
  bool shares_otherwise(int k) const;

  model::AssembledSystem& system_;
  Integrator& integrator_;
  ContactModes& modes_;
  const ContactScale& scale_;
  BetweenStates between_states_;
  bool own_force_;  // the integrator's lambda is the force of the contact
  std::vector<EventFunction> functions_;
  std::vector<model::ContactMode> modes_before_;  // of functions_, with the directions of slips after the last step
  std::vector<Value> now_, next_, probe_;
  numerics::BlockSigns signs_, signs_next_;  // at the points of now_ and next_; none where no forces were needed
  bool probed_ = false;                      // probe_ is filled for the step examined
  double h_before_ = 0;                      // [s] 0: no step yet since the last change
  double longest_ = 0;                       // [s] longest step tried since then
  bool other_springs_ = false;               // the last change was that other springs hold contacts at rest
  bool at_once_ = false;                     // the last change came the shortest step after the one before
  std::vector<Suspect> suspects_;
  std::vector<int> at_end_;
  std::vector<double> begin_slopes_, end_slopes_;  // of forces at the ends of the step examined, where needed
  double h_tried_ = 0;                             // [s] of the last trial, trial_; 0: none
  ContactChanges changes_;
  State trial_, moved_;
  State between_;
  Vec a_, lambda_, dq_;
  long long steps_tried_ = 0;
};

}  // namespace trammel::simulate
