// States brought onto their rows.
#include "system/on_rows/onto_rows.hpp"

#include <gtest/gtest.h>

#include "simulate/start/setup.hpp"
#include "support/made.hpp"

namespace trammel::test {
namespace {

simulate::Setup bob_with(const char* joints) {
  return simulate::set_up(scene::Scene::parse(std::string(R"({"trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {"bob": {"type": "point_mass", "mass": 2, "position": [3, 4], "velocity": [4, -3]}},
    "simulate": {"until": 1}, "record": {"every": 1})") +
                                                  joints + "}",
                                              "test.json"),
                          registry());
}

TEST(OntoRows, LeavesAStateThatHasNone) {
  const simulate::Setup setup = bob_with("");
  model::AssembledSystem system(setup.model);
  State state = setup.initial;
  EXPECT_TRUE(model::positions_onto_rows(system, state, {.allowed = 1e-9}));
  EXPECT_TRUE(model::velocities_onto_rows(system, state));
  EXPECT_EQ(state.q, setup.initial.q);
  EXPECT_EQ(state.v, setup.initial.v);
}

// Along the rod, the shortest way, to its round-off and not only to what is allowed.
TEST(OntoRows, EndsAtTheNearestStateToRoundOff) {
  const simulate::Setup setup =
      bob_with(R"(, "joints": {"rod": {"type": "distance", "between": ["ground", "bob.point"], "length": 5}})");
  model::AssembledSystem system(setup.model);
  State state = setup.initial;
  state.q *= 1.1, state.v = Vec{{4 + 0.3, -3 + 0.4}};
  EXPECT_TRUE(model::positions_onto_rows(system, state, {.allowed = 1e-2}));
  EXPECT_NEAR(state.q[0], 3, 5e-15);
  EXPECT_NEAR(state.q[1], 4, 5e-15);
  EXPECT_TRUE(model::velocities_onto_rows(system, state));
  EXPECT_NEAR(state.v[0], 4, 5e-15);
  EXPECT_NEAR(state.v[1], -3, 5e-15);
}

// A quarter of a turn from where the system was factorised last; the system is left at the state.
TEST(OntoRows, ProjectsVelocitiesByTheFactorsOfTheirOwnPlace) {
  const simulate::Setup setup =
      bob_with(R"(, "joints": {"rod": {"type": "distance", "between": ["ground", "bob.point"], "length": 5}})");
  model::AssembledSystem system(setup.model);
  State state = setup.initial;
  state.v = Vec{{4 + 0.3, -3 + 0.4}};
  EXPECT_TRUE(model::velocities_onto_rows(system, state));
  state.q = Vec{{-4, 3}}, state.v = Vec{{3 - 0.4, 4 + 0.3}};
  EXPECT_TRUE(model::velocities_onto_rows(system, state));
  EXPECT_NEAR(state.v[0], 3, 5e-15);
  EXPECT_NEAR(state.v[1], 4, 5e-15);
  EXPECT_NEAR(system.g_dot()[0], 0, 5e-15);
}

}  // namespace
}  // namespace trammel::test
