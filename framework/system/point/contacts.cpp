#include "system/point/contacts.hpp"

#include <cmath>
#include <utility>

namespace trammel::model {

ContactsAtPoint::ContactsAtPoint(Point& at) : at_(at) {
  for (const ContactEntry& entry : at_.model->contacts) {
    const auto& geometry = geometries_.emplace_back(make_contact_geometry(*at_.model, entry, at_.markers));
    slots_.push_back(slots_from(geometry->slots()));
    surfaces_.push_back({dynamic_cast<SurfaceContact*>(geometry.get())});
  }
  rows_.resize(geometries_.size());
  modes.contacts.resize(geometries_.size());
  loads.lay_out(modes);
}

void ContactsAtPoint::set_modes(const Modes& new_modes) {
  modes = new_modes;
  loads.lay_out(modes);
  for (Surface& surface : surfaces_) surface.point = -1;  // approach speeds may have changed
}

bool ContactsAtPoint::locks(int i) const {
  const Restitution* law = entry(i).restitution;
  return mode(i).closed && law && law->treatment().release == Restitution::Release::never;
}

const Rows& ContactsAtPoint::rows(int i) {
  OfContact& cache = rows_[std::size_t(i)];
  if (cache.point != at_.number) {
    evaluate(i, cache);
    cache.point = at_.number;
  }
  return cache.rows;
}

void ContactsAtPoint::evaluate(int i, OfContact& cache) {
  const Slots& slots = this->slots(i);
  const Space space = at_.model->world.space;
  const bool tangents = entry(i).friction != nullptr;
  const CallSite around = std::exchange(at_.site, geometry(i).call());
  cache.rows.resize(tangents ? dimension(space) : 1, space);
  geometry(i).rows(at_.here(), cache.rows);
  at_.site = around;
  cache.rate = cache.rows.g_t;
  cache.free = cache.rows.gamma;
  for (int k = 0; k < slots.count; ++k)
    add_motion({cache.rows.H(k), 0, cache.rate.size()}, at_.motion(slots[k]), cache.rate.data(), cache.free.data());
}

SurfaceContact& ContactsAtPoint::surface(int i) {
  Surface& pressed = surfaces_[std::size_t(i)];
  if (pressed.point != at_.number) {
    const CallSite around = at_.site;
    at_.called(entry(i).origin, "normal");
    pressed.contact->press(at_.here(), mode(i).approach_speed);
    at_.site = around;
    pressed.point = at_.number;
  }
  return *pressed.contact;
}

bool ContactsAtPoint::presses_surface(int i, int body) const {
  const auto& side = entry(i).surface;
  return side && mode(i).closed && (side->body == body || side->other == body);
}

double ContactsAtPoint::rate(int i, int row) {
  rows(i);
  return rows_[std::size_t(i)].rate(row);
}

double ContactsAtPoint::acceleration(int i, int row, const Vec& a) {
  const Rows& r = rows(i);
  double sum = -rows_[std::size_t(i)].free(row);
  at_.for_each_entry(slots(i), r, row, [&](double along, int velocity) { sum += along * a(velocity); });
  return sum;
}

double ContactsAtPoint::law_normal(int i) {
  return entry(i).force->normal(rows(i).g(0), rate(i, 0), mode(i).approach_speed);
}

Tangential ContactsAtPoint::slip(int i) {
  Tangential s = Tangential::Zero();
  for (int k = 0; k < tangents(i); ++k) s[k] = rate(i, 1 + k);
  return s;
}

SlipDirection ContactsAtPoint::slip_direction(int i) {
  return {slip(i), mode(i).direction, mode(i).least_slip};
}

// Evaluates the friction law, with its component named in the call site.
template <class Call>
double ContactsAtPoint::ask_friction(int i, const char* name, Call call) {
  return call_inside(at_.site, entry(i).friction_origin, name, call);
}

Tangential ContactsAtPoint::friction_ratio(int i) {
  const ContactEntry& entry = this->entry(i);
  if (entry.coulomb && mode(i).friction == ContactMode::Friction::slide) {
    const Tangential s = slip(i);
    const double mu =
        ask_friction(i, "kinetic_coefficient", [&] { return entry.coulomb->kinetic_coefficient(s.norm()); });
    return -mu * SlipDirection(s, mode(i).direction, mode(i).least_slip).unit();
  }
  if (!entry.smooth || mode(i).friction == ContactMode::Friction::stick) return Tangential::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm();
  if (!(speed > 0)) return Tangential::Zero();
  return -ask_friction(i, "ratio", [&] { return entry.smooth->ratio(speed); }) * (s / speed);
}

Eigen::Matrix2d ContactsAtPoint::friction_damping(int i) {
  const ContactEntry& entry = this->entry(i);
  if (entry.coulomb) {
    if (tangents(i) == 1 || mode(i).friction != ContactMode::Friction::slide) return Eigen::Matrix2d::Zero();
    const double speed = slip(i).norm();
    const double mu = ask_friction(i, "kinetic_coefficient", [&] { return entry.coulomb->kinetic_coefficient(speed); });
    return mu * slip_direction(i).slope();
  }
  if (!entry.smooth || mode(i).friction == ContactMode::Friction::stick) return Eigen::Matrix2d::Zero();
  const Tangential s = slip(i);
  const double speed = s.norm();
  const double slope = ask_friction(i, "slope", [&] { return entry.smooth->slope(speed); });
  if (speed == 0) return slope * Eigen::Matrix2d::Identity();
  const Tangential e = s / speed;
  const double turning = ask_friction(i, "ratio", [&] { return entry.smooth->ratio(speed); }) / speed;
  return turning * Eigen::Matrix2d::Identity() + (slope - turning) * e * e.transpose();
}

Eigen::Matrix3d ContactsAtPoint::seen_from_B(int i) {
  return at_.motion(slots(i).B).R.transpose() * at_.motion(slots(i).A).R;
}

Tangential ContactsAtPoint::displacement(int i) {
  Tangential x = geometry(i).coordinates_from(mode(i).anchor, rows(i));
  if (geometry(i).rolls()) x += geometry(i).rolled(seen_from_B(i) * mode(i).rolled_from.transpose());
  return x;
}

void ContactsAtPoint::anchor(int i, ContactMode& mode) {
  const Rows& r = rows(i);
  for (int k = 0; k < tangents(i); ++k) mode.anchor[k] = r.g(1 + k);
  if (geometry(i).rolls()) mode.rolled_from = seen_from_B(i);
}

bool ContactsAtPoint::follow_slip() {
  bool rolled = false;
  for (int i = 0; i < count(); ++i) {
    ContactMode& mode = modes.contacts[std::size_t(i)];
    if (!mode.closed || mode.friction == ContactMode::Friction::none || tangents(i) == 1) continue;
    if (mode.friction == ContactMode::Friction::slide) {
      const Tangential s = slip(i);
      if (s.dot(mode.direction) > mode.least_slip) mode.direction = s / std::hypot(s[0], s[1]);
    } else if (geometry(i).rolls()) {
      anchor(i, mode);
      rolled = true;
    }
  }
  return rolled;
}

std::vector<int> ContactsAtPoint::acting_with(ContactDirection d) const {
  std::vector<int> contacts = {d.contact};
  const int group = loads.place(d).group;
  if (group < 0) return contacts;
  for (int i = 0; i < count(); ++i)  // their loads may depend on the shares
    if (i != d.contact && in_joint(i)) contacts.push_back(i);
  if (modes.shared[std::size_t(group)].sliding.empty()) return contacts;
  for (const auto* directions : {&modes.shared[std::size_t(group)].basis, &modes.shared[std::size_t(group)].implied})
    for (const ContactDirection& other : *directions)
      if (other.contact != d.contact && other.row == 0) contacts.push_back(other.contact);
  return contacts;
}

}  // namespace trammel::model
