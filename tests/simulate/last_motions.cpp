// What is said of the last trial when steps become too small, on states made by hand.
#include "simulate/watch/last_motions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulate/start/setup.hpp"
#include "support/made.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

// Points a, b, c, d of 1 kg each, 1 m apart, and what else the scene contains.
struct Points {
  simulate::Setup setup;
  model::AssembledSystem system;
  State now, next;
  Vec error_parts;

  explicit Points(const std::string& more = "")
      : setup(simulate::set_up(scene::Scene::parse(R"({"trammel": 1, "space": "planar", "gravity": [0, 0], "bodies": {
            "a": {"type": "point_mass", "mass": 1, "position": [1, 2]},
            "b": {"type": "point_mass", "mass": 1, "position": [2, 2]},
            "c": {"type": "point_mass", "mass": 1, "position": [3, 2]},
            "d": {"type": "point_mass", "mass": 1, "position": [4, 2]}},
            "simulate": {"until": 1}, "record": {"every": 1})" +
                                                       more + "}",
                                                   "test.json"),
                               registry())),
        system(setup.model),
        now(setup.initial),
        next(setup.initial) {}
  std::string said(bool iterated = false, double until = 1) {
    return simulate::LastMotions().say(system, {now, next, 0.5, error_parts, iterated}, until);
  }
};

TEST(LastMotions, NameTheThreeBodiesThatMakeMostOfAnError) {
  Points points;
  points.error_parts = Vec{{1, 1, 2, 2, 1, 2, 1.5, 1.5}};
  EXPECT_THAT(points.said(), HasSubstr("is that of bodies.b (33 %), bodies.c (25 %), bodies.d (25 %)"));
  EXPECT_THAT(points.said(), Not(HasSubstr("bodies.a")));
}

TEST(LastMotions, NameNoBodyThatMakesLessThanAHundredthOfAnError) {
  Points points;
  points.error_parts = Vec{{0, 0, 1, 0, 0, 0.0099, 0, 0}};
  EXPECT_THAT(points.said(), HasSubstr("is that of bodies.b (99 %)"));
  EXPECT_THAT(points.said(), Not(HasSubstr("bodies.c")));
}

// The accelerations of the last iterate are those of no force, except c's.
TEST(LastMotions, NameTheBodyWhoseForcesTheLastIterateDoesNotBalance) {
  Points points;
  points.now.a.setZero(8), points.next.a.setZero(8);
  points.next.a[4] = 2;
  EXPECT_THAT(points.said(true), HasSubstr("the residual of the last iterate is that of bodies.c (100 %), by energy"));
}

TEST(LastMotions, NameTheBodyWhoseVelocityChangesMost) {
  Points points;
  points.now.a.setZero(8), points.next.a.setZero(8);
  points.next.a[6] = -3;
  EXPECT_THAT(points.said(), HasSubstr("the velocities change most in bodies.d (100 %), by energy"));
}

constexpr const char* rods = R"(, "joints": {
  "ab": {"type": "distance", "between": ["a.point", "b.point"], "length": 1},
  "cd": {"type": "distance", "between": ["c.point", "d.point"], "length": 1}})";

TEST(LastMotions, NameRowsBeyondTheRoundOffOfPlaces) {
  Points points(rods);
  points.next.a.resize(0);
  EXPECT_THAT(points.said(), Not(HasSubstr("rows"))) << "all are 0";
  points.next.q[6] += 1e-3;
  EXPECT_THAT(points.said(), HasSubstr("the rows farthest from 0 are those of joints.cd (0.001)"));
  points.next.q[6] -= 1e-3 - 4e-12;  // within 1e-12 of 5 m
  EXPECT_THAT(points.said(), Not(HasSubstr("rows")));
}

constexpr const char* floor_below = R"(, "contacts": {"floor": {"type": "constraint_method", "restitution": 0,
  "between": ["a.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}})";

TEST(LastMotions, NameTheContactThatMayCloseInTheRunsTime) {
  Points points(floor_below);
  EXPECT_THAT(points.said(), Not(HasSubstr("may close")));
  points.now.v[1] = -8;  // 2 m above the floor
  EXPECT_THAT(points.said(), HasSubstr("contacts.floor may close next, at t = 0.25 s by its gap of 2 m"));
  EXPECT_THAT(points.said(false, 0.24), Not(HasSubstr("may close")));
}

TEST(LastMotions, NameNoContactThatIsClosed) {
  Points points(floor_below);
  points.now.v[1] = -8;
  model::Modes modes = points.system.modes();
  modes.contacts[0].closed = true;
  points.system.set_modes(modes);
  EXPECT_THAT(points.said(), Not(HasSubstr("may close")));
}

}  // namespace
}  // namespace trammel::test
