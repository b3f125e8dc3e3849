// Refinement in the time loop. Bodies are asked after every step, with the contact pressures on their surface, and when
// one of their contacts has closed. The state is transferred to the new coordinates, and the changes are reported.
//
//     q, v by the bodies' transfers;   a, lambda from the equations of motion in the new coordinates
//
// A nested refinement changes neither shape nor velocity, so mass, momentum and energies stay; the event reports them
// before and after. A change of energy is a cause of its own in the ledger.
#pragma once

#include <memory>
#include <vector>

#include <trammel/integrator.hpp>

#include "model/refinement.hpp"
#include "simulate/results/refine_event.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class Refinement {
 public:
  Refinement(std::shared_ptr<model::Model> model, model::AssembledSystem& system);

  void lay_out();  // after bodies were read from an archive
  bool possible() const { return !refinable_.empty(); }
  // Null: nothing was refined. Otherwise `state` is in the new coordinates with a and lambda solved, and the energy has
  // changed by `gained()`. `contact`: index of the one that has just closed, -1 after a step.
  const Transfer* refine(State& state, int contact);
  const std::vector<RefineEvent>& events() const { return events_; }
  double gained() const { return gained_; }  // [J] by the last refinement

 private:
  RefineEvent::Side side(const State& state, int body) const;
  // Place on the body's surface where the contact has closed; 0 without a surface.
  Eigen::Vector2d place(const State& state, int contact, int body);
  RefineCause cause(const State& state, int contact, int body, std::vector<double>& pressure);
  void find_due(const State& state, int contact);

  std::shared_ptr<model::Model> model_;
  model::AssembledSystem& system_;
  std::vector<int> refinable_, due_, refined_;  // bodies
  std::vector<std::vector<double>> pressures_;  // by refinable body; its RefineCause refers to them
  std::vector<RefineCause> causes_;             // by due body
  std::unique_ptr<model::JoinedTransfer> transfer_;
  std::vector<RefineEvent> events_;
  double gained_ = 0;
};

}  // namespace trammel::simulate
