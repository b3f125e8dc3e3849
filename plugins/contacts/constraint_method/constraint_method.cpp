// The constraint method: an impact with restitution when the gap closes, then a constraint row while the contact force
// is compressive.
//
//     newton      u+ = -e u-           u: gap rate [m/s];  e: restitution, 0 for impacts below the capture speed
//     poisson     N_E = e N_C          N: normal impulses [N s] of expansion and compression
//     energetic   W_E = -e^2 W_C       W: works of the normal force [J] in expansion and compression
//
// The three laws agree for one contact without friction. With friction or several contacts, the first two may create
// energy (which is reported); the third never does.
//
// The capture speed ends a sequence of bounces, whose speeds decrease geometrically; results do not change between 1e-3
// and 1e-7 m/s. The defaults of onset, rebound and restart are exact. Their second choices reproduce simplifications in
// papers (Guo, Zhang, Chen, Acta Phys. Sin. 66, 164501 (2017)), for comparison:
//     onset: next_step      the impact happens at the end of the step that passed the surface
//     rebound: constrained  the row is active while the contact separates with e u, so that its force does work
//     restart: carry        acceleration and multipliers before the impact are kept
#include <trammel/contact.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct ConstraintMethod : Restitution {
  double restitution = 0;
  double capture_speed = 0;
  Onset onset = Onset::located;
  Rebound rebound = Rebound::free;
  Restart restart = Restart::consistent;
  ImpactLaw impact_law = ImpactLaw::newton;

  double coefficient(double approach_speed) const override { return approach_speed < capture_speed ? 0 : restitution; }
  Treatment treatment() const override {
    return {onset, rebound, restart, capture_speed, Release::when_pulled, impact_law};
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::contact<ConstraintMethod>("constraint_method",
                                       "impact with restitution, then a constraint while it pushes")
        .source("F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts, 1996: Newton's and Poisson's "
                "impact laws; W. J. Stronge, Proc. R. Soc. A 431, 169 (1990): the energetic one")
        .parameter("restitution", &ConstraintMethod::restitution,
                   {.min = 0, .max = 1, .doc = "e; 0 plastic, 1 elastic"})
        .parameter("capture_speed", &ConstraintMethod::capture_speed,
                   {.unit = "m/s",
                    .min = 0,
                    .usual_max = 1e-2,
                    .doc = "slower impacts have e = 0; 0: a ten millionth of the scene's speed"})
        .choice("onset", &ConstraintMethod::onset,
                {{"located", ConstraintMethod::Onset::located}, {"next_step", ConstraintMethod::Onset::next_step}},
                {.doc = "impact at the crossing, or at the end of the step that passed it"})
        .choice("rebound", &ConstraintMethod::rebound,
                {{"free", ConstraintMethod::Rebound::free}, {"constrained", ConstraintMethod::Rebound::constrained}},
                {.doc = "a separating contact is open, or its row is on at once"})
        .choice("restart", &ConstraintMethod::restart,
                {{"consistent", ConstraintMethod::Restart::consistent}, {"carry", ConstraintMethod::Restart::carry}},
                {.doc = "accelerations and multipliers after an impact: solved anew, or carried over"})
        .choice(
            "impact_law", &ConstraintMethod::impact_law,
            {{"newton", ConstraintMethod::ImpactLaw::newton},
             {"poisson", ConstraintMethod::ImpactLaw::poisson},
             {"energetic", ConstraintMethod::ImpactLaw::energetic}},
            {.doc = "what e relates: gap rates, normal impulses, or works of the normal force (never creates energy)"}))
