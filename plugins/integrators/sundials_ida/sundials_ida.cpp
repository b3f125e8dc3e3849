// SUNDIALS' IDA: backward differentiation formulas of variable order and step on the stabilised equations of index 2
// (equations.hpp). IDA takes its own steps, to its own tolerances; a step of the Simulator reads the solution.
//
// IDA integrates ahead, one internal step after another, until the end of a trial is passed. Its steps do not depend on
// where trials end, and its memory cannot be copied; the tape keeps the polynomial of every internal step since the
// last accepted state. A trial within the tape is answered by it, so trials leave no trace, bit for bit. The result is
// moved onto the rows, and a and lambda are solved for there; neither flows back into IDA.
//
//     accept     the tape before the step is forgotten. A state that no trial has given, because a correction
//                changed it, restarts IDA there
//     restart    IDA begins again with the first order, as after every `most_internal_steps` internal steps
//     archive    the state of the last restart and the number of internal steps since: they are repeated when a run
//                resumes, which gives the same bits
//
// Hindmarsh et al., ACM Trans. Math. Softw. 31, 363-396 (2005); Gear, Gupta, Leimkuhler, J. Comput. Appl. Math. 12,
// 77-90 (1985).
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <trammel/fidelity.hpp>
#include <trammel/integrator.hpp>
#include <trammel/own_tolerances.hpp>
#include <trammel/plugin.hpp>

#include "tape.hpp"

namespace {

using namespace trammel;

// After this many internal steps IDA begins again, which bounds what a resumed run repeats. A beginning costs about
// twenty internal steps, so this costs half a per cent.
constexpr long long most_internal_steps = 4096;

// A checksum that distinguishes states bit for bit.
std::uint64_t checksum(const State& state) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  const auto add = [&hash](const Vec& x) {
    for (const double value : x) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 1099511628211u;
    }
  };
  add(state.q), add(state.v);
  return hash;
}

class SundialsIda final : public Integrator, public DenseOutput, public HasFidelity, public OwnTolerances {
 public:
  double rtol = 1e-6, atol = 0, max_step = 0;
  int max_order = 5;

  void prepare(const World&) override { in_unit(1); }
  void in_unit(double length) override {
    constexpr double share = 1e-3;
    const double absolute = atol > 0 ? atol : share * rtol * length;
    solver_ = std::make_unique<ida::Solver>(ida::Tolerances{rtol, absolute, max_order, max_step});
  }
  Traits traits() const override {
    return {.order = 0, .implicit = true, .steps = max_order, .holds_position = true, .holds_velocity = true};
  }

  std::vector<FidelityParameter> fidelity() const override {
    using enum FidelityParameter::Costs;
    if (atol > 0) return {{"rtol", more_if_smaller}, {"atol", more_if_smaller}};
    return {{"rtol", more_if_smaller}};
  }

  void restart(System& s, const State& now) override { begin(s, now); }

  Outcome step(System& s, const State& now, double h, State& next) override {
    next.t = now.t + h;
    if (s.sizes().nv == 0) return stand_still(s, now, next);
    if (asleep_) repeat(s, now.t);
    if (const Outcome outcome = extend(s, next.t); !outcome) return outcome;
    if (!read(s, next)) return Outcome::reject(off_rows);
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    if (!next.a.allFinite() || !next.lambda.allFinite()) return Outcome::reject("the accelerations are not finite");
    given_.push_back(checksum(next));
    return Outcome::accept();
  }

  void accept(System& s, const State& now, const State& next) override {
    if (next.v.size() == 0) return;
    if (std::find(given_.begin(), given_.end(), checksum(next)) == given_.end()) return begin(s, next);
    given_.clear();
    tape_.forget_before(now.t);
    if (steps_of_later_ > 0 && now.t >= later_.t) {
      base_ = later_;
      steps_ -= std::exchange(steps_of_later_, 0);
    }
  }

  void interpolate(System& s, const State& now, const State& next, double theta, State& at) override {
    if (theta <= 0 || theta >= 1 || tape_.empty()) {
      at = theta <= 0 ? now : next;
      return;
    }
    at.t = now.t + theta * (next.t - now.t);
    tape_.at(at.t).evaluate(at.t, now.q.size(), at.q, at.v);
    s.normalise(at.q);
  }

  void archive(Archive& archive) override {
    constexpr long long most = 1'000'000'000;
    const double t_before = base_.t;
    archive("base_t", base_.t);
    archive("base_q", base_.q), archive("base_v", base_.v);
    archive("base_a", base_.a), archive("base_lambda", base_.lambda);
    long long steps = asleep_ ? steps_to_repeat_ : steps_;
    archive("internal_steps", steps);
    if (steps < 0 || steps > most) throw std::out_of_range("internal_steps");
    if (base_.v.size() != base_.a.size()) throw std::length_error("base_a");
    if (!asleep_ && steps == steps_ && base_.t == t_before) return;  // written
    asleep_ = true, steps_to_repeat_ = steps;
  }

