// What a user reads whose integrator does not take the scene: what, because of what, and what would do.
#include <gmock/gmock.h>

#include "support/run_scene.hpp"

#include "small_scenes.hpp"

namespace trammel::test {
namespace {

using compatibility::Need;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string refusal_of(json all) {
  try {
    simulate::validate(scene::Scene::parse(all.dump(), "test.json"), registry());
  } catch (const scene::SceneError& e) {
    return e.what();
  }
  return "accepted";
}

std::string without(const char* ability, Need need) {
  json all = with_need(need);
  all["plugins"] = {TRAMMEL_BUILD_DIR "/tests/plugins/limited.so"};
  all["integrator"] = {{"type", "limited"}, {"step", 1e-3}, {"without", ability}};
  return refusal_of(all);
}

struct Limit {
  const char* ability;
  Need need;
  const char *noun, *cause;
  friend void PrintTo(const Limit& limit, std::ostream* out) { *out << limit.ability; }
};
class IntegratorThatIsLimited : public testing::TestWithParam<Limit> {};

TEST_P(IntegratorThatIsLimited, IsRefusedWithTheCauseAndThoseThatTakeIt) {
  const auto& [ability, need, noun, cause] = GetParam();
  EXPECT_EQ(without("nothing", need), "accepted");
  EXPECT_THAT(without(ability, need),
              AllOf(HasSubstr("test.json:1:"), HasSubstr("integrator: \"limited\" with \"without\""),
                    HasSubstr(std::string("takes no ") + noun), HasSubstr(cause), HasSubstr("dop853"),
                    HasSubstr("integrators that do: ")));
}

INSTANTIATE_TEST_SUITE_P(
    All, IntegratorThatIsLimited,
    testing::Values(Limit{"rows", Need::rows, "rows", "joints.j has rows"},
                    Limit{"redundant_rows", Need::redundant_rows, "redundant rows", "joints.repeats: rows 1, 2 of 2"},
                    Limit{"friction", Need::friction, "friction that sticks", "the friction of joints.j sticks"},
                    Limit{"jumps", Need::jumps, "forces that jump", "contacts.c is decided at every evaluation"},
                    Limit{"rotations", Need::rotations, "rotations in space", "bodies.b turns in space"},
                    Limit{"events", Need::events, "events", "contacts.c opens and closes"}),
    [](const testing::TestParamInfo<Limit>& tested) { return std::string(tested.param.ability); });

TEST(Index3, IsRefusedWhereFrictionSticksAndNamesTheChoice) {
  json all = with_need(Need::friction);
  all["integrator"] = {{"type", "hht_alpha"}, {"formulation", "index3"}, {"step", 1e-3}};
  EXPECT_THAT(refusal_of(all), AllOf(HasSubstr("\"hht_alpha\" with \"formulation\": \"index3\" takes no friction"),
                                     HasSubstr("hht_alpha, newmark")));
}

TEST(MomentumCorrection, NamesTheBodyThatDoesNotTellItsOwn) {
  json all = with_body("assumed_mode_beam");
  all["integrator"] = {{"type", "hht_alpha"}, {"step", 1e-3}};
  all["corrections"]["energy"] = {{"type", "energy"}, {"keeps", "momentum"}};
  EXPECT_THAT(refusal_of(all), AllOf(HasSubstr("corrections.energy"), HasSubstr("bodies.b does not give its own"),
                                     HasSubstr("rigid_body"), Not(HasSubstr("assumed_mode_beam"))));
}

}  // namespace
}  // namespace trammel::test
