// Rigid contacts are the limit of compliant ones: whole scenes of scenes/contact, in which many contacts act at once,
// with linear springs for contacts, of growing stiffness, each damped at its static depth, and the same set-valued
// friction.
#include <cmath>
#include <functional>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

json scene_of(const std::string& file) {
  return json::parse(read_text(TRAMMEL_SOURCE_DIR "/scenes/contact/" + file), nullptr, true, /*ignore_comments=*/true);
}

// F = K delta + c delta delta', where c at the depth that carries `mass` damps its bouncing by half of critical.
json softened(json scene, double K, double mass) {
  const double depth = 9.81 * mass / K;
  for (json& contact : scene["contacts"]) {
    contact.erase("restitution");
    contact.update(json{{"type", "continuous_force"},
                        {"stiffness", K},
                        {"exponent", 1},
                        {"damping", "coefficient"},
                        {"damping_coefficient", std::sqrt(K * mass) / depth},
                        {"damping_exponent", 1}});
  }
  // Errors well below the static depth, whatever the stiffness.
  scene["integrator"] = json{{"type", "dop853"}, {"step", {{"relative", 1e-9}, {"absolute", 1e-11}}}};
  return scene;
}

// `falls`: what of the error is left at ten times the stiffness. The compliant contacts start without depth, sink by m
// g/K and come to rest; where the motion depends on it smoothly the error is of the order 1/K, and a tenth is left, a
// fifth at most. Where it begins with a fall from the state itself, the blow at its end has the speed sqrt(g m g/K):
// the error is of the order K^-1/2, and a third is left.
void expect_limit(const json& scene, const std::string& column, double mass, double first_stiffness, double falls) {
  const Finished rigid = run_text(scene.dump());
  ASSERT_TRUE(rigid.done()) << rigid.report.reason;
  EXPECT_TRUE(rigid.result["warnings"].empty()) << rigid.result["warnings"].dump();
  double before = 0, K = first_stiffness;
  for (int i = 0; i < 3; ++i, K *= 10) {
    const Finished run = run_text(softened(scene, K, mass).dump());
    ASSERT_TRUE(run.done()) << run.report.reason;
    const double error = std::abs(run.end(column) - rigid.end(column));
    if (i > 0) {
      EXPECT_LT(error, falls * before) << K;
    }
    before = error;
  }
}

TEST(StiffContacts, TipAStackOnAMovingTableAsRigidOnesDo) {
  json s = scene_of("tower.json");
  s["parameters"] = {{"n", 3}, {"w", 0.2}, {"h", 0.1}, {"mu", 2}};
  s["bodies"]["table"]["x"] = "=t^3";  // 6 t, beyond g w/(3 h) = 6.54 from 1.09 s on
  s["simulate"]["until"] = 1.3;
  expect_limit(s, "lean", 1, 1e4, 0.2);
  expect_limit(s, "u", 1, 1e4, 0.2);
}

TEST(StiffContacts, LetAHouseOfCardsSlideDownAsRigidOnesDo) {
  json s = scene_of("card_house.json");
  s["parameters"]["mu"] = 0.2;
  s["simulate"]["until"] = 0.12;
  expect_limit(s, "head", 0.002, 1e3, 0.2);
  // The left card bears on a face that is turned to it: its contact slides there, and three contacts in one point share
  // their forces in other ways at every instant.
  s["contacts"]["apex"]["between"][1]["plane"]["normal"] = {"=-cos(a)", "=-sin(a)"};
  expect_limit(s, "head", 0.002, 1e3, 0.2);
}

TEST(StiffContacts, LetAThinArchFallAsRigidOnesDo) {
  json s = scene_of("arch.json");
  s["parameters"].update(json{{"n", 5}, {"thickness", 0.085}});
  expect_limit(s, "crown", 170, 1e7, 0.4);
}

}  // namespace
}  // namespace trammel::test
