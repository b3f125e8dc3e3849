// The claims of an integrator that a suite of tests checks.
#include <trammel/testing/measurements.hpp>

namespace trammel {

namespace {

bool takes_rows(const Maker& make) {
  return make()->traits().rows;
}

bool takes_redundant_rows(const Maker& make) {
  return takes_rows(make) && make()->traits().redundant_rows;
}

// Checks of methods that accept rows.
Check on_rows(const char* name, const Maker& make, const std::function<Report()>& find_out) {
  return {name, [=] {
            if (takes_rows(make)) return find_out();
            Report report;
            report.claim("takes no rows, as its traits say: not asked", true);
            return report;
          }};
}

constexpr double pendulum_omega = 3.132;  // [rad/s] sqrt(9.81 / 1 m)

// With rows where the method takes them.
Problem any_pendulum(const Maker& make) {
  return takes_rows(make) ? problems::pendulum_with_rod() : problems::pendulum();
}

}  // namespace

std::vector<Check> integrator_checks(const Maker& make, const IntegratorClaims& c) {
  using namespace problems;
  const int fine = 2 * c.steps;
  std::vector<Check> checks = {
      {"HasItsOrderOnTheDampedOscillator", [=] { return check_order(make, oscillator(2, 0.1), c.order, c.steps); }},
      {"HasItsOrderOnThePendulum", [=] { return check_order(make, pendulum(), c.order, c.steps); }},
      {"HasItsOrderWhereTheMassVaries",
       [=] { return check_order(make, pendulum_of_varying_mass(), c.order, c.steps); }},
      on_rows("HasItsOrderOnThePendulumWithRod", make,
              [=] { return check_order(make, pendulum_with_rod(), c.order, fine); }),
      {"HoldsTheEnergyOfThePendulum", [=] { return check_energy(make, pendulum(), c.steps, c.energy); }},
      on_rows("HoldsTheRowOfThePendulum", make,
              [=] { return check_constraints(make, pendulum_with_rod(), fine, c.constraints); }),
      on_rows("HoldsRepeatedRows", make,
              [=] {
                if (takes_redundant_rows(make))
                  return check_constraints(make, pendulum_with_rod(1, 0.4, {1, 2}), fine, c.constraints);
                Report report;
                report.claim("takes no redundant rows, as its traits say: not asked", true);
                return report;
              }),
      // Slow and fast: the error is that of the positions, or that of the velocities.
      {"EstimatesItsErrorOnASlowOscillator",
       [=] { return check_estimate(make, oscillator(0.2, 0.1), 0.2, 2 / (0.2 * c.steps)); }},
      {"EstimatesItsErrorOnAFastOscillator",
       [=] { return check_estimate(make, oscillator(20, 0.1), 20, 2 / (20.0 * c.steps)); }},
      {"EstimatesItsErrorOnThePendulum",
       [=] { return check_estimate(make, pendulum(), pendulum_omega, 1.0 / c.steps); }},
      on_rows("EstimatesItsErrorOnThePendulumWithRod", make,
              [=] { return check_estimate(make, pendulum_with_rod(), pendulum_omega, 1.0 / fine); }),
      {"LeavesNoTraceOfATrial", [=] { return trial_leaves_no_trace(make, any_pendulum(make)); }},
      {"ResumesBitForBit", [=] { return resumes_bitwise(make, any_pendulum(make)); }},
  };
  if (c.imaginary_limit > 0)
    checks.push_back(
        {"IsStableOnTheImaginaryAxis", [=] { return check_stability(make, Axis::imaginary, c.imaginary_limit); }});
  if (c.real_limit > 0)
    checks.push_back(
        {"IsStableOnTheRealAxis", [=] { return check_stability(make, Axis::negative_real, c.real_limit); }});
  return checks;
}

}  // namespace trammel
