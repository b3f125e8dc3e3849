// The set-valued contact law: its restitution and how it treats what the law leaves open.
#include <gtest/gtest.h>
#include <trammel/contact.hpp>

#include "support/made.hpp"

namespace trammel::test {
namespace {

std::unique_ptr<Restitution> contact(const std::string& more) {
  return made<Restitution>(Kind::contact, R"({"type": "constraint_method", )" + more + "}");
}

TEST(ConstraintMethod, KeepsItsRestitutionDownToTheCaptureSpeed) {
  const auto law = contact(R"("restitution": 0.3, "capture_speed": 1e-3)");
  EXPECT_EQ(law->coefficient(5), 0.3);
  EXPECT_EQ(law->coefficient(1e-3), 0.3);
  EXPECT_EQ(law->coefficient(0.999e-3), 0);
  EXPECT_EQ(law->coefficient(0), 0);
}

TEST(ConstraintMethod, IsExactUnlessAskedOtherwise) {
  const Restitution::Treatment treatment = contact(R"("restitution": 0.3)")->treatment();
  EXPECT_EQ(treatment.onset, Restitution::Onset::located);
  EXPECT_EQ(treatment.rebound, Restitution::Rebound::free);
  EXPECT_EQ(treatment.restart, Restitution::Restart::consistent);
  EXPECT_EQ(treatment.capture_speed, 0);  // the scene's size decides
}

TEST(ConstraintMethod, OffersTheSimplificationsOfPapersByName) {
  const Restitution::Treatment treatment =
      contact(R"("onset": "next_step", "rebound": "constrained", "restart": "carry")")->treatment();
  EXPECT_EQ(treatment.onset, Restitution::Onset::next_step);
  EXPECT_EQ(treatment.rebound, Restitution::Rebound::constrained);
  EXPECT_EQ(treatment.restart, Restitution::Restart::carry);
}

TEST(ConstraintMethod, OffersThreeImpactLawsByName) {
  using Law = Restitution::ImpactLaw;
  EXPECT_EQ(contact(R"("restitution": 0.3)")->treatment().impact_law, Law::newton);
  EXPECT_EQ(contact(R"("impact_law": "newton")")->treatment().impact_law, Law::newton);
  EXPECT_EQ(contact(R"("impact_law": "poisson")")->treatment().impact_law, Law::poisson);
  EXPECT_EQ(contact(R"("impact_law": "energetic")")->treatment().impact_law, Law::energetic);
}

TEST(ConstraintMethod, RefusesARestitutionThatWouldGainEnergy) {
  EXPECT_NE(refusal(Kind::contact, R"({"type": "constraint_method", "restitution": 1.01})").find("restitution"),
            std::string::npos);
  EXPECT_NE(refusal(Kind::contact, R"({"type": "constraint_method", "restitution": -0.01})").find("restitution"),
            std::string::npos);
}

TEST(ConstraintMethod, RefusesANegativeCaptureSpeed) {
  EXPECT_NE(refusal(Kind::contact, R"({"type": "constraint_method", "capture_speed": -1e-9})").find("capture_speed"),
            std::string::npos);
}

}  // namespace
}  // namespace trammel::test
