#include "testing/kit/integrators/integrators.hpp"

#include "testing/kit/integrators/order.hpp"

namespace trammel::kit {

namespace {

constexpr ClaimsOf integrator_claim{"integrator.", "trammel/integrator.hpp"};

std::string takes_no_rows(const Subject& s) {
  return s.traits().rows ? "" : "it takes no rows: Traits::rows = false";
}
// Its map is not linear on linear problems, and a long step takes as many of its own as the motion asks.
std::string steps_inside_each_step(const Subject& s) {
  return s.traits().order > 0 ? "" : "it takes steps of its own inside each step: Traits::order = 0";
}
template <class Ability>
std::function<std::string(const Subject&)> unless_it_offers(const char* ability) {
  return [=](const Subject& s) {
    return s.offers<Ability>() ? std::string() : std::string("it does not offer ") + ability;
  };
}
std::string has_no_estimate_or_rows(const Subject& s) {
  const std::string rows = takes_no_rows(s);
  return rows.empty() ? unless_it_offers<ErrorEstimate>("ErrorEstimate")(s) : rows;
}

constexpr const char* of_order = "Of q and v with constant steps, constraints included.";
constexpr const char* order_fit = "log |y_h - y| = p log h + constant,   p = Traits::order";

int most_steps(const Subject& s) {
  return s.level == Level::quick ? 2048 : 16384;
}

Check order_on(const char* name, const char* claim, Problem (*problem)(const Subject&), bool rows) {
  Check check{integrator_claim(name, claim, order_fit, of_order), Level::quick, [=](const Subject& s) {
                return has_order(converge(s.maker<Integrator>(), problem(s), most_steps(s)), s.traits().order);
              }};
  if (rows) check.left_out = takes_no_rows;
  return check;
}

void add_orders(Checks& checks) {
  checks.push_back(order_on("order-on-the-damped-oscillator", "On a linear problem the method has the order it claims.",
                            some_oscillator, false));
  checks.push_back(order_on("order-on-the-pendulum", "On a nonlinear problem the method has the order it claims.",
                            some_pendulum, false));
  checks.push_back(order_on("order-where-the-mass-varies", "Where M depends on q the method has the order it claims.",
                            some_pendulum_of_varying_mass, false));
  checks.push_back(
      order_on("order-on-the-quaternion-top", "On orientations the method has the order it claims.", some_top, false));
  checks.push_back(order_on(
      "order-on-the-pendulum-with-rod", "On constrained motion the method has the order it claims.",
      [](const Subject& s) { return some_rod(s); }, true));
  checks.push_back(order_on("order-where-rows-depend-on-time",
                            "Where the rows depend on time the method has the order it claims.", some_wind, true));
  checks.push_back(
      {integrator_claim("order-when-rows-come-and-go", "After a restart with rows 1, 0, 1 the method keeps its order.",
                        order_fit, "The state jumped, or sizes changed: discard the history and start from `now`."),
       Level::quick, keeps_its_order_when_rows_come_and_go, takes_no_rows});
  checks.push_back(
      {integrator_claim("order-when-coordinates-change",
                        "When coordinates are replaced by more of them the method keeps its order.", order_fit,
                        "For systems whose coordinates are replaced during a run (a refined mesh)."),
       Level::quick, keeps_its_order_when_coordinates_change});
}

void add_contract(Checks& checks) {
  const char* const trial = "It changes nothing that later trials depend on";
  checks.push_back(
      {integrator_claim("trial-leaves-no-trace", "A trial step that is not accepted changes no bit of the run.",
                        "step(now, h) = step(now, h) after step(now, h'), bit for bit", trial),
       Level::quick, trial_leaves_no_trace});
  checks.push_back(
      {integrator_claim("reads-nothing-from-next", "The step does not depend on what `next` contains on entry.",
                        "step(now, h; next = NaN) = step(now, h; next = {}), bit for bit",
                        "`next` may have any content and size on entry."),
       Level::quick, reads_nothing_from_next});
  checks.push_back(
      {integrator_claim("takes-an-earlier-trial", "A trial that was looked into by shorter trials can be accepted.",
                        "accept(next) after another trial = accept(next)",
                        "The trial from `now` became the solution. History is updated here and nowhere else."),
       Level::quick, takes_an_earlier_trial});
  checks.push_back(
      {integrator_claim("resumes-bit-for-bit", "A run that resumes from its archive is the same bit for bit.",
                        "y_n(archive, y_k) = y_n for n > k", "Reads or writes the history, so that a run can resume."),
       Level::quick, resumes_bitwise});
  checks.push_back({integrator_claim("restart-forgets", "After a restart nothing of the past counts.",
                                     "restart(y_0) after any steps = restart(y_0) of a fresh method, bit for bit",
                                     "The state jumped, or sizes changed: discard the history and start from `now`."),
                    Level::quick, restart_forgets});
  checks.push_back({integrator_claim("moves-on-in-time", "A step of h ends h later.", "t_{n+1} = t_n + h",
                                     "A trial step from `now` to `next` with h > 0."),
                    Level::quick, moves_on_in_time});
  checks.push_back(
      {integrator_claim("is-implicit-as-claimed", "The method asks for the tangent if it is implicit, and else not.",
                        "S = c_m M + c_d D + c_k K with c_d or c_k, if and only if Traits::implicit",
                        "Claims of a method. Each of them is measured by tests."),
       Level::quick, iterates_only_if_implicit});
}

void add_symmetries(Checks& checks) {
  checks.push_back(
      {integrator_claim("same-at-another-time", "The same motion starts at another time and stays the same.",
                        "y(t + 1024 s) = y(t) of the same equations, 1024 s later",
                        "`t` may repeat, decrease or lie between steps."),
       Level::quick, does_not_depend_on_the_time_of_day});
  checks.back().words.contract.header = "trammel/system.hpp";
  checks.push_back(
      {integrator_claim(
           "same-in-another-order", "The order of the coordinates does not matter.", "P y(P q_0) = y(q_0)",
           "The System hides contacts, events, storage (dense or sparse), redundancy and the meaning of the "
           "coordinates."),
       Level::quick, does_not_depend_on_the_order_of_coordinates});
  checks.back().words.contract.header = "trammel/system.hpp";
  checks.push_back(
      {integrator_claim(
           "same-in-other-units", "The unit of length does not matter.", "y(1024 q_0)/1024 = y(q_0)",
           "The System hides contacts, events, storage (dense or sparse), redundancy and the meaning of the "
           "coordinates."),
       Level::quick, does_not_depend_on_the_unit_of_length});
  checks.back().words.contract.header = "trammel/system.hpp";
}

void add_extremes(Checks& checks) {
  const char* const reject = "Reject the step instead of returning numbers that are not finite.";
  checks.push_back({integrator_claim("any-step-is-finite-or-rejected",
                                     "Steps of 1e-12 s to 1e3 s end in finite numbers or a rejection.",
                                     "|y_{n+1}| < infinity, or Outcome::reject", reject),
                    Level::quick, any_step_is_finite_or_rejected, steps_inside_each_step});
  checks.push_back(
      {integrator_claim("rejects-what-is-not-a-number", "A step on a force that is not a number is rejected.",
                        "f = NaN: Outcome::reject", reject),
       Level::quick, rejects_what_is_not_a_number});
  checks.push_back(
      {integrator_claim("survives-any-failure",
                        "Whichever evaluation of the system fails, the step is finite or rejected.",
                        "f, a or correct() of evaluation n fails: |y_{n+1}| < infinity, or Outcome::reject", reject),
       Level::quick, survives_any_failure});
  checks.push_back({integrator_claim("stands-still-with-nothing-to-move", "A system without coordinates passes time.",
                                     "nv = 0: t_{n+1} = t_n + h", "constant between two calls of Integrator::restart"),
                    Level::quick, stands_still_with_nothing_to_move});
  checks.back().words.contract.header = "trammel/system.hpp";
  checks.push_back({integrator_claim("takes-any-mass-ratio", "Masses that differ by 1e8 lose no accuracy.",
                                     "M v' = f - W^T lambda, M = diag(1, 1e-8)", of_order),
                    Level::quick, takes_any_mass_ratio, takes_no_rows});
  checks.push_back(
      {integrator_claim("takes-any-time", "At t = 1e9 s the method moves as at 0.", "y(t + 1e9 s) = y(t)", of_order),
       Level::quick, takes_any_time});
  checks.push_back(
      {integrator_claim("allocates-nothing-when-warm", "A step asks for no memory once its vectors have their sizes.",
                        "allocations in steps 11 to 30 = 0",
                        "Once its vectors have their sizes, a step allocates no memory."),
       Level::quick, allocates_nothing});
}

void add_accuracy(Checks& checks) {
  checks.push_back(
      {integrator_claim("energy-error-shrinks", "The energy error of the pendulum shrinks with the method's order.",
                        "max |E_n - E_0| = O(h^p)", of_order),
       Level::quick, energy_error_shrinks});
  const char* const held = "g = 0 at the end of each step, to the iteration's tolerance";
  checks.push_back(
      {integrator_claim("holds-the-row", "Rows are held as claimed, and else drift with the method's order.",
                        "g = 0 if Traits::holds_position;  G v + g_t = 0 if Traits::holds_velocity;  else O(h^p)",
                        held),
       Level::quick, [](const Subject& s) { return holds_its_rows(s, some_rod(s)); }, takes_no_rows});
  checks.push_back({integrator_claim("holds-repeated-rows", "Rows that repeat each other are held as well.",
                                     "rank G = 1 of two rows;  g = 0, G v + g_t = 0 as claimed", held),
                    Level::quick,
                    [](const Subject& s) {
                      return holds_its_rows(s, some_rod(s, {1, 2}));
                    },
                    takes_no_rows});
  checks.push_back(
      {integrator_claim("is-stable-for-small-steps", "For small steps no root of the amplification matrix exceeds 1.",
                        "|z_i| <= 1 + O((omega h)^(p+1)) on x'' = -omega^2 x", of_order),
       Level::quick, is_stable_for_small_steps, steps_inside_each_step});
}

constexpr const char* estimate_line =
    "Weighted root-mean-square of the local error of the last trial, over q (as increments) and v";

Check estimate_on(const char* name, const char* claim, double omega, Problem (*problem)(const Subject&), bool rows) {
  return {integrator_claim(name, claim, "error() = |y_{n+1} - y(t_{n+1}; y_n)|, O(h^error_order)", estimate_line),
          Level::quick,
          [=](const Subject& s) {
            const double step = 1 / steps_per_radian(s.traits().order);
            return estimates_its_error(s, problem(s), omega, step / omega);
          },
          rows ? std::function(has_no_estimate_or_rows) : unless_it_offers<ErrorEstimate>("ErrorEstimate")};
}

void add_abilities(Checks& checks) {
  checks.push_back(estimate_on(
      "estimates-the-error-of-a-slow-oscillator", "The estimate is the error where positions matter.", 0.2,
      [](const Subject&) { return problems::oscillator(0.2, 0.1); }, false));
  checks.push_back(estimate_on(
      "estimates-the-error-of-a-fast-oscillator", "The estimate is the error where velocities matter.", 20,
      [](const Subject&) { return problems::oscillator(20, 0.1); }, false));
  checks.push_back(estimate_on("estimates-the-error-of-the-pendulum",
                               "The estimate is the error of a nonlinear motion.", pendulum_omega, some_pendulum,
                               false));
  checks.push_back(estimate_on(
      "estimates-the-error-on-rows", "The estimate is the error of a constrained motion.", pendulum_omega,
      [](const Subject& s) { return some_rod(s); }, true));
  const auto dense = unless_it_offers<DenseOutput>("DenseOutput");
  const char* const inside = "State inside the last trial at theta in [0, 1]; fills t, q, v.";
  checks.push_back({integrator_claim("dense-output-meets-the-ends", "The state inside a step meets its ends.",
                                     "y(theta = 0) = y_n, y(theta = 1) = y_{n+1}", inside),
                    Level::quick, dense_output_meets_the_ends, dense});
  checks.push_back(
      {integrator_claim("dense-output-has-an-order", "The state inside a step is accurate, not only its ends.",
                        "|y(theta) - y(t_n + theta h)| = O(h^min(p, 3)) or better", inside),
       Level::quick, dense_output_has_an_order, dense});
  checks.push_back(
      {integrator_claim("dense-output-is-that-of-the-step", "Other trials and `accept` leave the inside of a step.",
                        "y(theta) after step(now, h') and accept = y(theta), bit for bit", inside),
       Level::quick, dense_output_is_that_of_the_step, dense});
}

}  // namespace

Checks integrator_checks() {
  Checks checks;
  add_orders(checks);
  add_accuracy(checks);
  add_contract(checks);
  add_abilities(checks);
  add_symmetries(checks);
  add_extremes(checks);
  return checks;
}

}  // namespace trammel::kit
