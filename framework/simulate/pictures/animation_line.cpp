#include "simulate/pictures/animation_line.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace trammel::simulate {

namespace {

using model::ContactEntry;
using model::MarkerRef;

template <class Vector>
void append(const Vector& x, std::string& out) {
  for (Eigen::Index i = 0; i < x.size(); ++i) fmt::format_to(std::back_inserter(out), "{}{:.5g}", i ? "," : "[", x(i));
  out += ']';
}

template <class Columns>
void append_columns(const Columns& points, std::string& out) {
  out += '[';
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    if (j > 0) out += ',';
    append(points.col(j), out);
  }
  out += ']';
}

// Entries of one object. The first entry opens it: without contacts a line has no "contacts".
class Entries {
 public:
  Entries(const char* key, std::string& out) : key_(key), out_(out) {}
  ~Entries() {
    if (open_) out_ += '}';
  }
  Entries(const Entries&) = delete;
  Entries& operator=(const Entries&) = delete;
  void name(const std::string& name) {
    out_ += open_ ? "," : fmt::format(",\"{}\":{{", key_);
    open_ = true;
    out_ += nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + ":";
  }

 private:
  const char* key_;
  std::string& out_;
  bool open_ = false;
};

std::string marker_name(const model::Model& model, MarkerRef marker) {
  if (marker.body < 0) return fmt::format("ground.{}", marker.marker);
  const model::BodyEntry& body = model.bodies[std::size_t(marker.body)];
  return fmt::format("{}.{}", body.name, body.body->markers()[std::size_t(marker.marker)]);
}

bool has_ball(const ContactEntry& contact) {
  return contact.geometry.radius > 0 && !contact.limit && !contact.joint &&
         (!contact.surface || contact.surface->against == model::SurfaceSide::Against::sphere);
}

bool has_plane(const ContactEntry& contact) {
  return !contact.limit && !contact.joint &&
         (!contact.surface || contact.surface->against == model::SurfaceSide::Against::plane);
}

// Where and in which direction the contact pushes its first side; none for joint rows as limits.
struct Push {
  Vec3 at, normal;
};
std::optional<Push> push(model::AssembledSystem& system, const State& state, int i) {
  const ContactEntry& contact = system.model().contacts[std::size_t(i)];
  const double radius = contact.geometry.radius;
  if (has_plane(contact)) {
    const Vec3 normal = system.motion(contact.B).R * contact.geometry.normal;
    return Push{system.contact_marker(i).x - radius * normal, normal};
  }
  if (!contact.surface || contact.surface->against != model::SurfaceSide::Against::sphere) return {};
  const model::BodyEntry& body = system.model().bodies[std::size_t(contact.surface->body)];
  const Vec3 centre = system.motion(contact.A).x;
  Eigen::Vector2d parameters;
  Vec3 point, normal;
  body.surface->nearest(state.t, state.q.segment(body.q0, body.nq), centre, parameters, point, normal);
  const double distance = (centre - point).norm();
  if (!(distance > 0)) return {};
  return Push{point, (centre - point) / distance};
}

}  // namespace

AnimationLine::AnimationLine(const model::Model& model) : model_(model) {
  for (const model::BodyEntry& entry : model.bodies) {
    possible_ = possible_ || entry.drawn;
    if (const auto* faces = dynamic_cast<const HasFaces*>(entry.body.get())) faced_.push_back({&entry, faces});
  }
  for (const ContactEntry& contact : model.contacts) {
    if (!has_ball(contact)) continue;
    std::string name = marker_name(model, contact.A);
    const auto same = [&](const Ball& ball) { return ball.name == name; };
    if (std::none_of(balls_.begin(), balls_.end(), same)) balls_.push_back({std::move(name), contact.A});
  }
}

void AnimationLine::append(model::AssembledSystem& system, const State& state, std::string& out) {
  fmt::format_to(std::back_inserter(out), "{{\"t\":{:.9g}", state.t);
  shapes(state, out);
  faces(state, out);
  joints(system, out);
  contacts(system, state, out);
  forces(system, state, out);
  out += "}\n";
}

void AnimationLine::shapes(const State& state, std::string& out) {
  Entries entries("shapes", out);
  for (const model::BodyEntry& entry : model_.bodies) {
    if (!entry.drawn) continue;
    entry.drawn->shape(state.t, state.q.segment(entry.q0, entry.nq), shape_);
    entries.name(entry.name);
    append_columns(shape_, out);
  }
}

