#include "simulate/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "linear/dense/eps.hpp"
#include "plugin/breadcrumb.hpp"
#include "plugin/guard.hpp"
#include "run/run_failed.hpp"
#include "simulate/start/blame.hpp"
#include "simulate/trial_step.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {
namespace {

constexpr std::size_t most_warnings = 20;

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
      thresholds_(system_.model()),
      refinement_(std::move(model), system_),
      turns_(system_),
      theories_(system_.model()) {}

void Simulator::start(State initial) {
  now_ = std::move(initial);
  window_start_ = now_.t;
  if (now_.t > settings_.start)  // resumed from a checkpoint: earlier records are written
    records_ = (long long)(std::ceil((now_.t - settings_.start) / settings_.every - 1e-9));
  turns_.follow(now_.t, now_.q, now_.v);
  look_at_theories();
  system_.move_to(now_.t, now_.q, now_.v);
  scale_.take_all(system_);
  thresholds_.look_at_slips(system_, scale_);
  measure_joints();
  ContactChanges pressing, striking;
  bool bears = false;
  for (int i = 0; i < int(system_.model().contacts.size()); ++i) {
    if (system_.model().contacts[i].joint) {
      bears = true;
      continue;
    }
    const Scale scale = scale_.of(i);
    const bool compliant = system_.model().contacts[i].force, pressed = system_.gap(i) < -scale.touching();
    if (system_.gap(i) > scale.written_length()) continue;
    if (system_.gap_rate(i) > scale.written_speed() && !(compliant && pressed)) continue;
    compliant ? pressing.toggled.push_back(i) : striking.struck.push_back(i);
  }
  if (!pressing.empty()) settle(pressing);  // the energy that they store belongs to the start
  ledger_.start(now_);
  energy_start_ = energy_at_state();
  most_moved_ = energy_start_.kinetic;
  if (!striking.empty()) return settle(striking);
  if (!pressing.empty()) return;
  if (bears) return settle({});
  system_.accelerate({}, now_.a, now_.lambda);
  at_new_modes();
}

void Simulator::resume() {
  measure_joints();
  in_contact_ = modes_.any_closed();
  if (!last_row_ || now_.t >= settings_.until) return;
  // The end has moved: go on with rows at their multiples. The row at the former end may not have been one of them.
  last_row_ = false;
  if (settings_.start + double(records_ - 1) * settings_.every > now_.t + 1e-9 * settings_.every) --records_;
}

double Simulator::record_time(long long k) const {
  const double t = settings_.start + double(k) * settings_.every;
  return t > settings_.until - 1e-9 * settings_.every ? settings_.until : t;
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

// [J] Energy that counts as none in this scene: 1e-8 of the energy of its masses at its speed, which a fall through its
// length gives, or of `work` if that is more; a nanojoule if there is neither. That is ten times the energy of a fall
// through the last digits of a scene: a contact that is closed at the start may be off by those, and the stabilisation
// of its row closes it in steps of any length.
double Simulator::little_energy(double work) {
  constexpr double little = 1e-8, nanojoule = 1e-9;
  if (now_.v.size() == 0) return nanojoule;
  const double speed = std::max(scale_.scene().speed, scale_.scene().motion);
  const Vec rates = system_.coordinate_sizes().levers.cwiseInverse();  // of a speed of 1 m/s
  scratch_.setZero(now_.v.size());
  system_.add_mass_times(1, rates, scratch_);
  const double moving = scratch_.cwiseProduct(rates).lpNorm<Eigen::Infinity>() * speed * speed;
  const double energy = std::max(moving, work);
  return energy > 0 ? little * energy : nanojoule;
}

// [J] The largest work of a present force over the scene's length. Without gravity, what loads hold at rest has no
// speed.
double Simulator::work_over_length() {
  const Vec rates = system_.coordinate_sizes().levers.cwiseInverse();
  return system_.f().cwiseProduct(rates).lpNorm<Eigen::Infinity>() * scale_.scene().length();
}

// Largest energy that known causes can have set in motion so far: the initial energy, and the energy that fell, came in
// and went out. What a base brings in and takes out again counts while it is there; what the method creates never
// counts.
void Simulator::take_moved(const Energy& energy, const Ledger::Totals& totals) {
  const double changed = std::abs(energy_start_.elastic) + std::abs(energy.potential - energy_start_.potential) +
                         std::abs(totals.supplied) + std::abs(ledger_.refinements()) + totals.dissipated;
  most_moved_ = std::max(most_moved_, energy_start_.kinetic + changed);
}

// The energy without a cause, relative to the energy moved. A small addend keeps round-off of a system at rest from
// counting. The work of the forces costs an evaluation, so it is asked for only where it decides.
double Simulator::relative_drift() {
  take_moved(energy_at_state(), ledger_.totals());
  constexpr double round_off = 1e-12;  // of energies, which count from a place that may be far off
  const double drift = std::abs(energy_drift()), moved = most_moved_ + round_off * std::abs(ledger_.energy_start());
  const double without_work = drift / (moved + little_energy(0));
  return without_work > unexplained ? drift / (moved + little_energy(work_over_length())) : without_work;
}

// A method that is unstable at its step may return finite but meaningless numbers for long. Its energy shows this
// because it goes on growing; that of a damping method overshoots once and falls (HHT-alpha at h omega = 1e5: by 5e4).
void Simulator::judge_energy() {
  const double drift = relative_drift();
  if (!std::isfinite(drift)) {
    find_culprit(0);
    throw RunFailed(
        fmt::format("at t = {:.9g} s, step {}: the energy left the range of numbers: lengths, speeds, masses or "
                    "stiffnesses are too "
                    "large, or the solution diverged",
                    now_.t, statistics_.steps));
  }
  const bool runs_away = drift >= 1e3 && (last_row_ || drift >= drift_before_);
  drift_before_ = std::max(drift, 1e3);
  if (drift <= unexplained) last_good_ = now_;
  if (runs_away)
    throw RunFailed(fmt::format(
        "at t = {:.9g} s, step {}: the solution diverged: its energy changed by {:.3g} J that no force supplied or "
        "took, {:.3g} times what moved. The step may be too long for the method",
        now_.t, statistics_.steps, energy_drift(), drift));
  if (last_row_ && drift > unexplained)
    warnings_.push_back(fmt::format(
        "the method itself changed the energy by {:.3g} J, {:.2g} times all that moved; shorter steps change less",
        energy_drift(), drift));
}

void Simulator::look_at_theories() {
  if (const std::string impossible = theories_.look(now_.t, now_.q); !impossible.empty())
    throw RunFailed(fmt::format("at t = {:.9g} s, step {}: {}", now_.t, statistics_.steps, impossible));
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
    const StepControl::Proposal proposal = control().propose(now_.t, stop, location_.longest_step(step_limit_));
    double h = proposal.h, error = 0;
    EventLocation::Found found = EventLocation::Found::nothing;
    if (!try_step(proposal, h, found, error)) {
      if (!locked_) continue;
      jam(recorder, proposal.h);
      return true;
    }
    accept(h, h < proposal.h, proposal, error);
    record_inside(recorder);
    if (found == EventLocation::Found::event) {
      if (passes_infinity(location_.changes())) {
        jam(recorder, h);
        return true;
      }
      settle(location_.changes());
      const int contact = events_.empty() ? -1 : events_.back().contact;
      write_events(recorder);  // before a checkpoint, which may follow
      guard_against_standstill(h, proposal.h, contact);
      guard_against_storm(contact);
    }
    if (refinement_.possible()) refine(recorder, -1);
    return true;
  }
}

// True if sliding joints lock at the present state. Trial steps have ended there up to round-off.
bool Simulator::locks_here() {
  const auto slides = [this](std::size_t i) {
    return system_.model().contacts[i].joint &&
           system_.modes().contacts[i].friction == model::ContactMode::Friction::slide;
  };
  bool any = false;
  for (std::size_t i = 0; i < system_.modes().contacts.size(); ++i) any = any || slides(i);
  if (!any) return false;
  try {
    system_.move_to(now_.t, now_.q, now_.v);
    system_.accelerate({}, inside_.a, inside_.lambda);
    return false;
  } catch (const model::LocksItself&) {
    return true;
  }
}

// Near Painleve's critical state the forces of sliding contacts grow without end within a finite time, and steps become
// too short. Slightly larger friction is beyond that state, where an impact without collision ends the slip.
bool Simulator::near_critical_state() {
  constexpr double near = 1e-4, beyond = 10;
  const double distance = modes_.distance_from_critical(now_);
  raised_ = beyond * distance;
  return distance < near;
}

// A force that changes its sign through infinity looks like a release.
bool Simulator::passes_infinity(const ContactChanges& changes) {
  const auto slides = [](const model::ContactMode& m) {
    return m.closed && m.friction == model::ContactMode::Friction::slide;
  };
  const std::vector<model::ContactMode>& contacts = system_.modes().contacts;
  return !changes.released.empty() && std::any_of(contacts.begin(), contacts.end(), slides) && near_critical_state();
}

// A joint that locks itself while it slides comes to rest where it is.
void Simulator::jam(RecordSink& recorder, double h) {
  locked_ = false;
  ContactChanges changes;
  changes.locked = true;
  changes.raised = std::exchange(raised_, 0.0);
  settle(changes);
  write_events(recorder);
  guard_against_standstill(0, h, -1);
}

bool Simulator::try_step(const StepControl::Proposal& proposal, double& h, EventLocation::Found& found, double& error) {
  try {
    return step_and_examine(proposal, h, found, error);
  } catch (const OutsideDomain& e) {  // a shorter step may stay inside
    return refuse(proposal, said(e, system_.last_call()).c_str()), false;
  } catch (const model::LocksItself&) {  // inside the step: find how far steps get without it
    ++statistics_.rejected;
    control().rejected(proposal.h);
    locked_ = control().too_small(now_.t);
    return false;
  }
}

bool Simulator::step_and_examine(const StepControl::Proposal& proposal, double& h, EventLocation::Found& found,
                                 double& error) {
  tried_ = h;
  const Outcome outcome = trial_step(integrator_, system_, now_, h, next_);
  iterated_ = !outcome && integrator_.traits().implicit;
  if (!outcome) return refuse(proposal, outcome.reason()), false;
  const auto refuse_not_finite = [&] {
    if (!control().controlled()) fail_not_finite(h);
    ++statistics_.rejected;
    control().rejected(proposal.h);
    if (control().too_small(now_.t)) fail_not_finite(proposal.h);
    return false;
  };
  if (!next_.q.allFinite() || !next_.v.allFinite() || !next_.a.allFinite()) return refuse_not_finite();
  if (control().controlled()) {
    const Tolerance tolerance = scale_.scene().in_own_unit(control().tolerance(), settings_.every);
    error = estimate_->error(system_, now_, next_, tolerance);
    if (!(error <= 1)) {
      ++statistics_.rejected;
      control().rejected_for_error(h, error);
      if (!control().too_small(now_.t)) return false;
      locked_ = near_critical_state();
      if (!locked_) fail_for_error(h, tolerance);
      return false;
    }
  }
  if (location_.watches()) {
    const bool may_shorten = control().controlled() && h > 64 * control().smallest(now_.t);
    found = location_.examine(now_, h, next_, control().controlled(), may_shorten);
    if (found == EventLocation::Found::not_finite) return refuse_not_finite();
    if (found == EventLocation::Found::step_refused)
      return refuse(proposal, "a shorter step, tried to locate an event, was refused"), false;
    if (found == EventLocation::Found::passes_infinity)
      return refuse(proposal, "forces of contacts that slide pass infinity within it"), false;
    if (found == EventLocation::Found::step_too_long)
      return refuse(proposal, "it is too long to show what contacts did within it"), false;
  }
  return true;
}

void Simulator::refuse(const StepControl::Proposal& proposal, const char* reason) {
  ++statistics_.rejected;
  StepControl& steps = control();
  steps.rejected(proposal.h);
  if (!steps.controlled() && warnings_.size() < most_warnings)
    warnings_.push_back(
        fmt::format("t = {:.9g} s: a step of {:.3g} s was refused ({}) and halved", now_.t, proposal.h, reason));
  if (!steps.too_small(now_.t)) return;
  locked_ = near_critical_state();
  if (locked_) return;
  find_culprit(proposal.h);
  system_.move_to(now_.t, now_.q, now_.v);
  fail(proposal.h, reason);
}

std::string Simulator::circumstances() {
  for (const ContactEvent& event : events_) last_motions_.take(event);  // found, but not written yet
  try {
    return last_motions_.say(system_, {now_, next_, tried_, error_parts_, iterated_}, settings_.until);
  } catch (const std::exception&) {
    return "";  // a component has no answer at the state
  }
}

std::string Simulator::when(double h) const {
  return fmt::format("at t = {:.9g} s, step {} of {:.3g} s", now_.t, statistics_.steps + 1, h);
}

void Simulator::fail(double h, const std::string& why) const {
  throw RunFailed(fmt::format("{}: {}", when(h), why));
}

void Simulator::fail_for_error(double h, Tolerance tolerance) {
  tolerance.parts = &error_parts_;
  estimate_->error(system_, now_, next_, tolerance);
  fail(h, fmt::format("the error cannot be kept below the tolerance with steps of at least {:.3g} s",
                      control().smallest(now_.t)));
}

bool Simulator::near_the_end_of_numbers() const {
  return !(std::max(now_.q.lpNorm<Eigen::Infinity>(), now_.v.lpNorm<Eigen::Infinity>()) < 1e30);
}

// Throws if a component returned numbers that are not finite where the step began, or at the times of its trials. Does
// not throw if the state itself is near the end of the number range: there any component may overflow.
void Simulator::find_culprit(double h) {
  if (near_the_end_of_numbers()) return;
  for (const double part : {0.0, 0.5, 1.0, 2.0}) {
    system_.move_to(now_.t + part * h, now_.q, now_.v);
    const model::CallSite site = system_.find_not_finite();
    if (site.origin) throw NotFinite(when(h), site);
  }
}

// The components return finite numbers and the step does not: the method is to blame if no shorter step helps.
void Simulator::fail_not_finite(double h) {
  find_culprit(h);
  const std::string what = not_finite_in(next_);
  if (!what.empty() && !near_the_end_of_numbers() && !finite_with_shorter_steps(integrator_, system_, now_, h, inside_))
    throw BadStep(fmt::format("it returned {}; expected finite numbers", what));
  fail(h, "the solution diverged: numbers that are not finite. The step may be too long for the method");
}

namespace {

// What a correction has changed without the right to at the end of a step; "" if nothing.
std::string wrongly_changed(const State& uncorrected, const State& corrected) {
  for (const auto& [name, member] : {std::pair("q", &State::q), std::pair("v", &State::v), std::pair("a", &State::a),
                                     std::pair("lambda", &State::lambda)})
    if (const auto n = (uncorrected.*member).size(), found = (corrected.*member).size(); found != n)
      return fmt::format("it left {} with {} numbers; expected {}", name, found, n);
  if (!corrected.q.allFinite() || !corrected.v.allFinite()) return "it left numbers that are not finite";
  if (corrected.t != uncorrected.t)
    return fmt::format("it changed the time to {:.9g} s; expected {:.9g} s", corrected.t, uncorrected.t);
  return "";
}

}  // namespace

// Exceptions and wrong changes are charged to the correction unless a component that it called through the system
// threw.
Outcome Simulator::corrected(const LevelCorrection& entry, const Correction::Step& step) {
  const plugin::Breadcrumb goes_on(*entry.origin, "apply");
  plugin::ProcessSettings settings;
  const Outcome outcome = [&] {
    try {
      return entry.correction->apply(entry.level, system_, step, next_);
    } catch (...) {
      if (system_.last_call().origin) throw;
      plugin::rethrow_as_plugin_error(*entry.origin, "apply", next_.t);
    }
  }();
  const char* const fault = plugin::arithmetic_fault();
  settings.put_back();
  std::string cause = wrongly_changed(step.uncorrected, next_);
  if (*fault)
    cause = fmt::format("{}: it changed the arithmetic of the process, or a component that was called did", fault);
  if (!cause.empty()) throw plugin::PluginError(*entry.origin, "apply", cause, step.uncorrected.t);
  return outcome;
}

// The ledger follows the method's own step: energy changed by a correction counts as supplied by nothing.
void Simulator::step_ledger_and_correct() {
  ledger_.step(now_, next_);
  uncorrected_ = next_;
  const Correction::Step step{now_, uncorrected_, ledger_.energy()};
  for (const LevelCorrection& entry : corrections_)
    if (const Outcome outcome = corrected(entry, step); !outcome) fail(next_.t - now_.t, outcome.reason());
  if (next_.q == uncorrected_.q && next_.v == uncorrected_.v) return;
  system_.move_to(next_.t, next_.q, next_.v);
  system_.accelerate({}, next_.a, next_.lambda);
  ledger_.restart(next_);
}

void Simulator::accept(double h, bool shortened, const StepControl::Proposal& proposal, double error) {
  // The method's own t is t + h; only times that others rely on are replaced.
  if (!shortened && proposal.t_next != next_.t) next_.t = proposal.t_next;
  const double stop = record_time(records_);
  if (std::abs(stop - next_.t) <= 4 * eps * std::abs(stop)) next_.t = stop;
  if (!corrections_.empty()) step_ledger_and_correct();
  integrator_.accept(system_, now_, next_);
  last_motions_.take(h);
  if (shortened)
    control().interrupted();
  else
    control().accepted(proposal, error);
  ++statistics_.steps;
  if (in_contact_) ++statistics_.contact_steps;
  if (!shortened) {
    if (statistics_.smallest_step == 0 || h < statistics_.smallest_step) statistics_.smallest_step = h;
    statistics_.largest_step = std::max(statistics_.largest_step, h);
  }
  if (system_.sizes().nc > 0) {
    system_.move_to(next_.t, next_.q, next_.v);
    const ConstraintNorms norms = constraint_norms(system_, next_, scratch_);
    statistics_.largest.raise_to(norms);
    if (contradictory(norms)) fail(h, "the rows ask for accelerations that no motion has");
  }
  if (location_.watches()) scale_.take_contacts(system_);
  statistics_.locating_steps = location_.steps_tried();
  if (location_.watches()) location_.accept(h, next_);
  if (corrections_.empty()) ledger_.step(now_, next_);  // last: it leaves the system at the middle of the step
  std::swap(now_, next_);
  turns_.follow(now_.t, now_.q, now_.v);
  look_at_theories();
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
    take_moved(system_.energy(), totals);
    judge_joints(inside_);
    ++records_;
    last_good_ = now_;
  }
}

std::vector<std::string> Simulator::doubts() const {
  std::vector<std::string> all = audit_.warnings(system_.model(), ledger_);
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
  return energy_at_state().total() - ledger_.energy();
}

}  // namespace trammel::simulate
