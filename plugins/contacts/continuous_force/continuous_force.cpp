// A compliant contact: Hertz's spring with hysteresis damping.
//
//     F = K delta^n (1 + c delta')  >= 0,    delta = -gap [m],  delta' = -gap_rate [m/s],  c = factor(e) / v0 [s/m]
//
//     hunt_crossley        3 (1 - e) / 2       Hunt, Crossley, J. Appl. Mech. 42, 440 (1975)
//     lankarani_nikravesh  3 (1 - e^2) / 4     Lankarani, Nikravesh, J. Mech. Des. 112, 369 (1990)
//     paper                the same; Guo, Zhang, Chen 2017 write it K |eta|^1.5 (1 - c eta') with eta the gap
//     flores               8 (1 - e) / (5 e)   e > 0; Flores, Machado et al., Multibody Syst. Dyn. 25, 357 (2011)
//     none                 0                   Hertz
//     coefficient          instead             F = K delta^n + c2 delta^p delta' with c2 and p given; p = n is Hunt and
//                                              Crossley's form, p = 0 a damper whose force jumps at touch
//
// v0 is the approach speed at the last onset; a contact that was closed at rest (v0 = 0) has no damping. F is limited
// to F >= 0. The restitution e is nominal: a mass that strikes a wall rebounds with e* times its speed, for all K, n
// and v0, where factor (1 + e*) = log((1 + factor) / (1 - factor e*)). e* is close to e for flores, and above 0.66 for
// lankarani_nikravesh. U = K delta^(n+1) / (n + 1).
#include <cmath>

#include <trammel/contact.hpp>
#include <trammel/fidelity.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

// Hertz's exponent 3/2 by a square root, which is much faster than std::pow.
double power(double depth, double n) {
  return n == 1.5 ? depth * std::sqrt(depth) : std::pow(depth, n);
}

struct ContinuousForce : ContactForce, HasFidelity {
  enum class Damping { none, hunt_crossley, lankarani_nikravesh, flores, coefficient };
  double c2 = 0, p = 1.5;
  double stiffness = 0, exponent = 1.5, restitution = 1;
  Damping damping = Damping::lankarani_nikravesh;

  void prepare(const World&) override {
    if (damping == Damping::flores && restitution == 0)
      throw ParameterError("restitution",
                           "the damping law \"flores\" divides by it: found 0, expected more than 0 up to 1");
    if (c2 > 0 && damping != Damping::coefficient)
      throw ParameterError("damping_coefficient", "only \"damping\": \"coefficient\" uses it");
    factor_ = factor();
  }

  double normal(double gap, double gap_rate, double approach_speed) const override {
    if (!(gap < 0)) return 0;
    const double E = elastic(-gap), F = E * (1 - loss(approach_speed) * gap_rate) - damper(-gap, E) * gap_rate;
    return F > 0 ? F : 0;
  }

  double potential(double gap) const override {
    return gap < 0 ? stiffness * std::pow(-gap, exponent + 1) / (exponent + 1) : 0;
  }

  std::vector<FidelityParameter> fidelity() const override { return {{"stiffness"}}; }
  // Its limit as K grows.
  std::vector<FidelityAlternative> alternatives() const override {
    return {{"constraint_method", {{"restitution", restitution}}}};
  }

  Slope slope(double gap, double gap_rate, double approach_speed) const override {
    if (!(gap < 0)) return {};
    const double c = loss(approach_speed), F = elastic(-gap), d = damper(-gap, F);
    if (!(F * (1 - c * gap_rate) - d * gap_rate > 0)) return {};
    return {.by_gap = exponent * F / gap * (1 - c * gap_rate) - p * d / gap * gap_rate, .by_rate = -c * F - d};
  }

 private:
  double elastic(double depth) const { return stiffness * power(depth, exponent); }
  double damper(double depth, double elastic) const {
    if (c2 == 0) return 0;
    return c2 * (p == exponent ? elastic / stiffness : power(depth, p));
  }
  double factor() const {
    const double e = restitution;
    switch (damping) {
      case Damping::hunt_crossley:
        return 1.5 * (1 - e);
      case Damping::lankarani_nikravesh:
        return 0.75 * (1 - e * e);
      case Damping::flores:
        return 1.6 * (1 - e) / e;
      case Damping::none:
      case Damping::coefficient:
        break;
    }
    return 0;
  }
  double loss(double approach_speed) const { return approach_speed > 0 ? factor_ / approach_speed : 0; }

  double factor_ = 0;
};

}  // namespace

TRAMMEL_PLUGIN(trammel::contact<ContinuousForce>("continuous_force", "Hertz-type contact force with hysteresis damping")
                   .source("H. M. Lankarani, P. E. Nikravesh, J. Mech. Des. 112, 369 (1990)")
                   .parameter("stiffness", &ContinuousForce::stiffness,
                              {.unit = "N/m^n", .min = 0, .above_min = true, .required = true, .doc = "K"})
                   .parameter("exponent", &ContinuousForce::exponent,
                              {.min = 1, .usual_max = 3, .doc = "n; 1.5 is Hertz's"})
                   .parameter("restitution", &ContinuousForce::restitution,
                              {.min = 0, .max = 1, .doc = "nominal e of the damping law; 1 is elastic"})
                   .choice("damping", &ContinuousForce::damping,
                           {{"lankarani_nikravesh", ContinuousForce::Damping::lankarani_nikravesh},
                            {"paper", ContinuousForce::Damping::lankarani_nikravesh},
                            {"hunt_crossley", ContinuousForce::Damping::hunt_crossley},
                            {"flores", ContinuousForce::Damping::flores},
                            {"none", ContinuousForce::Damping::none},
                            {"coefficient", ContinuousForce::Damping::coefficient}},
                           {.doc = "law of the damping factor; \"paper\" is another name of lankarani_nikravesh"})
                   .parameter("damping_coefficient", &ContinuousForce::c2,
                              {.unit = "N s/m^(p+1)", .min = 0, .doc = "c2, with \"damping\": \"coefficient\""})
                   .parameter("damping_exponent", &ContinuousForce::p,
                              {.min = 0, .usual_max = 3, .doc = "p, with \"damping\": \"coefficient\""}))
