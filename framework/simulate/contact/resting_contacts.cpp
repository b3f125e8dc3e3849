#include "simulate/contact/resting_contacts.hpp"

#include <algorithm>

#include "simulate/contact/force_noise.hpp"

namespace trammel::simulate {
namespace {

constexpr double round_off = 1e-9;  // of the forces that act on a contact
constexpr int most_releases = 100;  // in all: a set that opens and closes without end has no equilibrium

}  // namespace

RestingContacts::RestingContacts(model::AssembledSystem& system)
    : system_(system),
      modes_{.contacts = std::vector<model::ContactMode>(system.model().contacts.size()), .shared = {}},
      scale_(system.model()) {
  system_.hold_still(true);
  system_.set_modes(modes_);
}

RestingContacts::~RestingContacts() {
  system_.hold_still(false);
  system_.set_modes({.contacts = std::vector<model::ContactMode>(modes_.contacts.size()), .shared = {}});
}

void RestingContacts::close_what_may_push() {
  scale_.take_all(system_);
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i)
    modes_.contacts[i].closed =
        system_.model().contacts[i].force || system_.gap(int(i)) <= scale_.of(int(i)).written_length();
  system_.set_modes(modes_);
}

bool RestingContacts::close_penetrating() {
  bool changed = false;
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i) {
    bool& closed = modes_.contacts[i].closed;
    if (closed || system_.gap(int(i)) >= 0) continue;
    closed = changed = true;
  }
  if (changed) system_.set_modes(modes_);
  return changed;
}

std::vector<int> RestingContacts::pulling(const Vec& lambda) {
  std::vector<model::ContactDirection> closed;
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i)
    if (modes_.contacts[i].closed && system_.row({int(i), 0}) >= 0) closed.push_back({int(i), 0});
  Vec N(Eigen::Index(closed.size()));
  for (std::size_t k = 0; k < closed.size(); ++k) N[Eigen::Index(k)] = system_.normal_force(closed[k].contact, lambda);
  std::vector<int> all;
  if (N.size() == 0 || N.minCoeff() >= 0) return all;
  const Judged judged = judge_forces(system_, closed, N, scale_);
  for (Eigen::Index k = 0; k < N.size(); ++k)
    if (-N[k] > std::max(round_off * judged.scale[k], judged.noise[k])) all.push_back(closed[std::size_t(k)].contact);
  return all;
}

bool RestingContacts::release_pulling(const Vec& lambda) {
  bool changed = false;
  for (const int i : pulling(lambda)) {
    if (released_ >= most_releases) break;
    modes_.contacts[std::size_t(i)].closed = false;
    changed = true, ++released_;
  }
  if (changed) system_.set_modes(modes_);
  return changed;
}

void RestingContacts::carry_along() {
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i) {
    const model::ContactEntry& contact = system_.model().contacts[i];
    model::ContactMode& mode = modes_.contacts[i];
    mode.closed = mode.closed && (contact.restitution || contact.joint || system_.gap(int(i)) < 0);
    if (mode.closed && contact.coulomb && contact.coulomb->static_coefficient() > 0)
      mode.friction = model::ContactMode::Friction::stick;
  }
  system_.set_modes(modes_);
}

}  // namespace trammel::simulate
