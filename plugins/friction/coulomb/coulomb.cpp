// Coulomb's dry friction with different coefficients for sticking and sliding, as a set-valued law.
//
//     |T| <= mu_0 N while sticking,   T = -mu N sgn(slip) while sliding,   mu <= mu_0
//
// method: events           stick and slide change at located events; between them stick is a row, slide a force
//         lcp_every_step   as published by Zhang and Wang: contacts slower than `stick_speed` form a complementarity
//                          problem that is solved in each evaluation; they start to slide at the ends of steps, and
//                          only the stop of a sliding contact is located. For fixed steps of an explicit method with
//                          Baumgarte's terms.
#include <sstream>

#include <trammel/friction.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Coulomb : SetValuedFriction {
  double mu_0 = 0, mu = 0, eps = 0;
  Decide method = Decide::at_events;

  void prepare(const World&) override {
    if (mu <= mu_0) return;
    std::ostringstream message;
    message << "found " << mu << ", expected at most \"static\" = " << mu_0
            << ": what slides is held less than what rests";
    throw ParameterError("kinetic", message.str());
  }

  double static_coefficient() const override { return mu_0; }
  double kinetic_coefficient(double) const override { return mu; }
  Decide decide() const override { return method; }
  double stick_speed() const override { return method == Decide::at_events ? 0 : eps; }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::friction<Coulomb>("coulomb", "dry friction that sticks, with static and kinetic coefficient")
        .source("F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts, 1996; R. Zhang, Q. Wang, "
                "Chin. J. Theor. Appl. Mech. 49(6), 1370 (2017)")
        .parameter("static", &Coulomb::mu_0, {.min = 0, .usual_max = 10, .required = true, .doc = "mu_0"})
        .parameter("kinetic", &Coulomb::mu, {.min = 0, .required = true, .doc = "mu, at most the static one"})
        .choice("method", &Coulomb::method,
                {{"events", Coulomb::Decide::at_events}, {"lcp_every_step", Coulomb::Decide::every_evaluation}},
                {.doc = "when stick and slide are decided"})
        .parameter("stick_speed", &Coulomb::eps,
                   {.unit = "m/s",
                    .min = 0,
                    .usual_max = 1e-4,
                    .doc = "lcp_every_step: slower than this sticks; 0: a millionth of the scene's speed"}))
