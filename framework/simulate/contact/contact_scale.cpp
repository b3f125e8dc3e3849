#include "simulate/contact/contact_scale.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {
namespace {

// The origin stands for what a force from outside acts from; how far off it is says nothing.
bool from_outside(const model::ForceEntry& force) {
  return force.A.body < 0 && force.A.marker == 0;
}

}  // namespace

void ContactScale::take(const Motion& marker) {
  place_ = std::max(place_, marker.x.cwiseAbs().maxCoeff());
  speed_ = std::max(speed_, marker.V.head(marker.x.size()).cwiseAbs().maxCoeff());
}

void ContactScale::take_length(double length) {
  if (length > one_point()) length_ = std::max(length_, length);
}

// `off`: by which rows between them do not hold, and which is no length.
void ContactScale::take_distances(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers,
                                  double off) {
  if (markers.empty()) return;
  const Vec3 first = system.motion(markers.front()).x;
  for (const model::MarkerRef marker : markers) {
    const Vec3& x = system.motion(marker).x;
    place_ = std::max(place_, x.cwiseAbs().maxCoeff());
    take_length((x - first).norm() - off);
  }
}

void ContactScale::take_gaps(model::AssembledSystem& system) {
  const model::Model& model = system.model();
  for (int i = 0; i < int(model.contacts.size()); ++i) {
    const model::ContactEntry& contact = model.contacts[std::size_t(i)];
    if (contact.joint || contact.limit) continue;
    take_length(std::abs(system.gap(i)));
  }
  gravity_ = model.world.gravity.norm();
  speed_ = std::max(speed_, std::sqrt(gravity_ * length_));
}

void ContactScale::take_all(model::AssembledSystem& system) {
  const model::Model& model = system.model();
  for (int body = 0; body < int(model.bodies.size()); ++body) {
    const int markers = int(model.bodies[std::size_t(body)].body->markers().size());
    Vec3 low, high;
    for (int marker = 0; marker < markers; ++marker) {
      const Motion& m = system.motion({body, marker});
      take(m);
      low = marker == 0 ? m.x : Vec3(low.cwiseMin(m.x)), high = marker == 0 ? m.x : Vec3(high.cwiseMax(m.x));
    }
    if (markers > 0) take_length((high - low).norm());
  }
  for (const model::ContactEntry& contact : model.contacts)
    place_ = std::max(place_, contact.geometry.point.cwiseAbs().maxCoeff());
  for (const model::JointEntry& joint : model.joints)
    take_distances(system, joint.markers, system.g().segment(joint.row, joint.rows).norm());
  for (const model::ForceEntry& force : model.forces)
    if (!from_outside(force)) take_distances(system, {force.A, force.B}, 0);
  take_gaps(system);
}

void ContactScale::take_contacts(model::AssembledSystem& system) {
  for (int i = 0; i < int(system.model().contacts.size()); ++i) take(system.contact_marker(i));
  take_gaps(system);
}

// Of gravity, and of a motion at this speed through this length. A gap may begin at any size; then the place bounds it.
double ContactScale::no_acceleration() const {
  const double way = std::max(length_, place_);
  return way > 0 ? 1e-12 * std::max(gravity_, speed_ * speed_ / way) : 0;
}

// Bodies at rest shake by the round-off of the weight that contacts hold: no less is asked for.
Tolerance ContactScale::in_own_unit(const Tolerance& tolerance, double every) const {
  if (tolerance.absolute > 0) return tolerance;
  const double way = speed_ * every + gravity_ * every * every;
  const double unit = length_ > 0 ? length_ : way > one_point() ? way : place_ > one_point() ? place_ : 1;
  const double round_off = 256 * std::numeric_limits<double>::epsilon() * gravity_ * every;
  return {tolerance.relative, std::max(tolerance.relative * std::min(1.0, unit), round_off)};
}

double ContactScale::error_of_position(const Tolerance& tolerance) const {
  const double relative = tolerance.relative * length();
  return relative + (tolerance.absolute > 0 ? tolerance.absolute : relative) + resolution();
}

void ContactScale::archive(Archive& a) {
  a("scale_length", length_), a("scale_place", place_), a("scale_speed", speed_), a("scale_gravity", gravity_);
}

}  // namespace trammel::simulate
