// What the Simulator relies on when it repeats steps to locate events, changes sizes or resumes a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <trammel/testing/archive.hpp>

#include "testing/kit/integrators/integrators.hpp"
#include "testing/kit/integrators/order.hpp"

namespace trammel::kit {

namespace {

// A method on a system of its own, advanced step by step.
struct Run {
  std::unique_ptr<System> system;
  std::unique_ptr<Integrator> method;
  State now, next;

  Run(const Subject& s, const Problem& problem, double t = 0)
      : system(problem.system()), method(s.maker<Integrator>()()), now(problem.solution(t)) {
    method->restart(*system, now);
  }
  bool try_step(double h) { return bool(method->step(*system, now, h, next)); }
  void accept() {
    method->accept(*system, now, next);
    std::swap(now, next);
  }
  bool step(double h) {
    if (!try_step(h)) return false;
    accept();
    return true;
  }
  bool steps(double h, int n) {
    for (int i = 0; i < n; ++i)
      if (!step(h)) return false;
    return true;
  }
};

State spoilt_state() {
  const double nan = std::nan("");
  return {nan, Vec::Constant(7, nan), Vec::Constant(1, nan), Vec(0), Vec::Constant(3, nan)};
}

double distance(const State& a, const State& b) {
  if (a.q.size() != b.q.size()) return std::numeric_limits<double>::infinity();
  return std::hypot((a.q - b.q).norm(), (a.v - b.v).norm());
}

constexpr double h = 5e-3;  // [s] of most runs
constexpr const char* stepped = "steps of 5 ms are accepted";

void claim_steps(Report& report, bool accepted) {
  if (!accepted) report.claim(stepped, false);
}

}  // namespace

Report trial_leaves_no_trace(const Subject& s) {
  const Problem problem = any_pendulum(s);
  Run plain(s, problem), tried(s, problem);
  std::mt19937 random = s.random(11);
  auto* estimate = dynamic_cast<ErrorEstimate*>(tried.method.get());
  bool accepted = true, now_kept = true, equal = true;
  int i = 0;
  for (; i < 12 && accepted && now_kept && equal; ++i) {
    const State before = tried.now;
    for (const double trial : {1e-3 * between(random, 0.5, 2), 0.2 * between(random, 0.5, 2), 1e-7}) {
      State other = spoilt_state();
      const bool taken = bool(tried.method->step(*tried.system, tried.now, trial, other));
      if (taken && estimate) estimate->error(*tried.system, tried.now, other, {});
    }
    now_kept = same_bits(before, tried.now);
    accepted = plain.step(h) && tried.step(h);
    equal = same_bits(plain.now, tried.now);
  }
  Report report;
  claim_steps(report, accepted);
  report.claim("a trial leaves `now` as it was", now_kept, now_kept ? "" : fmt::format("not in step {}", i));
  report.claim("trials of other sizes change no bit of the run", equal,
               equal ? ""
                     : fmt::format("in step {} q and v differ by {:.3e} from a run without them", i,
                                   distance(plain.now, tried.now)));
  return report;
}

Report reads_nothing_from_next(const Subject& s) {
  Run clean(s, any_pendulum(s)), spoilt(s, any_pendulum(s));
  bool accepted = true, equal = true;
  for (int i = 0; i < 6 && accepted && equal; ++i) {
    spoilt.next = spoilt_state(), clean.next = {};
    accepted = clean.try_step(h) && spoilt.try_step(h);
    equal = same_bits(clean.next, spoilt.next);
    clean.accept(), spoilt.accept();
  }
  Report report;
  claim_steps(report, accepted);
  report.claim("the step is the same bit for bit, whatever `next` contains on entry", equal);
  return report;
}

Report takes_an_earlier_trial(const Subject& s) {
  Run plain(s, any_pendulum(s)), looked(s, any_pendulum(s));
  bool accepted = true;
  for (int i = 0; i < 10 && accepted; ++i) {
    State closer;
    accepted = plain.step(h) && looked.try_step(h) && looked.method->step(*looked.system, looked.now, 2e-3, closer);
    looked.next.t = std::nextafter(looked.next.t, 1e9);  // located: a time rounded otherwise
    looked.accept();
  }
  Report report;
  claim_steps(report, accepted);
  const double off = distance(plain.now, looked.now);
  // Nothing but the last digits of t differs; 1e-10 leaves room for an iteration's tolerance.
  const double tolerance = s.traits().implicit ? 1e-10 : 1e-13;
  report.claim("a trial that was looked into is accepted like any other", off <= tolerance,
               fmt::format("{:.3e} off", off));
  return report;
}

Report resumes_bitwise(const Subject& s) {
  const Problem problem = any_pendulum(s);
  Run run(s, problem), resumed(s, problem);
  bool accepted = run.steps(h, 12);
  MemoryArchive memory;
  run.method->archive(memory);
  memory.reading = true;
  resumed.method = s.maker<Integrator>()();
  resumed.method->archive(memory);
  resumed.now = run.now;
  accepted = accepted && run.steps(h, 12) && resumed.steps(h, 12);
  Report report;
  claim_steps(report, accepted);
  const bool equal = same_bits(run.now, resumed.now);
  report.claim("a run that resumes from the archive is the same bit for bit", equal,
               equal ? "" : fmt::format("q and v differ by {:.3e}", distance(run.now, resumed.now)));
  return report;
}

Report restart_forgets(const Subject& s) {
  const Problem problem = any_pendulum(s);
  Run fresh(s, problem), used(s, problem);
  const State start = used.now;
  bool accepted = used.steps(2e-3, 9);
  used.now = start;
  used.method->restart(*used.system, start);
  accepted = accepted && fresh.steps(h, 8) && used.steps(h, 8);
  Report report;
  claim_steps(report, accepted);
  const bool equal = same_bits(fresh.now, used.now);
  report.claim("after a restart the run is that of a fresh method bit for bit", equal,
               equal ? "" : fmt::format("q and v differ by {:.3e}", distance(fresh.now, used.now)));
  return report;
}

namespace {

// Rows 1, 0, 1: the rod is taken off for a while and put back where it came off, so that it fits.
State with_the_rod_off(Integrator& m, const Problem& rod, int n) {
  const auto held = rod.system(), flying = flight(rod).system();
  const auto at = [](System& s, double t, const State& x) {
    State fresh{t, x.q, x.v, {}, {}};
    s.move_to(t, fresh.q, fresh.v);
    s.accelerate({}, fresh.a, fresh.lambda);
    return fresh;
  };
  const State off = integrate(m, *held, rod.solution(0), 0.4, n);
  const State flown = integrate(m, *flying, at(*flying, off.t, off), off.t + 0.2, n / 2);
  State back = at(*held, flown.t, off);
  return integrate(m, *held, back, back.t + 0.4, n);
}

}  // namespace

Report keeps_its_order_when_rows_come_and_go(const Subject& s) {
  const Problem rod = some_rod(s);
  // The same path on exact motion: each part is known by itself, and rows do not depend on time.
  State end = rod.solution(0.4);
  const auto held = rod.system();
  for (int i = 0; i < 40; ++i) end = exact_flow(*held, end, 0.01);
  return has_order(converge("the pendulum whose rod comes off and on again", 1, step_numbers(8, 4096, s.traits().order),
                            [&](int n) { return distance(with_the_rod_off(*s.maker<Integrator>()(), rod, n), end); }),
                   s.traits().order);
}

namespace {

// x = P y: half of the coordinates become twice as many by a linear map, as in a refined mesh.
struct Doubling final : Transfer {
  void q(In old, Out fresh) const override { v(old, fresh); }
  void v(In old, Out fresh) const override {
    for (Eigen::Index i = 0; i < old.size(); ++i) fresh(2 * i) = fresh(2 * i + 1) = old(i);
  }
};

}  // namespace

Report keeps_its_order_when_coordinates_change(const Subject& s) {
  std::mt19937 random = s.random(12);
  const double omega = between(random, 1.5, 2.5);
  const Problem small = springs({omega}), large = springs({omega, omega});
  const auto error = [&](int n) {
    const auto method = s.maker<Integrator>()();
    const auto before = small.system(), after = large.system();
    State now = integrate(*method, *before, small.solution(0), 0.5, n), fresh = now;
    const Doubling doubling;
    fresh.q.resize(2), fresh.v.resize(2);
    doubling.q(now.q, fresh.q), doubling.v(now.v, fresh.v);
    after->move_to(fresh.t, fresh.q, fresh.v);
    after->accelerate({}, fresh.a, fresh.lambda);
    if (auto* resizable = dynamic_cast<Resizable*>(method.get()))
      resizable->resize(*after, doubling, fresh);
    else
      method->restart(*after, fresh);
    State next;
    for (int i = 0; i < n; ++i) {
      if (!method->step(*after, fresh, 0.5 / n, next)) return std::nan("");
      method->accept(*after, fresh, next);
      std::swap(fresh, next);
    }
    double off = 0;
    for (int i = 0; i < 2; ++i) off += std::hypot(fresh.q(i) - std::cos(omega), fresh.v(i) + omega * std::sin(omega));
    return off;
  };
  return has_order(
      converge("a spring whose coordinate becomes two", 0.5, step_numbers(2, 4096, s.traits().order), error),
      s.traits().order);
}

Report stands_still_with_nothing_to_move(const Subject& s) {
  Run run(s, nothing());
  const bool accepted = run.steps(0.1, 10);
  Report report;
  report.claim("steps without coordinates (nv = 0) are accepted", accepted);
  report.claim("time passes", std::abs(run.now.t - 1) <= 1e-14,
               fmt::format("t = {:.17g} after ten steps of 0.1", run.now.t));
  return report;
}

Report moves_on_in_time(const Subject& s) {
  Run run(s, any_pendulum(s));
  bool accepted = true;
  double off = 0;
  for (const double step : {1e-3, 5e-3, 2e-4}) {
    const double expected = run.now.t + step;
    accepted = accepted && run.step(step);
    off = std::max(off, std::abs(run.now.t - expected));
  }
  Report report;
  claim_steps(report, accepted);
  report.claim("next.t = now.t + h", off <= 1e-16, fmt::format("{:.3e} s off", off));
  return report;
}

Report does_not_depend_on_the_time_of_day(const Subject& s) {
  const Problem problem = any_pendulum(s);
  // A power of two and steps of one: times have no round-off.
  constexpr double later = 1024, step = 1.0 / 256;
  Run now(s, problem), then(s, shifted(problem, later), later);
  const bool accepted = now.steps(step, 64) && then.steps(step, 64);
  Report report;
  claim_steps(report, accepted);
  const double off = distance(now.now, then.now);
  report.claim("the same motion 1024 s later", off <= 1e-10, fmt::format("{:.3e} off", off));
  return report;
}

Report does_not_depend_on_the_order_of_coordinates(const Subject& s) {
  std::mt19937 random = s.random(13);
  const double slow = between(random, 1, 2), fast = between(random, 8, 12);
  Run one(s, springs({slow, fast})), other(s, springs({fast, slow}));
  const bool accepted = one.steps(h, 60) && other.steps(h, 60);
  Report report;
  claim_steps(report, accepted);
  const double off =
      std::hypot((one.now.q - other.now.q.reverse()).norm(), (one.now.v - other.now.v.reverse()).norm() / fast);
  // Sums in another order, and what an iteration leaves: far below the error of any step.
  report.claim("the same motion with the coordinates in another order", off <= 1e-9, fmt::format("{:.3e} off", off));
  return report;
}

Report does_not_depend_on_the_unit_of_length(const Subject& s) {
  // 2^10 units to the metre: powers of two change no rounding, so that only thresholds can make a difference.
  const auto end = [&](double unit) {
    Problem falling = particle(
        [unit](double, const Vec& q, const Vec&) -> Vec { return unit * (1 - 9.81 * (q / unit).array().sin()); });
    falling.tangent = [unit](const Blend& c, const Vec& q, const Vec&) -> Mat {
      return Mat::Constant(1, 1, c.c_k * 9.81 * std::cos(q[0] / unit));
    };
    Run run(s, falling);
    if (!run.steps(0.01, 100)) throw std::runtime_error("a step of 10 ms was rejected");
    return Vec(run.now.q / unit)[0];
  };
  Report report;
  const double metres = end(1), thousandths = end(1024);
  report.claim("the same motion in metres and in their 1024th parts", std::abs(metres - thousandths) <= 1e-9,
               fmt::format("{:.17g} and {:.17g} m", metres, thousandths));
  return report;
}

Report iterates_only_if_implicit(const Subject& s) {
  const Problem problem = any_pendulum(s);
  const auto sound = problem.system();
  Failing counting(*sound, Failing::How::singular);
  const auto method = s.maker<Integrator>()();
  State now = problem.solution(0), next;
  method->restart(counting, now);
  Report report;
  for (int i = 0; i < 3; ++i) {
    if (!method->step(counting, now, h, next)) break;
    method->accept(counting, now, next);
    std::swap(now, next);
  }
  const bool asked = counting.iterations_factorised > 0, implicit = method->traits().implicit;
  report.claim(implicit ? "an implicit method asks for the tangent" : "an explicit method asks for no tangent",
               asked == implicit,
               fmt::format("{} factorisations with D or K in three steps", counting.iterations_factorised));
  return report;
}

}  // namespace trammel::kit
