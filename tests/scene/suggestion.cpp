#include "scene/suggestion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::HasSubstr;
using testing::Not;
using trammel::scene::did_you_mean;

std::vector<std::string> numbered(int n) {
  std::vector<std::string> names;
  for (int i = 1; i <= n; ++i) names.push_back("beam.mode_" + std::to_string(i));
  return names;
}

TEST(DidYouMean, ShowsAListThatCanBeReadAtAGlanceWhole) {
  const std::string text = did_you_mean("beam.mod_3", numbered(24));
  EXPECT_THAT(text, HasSubstr("beam.mode_24"));
  EXPECT_THAT(text, HasSubstr("Did you mean \"beam.mode_3\"?"));
}

TEST(DidYouMean, ShowsTheNearestOfALongListAndHowManyMoreThereAre) {
  std::vector<std::string> names = numbered(25);
  names.emplace_back("energy.total");
  const std::string text = did_you_mean("energy.totl", names);
  EXPECT_THAT(text, HasSubstr("; known: energy.total, "));
  EXPECT_THAT(text, HasSubstr(" and 14 more. Did you mean \"energy.total\"?"));
}

TEST(DidYouMean, KnowsANameByItsLastPart) {
  const std::vector<std::string> names = {"ground", "rod.com", "rod.pin", "contacts.floor.force"};
  EXPECT_THAT(did_you_mean("pin", names), HasSubstr("Did you mean \"rod.pin\"?"));
  EXPECT_THAT(did_you_mean("floor.force", names), HasSubstr("Did you mean \"contacts.floor.force\"?"));
  EXPECT_THAT(did_you_mean("in", names), Not(HasSubstr("Did you mean")));
  EXPECT_THAT(did_you_mean("", names), Not(HasSubstr("Did you mean")));
}

}  // namespace
