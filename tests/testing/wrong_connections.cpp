// The checks accept a right joint, force and contact law, and refuse wrong ones by the very checks that should find
// them.
#include <cmath>

#include <trammel/linear_rows.hpp>

#include "refusals.hpp"

namespace trammel::test {
namespace {

enum class JointDefect { none, wrong_sign_on_A, drive_forgotten, gamma_without_centripetal, acts_on_B_alone, resizes };

// The squared distance of two points in the plane or in space: g = (|d|^2 - (1 + t/2)^2)/2.
struct SquaredDistance : Joint {
  explicit SquaredDistance(JointDefect d) : defect(d) {}
  int row_count(Space) const override { return 1; }
  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const override {
    const Vec3 d = B.x - A.x;
    const auto n = d.size();
    const Vec3 u = (B.V - A.V).head(n);
    const bool alone = defect == JointDefect::acts_on_B_alone;
    const Vec3 arm = alone ? B.x : d, rate = alone ? Vec3(B.V.head(n)) : u;
    const double length = 1 + t / 2;
    if (defect == JointDefect::resizes) rows.H_A.setZero(1, 5);
    rows.g(0) = (arm.squaredNorm() - length * length) / 2;
    rows.H_B.row(0).head(n) = arm.transpose();
    if (!alone && defect != JointDefect::resizes)
      rows.H_A.row(0).head(n) = (defect == JointDefect::wrong_sign_on_A ? 1 : -1) * arm.transpose();
    rows.g_t(0) = defect == JointDefect::drive_forgotten ? 0 : -length / 2;
    rows.gamma(0) = 0.25 - (defect == JointDefect::gamma_without_centripetal ? 0 : rate.squaredNorm());
  }
  JointDefect defect;
};

Names refusals_of(JointDefect defect, Space space = Space::spatial) {
  return refusals(joint_checks([=] { return std::make_unique<SquaredDistance>(defect); }, space));
}

TEST(JointChecks, AcceptADistance) {
  EXPECT_EQ(refusals_of(JointDefect::none), Names());
  EXPECT_EQ(refusals_of(JointDefect::none, Space::planar), Names());
}
TEST(JointChecks, RefuseAJacobianOfTheWrongSign) {
  // d(g_dot)/dt is no longer H A - gamma either, nor do the reactions balance.
  EXPECT_EQ(refusals_of(JointDefect::wrong_sign_on_A),
            (Names{"JacobianIsTheGradient", "GammaIsTheRestOfTheAcceleration", "ReactionsBalance"}));
}
TEST(JointChecks, RefuseADriveWithoutItsTimeDerivative) {
  EXPECT_EQ(refusals_of(JointDefect::drive_forgotten),
            (Names{"TimeDerivativeIsThatOfFrozenMarkers", "GammaIsTheRestOfTheAcceleration"}));
}
TEST(JointChecks, RefuseAGammaWithoutVelocities) {
  EXPECT_EQ(refusals_of(JointDefect::gamma_without_centripetal), Names{"GammaIsTheRestOfTheAcceleration"});
}
TEST(JointChecks, RefuseAReactionOnOneMarkerOnly) {
  EXPECT_EQ(refusals_of(JointDefect::acts_on_B_alone), Names{"ReactionsBalance"});
}
TEST(JointChecks, RefuseRowsOfAnotherSize) {
  EXPECT_TRUE(refusals_of(JointDefect::resizes).contains("RowsHaveTheirSizes"));
}

struct ClaimsLinearRows final : SquaredDistance, LinearRows {
  explicit ClaimsLinearRows(bool c) : SquaredDistance(JointDefect::none), claims(c) {}
  bool linear() const override { return claims; }
  bool claims;
};
TEST(JointChecks, RefuseADistanceThatClaimsLinearRows) {
  EXPECT_EQ(refusals(joint_checks([] { return std::make_unique<ClaimsLinearRows>(true); })),
            Names{"RowsAreLinearIfClaimed"});
  EXPECT_EQ(refusals(joint_checks([] { return std::make_unique<ClaimsLinearRows>(false); })), Names());
}

// Without a word (NeedsOrientation) that the angles count.
struct EqualAngles final : Joint {
  int row_count(Space) const override { return 1; }
  void rows(double, const Motion& A, const Motion& B, Rows& rows) const override {
    rows.g(0) = B.angle - A.angle;
    rows.H_A(0, 2) = -1, rows.H_B(0, 2) = 1;
  }
};
TEST(JointChecks, RefuseAnglesThatAreHeldWithoutAWord) {
  EXPECT_EQ(refusals(joint_checks([] { return std::make_unique<EqualAngles>(); })), Names{"AxesCountOnlyWhereSaid"});
}

// Two equal rows are what a redundant mechanism has.
struct Twice final : Joint {
  int row_count(Space) const override { return 2; }
  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const override {
    Rows one;
    one.resize(1, A.x.size() == 2 ? Space::planar : Space::spatial);
    SquaredDistance(JointDefect::none).rows(t, A, B, one);
    for (int i = 0; i < 2; ++i) {
      rows.g(i) = one.g(0), rows.g_t(i) = one.g_t(0), rows.gamma(i) = one.gamma(0);
      rows.H_A.row(i) = one.H_A.row(0), rows.H_B.row(i) = one.H_B.row(0);
    }
  }
};
TEST(JointChecks, AcceptRowsThatRepeat) {
  EXPECT_EQ(refusals(joint_checks([] { return std::make_unique<Twice>(); })), Names());
}

enum class ForceDefect { none, makes_energy, forgets_its_damper, feeds, acts_on_B_alone, pulls_along_x, has_a_kink };

// A linear spring of no length with a damper along it: F_B = -k d - c (u . d) d/|d|^2.
struct Spring final : Force {
  explicit Spring(ForceDefect d) : defect(d) {}
  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const auto n = A.x.size();
    const Vec3 d = B.x - A.x;
    Vec3 F = -k * d - (defect == ForceDefect::feeds ? -1 : 1) * c * rate(A, B) * d.normalized();
    if (defect == ForceDefect::makes_energy) F(0) += 0.01 * d(1), F(1) -= 0.01 * d(0);  // curl
    if (defect == ForceDefect::pulls_along_x) F = -k * d(0) * Vec3::Unit(n, 0);
    if (defect == ForceDefect::has_a_kink) F -= (d.norm() > kink ? 5.0 : 1.0) * (d.norm() - kink) * d.normalized();
    on_B.head(n) = F;
    if (defect != ForceDefect::acts_on_B_alone) on_A.head(n) = -F;
  }
  double potential(double, const Motion& A, const Motion& B) const override {
    const Vec3 d = B.x - A.x;
    if (defect == ForceDefect::pulls_along_x) return k * d(0) * d(0) / 2;
    const double beyond = d.norm() - kink;
    return k * d.squaredNorm() / 2 +
           (defect == ForceDefect::has_a_kink ? (beyond > 0 ? 2.5 : 0.5) * beyond * beyond : 0);
  }
  Power power(double, const Motion& A, const Motion& B) const override {
    const double lost = c * std::pow(rate(A, B), 2);
    if (defect == ForceDefect::forgets_its_damper || defect == ForceDefect::pulls_along_x) return {};
    return {.dissipated = defect == ForceDefect::feeds ? -lost : lost};
  }
  static double rate(const Motion& A, const Motion& B) {  // of the distance
    return (B.V - A.V).head(A.x.size()).dot((B.x - A.x).normalized());
  }
  static constexpr double k = 7, c = 0.4;
  double kink = 0;
  ForceDefect defect;
};

// The same with its derivative, or one that takes the pull for constant.
struct SpringWithTangent final : Force, WrenchTangent {
  explicit SpringWithTangent(bool wrong) : forgets_the_turn(wrong) {}
  void wrench(double t, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    own.wrench(t, A, B, on_A, on_B);
  }
  double potential(double t, const Motion& A, const Motion& B) const override { return own.potential(t, A, B); }
  Power power(double t, const Motion& A, const Motion& B) const override { return own.power(t, A, B); }
  void add_wrench_tangent(double, const Motion& A, const Motion& B, PairTangent& K, PairTangent& D) const override {
    const auto n = A.x.size();
    const Vec3 d = B.x - A.x, u = d.normalized(), d_dot = (B.V - A.V).head(n);
    const Vec3 across = (d_dot - u.dot(d_dot) * u) / d.norm();
    const Mat3 one = Mat3::Identity(n, n), along = u * u.transpose();
    Mat3 by_d = Spring::k * one + Spring::c * u * across.transpose();
    if (!forgets_the_turn) by_d += Spring::c * u.dot(d_dot) / d.norm() * (one - along);
    add_by_distance(by_d, K);
    add_by_distance(Spring::c * along, D);
  }
  Spring own{ForceDefect::none};
  bool forgets_the_turn;
};
TEST(ForceChecks, AcceptAnExactTangent) {
  EXPECT_EQ(refusals(force_checks([] { return std::make_unique<SpringWithTangent>(false); })), Names());
}
TEST(ForceChecks, RefuseATangentThatIsNotTheDerivative) {
  EXPECT_EQ(refusals(force_checks([] { return std::make_unique<SpringWithTangent>(true); })),
            Names{"WrenchTangentIsExact"});
}

Names refusals_of(ForceDefect defect) {
  return refusals(force_checks([=] {
    auto spring = std::make_unique<Spring>(defect);
    const MovingPair pair = moving_pair(Space::planar);
    spring->kink = (pair.b.at(0.7).x - pair.a.at(0.7).x).norm();  // where one of the checks looks
    return spring;
  }));
}

TEST(ForceChecks, AcceptASpring) {
  EXPECT_EQ(refusals_of(ForceDefect::none), Names());
}
TEST(ForceChecks, RefuseAForceThatMakesEnergy) {
  EXPECT_EQ(refusals_of(ForceDefect::makes_energy), (Names{"EnergyBalances", "ActionIsReaction"}));
}
TEST(ForceChecks, RefuseADamperThatIsNotAccountedFor) {
  EXPECT_EQ(refusals_of(ForceDefect::forgets_its_damper), Names{"EnergyBalances"});
}
TEST(ForceChecks, RefuseADamperThatFeeds) {
  EXPECT_EQ(refusals_of(ForceDefect::feeds), Names{"OnlyDissipates"});
}
TEST(ForceChecks, RefuseAnActionWithoutReaction) {
  EXPECT_EQ(refusals_of(ForceDefect::acts_on_B_alone), (Names{"EnergyBalances", "ActionIsReaction"}));
}
TEST(ForceChecks, RefuseAForceAlongTheWorldsAxis) {  // its moment does not balance either
  EXPECT_EQ(refusals_of(ForceDefect::pulls_along_x), (Names{"TurnsWithTheScene", "ActionIsReaction"}));
}
TEST(ForceChecks, RefuseAKink) {
  EXPECT_TRUE(refusals_of(ForceDefect::has_a_kink).contains("HasADerivative"));
}

// Without a word (NeedsOrientation) that it acts with moments.
struct Torsion final : Force {
  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    on_A(2) = B.angle - A.angle, on_B(2) = A.angle - B.angle;
  }
  double potential(double, const Motion& A, const Motion& B) const override {
    return std::pow(B.angle - A.angle, 2) / 2;
  }
  Power power(double, const Motion&, const Motion&) const override { return {}; }
};
TEST(ForceChecks, RefuseMomentsWithoutAWord) {
  EXPECT_EQ(refusals(force_checks([] { return std::make_unique<Torsion>(); })), Names{"AxesCountOnlyWhereSaid"});
}

