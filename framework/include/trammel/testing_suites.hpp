// A GoogleTest suite for an integrator, one test per claim; needs no macro and no fixture:
//
//     const bool registered = trammel::register_integrator_suite("MyMethod", make, {.order = 2, .steps = 64});
#pragma once

#include <gtest/gtest.h>

#include <trammel/testing.hpp>

namespace trammel {

struct IntegratorClaims {
  double order = 1;
  int steps = 64;              // per second, where convergence is asymptotic
  double imaginary_limit = 0;  // of stability; 0: not claimed
  double real_limit = 0;       // likewise
  double energy = 0.05;        // largest relative change on the pendulum
  double constraints = 1e-2;   // [m, m/s] largest violation where the method does not hold the rows
};

namespace testing_detail {
class Check final : public ::testing::Test {
 public:
  explicit Check(std::function<Report()> check) : check_(std::move(check)) {}
  void TestBody() override {
    const Report report = check_();
    EXPECT_TRUE(report.holds) << report.table;
  }

 private:
  std::function<Report()> check_;
};
}  // namespace testing_detail

inline bool register_integrator_suite(const std::string& suite, const Maker& make, const IntegratorClaims& c) {
  const auto add = [&](const char* name, std::function<Report()> check) {
    ::testing::RegisterTest(suite.c_str(), name, nullptr, nullptr, __FILE__, __LINE__,
                            [check]() -> ::testing::Test* { return new testing_detail::Check(check); });
  };
  add("HasItsOrderOnTheDampedOscillator",
      [=] { return check_order(make, problems::oscillator(2, 0.1), c.order, c.steps); });
  add("HasItsOrderOnThePendulum", [=] { return check_order(make, problems::pendulum(), c.order, c.steps); });
  add("HasItsOrderOnThePendulumWithRod",
      [=] { return check_order(make, problems::pendulum_with_rod(), c.order, 2 * c.steps); });
  add("HoldsTheEnergyOfThePendulum", [=] { return check_energy(make, problems::pendulum(), c.steps, c.energy); });
  add("HoldsTheRowOfThePendulum",
      [=] { return check_constraints(make, problems::pendulum_with_rod(), 2 * c.steps, c.constraints); });
  add("HoldsRepeatedRows", [=] {
    return check_constraints(make, problems::pendulum_with_rod(1, 0.4, {1, 2}), 2 * c.steps, c.constraints);
  });
  add("LeavesNoTraceOfATrial", [=] { return trial_leaves_no_trace(make, problems::pendulum_with_rod()); });
  add("ResumesBitForBit", [=] { return resumes_bitwise(make, problems::pendulum_with_rod()); });
  if (c.imaginary_limit > 0)
    add("IsStableOnTheImaginaryAxis", [=] { return check_stability(make, Axis::imaginary, c.imaginary_limit); });
  if (c.real_limit > 0)
    add("IsStableOnTheRealAxis", [=] { return check_stability(make, Axis::negative_real, c.real_limit); });
  return true;
}

}  // namespace trammel