void AnimationLine::faces(const State& state, std::string& out) {
  Entries entries("faces", out);
  for (const Faced& faced : faced_) {
    faced.faces->faces(state.t, state.q.segment(faced.entry->q0, faced.entry->nq), mesh_);
    entries.name(faced.entry->name);
    out += "{\"points\":";
    append_columns(mesh_.points, out);
    out += ",\"values\":";
    simulate::append(mesh_.values, out);
    out += ",\"quads\":[";
    for (std::size_t k = 0; k < mesh_.quads.size(); ++k) {
      const auto& [p, outline] = mesh_.quads[k];
      fmt::format_to(std::back_inserter(out), "{}[{},{},{},{},{}]", k ? "," : "", p[0], p[1], p[2], p[3], outline);
    }
    out += "]}";
  }
}

void AnimationLine::joints(model::AssembledSystem& system, std::string& out) {
  {
    Entries entries("joints", out);
    for (const model::JointEntry& joint : model_.joints) {
      entries.name(joint.name);
      simulate::append(system.motion(joint.markers.front()).x, out);
    }
  }
  Entries entries("balls", out);
  for (const Ball& ball : balls_) {
    entries.name(ball.name);
    simulate::append(system.motion(ball.centre).x, out);
  }
}

void AnimationLine::contacts(model::AssembledSystem& system, const State& state, std::string& out) {
  if (state.lambda.size() != system.sizes().nc) return;
  Entries entries("contacts", out);
  for (std::size_t i = 0; i < model_.contacts.size(); ++i) {
    const int contact = int(i);
    if (!system.modes().contacts[i].closed || model_.contacts[i].joint) continue;
    const auto where = push(system, state, contact);
    if (!where) continue;
    Vec3 force = system.normal_force(contact, state.lambda) * where->normal;
    if (model_.contacts[i].friction) {
      const Vec3 friction = system.along_tangents(contact, system.friction_force(contact, state.lambda));
      force +=
          friction.size() == 1 ? Vec3(friction(0) * Eigen::Vector2d(where->normal(1), -where->normal(0))) : friction;
    }
    if (!force.allFinite()) continue;
    entries.name(model_.contacts[i].name);
    out += '[';
    simulate::append(where->at, out);
    out += ',';
    simulate::append(force, out);
    out += ']';
  }
}

void AnimationLine::forces(model::AssembledSystem& system, const State& state, std::string& out) {
  const int dim = dimension(model_.world.space), twist = dim + rotations(model_.world.space);
  Entries entries("forces", out);
  for (const model::ForceEntry& entry : model_.forces) {
    const Motion A = system.motion(entry.A);  // a copy: the next marker may use the same object
    const Motion& B = system.motion(entry.B);
    Wrench on_A = Wrench::Zero(twist), on_B = Wrench::Zero(twist);
    entry.force->wrench(state.t, A, B, on_A, on_B);
    if (!on_B.allFinite()) continue;
    entries.name(entry.name);
    out += '[';
    simulate::append(entry.from_outside ? B.x : A.x, out);
    out += ',';
    simulate::append(B.x, out);
    out += ',';
    simulate::append(on_B.head(dim), out);
    out += ']';
  }
}

nlohmann::ordered_json still_picture(model::AssembledSystem& system) {
  using Json = nlohmann::ordered_json;
  const model::Model& model = system.model();
  const auto numbers = [](const Vec3& x) { return std::vector<double>(x.data(), x.data() + x.size()); };
  Json planes = Json::array(), balls = Json::object(), joints = Json::object(), values = Json::object();
  for (const ContactEntry& contact : model.contacts) {
    if (has_ball(contact)) balls[marker_name(model, contact.A)] = contact.geometry.radius;
    if (!has_plane(contact) || contact.B.body >= 0) continue;
    const Motion& B = system.motion(contact.B);
    const Vec3 point = B.x + B.R * contact.geometry.point, normal = B.R * contact.geometry.normal;
    const Json plane = {{"point", numbers(point)}, {"normal", numbers(normal)}};
    if (std::find(planes.begin(), planes.end(), plane) == planes.end()) planes.push_back(plane);
  }
  for (const model::JointEntry& joint : model.joints) joints[joint.name] = joint.rows;
  for (const model::BodyEntry& entry : model.bodies)
    if (const auto* faces = dynamic_cast<const HasFaces*>(entry.body.get())) values[entry.name] = faces->face_values();
  return {{"space", model.world.space == Space::planar ? "planar" : "spatial"},
          {"gravity", numbers(model.world.gravity)},
          {"planes", planes},
          {"balls", balls},
          {"joints", joints},
          {"face_values", values}};
}

}  // namespace trammel::simulate
