#include "simulate/contact/signed_loads.hpp"

#include <algorithm>
#include <array>

namespace trammel::simulate {

int count_signed_loads(const model::Model& model, int contact) {
  const int dim = dimension(model.world.space);
  Motion anywhere;
  anywhere.x = Vec3::Zero(dim), anywhere.R = Mat3::Identity(dim, dim);
  Bearings bearings;
  bearings.begin(model.world.space);
  model.contacts[std::size_t(contact)].joint->bearing->bearings(0, anywhere, anywhere, bearings);
  return int(std::count(bearings.sizes.begin(), bearings.sizes.begin() + bearings.count, 1));
}

std::vector<double> signed_loads(model::AssembledSystem& system, int contact, double t, const Vec& lambda) {
  const model::ContactEntry& entry = system.model().contacts[std::size_t(contact)];
  const model::JointEntry& joint = system.model().joints[std::size_t(entry.joint->joint)];
  const std::array<const Motion*, 2> markers = {&system.motion(entry.A), &system.motion(entry.B)};
  Rows rows;
  rows.resize(joint.rows, system.model().world.space);
  joint.joint->rows_between(t, markers, rows);
  Bearings bearings;
  bearings.begin(system.model().world.space);
  entry.joint->bearing->bearings(t, *markers[0], *markers[1], bearings);
  // With what contacts put on the joint as they share their forces: without it, the load would depend on which of their
  // rows are in g.
  const Vec6 wrench = rows.H_B.transpose() * system.reactions(lambda).segment(joint.row, joint.rows);
  std::vector<double> loads;
  for (int k = 0, first = 0; k < bearings.count; first += bearings.sizes[std::size_t(k++)])
    if (bearings.sizes[std::size_t(k)] == 1) loads.push_back(bearings.C.row(first).dot(wrench));
  return loads;
}

}  // namespace trammel::simulate
