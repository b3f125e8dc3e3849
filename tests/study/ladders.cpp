// The rungs that `trade` and `explain --ablate` try: of every kind of component that has fidelity parameters.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "commands/simulation.hpp"
#include "study/trade/fidelity_study.hpp"

#include "support/made.hpp"

namespace trammel::study {
namespace {

using testing::Contains;
using testing::IsSupersetOf;

SceneSource scene(const std::string& name, std::vector<scene::Override> overrides = {}) {
  return SceneSource(TRAMMEL_SOURCE_DIR "/scenes/" + name, std::move(overrides));
}

std::vector<std::string> coarser(const SceneSource& source) {
  std::vector<std::string> all;
  for (const Rung& rung : ladders(source, test::registry()))
    if (!rung.finer) all.push_back(rung.what);
  return all;
}

std::vector<std::string> finer(const SceneSource& source) {
  std::vector<std::string> all;
  for (const Rung& rung : ladders(source, test::registry()))
    if (rung.finer) all.push_back(rung.what);
  return all;
}

TEST(Ladders, OfABeamAreItsModesAndItsCoupling) {
  const SceneSource beam = scene("beam_impact.json", {{"parameters.N", "4"}});
  EXPECT_THAT(coarser(beam), IsSupersetOf({"bodies.beam.modes.axial = 3", "bodies.beam.modes.transverse = 2",
                                           "bodies.beam.coupling = linear", "bodies.beam.coupling = none"}));
  EXPECT_THAT(finer(beam), IsSupersetOf({"bodies.beam.modes.axial = 6", "bodies.beam.modes.transverse = 6"}));
}

TEST(Ladders, OfAPlateAreItsMeshAndItsQuadrature) {
  const SceneSource sheet = scene("plate/pendulum.json", {{"parameters.mesh", "6x4"}});
  EXPECT_THAT(coarser(sheet), IsSupersetOf({"bodies.sheet.mesh.elements = 3x2", "bodies.sheet.quadrature = 3"}));
  EXPECT_THAT(finer(sheet), IsSupersetOf({"bodies.sheet.mesh.elements = 9x6", "bodies.sheet.quadrature = 6"}));
}

// Elements that the scene names by their numbers would be others.
TEST(Ladders, LeaveAMeshWhoseElementsHaveNumbersInTheScene) {
  const auto of_mesh = [](const std::string& what) { return what.find("mesh") != what.npos; };
  EXPECT_TRUE(std::ranges::none_of(finer(scene("plate/ball.json")), of_mesh));
}

TEST(Ladders, OfACompliantContactAreItsStiffnessAndTheRigidLimit) {
  const SceneSource beam = scene("beam_impact/continuous_force.json", {{"parameters.K", "1e9"}});
  EXPECT_THAT(coarser(beam), IsSupersetOf({"contacts.tip.stiffness = 100000000", "contacts.tip.stiffness = 10000000",
                                           "contacts.tip by constraint_method"}));
  EXPECT_THAT(finer(beam), Contains("contacts.tip.stiffness = 10000000000"));
}

TEST(Ladders, OfASmoothFrictionLawAreItsCreepAndTheSetValuedLimit) {
  const SceneSource block = scene(
      "friction/stopping.json", {{"contacts.sole.friction", R"({"type": "regularized_coulomb", "coefficient": 0.3})"}});
  EXPECT_THAT(finer(block),
              IsSupersetOf({"contacts.sole.friction.critical_velocity = 0.0001", "contacts.sole.friction by coulomb"}));
  EXPECT_THAT(coarser(block),
              IsSupersetOf({"contacts.sole.friction.critical_velocity = 0.01", "without friction of contacts.sole"}));
}

TEST(Ladders, OfCorrectionsAreTheirLevels) {
  const SceneSource mast =
      scene("truss/S1o.json", {{"corrections", R"({"position": "minimum_norm", "energy": true})"}});
  EXPECT_THAT(coarser(mast), IsSupersetOf({"without corrections", "without corrections of position",
                                           "without corrections of energy"}));
}

// A rung that no run accepts would be reported as a failure of the model.
TEST(Ladders, HaveRungsThatAreValidScenes) {
  for (const SceneSource& source :
       {scene("beam_impact.json"), scene("beam_impact/continuous_force.json"), scene("plate/pendulum.json"),
        scene("plate/ball.json"), scene("plate/falling_sheet.json"), scene("tour/06_falling_bar.json")})
    for (const Rung& rung : ladders(source, test::registry()))
      EXPECT_NO_THROW(simulate::validate(source.with({rung.change}), test::registry()))
          << source.file() << ": " << rung.what << ", " << rung.change.value;
}

TEST(Ladders, OverlapWhereOnePathIsPartOfTheOther) {
  EXPECT_TRUE(overlap("contacts.tip", "contacts.tip.stiffness"));
  EXPECT_TRUE(overlap("contacts.tip.friction.critical_velocity", "contacts.tip.friction"));
  EXPECT_FALSE(overlap("contacts.tip", "contacts.tip2.stiffness"));
}

}  // namespace
}  // namespace trammel::study
