#include "testing/kit/components/components.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include <trammel/body.hpp>
#include <trammel/fields.hpp>
#include <trammel/linear_rows.hpp>
#include <trammel/testing/markers.hpp>

namespace trammel::kit {

namespace {

struct Row {
  const char *name, *claim, *equation, *line;
  std::function<std::string(const Subject&)> left_out = {};
};

template <class Ability>
std::function<std::string(const Subject&)> unless_it_offers(const char* ability) {
  return [=](const Subject& s) {
    return s.offers<Ability>() ? std::string() : std::string("it does not offer ") + ability;
  };
}

// MassIsSymmetric -> mass-is-symmetric
std::string with_hyphens(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::isupper(static_cast<unsigned char>(c)) && !text.empty()) text += '-';
    text += char(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

// The check of this name among those that `list` gives for a subject.
Checks checks_of(const std::string& prefix, const char* header, const std::vector<Row>& rows,
                 const std::function<std::vector<trammel::Check>(const Subject&)>& list) {
  Checks checks;
  for (const Row& row : rows) {
    const std::string name = row.name;
    checks.push_back({{prefix + "." + with_hyphens(name), row.claim, row.equation, {header, row.line}},
                      Level::quick,
                      [=](const Subject& s) {
                        const auto all = list(s);
                        const auto found = std::ranges::find(all, name, &trammel::Check::name);
                        if (found == all.end()) throw std::logic_error("no check " + name);
                        return (*found)();
                      },
                      row.left_out});
  }
  return checks;
}

// Differences need a range over which the body's functions are smooth: the largest that serves.
Report over_a_smooth_range(const Subject& s, const std::string& name) {
  Report report;
  for (const double q : {0.3, 0.03, 3e-3, 3e-4, 3e-5}) {
    const auto all = trammel::body_checks(s.maker<Body>(), {.q = q, .v = std::min(1.0, 10 * q), .seed = s.seed});
    report = (*std::ranges::find(all, name, &trammel::Check::name))();
    if (report.holds || report.table.find("differences do not converge") == std::string::npos) return report;
  }
  return report;
}

std::string has_no_own_rows(const Subject& s) {
  return unless_it_offers<Constrained>("Constrained")(s);
}

std::string has_no_quaternion(const Subject& s) {
  for (const Coordinates::Part& part : s.maker<Body>()()->coordinates().parts())
    if (part.kind == Coordinates::Kind::rotation) return "";
  return "its coordinates have no rotation";
}

std::string has_constant_mass_not(const Subject& s) {
  return s.maker<Body>()()->mass_is_constant() ? "" : "mass_is_constant() = false";
}

std::string shows_nothing(const Subject& s) {
  return s.offers<Drawn>() || s.offers<Observed>() ? "" : "it offers neither Drawn nor Observed";
}

const std::vector<Row>& body_rows() {
  static const std::vector<Row> rows = {
      {"StartsOnItsManifold", "The initial state is finite and on the body's manifold.", "|p| = 1 of each quaternion p",
       "configuration and velocity at the start, from the body's parameters"},
      {"MassIsSymmetric", "The mass matrix is symmetric.", "M = M^T", "adds M (nv x nv), symmetric"},
      {"MassIsPositive", "No velocity has a negative kinetic energy.", "v^T M v >= 0", "adds M (nv x nv), symmetric"},
      {"MassIsConstantIfClaimed", "A mass that is claimed to be constant is.", "M(t, q) = M(0, q_0)",
       "virtual bool mass_is_constant() const", has_constant_mass_not},
      {"KineticEnergyIsThatOfItsMass", "The kinetic energy is that of the mass matrix.", "T = v^T M v/2",
       "virtual Energy energy(double t, In q, In v) const = 0;"},
      {"EnergyBalances", "Energy changes by the body's own drives and dampers only.",
       "dE/dt = supplied - dissipated along M a = f", "Along a motion d(total energy)/dt = supplied - dissipated."},
      {"OnlyDissipates", "Dampers take energy.", "dissipated >= 0", "by dampers, >= 0"},
      {"ForceAdds", "force() adds to the forces that are there.", "f(f_0) = f_0 + f(0)",
       "adds f (nv): elastic, gyroscopic, gravity, drives"},
      {"TangentIsExact", "The exact tangent is the derivative of mass and force.", "D = -df/dv, K = d(M a - f)/dq",
       "S += c_m M + c_d D + c_k K with D = -df/dv, K = d(M a - f)/dq", unless_it_offers<ExactTangent>("ExactTangent")},
      {"OwnRowsHaveTheirSizes", "Rows of its own keep the sizes they come in with.", "g, g_t, gamma: n; G: n x nv",
       "On entry `rows` has row_count rows, all zero.", has_no_own_rows},
      {"OwnJacobianIsTheGradient", "G is the gradient of g.", "G = dg/dq", "g(t, q) = 0,      g_dot = G v + g_t",
       has_no_own_rows},
      {"OwnRatesAreThoseOfThePath", "Rates of its own rows are those along a path.",
       "dg/dt = G v + g_t,  d(G v + g_t)/dt = G a - gamma", "g(t, q) = 0,      g_dot = G v + g_t", has_no_own_rows},
      {"OwnReactionDerivativeIsExact", "The reaction of its own rows has the derivative it states.",
       "K = d(G^T lambda)/dq", "S += c d(G^T lambda)/dq", has_no_own_rows},
      {"SeesRotationsNotQuaternions", "A quaternion and its negative are one rotation.", "f(-p) = f(p), M(-p) = M(p)",
       "a unit quaternion (w, x, y, z) and the angular velocity in body axes: 4 numbers, 3 rates", has_no_quaternion},
      {"ShowsItself", "What is drawn and observed is finite and of one size.", "|x| < infinity",
       "The body's shape for plots and animation", shows_nothing},
      {"ShowsFields", "Fields are finite, with as many values as points.", "columns of values = columns of points",
       "Gives one patch per element; a refinement changes their number.", unless_it_offers<HasFields>("HasFields")},
      {"MarkersAreWhole", "Markers are named once and have finite motions.", "R^T R = 1",
       "virtual std::span<const std::string> markers() const = 0;"},
      {"MotionIsFilledWhole", "motion() fills every member, whatever was in it.", "motion(m) = motion({})",
       "Fills every member of `motion`."},
      {"VelocityIsTheRateOfThePose", "A marker's velocity is the rate of its pose.",
       "dx/dt = V_linear, dR/dt = omega x R", "V = J v + V_t        A = J v' + bias"},
      {"JacobianIsThatOfTheVelocity", "J is the derivative of the velocity by v.", "V = J v + V_t",
       "V = J v + V_t        A = J v' + bias"},
      {"BiasIsTheRestOfTheAcceleration", "The bias is the acceleration at v' = 0.", "dV/dt = J a + bias",
       "V = J v + V_t        A = J v' + bias"},
      {"ReactionDerivativeIsExact", "The derivative of a constant wrench is exact.", "K = d(J^T F)/dq",
       "S += c d(J^T F)/dq for a constant wrench F at a marker",
       unless_it_offers<ReactionDerivative>("ReactionDerivative")},
      {"MotionIsLinearIfClaimed", "Markers that are claimed to be linear are.", "x = x_0 + J q, V = J v, J constant",
       "each marker has x = x_0 + J q and V = J v with constant J", unless_it_offers<LinearMarkers>("LinearMarkers")},
  };
  return rows;
}

std::string is_no_reaction_tangent(const Subject& s) {
  return unless_it_offers<ReactionTangent>("ReactionTangent")(s);
}
std::string is_not_linear(const Subject& s) {
  const auto joint = s.maker<Constraint>()();
  const auto* claims = dynamic_cast<const LinearRows*>(joint.get());
  return claims && claims->linear() ? "" : "it does not claim LinearRows";
}

const std::vector<Row>& joint_rows() {
  static const std::vector<Row> rows = {
      {"RowsHaveTheirSizes", "Rows keep the sizes they come in with.", "g: n, H_A: n x twist",
       "On entry `rows` has row_count rows, all zero."},
      {"JacobianIsTheGradient", "H_A and H_B are the gradients of g by the markers' twists.",
       "dg = H_A dX_A + H_B dX_B", "g_dot = H_A V_A + H_B V_B + ... + g_t"},
      {"TimeDerivativeIsThatOfFrozenMarkers", "g_t is the derivative by time alone.", "g_t = dg/dt at fixed markers",
       "(n) partial derivative by time"},
      {"GammaIsTheRestOfTheAcceleration", "gamma is what the markers' accelerations leave.",
       "d(g_dot)/dt = H_A A_A + H_B A_B - gamma", "H_A A_A + H_B A_B + ... = gamma"},
      {"ReactionTangentIsThatOfTheWrenches", "The reaction's derivative is that of its wrenches.",
       "K = d(H^T lambda)/dX",
       "Ability of joints between two markers: the derivatives of the wrenches H^T lambda, exact.",
       is_no_reaction_tangent},
      {"ReactionsBalance", "Reactions do no work on the two bodies together as one.",
       "sum over the markers of H^T lambda, about the origin = 0",
       "G = H_A J_A + H_B J_B + ...      and moves the markers' bias into gamma."},
      {"RowsAreLinearIfClaimed", "Rows that are claimed to be linear are.", "g = g_0 + H x with constant H",
       "Ability of a joint whose rows are linear in the positions of its markers", is_not_linear},
      {"AxesCountOnlyWhereSaid", "A marker's axes count only where the joint says so.", "dg/d(turn) = 0",
       "True if the component uses axes fixed in this marker"},
  };
  return rows;
}

const std::vector<Row>& force_rows() {
  static const std::vector<Row> rows = {
      {"EnergyBalances", "The work of the wrenches comes from the potential or is supplied or dissipated.",
       "dV/dt + F_A . V_A + F_B . V_B = supplied - dissipated",
       "Power of the non-conservative part: d(potential)/dt + power of the wrenches = supplied - dissipated."},
      {"OnlyDissipates", "Dampers take energy.", "dissipated >= 0",
       "Power of the non-conservative part: d(potential)/dt + power of the wrenches = supplied - dissipated."},
      {"ActionIsReaction", "Wrenches on A and B are equal and opposite.", "F_A + F_B = 0, moments about the origin too",
       "Wrenches on A and B; zero on entry."},
      {"TurnsWithTheScene", "Wrenches turn with the scene.", "Q F(A, B) = F(Q A, Q B)",
       "Wrenches on A and B; zero on entry."},
      {"HasADerivative", "Wrenches have a derivative by pose and velocity.",
       "dF/dX from the left = dF/dX from the right",
       "A force element between two markers: springs, dampers, drives, loads."},
      {"WrenchTangentIsExact", "The exact derivatives are those of the wrenches.", "K = dF/dX, D = dF/dV",
       "Adds to K the derivatives by the markers' poses while V stays, and to D those by V.",
       unless_it_offers<WrenchTangent>("WrenchTangent")},
      {"AxesCountOnlyWhereSaid", "A marker's axes count only where the force says so.", "dF/d(turn) = 0",
       "True if the component uses axes fixed in this marker"},
  };
  return rows;
}

const std::vector<Row>& contact_force_rows() {
  static const std::vector<Row> rows = {
      {"NeverPulls", "The contact force is never negative.", "F >= 0", "[N] >= 0; 0 at gap >= 0"},
      {"IsNothingApart", "There is no force and no energy while apart.", "F = V = 0 for gap >= 0",
       "[J] stored; 0 at gap >= 0"},
      {"StartsFromZero", "The force starts from zero as the gap closes.", "F -> 0 as gap -> 0-",
       "The compliant law: a force that acts while the gap is negative."},
      {"PotentialIsTheElasticEnergy", "The force at rest is minus the gradient of the potential.",
       "F(gap, 0) = -dV/dgap", "[J] stored; 0 at gap >= 0"},
      {"SlopeIsTheDerivative", "The slope is the derivative of the force.", "slope = dF/d(gap, gap_rate)",
       "Derivatives of `normal` by gap [N/m] and gap_rate [N s/m]."},
      {"EnergyNeverGrows", "Energy never grows over an approach and a return.", "d(m v^2/2 + V)/dt <= 0",
       "The compliant law: a force that acts while the gap is negative."},
  };
  return rows;
}

const std::vector<Row>& restitution_rows() {
  static const std::vector<Row> rows = {
      {"LosesEnergy", "An impact gains no energy and does not pull.", "0 <= e(u) <= 1",
       "virtual double coefficient(double approach_speed) const = 0;  // e in [0, 1]"},
      {"EndsASequenceOfBounces", "Slower than its capture speed nothing bounces.", "e(u) = 0 for u < capture speed",
       "e = 0 for slower impacts, which ends a sequence of bounces."},
  };
  return rows;
}

// The header of a sentence that is not in the kind's own.
void quoted_from(Checks& checks, const std::string& name, const char* header) {
  for (Check& check : checks)
    if (check.words.name.ends_with("." + name)) check.words.contract.header = header;
}

Reaction reaction_of(const Subject& s) {
  // A load acts on B alone.
  const auto force = s.maker<Force>()();
  const MovingPair pair = moving_pair(s.form.world.space);
  for (const double t : {0.1, 0.7, 1.3}) {
    const Motion A = pair.a.at(t), B = pair.b.at(t);
    Wrench on_A = Wrench::Zero(A.V.size()), on_B = on_A;
    force->wrench(t, A, B, on_A, on_B);
    if (!on_A.isZero(0)) return Reaction::on_A;
  }
  return Reaction::outside;
}

}  // namespace

Checks body_checks() {
  Checks checks;
  for (const Row& row : body_rows()) {
    const std::string name = row.name;
    checks.push_back({{"body." + with_hyphens(name), row.claim, row.equation, {"trammel/body.hpp", row.line}},
                      Level::quick,
                      [=](const Subject& s) { return over_a_smooth_range(s, name); },
                      row.left_out});
  }
  for (const char* name : {"energy-balances", "only-dissipates"}) quoted_from(checks, name, "trammel/types.hpp");
  for (const char* name :
       {"velocity-is-the-rate-of-the-pose", "jacobian-is-that-of-the-velocity", "bias-is-the-rest-of-the-acceleration"})
    quoted_from(checks, name, "trammel/marker.hpp");
  quoted_from(checks, "motion-is-linear-if-claimed", "trammel/linear_rows.hpp");
  quoted_from(checks, "shows-fields", "trammel/fields.hpp");
  for (const Checks& more : {surface_checks(), refinable_checks()})
    checks.insert(checks.end(), more.begin(), more.end());
  return checks;
}

Checks joint_checks() {
  Checks checks = checks_of("joint", "trammel/joint.hpp", joint_rows(), [](const Subject& s) {
    return trammel::joint_checks(s.maker<Constraint>(), s.form.world.space);
  });
  for (const char* name : {"jacobian-is-the-gradient", "time-derivative-is-that-of-frozen-markers",
                           "gamma-is-the-rest-of-the-acceleration"})
    quoted_from(checks, name, "trammel/marker.hpp");
  quoted_from(checks, "rows-are-linear-if-claimed", "trammel/linear_rows.hpp");
  quoted_from(checks, "axes-count-only-where-said", "trammel/needs_orientation.hpp");
  return checks;
}

Checks force_checks() {
  Checks checks = checks_of("force", "trammel/force.hpp", force_rows(), [](const Subject& s) {
    return trammel::force_checks(s.maker<Force>(), s.form.world.space, reaction_of(s));
  });
  for (Check& check : checks)
    if (check.words.name == "force.action-is-reaction" || check.words.name == "force.turns-with-the-scene")
      check.left_out = [](const Subject& s) {
        return reaction_of(s) == Reaction::outside ? "it acts on B alone, as a load does" : "";
      };
  quoted_from(checks, "axes-count-only-where-said", "trammel/needs_orientation.hpp");
  return checks;
}

Checks contact_force_checks() {
  return checks_of("contact", "trammel/contact.hpp", contact_force_rows(),
                   [](const Subject& s) { return trammel::contact_force_checks(s.maker<ContactForce>()); });
}

Checks restitution_checks() {
  return checks_of("contact", "trammel/contact.hpp", restitution_rows(),
                   [](const Subject& s) { return trammel::restitution_checks(s.maker<Restitution>()); });
}

}  // namespace trammel::kit
