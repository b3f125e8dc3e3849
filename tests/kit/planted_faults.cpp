// For each check a component that only just breaks it: the kit finds every one.
#include "support.hpp"

namespace kit_test {
namespace {

struct Planted {
  std::string component, check, verdict = "failed";
};
void PrintTo(const Planted& p, std::ostream* out) {
  *out << p.component << " by " << p.check;
}

const std::vector<Planted>& in_integrators() {
  static const std::vector<Planted> all = {
      {"claims_order_3", "integrator.order-on-the-damped-oscillator"},
      {"claims_order_3", "integrator.order-on-the-pendulum"},
      {"claims_order_3", "integrator.order-where-the-mass-varies"},
      {"claims_order_3", "integrator.order-on-the-quaternion-top"},
      {"claims_order_3", "integrator.order-on-the-pendulum-with-rod"},
      {"claims_order_3", "integrator.order-where-rows-depend-on-time"},
      {"claims_order_3", "integrator.order-when-rows-come-and-go"},
      {"claims_order_3", "integrator.order-when-coordinates-change"},
      {"claims_order_3", "integrator.energy-error-shrinks"},
      {"claims_order_1", "integrator.order-on-the-pendulum"},
      {"claims_to_be_implicit", "integrator.is-implicit-as-claimed"},
      {"claims_to_hold_rows", "integrator.holds-the-row"},
      {"claims_to_hold_rows", "integrator.holds-repeated-rows"},
      {"remembers_a_trial", "integrator.trial-leaves-no-trace"},
      {"remembers_a_trial", "integrator.takes-an-earlier-trial"},
      {"reads_next", "integrator.reads-nothing-from-next"},
      {"archives_nothing", "integrator.resumes-bit-for-bit"},
      {"remembers_after_restart", "integrator.restart-forgets"},
      {"returns_what_is_no_number", "integrator.rejects-what-is-not-a-number"},
      {"returns_what_is_no_number", "integrator.any-step-is-finite-or-rejected"},
      {"returns_what_is_no_number", "integrator.survives-any-failure"},
      {"allocates", "integrator.allocates-nothing-when-warm"},
      {"takes_another_time", "integrator.moves-on-in-time"},
      {"takes_another_time", "integrator.stands-still-with-nothing-to-move"},
      {"measures_in_metres", "integrator.same-in-other-units"},
      {"knows_the_hour", "integrator.same-at-another-time"},
      {"knows_the_hour", "integrator.takes-any-time"},
      {"grows", "integrator.is-stable-for-small-steps"},
      {"grows", "integrator.takes-any-mass-ratio"},
      {"estimate_ten_times_too_large", "integrator.estimates-the-error-of-a-slow-oscillator"},
      {"estimate_ten_times_too_large", "integrator.estimates-the-error-of-a-fast-oscillator"},
      {"estimate_ten_times_too_small", "integrator.estimates-the-error-of-the-pendulum"},
      {"estimate_ten_times_too_small", "integrator.estimates-the-error-on-rows"},
      {"estimate_of_another_order", "integrator.estimates-the-error-of-the-pendulum"},
      {"inside_is_the_start", "integrator.dense-output-has-an-order"},
      {"inside_misses_the_end", "integrator.dense-output-meets-the-ends"},
      {"inside_is_of_the_last_trial", "integrator.dense-output-is-that-of-the-step"},
      {"wrong_damping_is_accepted", "parameters.bounds-run"},
      {"wrong_damping_is_accepted", "parameters.random-sets-run"},
      {"prints", "process.prints-nothing"},
      {"changes_rounding", "process.keeps-settings-in-use"},
      {"changes_locale", "process.keeps-settings-in-use"},
      {"changes_folder", "process.keeps-settings-in-use"},
      {"throws", "process.throws-nothing"},
      {"hangs", "process.throws-nothing", "timed out"},
      {"crashes", "process.throws-nothing", "crashed"},
      {"exits", "process.throws-nothing", "crashed"},
      {"varies", "process.is-deterministic"},
      {"shares", "process.shares-no-state"},
  };
  return all;
}

const std::vector<Planted>& in_other_components() {
  static const std::vector<Planted> all = {
      {"mass_is_not_symmetric", "body.mass-is-symmetric"},
      {"mass_is_negative", "body.mass-is-positive"},
      {"energy_is_not_conserved", "body.energy-balances"},
      {"body_damper_supplies", "body.only-dissipates"},
      {"tangent_lies", "body.tangent-is-exact"},
      {"velocity_lies", "body.velocity-is-the-rate-of-the-pose"},
      {"marker_jacobian_lies", "body.jacobian-is-that-of-the-velocity"},
      {"motion_is_not_filled", "body.motion-is-filled-whole"},
      {"refinement_gains_energy", "body.refinement-keeps-the-energies"},
      {"refinement_moves_the_marker", "body.refinement-keeps-the-markers"},
      {"refinement_forgets", "body.refinement-resumes"},
      {"joint_does_work", "joint.reactions-balance"},
      {"joint_jacobian_lies", "joint.jacobian-is-the-gradient"},
      {"joint_forgets_gamma", "joint.gamma-is-the-rest-of-the-acceleration"},
      {"pushes_itself", "force.action-is-reaction"},
      {"force_potential_lies", "force.energy-balances"},
      {"force_damper_supplies", "force.only-dissipates"},
      {"knows_north", "force.turns-with-the-scene"},
      {"pulls", "contact.never-pulls"},
      {"acts_apart", "contact.is-nothing-apart"},
      {"contact_slope_lies", "contact.slope-is-the-derivative"},
      {"feeds", "contact.energy-never-grows"},
      {"contact_potential_lies", "contact.potential-is-the-elastic-energy"},
      {"gains_energy", "contact.loses-energy"},
      {"bounces_for_ever", "contact.ends-a-sequence-of-bounces"},
      {"drives", "friction.never-drives"},
      {"jumps", "friction.starts-from-zero"},
      {"friction_slope_lies", "friction.slope-is-the-derivative"},
      {"friction_grows", "friction.stays-inside-its-cone"},
      {"slides_harder", "friction.stays-inside-its-cone"},
      {"drives_when_sliding", "friction.never-drives"},
      {"never_sticks", "friction.decides-by-a-speed"},
      {"stops_halfway", "correction.restores-positions"},
      {"moves_along", "correction.leaves-the-free-motion"},
      {"changes_velocities", "correction.restores-positions"},
      {"acts_without_rows", "correction.does-nothing-without-rows"},
      {"invents", "correction.invents-no-state"},
      {"diverges_at_its_bound", "parameters.bounds-run"},
      {"default_outside", "parameters.are-declared-in-full"},
      {"undocumented", "parameters.are-declared-in-full"},
  };
  return all;
}

void expect_found(const std::string& library, const Planted& planted) {
  // A busy machine makes no other check wait for its limit.
  const std::string limit = planted.verdict == "timed out" ? "3" : "120";
  const auto json = check(library, {"--component", planted.component, "--only", planted.check, "--limit", limit}, 1);
  const auto& found = json.at("components").at(0).at("checks").at(0);
  EXPECT_EQ(found["name"], planted.check);
  EXPECT_EQ(found["verdict"], planted.verdict) << found["found"];
  EXPECT_NE(found["found"], "");
}

class Kit : public testing::TestWithParam<Planted> {};
TEST_P(Kit, CatchesEveryPlantedFaultInAnIntegrator) {
  expect_found(bad_plugins + "kit_integrators.so", GetParam());
}
class KitOfOthers : public testing::TestWithParam<Planted> {};
TEST_P(KitOfOthers, CatchesEveryPlantedFault) {
  expect_found(bad_plugins + "kit_components.so", GetParam());
}

std::string name_of(const testing::TestParamInfo<Planted>& info) {
  std::string name = info.param.component + "_by_" + info.param.check;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Planted, Kit, testing::ValuesIn(in_integrators()), name_of);
INSTANTIATE_TEST_SUITE_P(Planted, KitOfOthers, testing::ValuesIn(in_other_components()), name_of);

class GoodComponent : public testing::TestWithParam<std::pair<std::string, std::string>> {};
TEST_P(GoodComponent, PassesEveryCheck) {
  const auto json = check(bad_plugins + GetParam().first, {"--component", GetParam().second}, 0);
  EXPECT_EQ(faults(json), "");
}
INSTANTIATE_TEST_SUITE_P(
    All, GoodComponent,
    testing::Values(std::pair{"kit_integrators.so", "good_heun"}, std::pair{"kit_integrators.so", "good_newmark"},
                    std::pair{"kit_components.so", "good_masses"}, std::pair{"kit_components.so", "good_distance"},
                    std::pair{"kit_components.so", "good_spring"}, std::pair{"kit_components.so", "good_hertz"},
                    std::pair{"kit_components.so", "good_smooth"}, std::pair{"kit_components.so", "good_projection"}),
    [](const auto& tested) { return std::string(tested.param.second); });

}  // namespace
}  // namespace kit_test
