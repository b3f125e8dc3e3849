#include "simulate/settling/carried_forces.hpp"

#include <algorithm>

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;

void CarriedForces::keep(const State& state, const model::Modes& before) {
  lambda_ = state.lambda;
  forces_.clear();
  const auto carries = [this](const model::ContactEntry& contact) {
    return contact.restitution && contact.restitution->treatment().restart == Restitution::Restart::carry;
  };
  const auto& contacts = scene_.system.model().contacts;
  if (std::none_of(contacts.begin(), contacts.end(), carries)) return;
  forces_.assign(contacts.size(), Eigen::Vector3d::Zero());
  if (state.lambda.size() != scene_.system.sizes().nc) return;  // the start has no lambda yet
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const model::ContactMode& mode = before.contacts[i];
    if (!mode.closed) continue;
    if (contacts[i].restitution) forces_[i][0] = scene_.system.normal_force(int(i), state.lambda);
    if (mode.friction == Friction::stick) forces_[i].tail<2>() = scene_.system.friction_force(int(i), state.lambda);
  }
}

bool CarriedForces::asked(const ContactsAtEvent& at, const ContactChanges& changes) const {
  return std::any_of(at.touching.begin(), at.touching.end(), [&](const TouchingContact& c) {
    return (contains(changes.struck, c.contact) || contains(changes.released, c.contact)) &&
           scene_.treatment(c.contact).restart == Restitution::Restart::carry;
  });
}

void CarriedForces::take(Vec& lambda) const {
  const int joint_rows = scene_.system.model().sizes.nc;
  lambda.setZero(scene_.system.sizes().nc);
  if (lambda_.size() >= joint_rows) lambda.head(joint_rows) = lambda_.head(joint_rows);
  const auto force = [this](const model::ContactDirection& d) { return forces_[std::size_t(d.contact)][d.row]; };
  for (int i = 0; i < int(forces_.size()); ++i)
    for (int k = 0; k < 3; ++k)
      if (const int row = scene_.system.row({i, k}); row >= 0) lambda[row] = -force({i, k});
  for (const model::SharedRows& shared : scene_.system.modes().shared)
    for (std::size_t j = 0; j < shared.basis.size(); ++j)
      for (std::size_t i = 0; i < shared.implied.size(); ++i)
        lambda[scene_.system.row(shared.basis[j])] -=
            shared.K(Eigen::Index(i), Eigen::Index(j)) * force(shared.implied[i]);
}

}  // namespace trammel::simulate
