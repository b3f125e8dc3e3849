#include "run/contact_scale.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trammel::simulate {
namespace {

void take_place(const Vec3& x, Scale& scale) {
  scale.place = std::max(scale.place, x.cwiseAbs().maxCoeff());
}

Vec3 velocity(const Motion& marker) {
  return marker.V.head(marker.x.size());
}

void take_marker(const Motion& marker, Scale& scale) {
  take_place(marker.x, scale);
  scale.motion = std::max(scale.motion, velocity(marker).cwiseAbs().maxCoeff());
}

// Of the others from the first [m].
double extent(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers) {
  double largest = 0;
  for (const model::MarkerRef marker : markers)
    largest = std::max(largest, (system.motion(marker).x - system.motion(markers.front()).x).norm());
  return largest;
}

}  // namespace

void Scale::take_length(double length) {
  if (length > one_point()) gaps_and_bodies = std::max(gaps_and_bodies, length);
}

void Scale::take_speed(const Vec3& difference) {
  speed = std::max(speed, difference.cwiseAbs().maxCoeff());
}

void Scale::take_fall() {
  speed = std::max(speed, std::sqrt(gravity * gaps_and_bodies));
}

void Scale::raise_to(const Scale& other) {
  gaps_and_bodies = std::max(gaps_and_bodies, other.gaps_and_bodies);
  place = std::max(place, other.place);
  speed = std::max(speed, other.speed);
  motion = std::max(motion, other.motion);
  gravity = std::max(gravity, other.gravity);
}

// Of gravity, and of a motion at this speed through this length. A gap may begin at any size; then the place bounds it.
double Scale::no_acceleration() const {
  const double way = std::max(gaps_and_bodies, place);
  return 1e-12 * std::max(gravity, way > 0 ? speed * speed / way : 0);
}

// Bodies at rest shake by the round-off of the weight that contacts hold: no less is asked for.
Tolerance Scale::in_own_unit(const Tolerance& tolerance, double every) const {
  if (tolerance.absolute > 0) return tolerance;
  const double way = std::max(speed, motion) * every + gravity * every * every;
  const double unit = gaps_and_bodies > 0 ? gaps_and_bodies : way > one_point() ? way : place > one_point() ? place : 1;
  const double round_off = 256 * std::numeric_limits<double>::epsilon() * gravity * every;
  return {tolerance.relative, std::max(tolerance.relative * std::min(1.0, unit), round_off)};
}

double Scale::error_of_position(const Tolerance& tolerance) const {
  const double relative = tolerance.relative * length();
  return relative + (tolerance.absolute > 0 ? tolerance.absolute : relative) + resolution();
}

void ContactScale::take_body(model::AssembledSystem& system, int body) {
  const int markers = int(system.model().bodies[std::size_t(body)].body->markers().size());
  Vec3 low, high, first;
  Scale own;
  for (int marker = 0; marker < markers; ++marker) {
    const Motion& m = system.motion({body, marker});
    take_marker(m, own);
    if (marker == 0) first = velocity(m);
    own.take_speed(velocity(m) - first);
    low = marker == 0 ? m.x : Vec3(low.cwiseMin(m.x)), high = marker == 0 ? m.x : Vec3(high.cwiseMax(m.x));
  }
  if (markers > 0) own.take_length((high - low).norm());
  bodies_.gaps_and_bodies = std::max(bodies_.gaps_and_bodies, own.gaps_and_bodies);
  bodies_.speed = std::max(bodies_.speed, own.speed);
  bodies_.motion = std::max(bodies_.motion, own.motion);
  scene_.place = std::max(scene_.place, own.place);
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const model::ContactEntry& contact = system.model().contacts[i];
    if (contact.A.body == body || contact.B.body == body) own_[i].place = std::max(own_[i].place, own.place);
  }
}

