// A contact at the point: the rows of its geometry, its gap rate and slip, and the ratio of friction to normal force.
#include <cmath>

#include "system/assembly.hpp"

namespace trammel::model {

Wrench pressed_by(const Mat6& H, double normal, const Tangential& friction) {
  Wrench wrench(H.cols());
  with_twist(H.cols(), [&](auto twist) {
    for (int j = 0; j < twist; ++j) {
      wrench(j) = normal * H(0, j);
      for (Eigen::Index k = 0; k + 1 < H.rows(); ++k) wrench(j) += friction[k] * H(k + 1, j);
    }
  });
  return wrench;
}

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
  const int A = at.A, B = at.B;
  called(model->contacts[std::size_t(i)].name, "motion");
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  const bool tangents = entry.friction != nullptr;
  cache.rows.resize(tangents ? dimension(model->world.space) : 1, model->world.space);
  if (entry.joint) {
    slip_row(i, cache.rows);
  } else if (entry.limit) {
    evaluate_constraint(*entry.limit->joint, entry.limit->joint->row_count(model->world.space), motions(at), at.count,
                        cache.rows);
    if (const double side = entry.limit->side; side != 1) {
      for (Vec6* each : {&cache.rows.g, &cache.rows.g_t, &cache.rows.gamma}) *each *= side;
      for (int k = 0; k < at.count; ++k) cache.rows.H(k) *= side;
    }
  } else if (entry.surface) {
    surfaces[std::size_t(i)].contact->gap_row(here(), cache.rows);
  } else {
    model::contact_rows(entry.geometry, motion(A), motion(B), tangents, cache.rows);
  }
  returned();
  cache.rate = cache.rows.g_t;
  cache.free = cache.rows.gamma;
  for (int k = 0; k < at.count; ++k)
    add_motion({cache.rows.H(k), 0, cache.rate.size()}, motion(at[k]), cache.rate.data(), cache.free.data());
}

SurfaceContact& AssembledSystem::Work::surface(std::size_t i) {
  Pressed& pressed = surfaces[i];
  if (pressed.point != point) {
    called(model->contacts[i].name, "normal");
    pressed.contact->press(here(), modes.contacts[i].approach_speed);
    returned();
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

Tangential AssembledSystem::Work::friction_ratio(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  const ContactMode& mode = modes.contacts[std::size_t(i)];
  if (entry.coulomb && mode.friction == ContactMode::Friction::slide) {
    const Tangential s = slip(i);
    return -entry.coulomb->kinetic_coefficient(s.norm()) * SlipDirection(s, mode.direction, mode.slow).unit();
  }
  if (!entry.smooth) return Tangential::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm();
  return speed > 0 ? Tangential(-entry.smooth->ratio(speed) * (s / speed)) : Tangential(Tangential::Zero());
}

Eigen::Matrix2d AssembledSystem::Work::friction_damping(int i) {
  const ContactEntry& entry = model->contacts[std::size_t(i)];
  if (entry.coulomb) {
    if (tangents(i) == 1 || modes.contacts[std::size_t(i)].friction != ContactMode::Friction::slide)
      return Eigen::Matrix2d::Zero();
    return entry.coulomb->kinetic_coefficient(slip(i).norm()) * slip_direction(i).slope();
  }
  if (!entry.smooth) return Eigen::Matrix2d::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm(), slope = entry.smooth->slope(speed);
  if (speed == 0) return slope * Eigen::Matrix2d::Identity();
  const Tangential e = s / speed;
  const double turning = entry.smooth->ratio(speed) / speed;
  return turning * Eigen::Matrix2d::Identity() + (slope - turning) * e * e.transpose();
}

}  // namespace trammel::model
