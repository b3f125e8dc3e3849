// The parts of an AssembledSystem, each of which knows those before it: the point, its contacts, the equations, the
// factors.
#pragma once

#include <memory>

#include "system/assembled_system.hpp"
#include "system/equations/factors.hpp"
#include "system/equations/resting_friction.hpp"
#include "system/equations/shared_rows.hpp"

namespace trammel::model {

struct AssembledSystem::Parts {
  Parts(std::shared_ptr<const Model> model, Storage asked_for);

  void move_to(double t, const Vec& q, const Vec& v);
  void evaluate_rows() { shares.evaluate_rows(); }
  const Model& model() const { return *at.model; }

  Storage asked_for, storage;
  bool sparse;
  Counts counts;
  Point at;
  std::unique_ptr<BodyBlocks> blocks;  // instead of M, G, W and their factors with many bodies
  ContactsAtPoint contacts{at};
  JointFriction friction{at, contacts};
  RowsAtPoint rows{at, contacts, friction, blocks.get()};
  MassAndForceAtPoint masses{at, contacts, blocks.get(), sparse, counts};
  TangentAtPoint tangent{at, contacts, friction};
  FactorsAtPoint factors{at, contacts, rows, masses, tangent, blocks.get(), sparse, counts};
  ImpulseResponse response{at, contacts, rows, masses, blocks.get(), sparse};
  SharedRowsAtPoint shares{at, contacts, friction, rows, response};
  RestingFriction resting{at, contacts, rows, factors};

  long long iterated_at = -1;  // the point of the last Newton iteration
  Balance power;
  Vec right, right_rows;
  double stabilised_by = 0;
};

}  // namespace trammel::model
