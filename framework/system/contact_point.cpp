// A contact at the point: the rows of its geometry, its gap rate and slip, and the ratio of friction to normal force.
#include <cmath>
#include <utility>

#include "system/assembly.hpp"

namespace trammel::model {

const Rows& AssembledSystem::Work::contact(int i) {
  ContactRows& cache = contact_rows[std::size_t(i)];
  if (cache.point != point) {
    evaluate_contact(i, cache);
    cache.point = point;
  }
  return cache.rows;
}

void AssembledSystem::Work::evaluate_contact(int i, ContactRows& cache) {
  const Slots& at = contact_slots[std::size_t(i)];
  ContactGeometry& geometry = *geometries[std::size_t(i)];
  const bool tangents = model->contacts[std::size_t(i)].friction != nullptr;
  const CallSite around = std::exchange(site, geometry.call());
  cache.rows.resize(tangents ? dimension(model->world.space) : 1, model->world.space);
  geometry.rows(here(), cache.rows);
  site = around;
  cache.rate = cache.rows.g_t;
  cache.free = cache.rows.gamma;
  for (int k = 0; k < at.count; ++k)
    add_motion({cache.rows.H(k), 0, cache.rate.size()}, motion(at[k]), cache.rate.data(), cache.free.data());
}

SurfaceContact& AssembledSystem::Work::surface(std::size_t i) {
  Pressed& pressed = surfaces[i];
  if (pressed.point != point) {
    const CallSite around = site;
    called(model->contacts[i].origin, "normal");
    pressed.contact->press(here(), modes.contacts[i].approach_speed);
    site = around;
    pressed.point = point;
  }
  return *pressed.contact;
}

double AssembledSystem::Work::contact_rate(int i, int row) {
  contact(i);
  return contact_rows[std::size_t(i)].rate(row);
}

Tangential AssembledSystem::Work::slip(int i) {
  Tangential s = Tangential::Zero();
  for (int k = 0; k < tangents(i); ++k) s[k] = contact_rate(i, 1 + k);
  return s;
}

SlipDirection AssembledSystem::Work::slip_direction(int i) {
  const ContactMode& mode = modes.contacts[std::size_t(i)];
  return {slip(i), mode.direction, mode.slow};
}

// How the friction law is asked for a figure.
template <class Call>
double AssembledSystem::Work::ask_friction(int i, const char* name, Call call) {
  return call_inside(site, model->contacts[std::size_t(i)].friction_origin, name, call);
}

Tangential AssembledSystem::Work::friction_ratio(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  const ContactMode& mode = modes.contacts[std::size_t(i)];
  if (entry.coulomb && mode.friction == ContactMode::Friction::slide) {
    const Tangential s = slip(i);
    const double mu =
        ask_friction(i, "kinetic_coefficient", [&] { return entry.coulomb->kinetic_coefficient(s.norm()); });
    return -mu * SlipDirection(s, mode.direction, mode.slow).unit();
  }
  if (!entry.smooth) return Tangential::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm();
  if (!(speed > 0)) return Tangential::Zero();
  return -ask_friction(i, "ratio", [&] { return entry.smooth->ratio(speed); }) * (s / speed);
}

Eigen::Matrix2d AssembledSystem::Work::friction_damping(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  if (entry.coulomb) {
    if (tangents(i) == 1 || modes.contacts[std::size_t(i)].friction != ContactMode::Friction::slide)
      return Eigen::Matrix2d::Zero();
    const double speed = slip(i).norm();
    const double mu = ask_friction(i, "kinetic_coefficient", [&] { return entry.coulomb->kinetic_coefficient(speed); });
    return mu * slip_direction(i).slope();
  }
  if (!entry.smooth) return Eigen::Matrix2d::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm();
  const double slope = ask_friction(i, "slope", [&] { return entry.smooth->slope(speed); });
  if (speed == 0) return slope * Eigen::Matrix2d::Identity();
  const Tangential e = s / speed;
  const double turning = ask_friction(i, "ratio", [&] { return entry.smooth->ratio(speed); }) / speed;
  return turning * Eigen::Matrix2d::Identity() + (slope - turning) * e * e.transpose();
}

}  // namespace trammel::model
