// The time loop: steps, events, corrections, records.
//
// An iteration tries a step towards the next stop (a record time, or the end), lets EventLocation shorten it to the
// first event, corrects, accepts, and settles the event. The loop cannot hang: every iteration that does not end the
// run either advances t or is a rejected step, and the step control limits rejections in a row. An event advances t by
// at least 4 units in the last place. Some hundred events in a row that advance t by hardly more, or more than
// `event_limit` events in a thousandth of the run, end the run.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <trammel/correction.hpp>

#include "diagnose/conflict.hpp"
#include "plugin/plugin_error.hpp"
#include "run/contact_scale.hpp"
#include "run/settings.hpp"
#include "run/statistics.hpp"
#include "simulate/contact/coarse_thresholds.hpp"
#include "simulate/contact/contact_audit.hpp"
#include "simulate/event/event_location.hpp"
#include "simulate/refinement.hpp"
#include "simulate/results/checkpoint.hpp"
#include "simulate/results/ledger.hpp"
#include "simulate/results/recorder.hpp"
#include "simulate/settling/contact_mode.hpp"
#include "simulate/step_control.hpp"
#include "simulate/watch/energy_watch.hpp"
#include "simulate/watch/last_motions.hpp"
#include "simulate/watch/open_joints.hpp"
#include "simulate/watch/theory_watch.hpp"
#include "simulate/watch/turn_counts.hpp"

namespace trammel::simulate {

class Simulator {
 public:
  struct LevelCorrection {
    Correction::Level level;
    Correction* correction;
    const plugin::Origin* origin;  // lives as long as the correction
  };
  Simulator(std::shared_ptr<model::Model> model, Integrator& integrator, const Settings& settings,
            std::vector<LevelCorrection> corrections);

  // Starts at settings.start, or later as if the run had come there. Touching contacts are settled before the first
  // step.
  void start(State initial);
  void archive(JsonArchive& a);  // everything that decides how the run continues
  void resume();                 // to be called after the archive was read

  // Takes one accepted step and settles the event at its end; false: the end is reached and recorded. Throws RunFailed,
  // PluginError, OutputError; the state is then the last accepted one.
  bool advance(RecordSink& recorder);

  const State& state() const { return now_; }
  // The state at the last written row at which the energy still had known causes; none: there is none yet.
  const std::optional<State>& last_good() const { return last_good_; }
  const Settings& settings() const { return settings_; }
  model::AssembledSystem& system() { return system_; }
  const Statistics& statistics() const { return statistics_; }
  const Ledger& ledger() const { return ledger_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }
  // Reasons to doubt the run: contacts that pulled, impacts that created energy, bodies beyond their theory.
  std::vector<std::string> doubts() const;
  const ContactAudit& audit() const { return audit_; }
  Energy energy_at_state();
  Energy last_energy();     // at the end of a run; NaN if a component can no longer give its energy
  double energy_drift();    // [J] change of energy that no cause in the ledger explains
  double relative_drift();  // its absolute value relative to the energy moved (energy_watch.hpp)
  // After a failure: the bodies that move most, the last steps and the nearest events (last_motions.hpp).
  std::string circumstances();
  // Joints and bodies whose rows cannot be satisfied near the last state or a step later; empty: none are known.
  Conflict conflict();

 private:
  struct Trial {
    explicit Trial(const StepControl::Proposal& proposed) : proposal(proposed), h(proposed.h) {}
    bool shortened() const { return h < proposal.h; }

    StepControl::Proposal proposal;
    double h;  // [s] the proposed step, or the part of it up to an event
    EventLocation::Found found = EventLocation::Found::nothing;
    double error = 0;  // <= 1: within the tolerance
  };
  struct TouchingAtStart {
    ContactChanges pressing, striking;
  };
  TouchingAtStart touching_at_start();
  StepControl& control() { return in_contact_ || now_.t < hold_until_ ? contact_control_ : free_control_; }
  void archive_bodies(JsonArchive& a);
  void archive_state(Archive& a);
  void require_state_fits() const;  // throws std::out_of_range
  double record_time(long long k) const;
  void record_due(RecordSink& recorder);
  void judge_energy();
  void measure_joints();
  void judge_joints(const State& state);
  bool contradictory(const ConstraintNorms& norms);
  bool near_the_end_of_numbers() const;
  StepControl::Proposal propose(double stop);
  bool try_step(Trial& trial);
  bool step_and_examine(Trial& trial);
  bool within_tolerance(Trial& trial);
  bool examine_contacts(Trial& trial);
  // False, or the run fails: no shorter step is left.
  bool refuse(const Trial& trial, const char* reason);
  bool refuse_not_finite(const Trial& trial);
  void complete(const Trial& trial, RecordSink& recorder);
  void accept(const Trial& trial);
  void take_exact_time(const Trial& trial);
  void count(const Trial& trial);
  void measure_rows(double h);
  bool locks_here();
  bool near_critical_state();
  bool passes_infinity(const ContactChanges& changes);
  void jam(RecordSink& recorder, double h);
  void look_at_theories();
  std::string here() const;          // "at t = 1 s, step 100": the last accepted one
  std::string when(double h) const;  // "at t = 1 s, step 101 of 0.01 s": the one that was tried
  [[noreturn]] void fail(double h, const std::string& why) const;
  [[noreturn]] void fail_for_error(double h, Tolerance tolerance);
  void find_culprit(double h);
  [[noreturn]] void fail_not_finite(double h);
  void step_ledger_and_correct();
  Outcome corrected(const LevelCorrection& entry, const Correction::Step& step);
  void record_inside(RecordSink& recorder);
  void settle(const ContactChanges& changes);
  bool renew_bases();
  bool renew_springs();
  void guard_against_standstill(double h, double wanted, int contact);
  void guard_against_storm(int contact);  // contact: the last one; -1: unknown
  std::string last_of(int contact) const;
  std::vector<int> struck_contacts() const;
  void write_events(RecordSink& recorder);
  void refine(RecordSink& recorder, int contact);
  void at_new_modes();
  void restart_all_but_integrator();

  Settings settings_;
  model::AssembledSystem system_;
  Integrator& integrator_;
  ErrorEstimate* estimate_;
  DenseOutput* dense_;
  std::vector<LevelCorrection> corrections_;
  StepControl free_control_, contact_control_;
  ContactScale scale_;
  ContactModes modes_;
  EventLocation location_;
  Ledger ledger_;
  EnergyWatch energy_;
  ContactAudit audit_;
  CoarseThresholds thresholds_;
  Refinement refinement_;
  TurnCounts turns_;
  TheoryWatch theories_;
  OpenJoints open_joints_;
  LastMotions last_motions_;
  Statistics statistics_;

  State now_, next_, inside_, uncorrected_;
  std::optional<State> last_good_;
  double tried_ = 0;  // [s] the last trial's step
  Vec error_parts_;   // LastTrial::error_parts
  bool iterated_ = false;
  bool in_contact_ = false;
  double step_limit_ = std::numeric_limits<double>::infinity();   // [s] longest_step_in_contact
  double hold_until_ = -std::numeric_limits<double>::infinity();  // [s] contact steps are used until then
  long long records_ = 0;                                         // rows written
  bool last_row_ = false;                                         // the row at the end is written
  double window_start_ = 0;
  long long window_events_ = 0;
  bool locked_ = false;  // no step from here is so short that sliding contacts have finite forces
  double raised_ = 0;    // ContactChanges::raised
  int standing_ = 0;     // events in a row that hardly advanced t
  std::vector<ContactEvent> events_;
  std::vector<std::string> warnings_;
  Vec scratch_;
};

}  // namespace trammel::simulate
