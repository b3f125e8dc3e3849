// One good integrator, Heun's method, and the same with one fault each: `trammel check` must find every one of them.
#include <unistd.h>

#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include <trammel/plugin.hpp>

#include "kit_newmark.hpp"

namespace {

using namespace trammel;

enum class Fault {
  none,
  claims_order_3,
  claims_order_1,
  claims_to_be_implicit,
  claims_to_hold_rows,
  remembers_a_trial,
  reads_next,
  archives_nothing,
  remembers_after_restart,
  returns_what_is_no_number,
  allocates,
  takes_another_time,
  measures_in_metres,
  knows_the_hour,
  grows,
  prints,
  changes_rounding,
  changes_locale,
  changes_folder,
  throws,
  hangs,
  crashes,
  exits,
  varies,
  shares,
};

int used_so_far = 0;  // of all components

template <Fault fault>
class Heun final : public Integrator {
 public:
  Traits traits() const override {
    Traits t{.order = 2};
    if (fault == Fault::claims_order_3) t.order = 3;
    if (fault == Fault::claims_order_1) t.order = 1;
    t.implicit = fault == Fault::claims_to_be_implicit;
    t.holds_position = t.holds_velocity = fault == Fault::claims_to_hold_rows;
    return t;
  }
  void restart(System&, const State&) override {
    if (fault != Fault::remembers_after_restart) count_ = 0;
  }
  Outcome step(System& s, const State& now, double h, State& next) override {
    spoil_the_process(now);
    if (fault == Fault::remembers_a_trial) count_ += 1;
    const double more = fault == Fault::reads_next && next.q.size() > 0 ? 1e-9 : 0;
    const double length = fault == Fault::knows_the_hour && now.t > 1000 ? h * 1.01 : h;
    if (fault == Fault::allocates) remembered_ = std::make_unique<Vec>(now.q);

    s.rate(now.q, now.v, slope_);
    v_ = now.v + length * now.a;
    q_ = now.q + length * slope_;
    s.normalise(q_);
    s.move_to(now.t + h, q_, v_);
    s.accelerate({}, a_, next.lambda);
    s.rate(q_, v_, slope_again_);
    next.q = now.q + length / 2 * (slope_ + slope_again_);
    s.normalise(next.q);
    next.v = (now.v + length / 2 * (now.a + a_)) * (1 + 1e-9 * count_ + more);
    if (fault == Fault::grows) next.v *= 1 + 0.1 * h;
    if (fault == Fault::measures_in_metres) next.v = (next.v.array().abs() > 0.03).select(next.v, 0);
    next.t = now.t + (fault == Fault::takes_another_time ? h * (1 + 1e-9) : h);
    s.move_to(next.t, next.q, next.v);
    s.accelerate({}, next.a, next.lambda);
    if (fault == Fault::varies) next.v *= 1 + 1e-15 * double(std::rand() % 100);
    if (fault == Fault::shares) next.v *= 1 + 1e-12 * used_so_far;
    if (fault == Fault::returns_what_is_no_number) return Outcome::accept();
    const bool finite = next.q.allFinite() && next.v.allFinite() && next.a.allFinite() && next.lambda.allFinite();
    return finite ? Outcome::accept() : Outcome::reject("the accelerations are not finite");
  }
  void accept(System&, const State&, const State&) override {
    ++used_so_far;
    if (fault == Fault::archives_nothing || fault == Fault::remembers_after_restart) count_ += 1;
  }

 private:
  void spoil_the_process(const State& now) const {
    if (fault == Fault::prints) std::puts("stepping");
    if (fault == Fault::changes_rounding) std::fesetround(FE_UPWARD);
    if (fault == Fault::changes_locale && !std::setlocale(LC_ALL, "C.UTF-8")) std::abort();
    if (fault == Fault::changes_folder && ::chdir("/") != 0) std::abort();
    if (now.t < 0.01) return;
    if (fault == Fault::throws) throw std::runtime_error("one step too many");
    if (fault == Fault::exits) std::exit(0);
    if (fault == Fault::crashes) std::raise(SIGSEGV);
    while (fault == Fault::hangs) ::usleep(1000);
  }

  double count_ = 0;
  Vec q_, v_, a_, slope_, slope_again_;
  std::unique_ptr<Vec> remembered_;
};

template <Fault fault>
Declaration heun(const char* name) {
  return integrator<Heun<fault>>(name, "Heun's method").source("Heun 1900, Z. Math. Phys. 45, 23-38");
}

using kit_faults::newmark;
using kit_faults::NewmarkFault;

}  // namespace

TRAMMEL_PLUGIN(
    heun<Fault::none>("good_heun"), heun<Fault::claims_order_3>("claims_order_3"),
    heun<Fault::claims_order_1>("claims_order_1"), heun<Fault::claims_to_be_implicit>("claims_to_be_implicit"),
    heun<Fault::claims_to_hold_rows>("claims_to_hold_rows"), heun<Fault::remembers_a_trial>("remembers_a_trial"),
    heun<Fault::reads_next>("reads_next"), heun<Fault::archives_nothing>("archives_nothing"),
    heun<Fault::remembers_after_restart>("remembers_after_restart"),
    heun<Fault::returns_what_is_no_number>("returns_what_is_no_number"), heun<Fault::allocates>("allocates"),
    heun<Fault::takes_another_time>("takes_another_time"), heun<Fault::measures_in_metres>("measures_in_metres"),
    heun<Fault::knows_the_hour>("knows_the_hour"), heun<Fault::grows>("grows"), heun<Fault::prints>("prints"),
    heun<Fault::changes_rounding>("changes_rounding"), heun<Fault::changes_locale>("changes_locale"),
    heun<Fault::changes_folder>("changes_folder"), heun<Fault::throws>("throws"), heun<Fault::hangs>("hangs"),
    heun<Fault::crashes>("crashes"), heun<Fault::exits>("exits"), heun<Fault::varies>("varies"),
    heun<Fault::shares>("shares"), newmark<NewmarkFault::none>("good_newmark"),
    newmark<NewmarkFault::estimate_ten_times_too_large>("estimate_ten_times_too_large"),
    newmark<NewmarkFault::estimate_ten_times_too_small>("estimate_ten_times_too_small"),
    newmark<NewmarkFault::estimate_of_another_order>("estimate_of_another_order"),
    newmark<NewmarkFault::inside_is_the_start>("inside_is_the_start"),
    newmark<NewmarkFault::inside_misses_the_end>("inside_misses_the_end"),
    newmark<NewmarkFault::inside_is_of_the_last_trial>("inside_is_of_the_last_trial"),
    newmark<NewmarkFault::wrong_damping_is_accepted>("wrong_damping_is_accepted"))
