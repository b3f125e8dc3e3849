// Checks in records and after events whether contacts obeyed their laws, up to round-off:
//
//     N >= 0,   |T| <= mu_0 N  [N],   T . slip <= 0 [W],   work of friction <= 0 [J]
//
// The scale of the round-off are the forces that act on the contact itself (force_noise.hpp). What is round-off of the
// largest force in its island moves nothing (worst_forces.hpp): a load that fades away leaves no force at all. Contacts
// that share rows are checked together (AssembledSystem::spare_load); what they miss counts if it could accelerate a
// body. Their forces have the resultants that move the bodies only as long as their rows depend on each other
// (AssembledSystem::off_span). Friction that supplies energy counts where this is more than 1e-8 of all that was lost
// and supplied, and more than counts as none in the scene: what rests and moves by round-off only exchanges energies of
// round-off.
// A violation becomes a warning: the run cannot be trusted there. The audit also keeps when contacts were statically
// indeterminate: closed with rows that depend on each other, so that their forces are not unique
// (complementarity/shares/carrying_rows.hpp).
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "run/contact_scale.hpp"
#include "simulate/contact/worst_forces.hpp"
#include "simulate/results/ledger.hpp"

namespace trammel::simulate {

class ContactAudit {
 public:
  void look(model::AssembledSystem& system, const State& state, const ContactScale& scale);

  struct Span {
    double first = 0, last = 0;  // [s]
  };
  const std::map<int, Span>& indeterminate() const { return indeterminate_; }  // by contact
  // `no_energy` [J]: what counts as none in the scene (watch/energy_watch.hpp).
  std::vector<std::string> warnings(const model::Model& model, const Ledger& ledger, double no_energy) const;

  void archive(Archive& a, std::size_t contacts);

 private:
  // What the force of a contact has beyond its law; not positive where it obeys.
  struct Excess {
    double pull = 0, beyond_cone = 0, along_slip = 0;  // [N] pulls, exceeds its cone, pushes along its slip
    double slip = 0;                                   // [m/s]
    double largest() const { return std::max({pull, beyond_cone, along_slip}); }
  };
  // The forces that act on one contact (force_noise.hpp): the largest of its directions.
  struct ActsOn {
    double force = 0, noise = 0;  // [N]
    double speed = 0;             // [m/s]
  };
  static Excess excess(model::AssembledSystem& system, int contact, double N, const model::Tangential& T,
                       const Scale& scale);
  void raise_worst(int contact, double t, const Excess& excess, const ActsOn& acts, const ContactScale& scale);
  void look_at_forces(model::AssembledSystem& system, const State& state, const std::vector<int>& closed,
                      const Vec& lambda, const ContactScale& scale);
  void look_at_groups(model::AssembledSystem& system, double t, const Vec& lambda, const ContactScale& scale);

  // In an island. `acts` [N]: the forces beside which it has to be more than round-off.
  void raise(Violation kind, std::size_t island, const WorstForces::Worst& found, double acts);

  WorstForces worst_;
  std::map<int, Span> indeterminate_;
};

}  // namespace trammel::simulate
