// `trammel check` on a library, its verdicts by the names of the checks.
#pragma once

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace kit_test {

inline const std::string bad_plugins = TRAMMEL_BUILD_DIR "/tests/plugins/";
inline const std::string installed = TRAMMEL_BUILD_DIR "/lib/trammel/";

// The checks that were not passed, nor skipped, with what they found.
inline std::string faults(const nlohmann::json& json) {
  if (!json.is_object()) return "no JSON";
  std::string text;
  for (const auto& component : json.value("components", nlohmann::json::array()))
    for (const auto& one : component["checks"])
      if (one["verdict"] != "passed" && one["verdict"] != "skipped" && !one.contains("expected to fail"))
        text += component["name"].get<std::string>() + ": " + one["name"].get<std::string>() + " " +
                one["verdict"].get<std::string>() + "\n" + one["found"].get<std::string>() + "\n";
  return text;
}

inline nlohmann::json check(const std::string& library, std::vector<std::string> more = {}, int exit_code = -1) {
  std::vector<std::string> words = {"check", library, "--json"};
  words.insert(words.end(), more.begin(), more.end());
  // Verdicts depend on no seed: TRAMMEL_SEED=7 build/tests/kit_tests
  if (const char* seed = std::getenv("TRAMMEL_SEED")) words.insert(words.end(), {"--seed", seed});
  const cli::Result result = cli::trammel(words, {.time_limit = 280});
  if (exit_code >= 0) {
    EXPECT_EQ(result.exit_code, exit_code) << faults(nlohmann::json::parse(result.out, nullptr, false)) << result.err;
  }
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  EXPECT_TRUE(json.is_object()) << result.out << result.err;
  return json;
}

}  // namespace kit_test
