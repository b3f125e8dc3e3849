// After a failure: the change that is named gets the run past it, from the start as from the last good state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulate/watch/energy_watch.hpp"
#include "study/evidence/remedy.hpp"

#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::study {
namespace {

using testing::HasSubstr;

// Crank and rod of equal length: at a right angle of the crank the rows are redundant, and round-off of rates there is
// an error that no step keeps below a tolerance of 1e-12.
const char* const singular = R"json({
  "trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {
    "crank": {"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": ["=0.5*cos(1)", "=0.5*sin(1)"], "angle": 1,
              "angular_velocity": 4, "markers": {"a": [-0.5, 0], "b": [0.5, 0]}},
    "rod": {"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": ["=1.5*cos(1)", "=0.5*sin(1)"], "angle": -1,
            "markers": {"a": [-0.5, 0], "b": [0.5, 0]}}},
  "joints": {
    "A": {"type": "revolute", "between": ["ground", "crank.a"]},
    "B": {"type": "revolute", "between": ["crank.b", "rod.a"]},
    "slot": {"type": "point_on_line", "between": ["ground", "rod.b"]}},
  "initial": {"consistent": "project"},
  "integrator": {"type": "dop853", "step": {"tolerance": 1e-12}}, "simulate": {"until": 3},
  "record": {"every": 0.01, "observe": {"angle": "crank.angle"}}
})json";

// The spring turns the bar by more than a step of a hundredth of a second bears, and shorter ones are not allowed.
const char* const newton = R"({
  "trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {"bar": {"type": "rigid_body", "mass": 1, "inertia": "=1/12", "position": [0.5, 0],
                     "markers": {"hinge": [-0.5, 0], "tip": [0.5, 0]}}},
  "joints": {"hinge": {"type": "revolute", "between": ["ground", "bar.hinge"]}},
  "forces": {"spring": {"type": "spring_damper", "between": [{"point": [0, -1.02]}, "bar.tip"], "stiffness": 1e6,
                        "length": 0.5}},
  "integrator": {"type": "newmark", "step": {"tolerance": 0.1, "min": 0.01}, "max_iterations": 4},
  "simulate": {"until": 0.2}, "record": {"every": 0.01, "observe": {"angle": "bar.angle"}}
})";

// The rod shortens until it lies along the bar, and goes on to shorten.
const char* const contradiction = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"bar": {"type": "rigid_body", "mass": 1, "inertia": "=1/12", "position": [0, 0.5], "angle": "=pi/2",
                     "markers": {"hinge": [-0.5, 0], "tip": [0.5, 0]}}},
  "joints": {"hinge": {"type": "revolute", "between": ["ground", "bar.hinge"]},
             "rod": {"type": "distance", "between": [{"point": [2, 0]}, "bar.tip"], "length": "=sqrt(5)-t"}},
  "initial": {"consistent": "project"},
  "integrator": {"type": "dop853", "step": {"tolerance": 1e-8}}, "simulate": {"until": 3},
  "record": {"every": 0.05, "observe": {"angle": "bar.angle"}}
})";

struct Failing {
  const char* name;
  std::string text;
  std::vector<scene::Override> set;
  std::string reason;
};
void PrintTo(const Failing& failing, std::ostream* out) {
  *out << failing.name;
}

struct Failed {
  explicit Failed(const Failing& failing) : report(test::run_text(failing.text, failing.set).report) {
    std::filesystem::create_directories(folder.path());
    const std::string file = folder.path() / "scene.json";
    std::ofstream(file) << failing.text;
    source.emplace(file, failing.set);
  }
  RemedySearch search(const SearchLimits& limits) {
    return find_remedy(*source, registry, {report.t, report.last_good}, limits);
  }
  test::Folder folder;
  simulate::RunReport report;
  std::optional<SceneSource> source;
  plugin::Registry registry;
};

constexpr double ample = 60;  // [s]

