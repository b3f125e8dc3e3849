// The checks accept a right body and refuse wrong ones, each by the very checks that should find the defect.
#include <trammel/linear_rows.hpp>

#include "elastic_pendulum.hpp"
#include "free_top.hpp"
#include "point_on_a_circle.hpp"
#include "refusals.hpp"

namespace trammel::test {
namespace {

std::set<std::string> refusals_of(BodyDefect defect) {
  return refusals(body_checks([=] { return std::make_unique<ElasticPendulum>(defect); }));
}
std::set<std::string> refusals_of(TopDefect defect) {
  return refusals(body_checks([=] { return std::make_unique<FreeTop>(defect); }));
}

std::set<std::string> refusals_of(CircleDefect defect) {
  return refusals(body_checks([=] { return std::make_unique<PointOnACircle>(defect); }));
}

struct ClaimsLinearMarkers final : ElasticPendulum, LinearMarkers {
  ClaimsLinearMarkers() : ElasticPendulum(BodyDefect::none) {}
};
TEST(BodyChecks, RefuseAPendulumThatClaimsLinearMarkers) {
  EXPECT_EQ(refusals(body_checks([] { return std::make_unique<ClaimsLinearMarkers>(); })),
            Names{"MotionIsLinearIfClaimed"});
}

// The second marker stands still, and what was filled in for it stays.
struct FillsTheSecondMarkerOnce : ElasticPendulum {
  FillsTheSecondMarkerOnce() : ElasticPendulum(BodyDefect::none) {}
  void motion(int marker, double t, In q, In v, Motion& motion) const override {
    if (marker == 0) return ElasticPendulum::motion(marker, t, q, v, motion);
    if (motion.J.size() > 0) return;
    motion.x = Vec3::Zero(2), motion.R = Mat3::Identity(2, 2);
    motion.V = motion.bias = Vec6::Zero(3);
    motion.dofs = {0, 1}, motion.J = Jac::Zero(3, 2);
  }
};
struct ClaimsSharedMotion final : FillsTheSecondMarkerOnce, SharedMotion {};
TEST(BodyChecks, RefuseSharedMotionOfAMarkerThatIsFilledOnce) {
  const auto refuses = [](const MakerOf<Body>& make) {
    return refusals(body_checks(make)).contains("MotionIsFilledWhole");
  };
  EXPECT_FALSE(refuses([] { return std::make_unique<FillsTheSecondMarkerOnce>(); }));
  EXPECT_TRUE(refuses([] { return std::make_unique<ClaimsSharedMotion>(); }));
}

TEST(BodyChecks, AcceptRightBodies) {
  EXPECT_EQ(refusals_of(BodyDefect::none), Names());
  EXPECT_EQ(refusals_of(CircleDefect::none), Names());
  EXPECT_EQ(refusals_of(TopDefect::none), Names());
}

struct Refused {
  BodyDefect defect;
  Names by;
};
class WrongBody : public testing::TestWithParam<Refused> {};

TEST_P(WrongBody, IsRefusedByTheChecksThatShouldFindIt) {
  EXPECT_EQ(refusals_of(GetParam().defect), GetParam().by);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongBody,
    testing::Values(Refused{BodyDefect::asymmetric_mass, {"MassIsSymmetric", "TangentIsExact"}},
                    // The energy's kinetic part and the exact tangent still have the right mass.
                    Refused{BodyDefect::negative_mass,
                            {"MassIsPositive", "KineticEnergyIsThatOfItsMass", "EnergyBalances", "TangentIsExact"}},
                    Refused{BodyDefect::mass_claims_to_be_constant, {"MassIsConstantIfClaimed"}},
                    Refused{BodyDefect::kinetic_energy_without_a_half,
                            {"KineticEnergyIsThatOfItsMass", "EnergyBalances"}},
                    Refused{BodyDefect::force_makes_energy, {"EnergyBalances", "TangentIsExact"}},
                    Refused{BodyDefect::damper_supplies, {"OnlyDissipates"}},
                    Refused{BodyDefect::force_overwrites, {"ForceAdds"}},
                    Refused{BodyDefect::two_markers_of_one_name, {"MarkersAreWhole"}},
                    Refused{BodyDefect::motion_leaves_the_bias, {"MotionIsFilledWhole"}},
                    Refused{BodyDefect::velocity_turns_the_other_way, {"VelocityIsTheRateOfThePose"}},
                    Refused{BodyDefect::jacobian_has_a_wrong_sign, {"JacobianIsThatOfTheVelocity"}},
                    Refused{BodyDefect::bias_without_coriolis, {"BiasIsTheRestOfTheAcceleration"}},
                    Refused{BodyDefect::tangent_without_damping, {"TangentIsExact"}},
                    Refused{BodyDefect::reaction_derivative_without_radius, {"ReactionDerivativeIsExact"}},
                    Refused{BodyDefect::shape_comes_and_goes, {"ShowsItself"}}),
    [](const testing::TestParamInfo<Refused>& test) {
      return std::to_string(test.index) + "_" + *test.param.by.begin();
    });

TEST(BodyChecks, RefuseWrongRowsOfItsOwn) {
  EXPECT_EQ(refusals_of(CircleDefect::rows_resized), Names{"OwnRowsHaveTheirSizes"});
  EXPECT_EQ(refusals_of(CircleDefect::gradient_of_twice_the_row),
            (Names{"OwnJacobianIsTheGradient", "OwnRatesAreThoseOfThePath", "OwnReactionDerivativeIsExact"}));
  EXPECT_EQ(refusals_of(CircleDefect::no_time_derivative), Names{"OwnRatesAreThoseOfThePath"});
  EXPECT_EQ(refusals_of(CircleDefect::gamma_of_wrong_sign), Names{"OwnRatesAreThoseOfThePath"});
  EXPECT_EQ(refusals_of(CircleDefect::no_reaction_derivative), Names{"OwnReactionDerivativeIsExact"});
}
TEST(BodyChecks, RefuseABodyThatStartsNowhere) {
  EXPECT_TRUE(refusals_of(BodyDefect::starts_nowhere).contains("StartsOnItsManifold"));
}
TEST(BodyChecks, RefuseAQuaternionThatIsNoRotation) {
  EXPECT_TRUE(refusals_of(TopDefect::starts_off_the_manifold).contains("StartsOnItsManifold"));
}
TEST(BodyChecks, RefuseAForceThatTellsAQuaternionFromItsNegative) {
  EXPECT_TRUE(refusals_of(TopDefect::reads_the_sign).contains("SeesRotationsNotQuaternions"));
}
TEST(BodyChecks, RefuseAVelocityInBodyAxes) {
  EXPECT_EQ(refusals_of(TopDefect::velocity_in_body_axes), Names{"VelocityIsTheRateOfThePose"});
}

}  // namespace
}  // namespace trammel::test