enum class LawDefect { none, pulls, acts_apart, jumps, stores_too_much, slope_without_damping, feeds };

// F = K d^1.5 (1 + 0.6 d'/v0), d = -gap; Hunt and Crossley's form.
struct Law final : ContactForce {
  explicit Law(LawDefect d) : defect(d) {}
  double normal(double gap, double rate, double v0) const override {
    if (gap >= 0) return defect == LawDefect::acts_apart && gap > 0 && gap < 1e-3 ? 1e-9 : 0;
    const double s = v0 > 0 ? -rate / v0 : 0, sign = defect == LawDefect::feeds ? -1 : 1;
    const double F = K * std::pow(-gap, 1.5) * (1 + sign * 0.6 * s) + (defect == LawDefect::jumps ? 1 : 0);
    return defect == LawDefect::pulls ? F : std::max(0.0, F);
  }
  double potential(double gap) const override {
    const double jump = defect == LawDefect::jumps ? 1 : 0;
    return gap >= 0 ? 0 : (defect == LawDefect::stores_too_much ? 0.41 : 0.4) * K * std::pow(-gap, 2.5) - jump * gap;
  }
  Slope slope(double gap, double rate, double v0) const override {
    if (gap >= 0 || normal(gap, rate, v0) <= 0) return {};
    const double s = v0 > 0 ? -rate / v0 : 0, sign = defect == LawDefect::feeds ? -1 : 1;
    const double damping = defect == LawDefect::slope_without_damping ? 0 : sign * 0.6 / v0;
    return {-1.5 * K * std::sqrt(-gap) * (1 + sign * 0.6 * s), -K * std::pow(-gap, 1.5) * damping};
  }
  static constexpr double K = 1e6;
  LawDefect defect;
};

