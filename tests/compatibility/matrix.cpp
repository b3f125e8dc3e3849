// Every combination that the matrix allows runs and keeps the physics; every one that it forbids is refused.
#include <gmock/gmock.h>

#include <algorithm>

#include "statics/static_run.hpp"
#include "support/modes_of.hpp"
#include "support/run_scene.hpp"

#include "small_scenes.hpp"

namespace trammel::test {
namespace {

using compatibility::Form;
using compatibility::IntegratorForm;
using compatibility::LawPair;
using compatibility::Need;

const compatibility::Matrix& matrix() {
  static const compatibility::Matrix all = compatibility::matrix(registry());
  return all;
}

// Those of tests among them are no methods for a scene.
std::vector<IntegratorForm> methods() {
  std::vector<IntegratorForm> all;
  for (const IntegratorForm& one : matrix().integrators)
    if (one.form.type != "limited" && one.form.type != "free_euler") all.push_back(one);
  return all;
}

bool takes(const IntegratorForm& method, Need need) {
  return std::find(method.takes.begin(), method.takes.end(), need) != method.takes.end();
}
bool takes_all(const IntegratorForm& method, const std::vector<Need>& needs) {
  return std::all_of(needs.begin(), needs.end(), [&](Need need) { return takes(method, need); });
}

json with_integrator(json all, const Form& form, json step = 1e-3) {
  all["integrator"] = entry(form, {{"step", std::move(step)}});
  return all;
}

// What validate says; empty: it accepts the scene.
std::string refusal_of(const json& all, simulate::RunReport (*run)(const scene::Scene&, plugin::Registry&,
                                                                   const simulate::RunOptions&) = nullptr) {
  try {
    const scene::Scene scene = scene::Scene::parse(all.dump(), "test.json");
    if (!run) {
      simulate::validate(scene, registry());
      return "";
    }
    const Folder folder;
    simulate::RunOptions options;
    options.out = folder.path();
    run(scene, registry(), options);
  } catch (const scene::SceneError& e) {
    return e.what();
  }
  return "";
}

double total(const json& energy) {
  return energy.at("kinetic").get<double>() + energy.at("potential").get<double>() + energy.at("elastic").get<double>();
}

// How far rows may be off. Methods that hold them do so to 1e-10 or better; Baumgarte's terms and the velocities of
// index 3 ripple by what a step of 1 ms leaves. An impact at the end of the step is late by a step of 5 cm/s.
struct Off {
  double position = 1e-6, velocity = 1e-3;
};
constexpr Off a_step_late{1e-4, 0.1};

void expect_physics(const json& all, const std::string& what, const Off& off = {}) {
  SCOPED_TRACE(what);
  const Finished run = run_text(all.dump());
  ASSERT_TRUE(run.done()) << run.report.reason << "\n" << all.dump();
  EXPECT_LE(run.result["constraint_maxima"]["position"].get<double>(), off.position);
  EXPECT_LE(run.result["constraint_maxima"]["velocity"].get<double>(), off.velocity);
  // Of the falling kilogram 0.2 mJ, of the pendulum 100 J. What methods of order 2 change in 20 steps is a thousandth.
  const double from = run.result["energy_start"], to = total(run.result["energy_end"]);
  const double supplied = run.result["energy_supplied"]["total"].get<double>();
  const double moved =
      std::abs(from) + std::abs(to) + std::abs(supplied) + run.result["energy_end"]["kinetic"].get<double>();
  EXPECT_LE(to - from - supplied, 1e-3 * moved + 1e-9);
  EXPECT_TRUE(std::isfinite(to));
}

TEST(Matrix, EveryIntegratorRunsWhatItTakesAndIsRefusedWhatItDoesNot) {
  for (const IntegratorForm& method : methods())
    for (const Need need : compatibility::every_need) {
      const json step = need == Need::error_estimate ? json{{"tolerance", 1e-5}} : json(1e-3);
      const json all = with_integrator(with_need(need), method.form, step);
      const std::string what = method.form.name() + " with " + name(need);
      if (takes(method, need))
        expect_physics(all, what);
      else
        EXPECT_NE(refusal_of(all), "") << what;
    }
}

TEST(Matrix, EveryPairOfLawsRunsWithEveryIntegratorThatTakesItsNeeds) {
  for (const LawPair& laws : matrix().laws) {
    const json all = with_laws(laws);
    const std::string pair = (laws.contact ? laws.contact->name() : "a joint") + " and " +
                             (laws.friction ? laws.friction->name() : "no friction");
    for (const IntegratorForm& method : methods()) {
      const json run = with_integrator(all, method.form);
      const std::string what = pair + " with " + method.form.name();
      if (laws.why_not.empty() && takes_all(method, laws.needs))
        expect_physics(run, what, laws.fixed_steps ? a_step_late : Off{});
      else
        EXPECT_NE(refusal_of(run), "") << what;
    }
  }
}

TEST(Matrix, LawsThatNeedFixedStepsAreRefusedUnderATolerance) {
  for (const LawPair& laws : matrix().laws) {
    if (!laws.why_not.empty()) continue;
    json all = with_laws(laws);
    all["integrator"] = {{"type", "dop853"}, {"step", {{"tolerance", 1e-6}}}};
    EXPECT_EQ(refusal_of(all) != "", laws.fixed_steps) << all.dump();
  }
}

TEST(Matrix, LawsAreTakenByStaticsOrRefused) {
  for (const LawPair& laws : matrix().laws) {
    if (!laws.why_not.empty()) continue;
    json all = with_laws(laws);
    all["static"] = {{"steps", 1}};
    // Something must hold what friction does not.
    if (!laws.contact || laws.contact->type != "penalty")
      all["forces"]["s"] = {{"type", "spring_damper"},
                            {"stiffness", 100},
                            {"length", 0.5},
                            {"between", {{{"point", {-0.5, 0}}}, laws.contact ? "b.point" : "b.com"}}};
    else
      all["forces"]["s"] = {
          {"type", "bushing"}, {"stiffness", {100, 100, 0}}, {"between", {{{"point", {0.6, 0.5, 0.1}}}, "b.com"}}};
    const std::string found = refusal_of(all, &simulate::run_static);
    if (laws.why_no_statics.empty())
      EXPECT_EQ(found, "") << all.dump(1);
    else
      EXPECT_THAT(found, testing::HasSubstr(laws.why_no_statics));
  }
}

TEST(Matrix, LawsAreTakenByModesOrRefused) {
  for (const LawPair& laws : matrix().laws) {
    if (!laws.why_not.empty()) continue;
    json all = with_laws(laws);
    all["integrator"] = {{"type", "runge_kutta_4"}, {"step", 1e-3}};
    std::string found;
    try {
      modes_of(all.dump());
    } catch (const scene::SceneError& e) {
      found = e.what();
    }
    if (laws.why_no_modes.empty())
      EXPECT_EQ(found, "") << all.dump(1);
    else
      EXPECT_THAT(found, testing::HasSubstr(laws.why_no_modes));
  }
}

TEST(Matrix, EveryCorrectionRunsWithEveryIntegratorOnItsLevelsAndIsRefusedOnOthers) {
  for (const compatibility::CorrectionForm& correction : matrix().corrections)
    for (const auto level : {Correction::Level::position, Correction::Level::velocity, Correction::Level::energy}) {
      const bool corrects =
          std::find(correction.levels.begin(), correction.levels.end(), level) != correction.levels.end();
      for (const IntegratorForm& method : methods()) {
        json all = with_integrator(pendulum(), method.form);
        all["corrections"][compatibility::to_string(level)] = entry(correction.form);
        if (corrects)
          expect_physics(all, correction.form.name() + " with " + method.form.name());
        else
          EXPECT_NE(refusal_of(all), "");
      }
    }
}

TEST(Matrix, EveryBodyRunsWithEveryIntegratorThatTakesItsNeeds) {
  for (const compatibility::BodyKind& body : matrix().bodies) {
    if (body.type == "refining_bar") continue;  // of another test
    const json all = with_body(body.type);
    ASSERT_FALSE(all.is_null()) << body.type << " has no scene in small_scenes.hpp";
    for (const IntegratorForm& method : methods())
      if ((!body.rows || takes(method, Need::rows)) && (!body.rotations || takes(method, Need::rotations)))
        expect_physics(with_integrator(all, method.form, step_of(all)), body.type + " with " + method.form.name());
  }
}

TEST(Matrix, TellsBodiesWithoutMomentumFromThoseThatACorrectionNeeds) {
  for (const compatibility::BodyKind& body : matrix().bodies)
    for (const compatibility::CorrectionForm& correction : matrix().corrections) {
      if (!correction.needs_momentum || body.type == "refining_bar" || body.type == "moving_base") continue;
      json all = with_body(body.type);
      all["integrator"] = {{"type", "runge_kutta_4"}, {"step", step_of(all)}};
      all["corrections"]["energy"] = entry(correction.form);
      EXPECT_EQ(refusal_of(all) == "", body.momentum) << body.type;
    }
}

}  // namespace
}  // namespace trammel::test