 private:
  static constexpr const char* off_rows = "IDA's solution could not be moved onto the rows";

  void begin(System& s, const State& now) {
    base_ = now;
    steps_ = steps_of_later_ = 0;
    failed_ = nullptr, refused_ = "";
    asleep_ = false;
    given_.clear(), tape_.clear();
    tape_.reserve(now.q.size() + now.v.size(), max_order);
    if (now.v.size() > 0) start(s, State(now));
  }

  // Projects first: a state off the rows, as after an impact at the end of a step, has no solution through it.
  void start(System& s, State now) {
    solver_->equations().restart(s);
    const State given = now;
    if (!solver_->equations().project(s, now.t, now.q, now.v)) now = given;
    s.move_to(now.t, now.q, now.v);
    s.accelerate({}, now.a, now.lambda);
    solver_->restart(s, now);
  }

  static Outcome stand_still(System& s, const State& now, State& next) {
    next.q = now.q, next.v = now.v;
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    return Outcome::accept();
  }

  // A failure beyond the tape is kept: IDA stays where it was and would fail again.
  Outcome extend(System& s, double t) {
    if (tape_.empty() || tape_.end() < t) solver_->equations().use(s);
    while (tape_.empty() || tape_.end() < t) {
      if (failed_) std::rethrow_exception(failed_);
      if (*refused_) return Outcome::reject(refused_);
      try {
        const Outcome outcome = internal_step(s);
        if (!outcome) refused_ = outcome.reason();
      } catch (...) {
        failed_ = std::current_exception();
      }
    }
    return Outcome::accept();
  }

  Outcome internal_step(System& s) {
    if (steps_ - steps_of_later_ >= most_internal_steps && !begin_later(s)) return Outcome::reject(off_rows);
    const Outcome outcome = solver_->advance(tape_.next());
    if (outcome) tape_.keep(), ++steps_;
    return outcome;
  }

  // IDA begins again at the end of the tape.
  bool begin_later(System& s) {
    later_.t = tape_.end();
    later_.q.resize(s.sizes().nq);
    if (!read(s, later_)) return false;
    s.move_to(later_.t, later_.q, later_.v);
    s.accelerate({}, later_.a, later_.lambda);
    solver_->restart(s, later_);
    steps_of_later_ = steps_;
    return true;
  }

  // q and v of the tape at state.t, on the rows.
  bool read(System& s, State& state) {
    tape_.at(state.t).evaluate(state.t, s.sizes().nq, state.q, state.v);
    s.normalise(state.q);
    return solver_->equations().project(s, state.t, state.q, state.v);
  }

  // The internal steps that the run had taken when it was archived.
  void repeat(System& s, double now) {
    begin(s, State(base_));
    while (steps_ < steps_to_repeat_) {
      if (!internal_step(s)) throw std::runtime_error("the internal steps of the checkpoint cannot be repeated");
      tape_.forget_before(now);
    }
  }

  std::unique_ptr<ida::Solver> solver_;
  ida::Tape tape_;
  State base_;                    // where IDA last began, not later than the last accepted state
  long long steps_ = 0;           // internal ones since then
  State later_;                   // where it began again, later than base_
  long long steps_of_later_ = 0;  // internal ones from base_ to later_; 0: there is none
  bool asleep_ = true;            // IDA has not begun; an archive may have been read
  long long steps_to_repeat_ = 0;
  std::vector<std::uint64_t> given_;  // checksums of the trials since the last accepted state
  std::exception_ptr failed_;         // beyond the tape
  const char* refused_ = "";          // likewise
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::integrator<SundialsIda>("sundials_ida",
                                     "SUNDIALS' IDA: backward differentiation of variable order and step, stabilised")
        .source("Hindmarsh et al. 2005, ACM Trans. Math. Softw. 31, 363-396; Gear, Gupta, Leimkuhler 1985, J. Comput. "
                "Appl. Math. 12, 77-90")
        .parameter("rtol", &SundialsIda::rtol,
                   {.min = 0,
                    .max = 1e-1,
                    .usual_min = 1e-12,
                    .usual_max = 1e-3,
                    .above_min = true,
                    .doc = "of the local error of each internal step, relative to |q_i| and |v_i|"})
        .parameter("atol", &SundialsIda::atol,
                   {.min = 0,
                    .usual_max = 1e-3,
                    .doc = "likewise, absolute, in the unit of each coordinate and rate; 0: rtol / 1000 of the scene's "
                           "length, 1 at most"})
        .parameter("max_order", &SundialsIda::max_order,
                   {.min = 1, .max = 5, .doc = "of the formulas; above 2 they are unstable for some fast oscillations"})
        .parameter("max_step", &SundialsIda::max_step,
                   {.unit = "s", .min = 0, .doc = "longest internal step; 0: any. For loads that begin at rest"}))
