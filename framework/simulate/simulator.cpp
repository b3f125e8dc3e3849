#include "simulate/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "linear/dense/eps.hpp"
#include "run/run_failed.hpp"
#include "simulate/event/trial_step.hpp"
#include "simulate/start/blame.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {
namespace {

constexpr std::size_t most_warnings = 20;
constexpr double shortest_law = 1e-5;   // of the time between two records: steps become no shorter to show laws of time
constexpr double nearly_shortest = 64;  // times the shortest step: one of no more is not shortened to show events
constexpr double same_record = 1e-9;  // of the time between two records: times differ from their multiples by round-off

int error_order(Integrator& integrator) {
  const auto* estimate = dynamic_cast<const ErrorEstimate*>(&integrator);
  return estimate ? estimate->error_order() : 1;
}

bool even_steps(Integrator& integrator) {
  return dynamic_cast<const OscillatingSteps*>(&integrator) != nullptr;
}

}  // namespace

Simulator::Simulator(std::shared_ptr<model::Model> model, Integrator& integrator, const Settings& settings,
                     std::vector<LevelCorrection> corrections)
    : settings_(settings),
      system_(model),
      integrator_(integrator),
      estimate_(dynamic_cast<ErrorEstimate*>(&integrator)),
      dense_(dynamic_cast<DenseOutput*>(&integrator)),
      corrections_(std::move(corrections)),
      free_control_(settings.step, settings.every, error_order(integrator), even_steps(integrator)),
      contact_control_(settings.contact_step, settings.every, error_order(integrator), even_steps(integrator)),
      scale_(system_.model()),
      modes_(system_, scale_, settings_),
      location_(system_, integrator, modes_, scale_),
      ledger_(system_, integrator),
      energy_(system_, scale_, ledger_, StepControl::resolution(settings.every)),
      thresholds_(system_.model()),
      refinement_(std::move(model), system_),
      turns_(system_),
      theories_(system_.model()) {}

void Simulator::start(State initial) {
  now_ = std::move(initial);
  window_start_ = now_.t;
  if (now_.t > settings_.start)  // resumed from a checkpoint: earlier records are written
    records_ = (long long)(std::ceil((now_.t - settings_.start) / settings_.every - same_record));
  turns_.follow(now_.t, now_.q, now_.v);
  look_at_theories();
  system_.move_to(now_.t, now_.q, now_.v);
  scale_.take_all(system_);
  thresholds_.look_at_slips(system_, scale_);
  measure_joints();
  const auto [pressing, striking] = touching_at_start();
  if (!pressing.empty()) settle(pressing);  // the energy that they store belongs to the start
  ledger_.start(now_);
  energy_.start(energy_at_state());
  if (!striking.empty()) return settle(striking);
  if (!pressing.empty()) return;
  const auto& contacts = system_.model().contacts;
  if (std::any_of(contacts.begin(), contacts.end(), [](const model::ContactEntry& c) { return c.joint.has_value(); }))
    return settle({});
  system_.accelerate({}, now_.a, now_.lambda);
  at_new_modes();
}

// Compliant contacts that press, and rigid ones that touch and do not part.
Simulator::TouchingAtStart Simulator::touching_at_start() {
  TouchingAtStart touching;
  for (int i = 0; i < int(system_.model().contacts.size()); ++i) {
    const model::ContactEntry& contact = system_.model().contacts[std::size_t(i)];
    if (contact.joint) continue;
    const Scale scale = scale_.of(i);
    if (system_.gap(i) > scale.written_length()) continue;
    const bool pressed = contact.force && system_.gap(i) < -scale.touching();
    if (system_.gap_rate(i) > scale.written_speed() && !pressed) continue;
    contact.force ? touching.pressing.toggled.push_back(i) : touching.striking.struck.push_back(i);
  }
  return touching;
}

