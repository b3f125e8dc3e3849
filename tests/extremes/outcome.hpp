// What every extreme must end in: a result with an energy that is accounted for, or an error with time, step and cause.
#pragma once

#include <cmath>

#include <gmock/gmock.h>

#include "support/run_scene.hpp"

namespace trammel::test {

inline void expect_finite(const Finished& run) {
  for (const auto& [name, values] : run.series)
    for (const double x : values) ASSERT_TRUE(std::isfinite(x)) << name;
}

// A failure states time, step and reason; the results kept are finite.
inline void expect_clear_failure(const Finished& run) {
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, testing::ContainsRegex("at t = [-+.e0-9]+ s, step [0-9]+"));
  EXPECT_GT(run.report.reason.size(), 45u) << run.report.reason;  // and a cause
  expect_finite(run);
}

// Done, finite, and the energy no cause explains is below `share` of 3.01 J, or a warning says so.
inline void expect_result_or_clear_failure(const Finished& run, double share = 0.05) {
  if (!run.done()) return expect_clear_failure(run);
  expect_finite(run);
  const double drift = std::abs(run.result["energy_drift"].get<double>());
  EXPECT_TRUE(drift < share * 3.0131 || !run.result["warnings"].empty()) << drift;
}

}  // namespace trammel::test
