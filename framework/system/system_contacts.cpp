// Contact quantities for the Simulator: gaps, rates, accelerations, forces, and the response to impulses.
#include <algorithm>
#include <cmath>

#include "system/parts.hpp"

namespace trammel::model {

double AssembledSystem::gap(int contact) {
  return parts_->contacts.rows(contact).g(0);
}

double AssembledSystem::coordinate(ContactDirection d) {
  return parts_->contacts.rows(d.contact).g(d.row);
}

double AssembledSystem::gap_rate(int contact) {
  return parts_->contacts.rate(contact, 0);
}

double AssembledSystem::rate(ContactDirection d) {
  return parts_->contacts.rate(d.contact, d.row);
}

double AssembledSystem::acceleration(ContactDirection d, const Vec& a) {
  return parts_->contacts.acceleration(d.contact, d.row, a);
}

double AssembledSystem::normal_force(int contact, const Vec& lambda) {
  return parts_->shares.force_along({contact, 0}, lambda);
}

Tangential AssembledSystem::friction_force(int contact, const Vec& lambda) {
  Parts& p = *parts_;
  Tangential T = Tangential::Zero();
  if (p.contacts.mode(contact).friction == ContactMode::Friction::stick) {
    if (p.resting.decides(contact)) return p.resting.force(contact);
    for (int k = 0; k < p.contacts.tangents(contact); ++k) T[k] = p.shares.force_along({contact, 1 + k}, lambda);
    return T;
  }
  if (!p.contacts.entry(contact).friction) return T;
  return p.contacts.friction_ratio(contact) * normal_force(contact, lambda);
}

AssembledSystem::Sharing AssembledSystem::sharing(int contact) const {
  const ContactLoads& loads = parts_->contacts.loads;
  Sharing sharing;
  for (int k = 0; k < 3; ++k) {
    const ContactLoads::Place& place = loads.place({contact, k});
    if (place.group < 0) continue;
    sharing.shared = sharing.shared || loads.depends(place);
    sharing.group = place.group;
    sharing.as_spring = loads.shares_as_spring(contact, place.group);
    sharing.idle = sharing.idle || (k == 0 && loads.shares(place).isZero(0));
  }
  return sharing;
}

double AssembledSystem::spare_load(int group, const Vec& lambda) {
  Parts& p = *parts_;
  const ContactLoads& loads = p.shares.prepared(group, lambda);
  const double spare = loads.spare_load(group);
  if (spare >= 0 || modes().shared[std::size_t(group)].sliding.empty()) return spare;
  return std::max(spare, loads.spare_load_with_sliding(group, p.shares.moved_with_sliding(group)));
}

double AssembledSystem::spare_load_as_springs(int group, const Vec& lambda) {
  Parts& p = *parts_;
  const ContactLoads& loads = p.shares.prepared(group, lambda);
  const double spare = loads.spare_load_as_springs(group);
  if (spare >= 0 || modes().shared[std::size_t(group)].sliding.empty()) return spare;
  return std::max(spare, loads.spare_load_as_springs_with_sliding(group, p.shares.moved_with_sliding(group)));
}

std::vector<ContactSpring> AssembledSystem::find_springs(int group, const Vec& lambda, double round_off) {
  Parts& p = *parts_;
  const ContactLoads& loads = p.shares.prepared(group, lambda);
  const std::vector<ContactSpring> springs = loads.find_springs(group, round_off);
  const bool hold = springs.empty() || springs.front().spring != complementarity::Spring::locked;
  if (hold || modes().shared[std::size_t(group)].sliding.empty()) return springs;
  return loads.find_springs_with_sliding(group, p.shares.moved_with_sliding(group), round_off);
}

std::vector<ContactSpring> AssembledSystem::springs_pushed_by(int group, const Vec& lambda, const Vec& N) {
  return parts_->shares.prepared(group, lambda).springs_pushed_by(group, N);
}

std::vector<Carried> AssembledSystem::carried_as_springs(int group, const Vec& lambda) {
  const ContactLoads& loads = parts_->shares.prepared(group, lambda);
  return loads.carried_as_springs(group, parts_->shares.moved_with_sliding(group));
}

double AssembledSystem::largest_load(int group, const Vec& lambda) {
  return parts_->shares.prepared(group, lambda).largest_load(group);
}

double AssembledSystem::spring_force(int contact, const Vec& lambda) {
  return parts_->shares.spring_force(contact, lambda);
}

double AssembledSystem::departure(int group, const Vec& a) {
  double most = 0;
  for (const ContactDirection& d : modes().shared[std::size_t(group)].implied)
    most = std::max(most, std::abs(acceleration(d, a)));
  return most;
}

double AssembledSystem::leverage(int group) {
  return parts_->shares.leverage(group);
}

double AssembledSystem::off_span(int group) {
  return parts_->shares.off_span(group);
}

Vec AssembledSystem::reactions(const Vec& lambda) {
  return parts_->shares.reactions(lambda);
}

int AssembledSystem::tangents(int contact) const {
  return parts_->contacts.tangents(contact);
}

Tangential AssembledSystem::slip(int contact) {
  return parts_->contacts.slip(contact);
}

Tangential AssembledSystem::slip_acceleration(int contact, const Vec& a) {
  Tangential s = Tangential::Zero();
  for (int k = 0; k < tangents(contact); ++k) s[k] = parts_->contacts.acceleration(contact, 1 + k, a);
  return s;
}

Vec3 AssembledSystem::along_tangents(int contact, const Tangential& x) {
  ContactsAtPoint& contacts = parts_->contacts;
  return contacts.geometry(contact).along_tangents(x, parts_->at.motion(contacts.slots(contact).B));
}

void AssembledSystem::anchor(int contact, ContactMode& mode) {
  parts_->contacts.anchor(contact, mode);
}

void AssembledSystem::step_taken() {
  if (model().world.space == Space::planar || !parts_->contacts.follow_slip()) return;
  parts_->rows.forget();
  ++parts_->at.configuration;
}

void AssembledSystem::impulse_response(const std::vector<ContactDirection>& directions, Mat& jump, Mat& delassus) {
  parts_->evaluate_rows();
  parts_->response.respond(directions, jump, delassus);
}

double AssembledSystem::highest_frequency(const std::vector<ContactDirection>& directions) {
  if (directions.empty()) return 0;
  const Sizes n = sizes();
  Mat jump, delassus;
  impulse_response(directions, jump, delassus);
  const Vec no_a = Vec::Zero(n.nv), no_lambda = Vec::Zero(n.nc);
  const bool sparse = parts_->sparse;
  Mat K = Mat::Zero(sparse ? 0 : n.nv, sparse ? 0 : n.nv), KX;
  if (sparse)
    KX = sparse_tangent({0, 0, 1}, no_a, no_lambda) * jump;
  else
    add_tangent({0, 0, 1}, no_a, no_lambda, K), KX = K * jump;
  Mat MX = Mat::Zero(jump.rows(), jump.cols());
  Vec column;
  for (Eigen::Index i = 0; i < jump.cols(); ++i) {
    column.setZero(jump.rows());
    add_mass_times(1, jump.col(i), column);
    MX.col(i) = column;
  }
  double highest = 0;
  for (Eigen::Index i = 0; i < jump.cols(); ++i) {
    const double stiffness = jump.col(i).dot(KX.col(i)), mass = jump.col(i).dot(MX.col(i));
    if (stiffness > 0 && mass > 0) highest = std::max(highest, std::sqrt(stiffness / mass));
  }
  return highest;
}

const Motion& AssembledSystem::contact_marker(int contact) {
  Parts& p = *parts_;
  const int slot = p.contacts.slots(contact).A;
  if (p.at.markers.on_surface(slot)) p.contacts.rows(contact);  // computes the nearest point
  return p.at.motion(slot);
}

Vec3 AssembledSystem::velocity_apart(int contact) {
  Parts& p = *parts_;
  p.contacts.rows(contact);  // computes the nearest points of surfaces
  const Slots& slots = p.contacts.slots(contact);
  const Eigen::Index dim = p.at.motion(slots.A).x.size();
  return p.at.motion(slots.A).V.head(dim) - p.at.motion(slots.B).V.head(dim);
}

bool AssembledSystem::has_surface_contact(int body) const {
  for (int i = 0; i < parts_->contacts.count(); ++i)
    if (parts_->contacts.presses_surface(i, body)) return true;
  return false;
}

std::vector<double> AssembledSystem::surface_pressure(int body) {
  ContactsAtPoint& contacts = parts_->contacts;
  std::vector<double> by_patch;
  for (int i = 0; i < contacts.count(); ++i) {
    if (!contacts.presses_surface(i, body)) continue;
    by_patch.resize(std::size_t(model().bodies[std::size_t(body)].samples->patches()), 0.0);
    contacts.surface(i).raise_pressure(body, by_patch);
  }
  return by_patch;
}

double AssembledSystem::all_behind_plane(int contact) {
  SurfaceContact* surface = parts_->contacts.surface_of(contact);
  return surface ? surface->all_behind(parts_->at.here()) : -1;
}

}  // namespace trammel::model