// `off`: by which rows between them do not hold, and which is no length.
void ContactScale::take_distances(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers,
                                  double off) {
  if (markers.empty()) return;
  const Vec3 first = system.motion(markers.front()).x, at_speed = velocity(system.motion(markers.front()));
  Scale here;
  for (const model::MarkerRef marker : markers) take_place(system.motion(marker).x, here);
  for (const model::MarkerRef marker : markers) {
    here.take_length((system.motion(marker).x - first).norm() - off);
    here.take_speed(velocity(system.motion(marker)) - at_speed);
  }
  bodies_.gaps_and_bodies = std::max(bodies_.gaps_and_bodies, here.gaps_and_bodies);
  bodies_.speed = std::max(bodies_.speed, here.speed);
  scene_.place = std::max(scene_.place, here.place);
}

void ContactScale::take_contact(model::AssembledSystem& system, int contact) {
  const model::ContactEntry& entry = system.model().contacts[std::size_t(contact)];
  Scale& own = own_[std::size_t(contact)];
  take_marker(system.contact_marker(contact), own);
  own.take_speed(system.velocity_apart(contact));
  if (!entry.joint) own.speed = std::max(own.speed, std::abs(system.gap_rate(contact)));
  if (entry.friction) own.speed = std::max(own.speed, system.slip(contact).norm());
  if (!entry.joint && !entry.limit) own.take_length(std::abs(system.gap(contact)));
  if (entry.limit) own.take_length(extent(system, entry.limit->markers));  // its gap may be an angle
  own.take_fall();
  scene_.raise_to(own);
}

void ContactScale::take_all(model::AssembledSystem& system) {
  const model::Model& model = system.model();
  bodies_.gravity = model.world.gravity.norm();
  for (std::size_t i = 0; i < own_.size(); ++i) {
    own_[i].gravity = bodies_.gravity;
    take_place(model.contacts[i].geometry.point, own_[i]);
  }
  for (int body = 0; body < int(model.bodies.size()); ++body) take_body(system, body);
  for (const model::JointEntry& joint : model.joints)
    take_distances(system, joint.markers, system.g().segment(joint.row, joint.rows).norm());
  for (const model::ForceEntry& force : model.forces)  // where a force from outside acts from says nothing
    if (!force.from_outside) take_distances(system, {force.A, force.B}, 0);
  for (std::size_t i = 0; i < own_.size(); ++i) bodies_.take_speed(system.velocity_apart(int(i)));  // one may strike it
  bodies_.take_fall();
  scene_.raise_to(bodies_);
  take_contacts(system);
}

void ContactScale::take_contacts(model::AssembledSystem& system) {
  for (int i = 0; i < int(own_.size()); ++i) take_contact(system, i);
  scene_.take_fall();
}

Scale ContactScale::of(int contact) const {
  Scale scale = bodies_;
  scale.raise_to(own_[std::size_t(contact)]);
  // Where joints rub, a scene may have no length but the gaps of others.
  if (scale.gaps_and_bodies == 0) scale.gaps_and_bodies = scene_.gaps_and_bodies;
  return scale;
}

void ContactScale::archive(Archive& a) {
  Mat all(5, Eigen::Index(own_.size()) + 2);
  const auto put = [&](Eigen::Index k, const Scale& s) {
    all.col(k) << s.gaps_and_bodies, s.place, s.speed, s.motion, s.gravity;
  };
  for (std::size_t i = 0; i < own_.size(); ++i) put(Eigen::Index(i), own_[i]);
  put(all.cols() - 2, bodies_), put(all.cols() - 1, scene_);
  Vec flat = Eigen::Map<const Vec>(all.data(), all.size());
  a("scales", flat);
  if (flat.size() != all.size()) throw std::length_error("scales");
  const auto get = [&](Eigen::Index k, Scale& s) {
    s = {flat[5 * k], flat[5 * k + 1], flat[5 * k + 2], flat[5 * k + 3], flat[5 * k + 4]};
  };
  for (std::size_t i = 0; i < own_.size(); ++i) get(Eigen::Index(i), own_[i]);
  get(all.cols() - 2, bodies_), get(all.cols() - 1, scene_);
}

}  // namespace trammel::simulate