void Simulator::resume() {
  measure_joints();
  in_contact_ = any_closed(system_);
  if (!last_row_ || now_.t >= settings_.until) return;
  // The end has moved: rows are again written at their multiples. The row at the former end may not have been one.
  last_row_ = false;
  if (settings_.start + double(records_ - 1) * settings_.every > now_.t + same_record * settings_.every) --records_;
}

double Simulator::record_time(long long k) const {
  const double t = settings_.start + double(k) * settings_.every;
  return t > settings_.until - same_record * settings_.every ? settings_.until : t;
}

// Writes the rows that are due at the present state.
void Simulator::record_due(RecordSink& recorder) {
  while (!last_row_ && record_time(records_) <= now_.t) {
    recorder.row(system_, now_, ledger_.totals(), statistics_.steps);
    audit_.look(system_, now_, scale_);
    system_.move_to(now_.t, now_.q, now_.v);
    thresholds_.look_at_slips(system_, scale_);
    last_row_ = record_time(records_) >= settings_.until;
    ++records_;
    judge_energy();
    judge_joints(now_);
  }
}

void Simulator::judge_energy() {
  using Verdict = EnergyWatch::Verdict;
  const auto [verdict, sentence] = energy_.look(energy_at_state(), last_row_);
  if (verdict == Verdict::explained) last_good_ = now_;
  if (verdict == Verdict::not_finite) find_culprit(0);
  if (verdict == Verdict::not_finite || verdict == Verdict::diverged) throw RunFailed(here() + ": " + sentence);
  if (verdict == Verdict::unexplained && last_row_) warnings_.push_back(sentence);
}

void Simulator::look_at_theories() {
  if (const std::string impossible = theories_.look(now_.t, now_.q); !impossible.empty())
    throw RunFailed(here() + ": " + impossible);
}

bool Simulator::advance(RecordSink& recorder) {
  write_events(recorder);
  if (record_time(records_) <= now_.t && locks_here()) {
    jam(recorder, 0);
    return true;
  }
  record_due(recorder);
  if (now_.t >= settings_.until) return false;
  const double stop = dense_ && control().controlled() ? settings_.until : record_time(records_);
  for (;;) {
    Trial trial(propose(stop));
    if (try_step(trial)) {
      complete(trial, recorder);
      return true;
    }
    if (locked_) {
      jam(recorder, trial.proposal.h);
      return true;
    }
  }
}

// With contacts, a controlled step is so short that its ends show what laws of time do within it: error control sees
// the laws only through the motion, and where bodies rest it sees nothing.
StepControl::Proposal Simulator::propose(double stop) {
  StepControl& steps = control();
  const double longest = location_.longest_step(step_limit_);
  const StepControl::Proposal proposal = steps.propose(now_.t, stop, longest);
  if (!steps.controlled() || !location_.has_contacts()) return proposal;
  const double least = std::max(shortest_law * settings_.every, steps.smallest(now_.t));
  double h = proposal.h;
  for (const scene::LawOfTime& law : system_.model().laws) h = scene::step_that_shows(law, now_.t, h, least);
  return h < proposal.h ? steps.propose(now_.t, stop, std::min(h, longest)) : proposal;
}

void Simulator::complete(const Trial& trial, RecordSink& recorder) {
  accept(trial);
  record_inside(recorder);
  if (location_.has_contacts()) modes_.follow_loads(now_);  // springs inside the step are those of its begin
  const bool event = trial.found == EventLocation::Found::event;
  if (event && !(location_.changes().only_leaning() && renew_bases()) &&
      !(location_.changes().only_unloaded() && renew_springs())) {
    if (passes_infinity(location_.changes())) return jam(recorder, trial.h);
    settle(location_.changes());
    const int contact = events_.empty() ? -1 : events_.back().contact;
    write_events(recorder);  // before a checkpoint, which may follow
    guard_against_standstill(trial.h, trial.proposal.h, contact);
    guard_against_storm(contact);
  }
  if (refinement_.possible()) refine(recorder, -1);
}

