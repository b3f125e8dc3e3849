// Which joints have come apart: farther than a tenth of their size, or 0.1 rad.
#include "simulate/watch/open_joints.hpp"

#include "simulate/start/setup.hpp"
#include "support/made.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// A bar of 5 m on a hinge; a slider, and two points tied to each other, which have no length but the scene's, 2 m; a
// rod of 0.1 m.
const char* const scene_of_joints = R"({"trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"bar": {"type": "rigid_body", "mass": 1, "inertia": 1, "position": [0, 0],
                     "markers": {"from": [0, 0], "to": [-4, 3]}},
             "slider": {"type": "rigid_body", "mass": 1, "inertia": 1, "position": [0, 0]},
             "a": {"type": "point_mass", "mass": 1, "position": [1, 0]},
             "b": {"type": "point_mass", "mass": 1, "position": [1, 0]},
             "c": {"type": "point_mass", "mass": 1, "position": [1, 0.1]}},
  "joints": {"hinge": {"type": "revolute", "between": ["ground", "bar.from"]},
             "guide": {"type": "prismatic", "between": ["ground", "slider.com"], "axis": [1, 0]},
             "tie": {"type": "revolute", "between": ["a.point", "b.point"]},
             "rod": {"type": "distance", "between": ["a.point", "c.point"], "length": 0.1}},
  "simulate": {"until": 1}, "record": {"every": 1}})";

using Slider = Eigen::Vector3d;  // along the guide, across it [m]; turned [rad]
using Apart = Eigen::Vector2d;   // the second point from the first one [m]
struct More {
  double bar = 0, rod = 0;  // off its hinge; too long [m]
};

class Joints {
 public:
  explicit Joints(const Apart& at_start = {0, 0})
      : setup_(simulate::set_up(scene::Scene::parse(scene_of_joints, "test.json"), registry())) {
    move({0, 0, 0}, at_start);
    open_.measure(system_, 2, 1e-12);
  }
  std::string description(const Slider& slider, const Apart& apart, const More& more = {}) {
    return open_.description(system_, move(slider, apart, more));
  }

 private:
  State move(const Slider& slider, const Apart& apart, const More& more = {}) {
    State state = setup_.initial;
    const auto at = [this](const char* body) {
      return setup_.model->bodies[std::size_t(setup_.model->body_named.at(body))].q0;
    };
    state.q.segment<3>(at("slider")) += slider;
    state.q.segment<2>(at("b")) += apart;
    state.q[at("bar")] += more.bar;
    state.q[at("c") + 1] += more.rod;
    system_.move_to(state.t, state.q, state.v);
    return state;
  }
  simulate::Setup setup_;
  model::AssembledSystem system_{setup_.model};
  simulate::OpenJoints open_;
};

const Slider at_rest(0, 0, 0);
const Apart together(0, 0);

TEST(JointsThatOpen, AreReportedInRadiansWhateverTheScenesLengthIs) {
  Joints joints;
  EXPECT_EQ(joints.description({0, 0, 0.09}, together), "");
  EXPECT_EQ(joints.description({0, 0, 0.11}, together), "joints.guide by 0.11 rad");
}

TEST(JointsThatOpen, OfPointsAreJudgedByTheScenesLength) {
  Joints joints;
  EXPECT_EQ(joints.description(at_rest, {0.19, 0}), "");
  EXPECT_EQ(joints.description(at_rest, {0.21, 0}), "joints.tie by 0.21 m");
}

// A start that is off by what its numbers were written with.
TEST(JointsThatOpen, DoNotTakeForTheirSizeWhatTheyWereOffByAtTheStart) {
  Joints joints({1e-9, 0});
  EXPECT_EQ(joints.description(at_rest, {0.19, 0}), "");
}

// Slid by 10 m the guide is longer than the scene.
TEST(JointsThatOpen, AreJudgedByTheLengthThatTheyHaveNow) {
  Joints joints;
  EXPECT_EQ(joints.description({10, 0.85, 0}, together), "");
  EXPECT_EQ(joints.description({10, 1.05, 0}, together), "joints.guide by 1.05 m");
}

TEST(JointsThatOpen, AreJudgedByTheirWorstRow) {
  Joints joints;
  EXPECT_EQ(joints.description({0, 0.3, 0.2}, together), "joints.guide by 0.2 rad");
  EXPECT_EQ(joints.description({0, 0.5, 0.2}, together), "joints.guide by 0.5 m");
  EXPECT_EQ(joints.description(at_rest, {0.5, 0.3}), "joints.tie by 0.5 m");
  EXPECT_EQ(joints.description(at_rest, {0.3, 0.5}), "joints.tie by 0.5 m");
}

TEST(JointsThatOpen, AreReportedTheWorstFirst) {
  Joints joints;
  EXPECT_EQ(joints.description({0, 0, 0.2}, {0.3, 0}), "joints.guide by 0.2 rad, joints.tie by 0.3 m");
  EXPECT_EQ(joints.description({0, 0, 0.2}, {0.5, 0}), "joints.tie by 0.5 m, joints.guide by 0.2 rad");
}

TEST(JointsThatOpen, AreJudgedByTheSizeOfTheirBodies) {
  Joints joints;
  EXPECT_EQ(joints.description(at_rest, together, {.bar = 0.49}), "");
  EXPECT_EQ(joints.description(at_rest, together, {.bar = 0.51}), "joints.hinge by 0.51 m");
}

TEST(JointsThatOpen, AreJudgedByTheirOwnLengthWhereThatIsSmall) {
  Joints joints;
  EXPECT_EQ(joints.description(at_rest, together, {.rod = 0.009}), "");
  EXPECT_EQ(joints.description(at_rest, together, {.rod = 0.011}), "joints.rod by 0.011 m");
}

TEST(JointsThatOpen, BeyondThreeAreCounted) {
  Joints joints;
  EXPECT_EQ(joints.description({0, 0, 0.2}, {0.5, 0}, {.rod = 0.03}),
            "joints.rod by 0.03 m, joints.tie by 0.5 m, joints.guide by 0.2 rad");
  EXPECT_EQ(joints.description({0, 0, 0.2}, {0.5, 0}, {.bar = 0.6, .rod = 0.03}),
            "joints.rod by 0.03 m, joints.tie by 0.5 m, joints.guide by 0.2 rad and 1 more");
}

}  // namespace
}  // namespace trammel::test
