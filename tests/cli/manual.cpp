// `trammel describe`: pages on the language of scenes, and what bodies say that they offer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace {

using cli::trammel;
using testing::HasSubstr;

TEST(Manual, ExplainsTheLanguageOfScenes) {
  for (const char* topic : {"scene", "expressions", "for", "table", "markers", "observables", "events", "study"}) {
    const auto result = trammel({"describe", topic});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, testing::StartsWith(topic));
    std::size_t longest = 0, begin = 0;
    for (std::size_t end; (end = result.out.find('\n', begin)) != std::string::npos; begin = end + 1)
      longest = std::max(longest, end - begin);
    EXPECT_LE(longest, 130u) << topic;
  }
}

TEST(Manual, NamesEveryFunctionMarkerAndKindOfEvent) {
  EXPECT_THAT(trammel({"describe", "expressions"}).out, HasSubstr("atan2(x, y)"));
  EXPECT_THAT(trammel({"describe", "markers"}).out, HasSubstr("root, tip"));
  EXPECT_THAT(trammel({"describe", "observables"}).out, HasSubstr("angular_momentum_z"));
  EXPECT_THAT(trammel({"describe", "events"}).out, HasSubstr("contact_close"));
  EXPECT_THAT(trammel({"describe", "point_mass"}).out, HasSubstr("point, com"));
}

TEST(Manual, AllOfItIsListed) {
  const auto result = trammel({"list", "--all"});
  for (const char* name : {"hht_alpha", "simulate", "step", "expressions", "markers"})
    EXPECT_THAT(result.out, HasSubstr(name));
}

TEST(Manual, NamesWhatThereIsWhereAPageIsMissing) {
  const auto result = trammel({"describe", "expresions"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("expressions"));
}

}  // namespace