// False: refused; shorter steps may follow.
bool Simulator::try_step(Trial& trial) {
  try {
    return step_and_examine(trial);
  } catch (const OutsideDomain& e) {  // a shorter step may stay inside
    return refuse(trial, said(e, system_.last_call()).c_str());
  } catch (const model::LocksItself&) {  // inside the step: find how far steps get without it
    ++statistics_.rejected;
    control().rejected(trial.proposal.h);
    locked_ = control().too_small(now_.t);
    return false;
  }
}

bool Simulator::step_and_examine(Trial& trial) {
  tried_ = trial.h;
  const Outcome outcome = trial_step(integrator_, system_, now_, trial.h, next_);
  iterated_ = !outcome && integrator_.traits().implicit;
  if (!outcome) return refuse(trial, outcome.reason());
  if (!next_.q.allFinite() || !next_.v.allFinite() || !next_.a.allFinite()) return refuse_not_finite(trial);
  if (control().controlled() && !within_tolerance(trial)) return false;
  return !location_.has_contacts() || examine_contacts(trial);
}

bool Simulator::within_tolerance(Trial& trial) {
  const Tolerance tolerance = scale_.scene().in_own_unit(control().tolerance(), settings_.every);
  trial.error = estimate_->error(system_, now_, next_, tolerance);
  if (trial.error <= 1) return true;
  ++statistics_.rejected;
  control().rejected_for_error(trial.h, trial.error);
  if (!control().too_small(now_.t)) return false;
  locked_ = near_critical_state();
  if (!locked_) fail_for_error(trial.h, tolerance);
  return false;
}

// Shortens the trial to its first event. False: it shows too little of what contacts did within it.
bool Simulator::examine_contacts(Trial& trial) {
  using Found = EventLocation::Found;
  using Steps = EventLocation::Steps;
  const bool can_shorten = trial.h > nearly_shortest * control().smallest(now_.t);
  const Steps steps = !control().controlled() ? Steps::fixed : can_shorten ? Steps::controlled : Steps::nearly_shortest;
  trial.found = location_.examine(now_, trial.h, next_, steps);
  switch (trial.found) {
    case Found::nothing:
    case Found::event:
      return true;
    case Found::not_finite:
      return refuse_not_finite(trial);
    case Found::step_refused:
      return refuse(trial, "a shorter step, tried to locate an event, was refused");
    case Found::passes_infinity:
      return refuse(trial, "forces of contacts that slide pass infinity within it");
    case Found::step_too_long:
      return refuse(trial, "it is too long to show what contacts did within it");
  }
  return true;
}

bool Simulator::refuse(const Trial& trial, const char* reason) {
  ++statistics_.rejected;
  const double h = trial.proposal.h;
  StepControl& steps = control();
  steps.rejected(h);
  if (!steps.controlled() && warnings_.size() < most_warnings)
    warnings_.push_back(fmt::format("t = {:.9g} s: a step of {:.3g} s was refused ({}) and halved", now_.t, h, reason));
  if (!steps.too_small(now_.t)) return false;
  locked_ = near_critical_state();
  if (locked_) return false;
  find_culprit(h);
  system_.move_to(now_.t, now_.q, now_.v);
  fail(h, reason);
}

bool Simulator::refuse_not_finite(const Trial& trial) {
  if (!control().controlled()) fail_not_finite(trial.h);
  ++statistics_.rejected;
  control().rejected(trial.proposal.h);
  if (control().too_small(now_.t)) fail_not_finite(trial.proposal.h);
  return false;
}