Names refusals_of(LawDefect defect) {
  return refusals(contact_force_checks([=] { return std::make_unique<Law>(defect); }));
}

TEST(ContactForceChecks, AcceptALawWithDamping) {
  EXPECT_EQ(refusals_of(LawDefect::none), Names());
}
TEST(ContactForceChecks, RefuseALawThatPulls) {
  EXPECT_EQ(refusals_of(LawDefect::pulls), Names{"NeverPulls"});
}
TEST(ContactForceChecks, RefuseALawThatActsApart) {
  EXPECT_EQ(refusals_of(LawDefect::acts_apart), Names{"IsNothingApart"});
}
TEST(ContactForceChecks, RefuseAJumpUnlessTheLawSaysSo) {
  EXPECT_EQ(refusals_of(LawDefect::jumps), Names{"StartsFromZero"});
  EXPECT_EQ(refusals(contact_force_checks([] { return std::make_unique<Law>(LawDefect::jumps); },
                                          {.starts_from_zero = false})),
            Names());
}
TEST(ContactForceChecks, RefuseAPotentialThatIsNotTheForces) {  // the energy it overstates on the way in shows, too
  EXPECT_TRUE(refusals_of(LawDefect::stores_too_much).contains("PotentialIsTheElasticEnergy"));
}
TEST(ContactForceChecks, RefuseAWrongSlope) {
  EXPECT_EQ(refusals_of(LawDefect::slope_without_damping), Names{"SlopeIsTheDerivative"});
}
TEST(ContactForceChecks, RefuseALawThatMakesEnergy) {
  EXPECT_EQ(refusals_of(LawDefect::feeds), Names{"EnergyNeverGrows"});
}

