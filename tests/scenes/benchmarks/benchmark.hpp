// Runs a scene of scenes/benchmarks and holds it against the reference data's own acceptance values.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_scene.hpp"

namespace trammel::test {

inline nlohmann::json reference(const std::string& name) {
  return nlohmann::json::parse(read_text(TRAMMEL_SOURCE_DIR "/tests/data/benchmarks/" + name + ".json"));
}

// `value` is what the data accept for `quantity`, to their tolerance.
inline void expect_accepted(const nlohmann::json& data, const std::string& quantity, double value) {
  for (const nlohmann::json& one : data.at("acceptance")) {
    if (one.at("quantity") != quantity) continue;
    EXPECT_NEAR(value, one.at("value").get<double>(), one.at("abs_tol").get<double>()) << quantity;
    return;
  }
  ADD_FAILURE() << "the data have no quantity \"" << quantity << "\"";
}

// The column at the recorded time nearest to t.
inline double at(const Finished& run, double t, const std::string& column) {
  const std::vector<double>& times = run.series.at("t");
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - t) < std::abs(times[nearest] - t)) nearest = i;
  EXPECT_NEAR(times[nearest], t, 1e-9) << column << " is not recorded there";
  return run.series.at(column)[nearest];
}

// Where a column, sampled evenly, passes 0, by the cubic through the four samples around it.
inline std::vector<double> zeros(const Finished& run, const std::string& column) {
  const std::vector<double>&t = run.series.at("t"), &y = run.series.at(column);
  std::vector<double> found;
  for (std::size_t i = 1; i + 2 < t.size(); ++i) {
    if (y[i] == 0 || (y[i] < 0) == (y[i + 1] < 0)) continue;
    const auto cubic = [&](double s) {  // s in [0, 1] from sample i to the next
      return -s * (s - 1) * (s - 2) / 6 * y[i - 1] + (s + 1) * (s - 1) * (s - 2) / 2 * y[i] -
             (s + 1) * s * (s - 2) / 2 * y[i + 1] + (s + 1) * s * (s - 1) / 6 * y[i + 2];
    };
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      ((cubic(middle) < 0) == (y[i] < 0) ? low : high) = middle;
    }
    found.push_back(t[i] + low * (t[i + 1] - t[i]));
  }
  return found;
}

inline double spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

// A benchmark's run, done.
inline Finished run_benchmark(const std::string& name, const Overrides& overrides = {}) {
  Finished run = run_file("benchmarks/" + name + ".json", overrides);
  EXPECT_TRUE(run.done()) << run.report.reason;
  return run;
}

}  // namespace trammel::test
