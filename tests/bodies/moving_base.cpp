// The base that moves by given laws. That its markers move by them: tests/plugins/shipped_components.cpp.
#include <gtest/gtest.h>

#include <trammel/body.hpp>
#include <trammel/marker.hpp>

#include "support/made.hpp"

namespace trammel::test {
namespace {

Motion at(const Body& body, int marker, double t) {
  Motion m;
  body.motion(marker, t, Vec(), Vec(), m);
  return m;
}

TEST(MovingBase, HasNoCoordinates) {
  const auto body = made<Body>(Kind::body, R"json({"type": "moving_base", "x": "=0.3*sin(2*t)"})json");
  EXPECT_EQ(body->coordinates().nq(), 0);
  EXPECT_EQ(body->coordinates().nv(), 0);
}

TEST(MovingBase, RestsAtTheOriginWithoutLaws) {
  const auto body = made<Body>(Kind::body, R"({"type": "moving_base"})");
  const Motion m = at(*body, 0, 3);
  EXPECT_TRUE(m.x.isZero(0));
  EXPECT_TRUE(m.V.isZero(0));
  EXPECT_TRUE(m.bias.isZero(0));
}

TEST(MovingBaseInput, IsRefusedWithAReason) {
  const auto refused = [](const char* entry, const char* reason, const World& world = planar()) {
    const std::string text = refusal(Kind::body, entry, world);
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  refused(R"({"type": "moving_base", "z": 1})", "this scene is planar");
  refused(R"({"type": "moving_base", "axis": [0, 1]})", "this scene is planar");
  refused(R"({"type": "moving_base", "angle": "=t"})", "axis: missing", spatial());
  refused(R"({"type": "moving_base", "angle": "=t", "axis": [0, 0, 0]})", "found the length 0", spatial());
  refused(R"({"type": "moving_base", "markers": {"origin": [1, 0]}})", "built in");
  refused(R"({"type": "moving_base", "x": "=sin(t"})", "expected ')'");
}

}  // namespace
}  // namespace trammel::test