enum class RestitutionDefect { none, gains, attracts, bounces_for_ever };

struct Bounce final : Restitution {
  explicit Bounce(RestitutionDefect d) : defect(d) {}
  double coefficient(double speed) const override {
    if (speed < treatment().capture_speed && defect != RestitutionDefect::bounces_for_ever) return 0;
    if (defect == RestitutionDefect::gains) return speed > 1e3 ? 1.01 : 0.5;
    return defect == RestitutionDefect::attracts ? 0.5 - speed / 10 : 0.5;
  }
  Treatment treatment() const override { return {.capture_speed = 1e-4}; }
  RestitutionDefect defect;
};

Names refusals_of(RestitutionDefect defect) {
  return refusals(restitution_checks([=] { return std::make_unique<Bounce>(defect); }));
}

TEST(RestitutionChecks, RefuseWhatGainsEnergyPullsOrBouncesForEver) {
  EXPECT_EQ(refusals_of(RestitutionDefect::none), Names());
  EXPECT_EQ(refusals_of(RestitutionDefect::gains), Names{"LosesEnergy"});
  EXPECT_EQ(refusals_of(RestitutionDefect::attracts), Names{"LosesEnergy"});
  EXPECT_EQ(refusals_of(RestitutionDefect::bounces_for_ever), Names{"EndsASequenceOfBounces"});
}

TEST(Checks, ThatMeetAnExceptionFailWithItsText) {
  struct Broken final : Joint, LinearRows {
    bool linear() const override { return true; }
    int row_count(Space) const override { throw std::domain_error("out of rope"); }
    void rows(double, const Motion&, const Motion&, Rows&) const override {}
  };
  for (const Check& check : joint_checks([] { return std::make_unique<Broken>(); })) {
    const Report report = check();
    EXPECT_FALSE(report.holds) << check.name;
    EXPECT_NE(report.table.find("out of rope"), std::string::npos) << report.table;
  }
}

}  // namespace
}  // namespace trammel::test
