// GoogleTest suites of checks, one test per claim, without macros and fixtures:
//
//     const bool registered = trammel::register_suite("MyMethod", trammel::integrator_checks(make, {.order = 2}));
//     const bool registered = trammel::register_suite("MyBody", trammel::body_checks(make));
//
// With TRAMMEL_MEASURED=1 in the environment each test prints its measurements, also when it passes.
#pragma once

#include <cstdlib>
#include <iostream>

#include <gtest/gtest.h>

#include <trammel/testing/measurements.hpp>
#include <trammel/testing/components.hpp>

namespace trammel {

inline bool register_suite(const std::string& suite, const std::vector<Check>& checks) {
  struct Test final : public ::testing::Test {
    explicit Test(Check c) : check(std::move(c)) {}
    void TestBody() override {
      const Report report = check();
      if (std::getenv("TRAMMEL_MEASURED")) std::cout << report.table;
      EXPECT_TRUE(report.holds) << report.table;
    }
    Check check;
  };
  for (const Check& check : checks)
    ::testing::RegisterTest(suite.c_str(), check.name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                            [check]() -> ::testing::Test* { return new Test(check); });
  return true;
}

inline bool register_integrator_suite(const std::string& suite, const Maker& make, const IntegratorClaims& claims) {
  return register_suite(suite, integrator_checks(make, claims));
}

}  // namespace trammel
