// Every component that Trammel ships passes its own kit at level quick.
#include <algorithm>
#include <filesystem>

#include "support.hpp"

namespace kit_test {
namespace {

std::vector<std::string> libraries() {
  std::vector<std::string> names;
  for (const auto& item : std::filesystem::directory_iterator(installed))
    if (item.path().extension() == ".so") names.push_back(item.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class Shipped : public testing::TestWithParam<std::string> {};
TEST_P(Shipped, PassesItsKit) {
  const auto json = check(installed + GetParam() + ".so", {"--limit", "120"}, 0);
  EXPECT_EQ(faults(json), "");
}
INSTANTIATE_TEST_SUITE_P(All, Shipped, testing::ValuesIn(libraries()), [](const auto& tested) { return tested.param; });

class Template : public testing::TestWithParam<std::string> {};
TEST_P(Template, PassesItsKitAsItIs) {
  const auto json = check(bad_plugins + "template_" + GetParam() + ".so", {"--limit", "120"}, 0);
  EXPECT_EQ(faults(json), "");
}
INSTANTIATE_TEST_SUITE_P(All, Template,
                         testing::Values("integrator", "body", "joint", "force", "contact", "friction", "correction"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace kit_test
