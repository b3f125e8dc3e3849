// What a run says that ends because contacts have no forces: the cause, whatever else the scene holds.
#include <gmock/gmock.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A ball between walls that close, beside a drawer, which nothing ties to them.
std::string squeezed(const std::string& law, double mu, double mu_of_drawer) {
  const auto friction = [](double of) {
    return of > 0 ? fmt::format(R"(, "friction": {{"type": "coulomb", "static": {0}, "kinetic": {0}}})", of) : "";
  };
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {{"ball": {{"type": "point_mass", "mass": 1, "position": [0, 0]}},
             "wall": {{"type": "moving_base", "x": "=0.5-t"}},
             "drawer": {{"type": "rigid_body", "mass": 1, "inertia": 1}}}},
  "joints": {{"guide": {{"type": "prismatic", "between": ["ground", "drawer.com"]{2}}}}},
  "contacts": {{"left": {{"type": "constraint_method", "impact_law": "{0}"{1},
                        "between": ["ball.point", {{"plane": {{"point": [-0.1, 0], "normal": [1, 0]}}}}]}},
               "right": {{"type": "constraint_method", "impact_law": "{0}"{1},
                         "between": ["ball.point",
                                     {{"plane": {{"point": [0, 0], "normal": [-1, 0], "on": "wall.origin"}}}}]}}}},
  "simulate": {{"until": 2}}, "record": {{"every": 0.1, "observe": {{"x": "ball.point.x"}}}}}})",
                     law, friction(mu), friction(mu_of_drawer));
}

TEST(ContactsWithoutForces, AreBlockedWithFrictionAsWithout) {
  for (const char* law : {"newton", "poisson", "energetic"})
    for (const double mu : {0.0, 0.01, 2.0})
      for (const double mu_of_drawer : {0.0, 0.3}) {
        const Finished run = run_text(squeezed(law, mu, mu_of_drawer));
        ASSERT_EQ(run.report.status, simulate::Status::failed);
        EXPECT_THAT(run.report.reason, HasSubstr("left, right")) << law << ", mu " << mu;
        EXPECT_THAT(run.report.reason, HasSubstr("close on bodies that cannot give way")) << law << ", mu " << mu;
        EXPECT_THAT(run.report.reason, Not(HasSubstr("Painleve"))) << law << ", mu " << mu;
      }
}

}  // namespace
}  // namespace trammel::test