void Simulator::accept(const Trial& trial) {
  take_exact_time(trial);
  if (!corrections_.empty()) step_ledger_and_correct();
  integrator_.accept(system_, now_, next_);
  last_motions_.take(trial.h);
  if (trial.shortened())
    control().interrupted();
  else
    control().accepted(trial.proposal, trial.error);
  count(trial);
  if (system_.sizes().nc > 0) measure_rows(trial.h);
  if (location_.has_contacts()) {
    scale_.take_contacts(system_);
    location_.accept(trial.h, next_);
  }
  if (corrections_.empty()) ledger_.step(now_, next_);  // last: it leaves the system at the middle of the step
  std::swap(now_, next_);
  turns_.follow(now_.t, now_.q, now_.v);
  look_at_theories();
}

// The method's own t is t + h; only times that others rely on are replaced. An event is not moved back: a law of time
// may jump between.
void Simulator::take_exact_time(const Trial& trial) {
  if (!trial.shortened()) next_.t = trial.proposal.t_next;
  const double stop = record_time(records_);
  if (trial.shortened() && next_.t > stop) return;
  if (std::abs(stop - next_.t) <= 4 * eps * std::abs(stop)) next_.t = stop;
}

void Simulator::count(const Trial& trial) {
  ++statistics_.steps;
  statistics_.locating_steps = location_.steps_tried();
  if (in_contact_) ++statistics_.contact_steps;
  if (trial.shortened()) return;
  if (statistics_.smallest_step == 0 || trial.h < statistics_.smallest_step) statistics_.smallest_step = trial.h;
  statistics_.largest_step = std::max(statistics_.largest_step, trial.h);
}

void Simulator::measure_rows(double h) {
  system_.move_to(next_.t, next_.q, next_.v);
  const ConstraintNorms norms = constraint_norms(system_, next_, scratch_);
  statistics_.largest.raise_to(norms);
  if (contradictory(norms)) fail(h, "the rows ask for accelerations that no motion has");
}

// Writes the rows due inside the last step (next_ -> now_) by the method's own interpolation.
void Simulator::record_inside(RecordSink& recorder) {
  if (!dense_ || !control().controlled()) return;
  const double h = now_.t - next_.t;
  for (double t = record_time(records_); !last_row_ && t < now_.t; t = record_time(records_)) {
    dense_->interpolate(system_, next_, now_, (t - next_.t) / h, inside_);
    inside_.t = t;
    if (!inside_.q.allFinite() || !inside_.v.allFinite())
      fail(h, fmt::format("the method finds no state at t = {:.9g} s, inside its last step; a tighter tolerance takes "
                          "shorter steps",
                          t));
    system_.move_to(t, inside_.q, inside_.v);
    system_.accelerate({}, inside_.a, inside_.lambda);
    const Ledger::Totals totals = ledger_.totals_inside((t - next_.t) / h);
    recorder.row(system_, inside_, totals, statistics_.steps);
    audit_.look(system_, inside_, scale_);
    energy_.take_moved(system_.energy(), totals);
    judge_joints(inside_);
    ++records_;
    last_good_ = now_;
  }
}

std::vector<std::string> Simulator::doubts() const {
  std::vector<std::string> all = audit_.warnings(system_.model(), ledger_, energy_.none());
  const std::vector<std::string> of_impacts = modes_.impact_warnings().lines(system_.model());
  all.insert(all.end(), of_impacts.begin(), of_impacts.end());
  const std::vector<std::string> of_theories = theories_.warnings();
  all.insert(all.end(), of_theories.begin(), of_theories.end());
  const std::vector<std::string> coarse = thresholds_.warnings(system_.model(), settings_, scale_);
  all.insert(all.end(), coarse.begin(), coarse.end());
  return all;
}

Energy Simulator::energy_at_state() {
  if (now_.q.size() == 0) return {};
  system_.move_to(now_.t, now_.q, now_.v);
  return system_.energy();
}

Energy Simulator::last_energy() {
  try {
    return energy_at_state();
  } catch (const std::exception&) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {unknown, unknown, unknown};
  }
}

double Simulator::energy_drift() {
  return energy_.drift(energy_at_state());
}

double Simulator::relative_drift() {
  return energy_.relative_drift(energy_at_state());
}

}  // namespace trammel::simulate
