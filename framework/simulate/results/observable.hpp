// The quantities that "record": {"observe": {"name": "what"}} may name, evaluated at a time of the run.
//
//     BODY.OBSERVABLE                 a body's own scalars: "beam.angle"
//     BODY.MARKER.x y z vx vy vz ax ay az angle omega alpha      in world axes; angle, omega, alpha in planar scenes
//     contacts.NAME.gap gap_rate force closed                    force [N] >= 0 pushes; closed is 0 or 1
//     joints.NAME.reaction            2-norm of the joint's multipliers
//     energy.kinetic potential elastic total                     [J]
//
// or {"of": "block.com.x", "relative_to": "table.origin", "since_start": true}: a marker's motion as seen from another
// one (relative_motion.hpp); with "since_start" minus its initial value.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "scene/value.hpp"
#include "simulate/results/quantity.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// The system at one state of the solution. Accelerations and multipliers are solved from the equations of motion at the
// first use, whatever the integrator keeps.
class Moment {
 public:
  Moment(model::AssembledSystem& system, const State& state) : system_(system), state_(state) {
    system_.move_to(state.t, state.q, state.v);
  }
  model::AssembledSystem& system() { return system_; }
  const State& state() const { return state_; }
  const Vec& a() { return solve(), a_; }
  const Vec& lambda() { return solve(), lambda_; }
  const Vec& reactions();  // AssembledSystem::reactions, of least norm if joints have redundant rows
  const Energy& energy();

 private:
  void solve();
  model::AssembledSystem& system_;
  const State& state_;
  Vec a_, lambda_, reactions_;
  Energy energy_;
  bool solved_ = false, reactions_known_ = false, energy_known_ = false;
};

struct Column {
  std::string name;  // in the header
  std::function<double(Moment&)> value;
  bool since_start = false;  // minus the value at the start, from begin_columns on
  Quantity quantity = {};
};

// The columns "record" asks for, in scene order; unknown names are reported with the nearest.
std::vector<Column> read_observables(const scene::Value& root, const model::Model& model, scene::Problems& problems);

// Passes the initial state of the run to the columns, also when the run resumes.
void begin_columns(std::vector<Column>& columns, model::AssembledSystem& system, const State& start);

}  // namespace trammel::simulate
