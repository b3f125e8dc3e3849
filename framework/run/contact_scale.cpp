#include "run/contact_scale.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
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

// [m] The largest distance of the other markers from the first.
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

// Round-off of gravity, and of the acceleration of a motion at this speed over this length. A gap may be huge at the
// start; then `place` limits the length.
double Scale::no_acceleration() const {
  const double way = std::max(gaps_and_bodies, place);
  return round_off * std::max(gravity, way > 0 ? speed * speed / way : 0);
}

// Bodies at rest shake by the round-off of the weight that contacts hold, and turn by this divided by their size. A
// smaller error cannot be required; the relative part of the scene's speed always applies to velocities.
Tolerance Scale::in_own_unit(const Tolerance& tolerance, double every) const {
  if (tolerance.absolute > 0) return tolerance;
  const double way = std::max(speed, motion) * every + gravity * every * every;
  const double unit = gaps_and_bodies > 0 ? gaps_and_bodies : way > one_point() ? way : place > one_point() ? place : 1;
  const double length = std::min(1.0, unit), shaking = 256 * std::numeric_limits<double>::epsilon() * gravity * every;
  return {.relative = tolerance.relative,
          .absolute = std::max(tolerance.relative * length, shaking),
          .absolute_rate = std::min(shaking / length, tolerance.relative * std::max(speed, motion))};
}

double Scale::error_of_position(const Tolerance& tolerance) const {
  const double relative = tolerance.relative * length();
  return relative + (tolerance.absolute > 0 ? tolerance.absolute : relative) + resolution();
}

namespace {

// Joins bodies to sets, each named by one of its bodies.
class Islands {
 public:
  explicit Islands(std::size_t bodies) : parent_(bodies) { std::iota(parent_.begin(), parent_.end(), std::size_t(0)); }
  std::size_t of(std::size_t body) {
    while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
    return body;
  }
  void connect(const std::vector<int>& bodies) {  // < 0: the ground
    std::optional<std::size_t> first;
    for (const int body : bodies) {
      if (body < 0) continue;
      const std::size_t island = of(std::size_t(body));
      parent_[island] = first.value_or(island);
      if (!first) first = island;
    }
  }

 private:
  std::vector<std::size_t> parent_;
};

std::vector<int> bodies_of(const model::Model& model, const model::ContactEntry& contact) {
  std::vector<int> all = {contact.A.body, contact.B.body};
  const auto add = [&all](const std::vector<model::MarkerRef>& markers) {
    for (const model::MarkerRef marker : markers) all.push_back(marker.body);
  };
  if (contact.limit) add(contact.limit->markers);
  if (contact.surface) all.push_back(contact.surface->body), all.push_back(contact.surface->other);
  if (contact.joint) add(model.joints[std::size_t(contact.joint->joint)].markers);
  return all;
}

}  // namespace

ContactScale::ContactScale(const model::Model& model) : own_(model.contacts.size()) {
  Islands islands(model.bodies.size());
  for (const model::JointEntry& joint : model.joints) {
    std::vector<int> bodies;
    for (const model::MarkerRef marker : joint.markers) bodies.push_back(marker.body);
    islands.connect(bodies);
  }
  for (const model::ForceEntry& force : model.forces) islands.connect({force.A.body, force.B.body});
  for (const model::ContactEntry& contact : model.contacts) islands.connect(bodies_of(model, contact));
  std::map<std::size_t, std::size_t> numbers;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    island_of_body_.push_back(numbers.try_emplace(islands.of(i), numbers.size()).first->second);
  for (const model::ContactEntry& contact : model.contacts) {
    island_of_contact_.push_back(numbers.size());
    for (const int body : bodies_of(model, contact))
      if (body >= 0) island_of_contact_.back() = island_of_body_[std::size_t(body)];
  }
  islands_.resize(numbers.size() + 1);
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
  Scale& island = islands_[island_of_body_[std::size_t(body)]];
  island.gaps_and_bodies = std::max(island.gaps_and_bodies, own.gaps_and_bodies);
  island.speed = std::max(island.speed, own.speed);
  island.motion = std::max(island.motion, own.motion);
  scene_.place = std::max(scene_.place, own.place);
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const model::ContactEntry& contact = system.model().contacts[i];
    if (contact.A.body == body || contact.B.body == body) own_[i].place = std::max(own_[i].place, own.place);
  }
}

// `off`: the violation of the rows between them, which is no length.
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
  const auto on_body = std::find_if(markers.begin(), markers.end(), [](const auto& m) { return m.body >= 0; });
  Scale& island = on_body == markers.end() ? islands_.back() : islands_[island_of_body_[std::size_t(on_body->body)]];
  island.gaps_and_bodies = std::max(island.gaps_and_bodies, here.gaps_and_bodies);
  island.speed = std::max(island.speed, here.speed);
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
  const double gravity = model.world.gravity.norm();
  for (Scale& island : islands_) island.gravity = gravity;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    own_[i].gravity = gravity;
    take_place(model.contacts[i].geometry.point, own_[i]);
  }
  for (int body = 0; body < int(model.bodies.size()); ++body) take_body(system, body);
  for (const model::JointEntry& joint : model.joints)
    take_distances(system, joint.markers, system.g().segment(joint.row, joint.rows).norm());
  // the place at which a force from outside is given has no meaning
  for (const model::ForceEntry& force : model.forces)
    if (!force.from_outside) take_distances(system, {force.A, force.B}, 0);
  for (std::size_t i = 0; i < own_.size(); ++i)  // any body may strike it
    islands_[island_of_contact_[i]].take_speed(system.velocity_apart(int(i)));
  for (Scale& island : islands_) {
    island.take_fall();
    scene_.raise_to(island);
  }
  take_contacts(system);
}

void ContactScale::take_contacts(model::AssembledSystem& system) {
  for (int i = 0; i < int(own_.size()); ++i) take_contact(system, i);
  scene_.take_fall();
}

Scale ContactScale::of(int contact) const {
  Scale scale = islands_[island_of_contact_[std::size_t(contact)]];
  scale.raise_to(own_[std::size_t(contact)]);
  // If joints rub, a scene may have no length except the gaps of other contacts.
  if (scale.gaps_and_bodies == 0) scale.gaps_and_bodies = scene_.gaps_and_bodies;
  return scale;
}

void ContactScale::archive(Archive& a) {
  std::vector<Scale*> scales;
  for (Scale& own : own_) scales.push_back(&own);
  for (Scale& island : islands_) scales.push_back(&island);
  scales.push_back(&scene_);
  Vec flat(Eigen::Index(5 * scales.size()));
  Eigen::Index k = 0;
  for (const Scale* s : scales) {
    flat.segment<5>(k) << s->gaps_and_bodies, s->place, s->speed, s->motion, s->gravity;
    k += 5;
  }
  a("scales", flat);
  if (flat.size() != k) throw std::length_error("scales");
  k = 0;
  for (Scale* s : scales) {
    *s = {flat[k], flat[k + 1], flat[k + 2], flat[k + 3], flat[k + 4]};
    k += 5;
  }
}

}  // namespace trammel::simulate
