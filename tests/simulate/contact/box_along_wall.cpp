// A box slides along a wall that it touches without a force: the wall must not matter, in whatever order its contacts
// are written.
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

struct BoxAlongWall {
  double width, on_floor, on_wall, speed;  // [m] across the wall; coefficients of friction; [m/s]
};

constexpr double length = 0.2, height = 1;

std::string contact(const std::string& name, const std::string& normal, double mu) {
  return fmt::format(
      R"("{}": {{"type": "constraint_method", "restitution": 0,
                 "between": ["b.v{}", {{"plane": {{"point": [0, 0, 0], "normal": {}}}}}],
                 "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}})",
      name, name.back(), normal, mu, mu);
}

std::string scene(const BoxAlongWall& b, const std::vector<std::string>& contacts) {
  std::string markers, all;
  for (int i = 0; i < 8; ++i)
    markers += fmt::format(R"({}"v{}": [{}, {}, {}])", i ? ", " : "", i, (i & 1 ? 0.5 : -0.5) * b.width,
                           (i & 2 ? 0.5 : -0.5) * length, (i & 4 ? 0.5 : -0.5) * height);
  for (const std::string& name : contacts) {
    const bool floor = name.front() == 'f';
    all += (all.empty() ? "" : ", ") + contact(name, floor ? "[0, 0, 1]" : "[1, 0, 0]", floor ? b.on_floor : b.on_wall);
  }
  return fmt::format(
      R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
           "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": [{:.17g}, {:.17g}, {:.17g}],
                              "position": [{}, {}, {}], "velocity": [0, {}, 0], "markers": {{{}}}}}}},
           "contacts": {{{}}}, "simulate": {{"until": 1}},
           "record": {{"every": 0.02, "observe": {{"x": "b.com.x", "y": "b.com.y", "z": "b.com.z",
                       "wx": "b.com.omega_x", "wz": "b.com.omega_z"}}}}}})",
      (length * length + height * height) / 12, (b.width * b.width + height * height) / 12,
      (b.width * b.width + length * length) / 12, b.width / 2, length / 2, height / 2, b.speed, markers, all);
}

// Also where the box tips over its front edge, its friction on the floor lies in its plane of symmetry. A slip below
// 1e-7 of the speed counts as rest, which moves the box by as much in the second that follows.
void expect_no_effect_of_wall(const BoxAlongWall& b) {
  const Finished alone = run_text(scene(b, {"f0", "f1", "f2", "f3"}));
  ASSERT_TRUE(alone.done()) << alone.report.reason;
  std::vector<std::string> contacts = {"f3", "x4", "f0", "f1", "x2", "f2", "x0", "x6"};
  std::mt19937 random(3);
  for (int order = 0; order < 12; ++order) {
    const Finished run = run_text(scene(b, contacts));
    ASSERT_TRUE(run.done()) << order << ": " << run.report.reason;
    EXPECT_LT(run.result["counts"]["steps"], 1000) << order;
    EXPECT_TRUE(run.result["warnings"].empty()) << order << ": " << run.result["warnings"];
    for (const char* column : {"x", "y", "z", "wx", "wz"})
      EXPECT_NEAR(run.end(column), alone.end(column), 1e-7 * b.speed) << order << " " << column;
    for (std::size_t k = contacts.size(); k > 1; --k) std::swap(contacts[k - 1], contacts[random() % k]);
  }
}

TEST(BoxThatTouchesAWall, TipsOverOnTheFloorAsWithoutTheWall) {
  expect_no_effect_of_wall({0.2, 0.3, 0.6, 1});
}

// Its feet on the wall are idle, and their forces as springs are round-off.
TEST(BoxThatTouchesAWall, TipsOverAnEdgeThatSticksInFewSteps) {
  expect_no_effect_of_wall({0.5, 0.3, 0.3, 2});
}

}  // namespace
}  // namespace trammel::test