class Remedied : public testing::TestWithParam<Failing> {};

TEST_P(Remedied, GetsPastItsFailureWithTheChangeThatIsNamed) {
  Failed failed(GetParam());
  ASSERT_EQ(failed.report.status, simulate::Status::failed);
  EXPECT_THAT(failed.report.reason, HasSubstr(GetParam().reason));
  const RemedySearch search = failed.search({ample});
  ASSERT_TRUE(search.remedy) << search.sentence();
  if (failed.report.last_good) {
    EXPECT_EQ(search.remedy->from, failed.report.last_good->t);
  }
  EXPECT_GT(search.remedy->passes, failed.report.t);
  EXPECT_THAT(search.sentence(), HasSubstr("it passes t = "));

  CaseOptions options;
  options.enough = search.remedy->passes;
  const CaseResult whole = run_case(failed.source->with(search.remedy->overrides), failed.registry, options);
  EXPECT_TRUE(whole.done()) << whole.reason;
  EXPECT_LT(whole.relative_drift, simulate::EnergyWatch::unexplained);
}

// Runge-Kutta bears omega h = 2.83: steps of 0.05 s are too long for 100 rad/s, and so are steps of 0.033 s, which
// halves of 0.08 s become.
INSTANTIATE_TEST_SUITE_P(
    Of, Remedied,
    testing::Values(Failing{"ASingularConfiguration", singular, {}, "the error cannot be kept below the tolerance"},
                    Failing{"NewtonsIteration", newton, {}, "Newton's iteration did not converge"},
                    Failing{"StiffnessWithAnExplicitMethod",
                            test::oscillator,
                            {{"forces.spring.stiffness", "1e4"}, {"integrator.step", "0.08"}, {"contacts", "{}"}},
                            "the solution diverged"},
                    Failing{"AStormOfEvents",
                            test::ball,
                            {{"contacts.floor.restitution", "0.999"},
                             {"simulate.event_limit", "5"},
                             {"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-9}})"},
                             {"bodies.ball.position", "[0, 1e-6]"}},
                            "event storm"}),
    [](const auto& failing) { return failing.param.name; });

const Failing without_remedy = {"AContradiction", contradiction, {}, "contradict each other"};

TEST(Remedy, IsNotClaimedWhereNothingHelps) {
  Failed failed(without_remedy);
  EXPECT_THAT(failed.report.reason, HasSubstr(without_remedy.reason));
  const RemedySearch search = failed.search({ample});
  EXPECT_FALSE(search.remedy);
  EXPECT_GT(search.tried, 5);  // the methods that take rows
  EXPECT_THAT(search.sentence(), HasSubstr(fmt::format("none of the {} changes tried", search.tried)));
  EXPECT_EQ(search.to_json()["found"], false);
}

TEST(Remedy, IsSoughtAsLongAsIsAllowed) {
  Failed failed(without_remedy);
  const RemedySearch search = failed.search({.cpu = 1e-6});
  EXPECT_EQ(search.end, RemedySearch::End::out_of_time);
  EXPECT_LT(search.tried, 2);
}

TEST(Remedy, IsSoughtUntilAnInterrupt) {
  Failed failed(without_remedy);
  simulate::Interrupt interrupt;
  interrupt.request();
  const RemedySearch search = failed.search({ample, &interrupt});
  EXPECT_EQ(search.end, RemedySearch::End::interrupted);
  EXPECT_THAT(search.sentence(), HasSubstr("interrupted"));
}

// A state that the scene cannot take: what helps is found from the start.
TEST(Remedy, IsSoughtFromTheStartIfThereIsNoGoodState) {
  Failed failed({"", singular, {}, ""});
  failed.report.last_good->q.resize(100);
  const RemedySearch search = failed.search({ample});
  ASSERT_TRUE(search.remedy) << search.sentence();
  EXPECT_EQ(search.remedy->from, 0);
}

}  // namespace
}  // namespace trammel::study
