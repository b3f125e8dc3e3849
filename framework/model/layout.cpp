#include <algorithm>

#include "model/model.hpp"

namespace trammel::model {
namespace {

void look_up_abilities(BodyEntry& entry) {
  Body* body = entry.body.get();
  entry.mass_and_force = dynamic_cast<const MassAndForce*>(body);
  entry.tangent = dynamic_cast<const ExactTangent*>(body);
  entry.carried_stress = dynamic_cast<const CarriedStress*>(body);
  entry.reaction_derivative = dynamic_cast<const ReactionDerivative*>(body);
  entry.constrained = dynamic_cast<const Constrained*>(body);
  entry.observed = dynamic_cast<const Observed*>(body);
  entry.drawn = dynamic_cast<const Drawn*>(body);
  entry.momentum = dynamic_cast<const HasMomentum*>(body);
  entry.refinable = dynamic_cast<Refinable*>(body);
  entry.surface = dynamic_cast<const Surface*>(body);
  entry.samples = dynamic_cast<const SampledSurface*>(body);
  entry.sliding = dynamic_cast<const SlidingSurface*>(body);
}

void look_up_abilities(ContactEntry& entry) {
  entry.restitution = dynamic_cast<const Restitution*>(entry.law.get());
  entry.force = dynamic_cast<const ContactForce*>(entry.law.get());
  entry.coulomb = dynamic_cast<const SetValuedFriction*>(entry.friction.get());
  entry.smooth = dynamic_cast<const SmoothFriction*>(entry.friction.get());
  if (entry.limit) entry.limit->tangent = dynamic_cast<const ReactionTangent*>(entry.limit->joint.get());
  if (entry.surface) entry.surface->by_points = dynamic_cast<const ForceBySurfacePoints*>(entry.law.get());
}

void place_coordinates(BodyEntry& entry, Sizes& sizes) {
  const Coordinates coordinates = entry.body->coordinates();
  entry.parts.assign(coordinates.parts().begin(), coordinates.parts().end());
  entry.q0 = sizes.nq, entry.nq = coordinates.nq();
  entry.v0 = sizes.nv, entry.nv = coordinates.nv();
  sizes.nq += entry.nq;
  sizes.nv += entry.nv;
}

template <class Entry>
void place_rows(Entry& entry, int rows, Sizes& sizes) {
  entry.row = sizes.nc;
  entry.rows = rows;
  sizes.nc += rows;
}

bool is_flat(const BodyEntry& entry) {
  return std::all_of(entry.parts.begin(), entry.parts.end(),
                     [](const Coordinates::Part& part) { return part.kind == Coordinates::Kind::flat; });
}

}  // namespace

void Model::lay_out() {
  sizes = {};
  flat = true;
  constant_mass = true;
  for (BodyEntry& entry : bodies) {
    look_up_abilities(entry);
    place_coordinates(entry, sizes);
    place_rows(entry, entry.constrained ? entry.constrained->row_count() : 0, sizes);
    flat = flat && is_flat(entry);
    constant_mass = constant_mass && entry.body->mass_is_constant();
  }
  for (JointEntry& entry : joints) {
    entry.tangent = dynamic_cast<const ReactionTangent*>(entry.joint.get());
    place_rows(entry, entry.joint->row_count(world.space), sizes);
  }
  for (ForceEntry& entry : forces) entry.tangent = dynamic_cast<const WrenchTangent*>(entry.force.get());
  for (ContactEntry& entry : contacts) look_up_abilities(entry);
}

std::vector<RowGroup> row_groups(const Model& model) {
  std::vector<RowGroup> groups;
  for (const BodyEntry& entry : model.bodies)
    if (entry.rows > 0) groups.push_back({"bodies." + entry.name, entry.row, entry.rows});
  for (const JointEntry& entry : model.joints) groups.push_back({"joints." + entry.name, entry.row, entry.rows});
  return groups;
}

}  // namespace trammel::model
