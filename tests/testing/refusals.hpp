// Which checks refuse a component.
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>

#include <trammel/testing/components.hpp>
#include <trammel/testing/markers.hpp>

namespace trammel::test {

using Names = std::set<std::string>;

inline Names refusals(const std::vector<Check>& checks) {
  Names names;
  for (const Check& check : checks)
    if (const Report report = check(); !report) {
      names.insert(check.name);
      EXPECT_NE(report.table.find("FAILS: "), std::string::npos) << report.table;
    }
  return names;
}

}  // namespace trammel::test
