#include "model/contact_input.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "model/law_pairs.hpp"
#include "model/scene_keys.hpp"
#include "plugin/parameters.hpp"
#include "scene/suggestion.hpp"

namespace trammel::model {
namespace {

using scene::Problems;
using scene::Value;

class ContactInput {
 public:
  ContactInput(MarkerInput& markers, Model& model, plugin::Registry& registry, Problems& problems)
      : markers_(markers), model_(model), registry_(registry), problems_(problems) {}

  void read(const std::string& name, const Value& value) {
    ContactEntry entry;
    entry.name = name;
    auto [law, origin] = plugin::make<Component>(registry_, Kind::contact, value, model_.world, problems_);
    if (value.find("reaches")) {
      if (!read_limit(value, entry) || !law) return;
      return add(std::move(entry), value, std::move(law), origin);
    }
    if (const Value* from = value.find("from"))
      problems_.error(from->problem("it says from where \"reaches\" is approached, which is missing"));
    const scene::Items* pair = markers_.between(value);
    if (!pair) return;
    if (const Value* radius = value.find("radius")) {
      entry.geometry.radius = radius->read_number(problems_).value_or(0);
      if (entry.geometry.radius < 0)
        problems_.error(radius->problem(fmt::format("found {}, expected a radius >= 0 [m]", entry.geometry.radius)));
    }
    if (!read_sides((*pair)[0], (*pair)[1], value, entry) || !law) return;
    add(std::move(entry), value, std::move(law), origin);
  }

 private:
  // {"plane": {"point": [..], "normal": [..], "on": marker}}: point and normal in the marker's axes.
  bool read_plane(const Value& value, ContactEntry& entry) {
    const Value* plane = value.find("plane");
    if (!plane) {
      problems_.error(
          value.problem("expected {\"plane\": {\"point\": ..., \"normal\": ...}} or {\"surface\": body} as the second "
                        "of \"between\""));
      return false;
    }
    check_keys(value, {"plane"}, problems_);
    if (!check_keys(*plane, {"point", "normal", "on"}, problems_)) return false;
    for (const char* key : {"point", "normal"})
      if (!plane->find(key)) problems_.error(plane->problem(fmt::format("\"{}\" is missing", key)));
    if (const Value* on = plane->find("on")) {
      const auto B = markers_.marker(*on);
      if (!B) return false;
      entry.B = *B;
    }
    if (!plane->find("point") || !plane->find("normal")) return false;
    const auto point = read_vector(*plane->find("point"), model_.world.space, problems_);
    const auto normal = read_vector(*plane->find("normal"), model_.world.space, problems_);
    if (!point || !normal) return false;
    const double length = normal->stableNorm();
    if (!(length > 0)) {
      problems_.error(
          plane->find("normal")->problem("the normal has length 0; expected the direction of the free side"));
      return false;
    }
    const double radius = entry.geometry.radius;
    entry.geometry = PointOnPlane(*point, *normal / length);
    entry.geometry.radius = radius;
    return true;
  }

  // {"surface": "plate"}: index of a body with a surface; -1: a problem was reported.
  int surface_body(const Value& value) {
    check_keys(value, {"surface"}, problems_);
    const auto name = value.find("surface")->read_text(problems_);
    if (!name) return -1;
    std::vector<std::string> with_surface;
    for (int b = 0; b < int(model_.bodies.size()); ++b) {
      const BodyEntry& candidate = model_.bodies[std::size_t(b)];
      if (!dynamic_cast<const SampledSurface*>(candidate.body.get()) ||
          !dynamic_cast<const Surface*>(candidate.body.get()))
        continue;
      with_surface.push_back(candidate.name);
      if (candidate.name == *name) return b;
    }
    problems_.error(value.problem(
        with_surface.empty()
            ? std::string("no body of this scene has a surface; tspline_plate is one")
            : fmt::format("no body \"{}\" with a surface{}", *name, scene::did_you_mean(*name, with_surface))));
    return -1;
  }

  static bool is_surface(const Value& value) { return value.type() == Value::Type::object && value.find("surface"); }
  static bool is_plane(const Value& value) { return value.type() == Value::Type::object && value.find("plane"); }

  // ["ball.com", {"surface": "plate"}]
  bool read_sphere_on_surface(const Value& ball, const Value& surface, ContactEntry& entry) {
    const auto A = markers_.marker(ball);
    const int body = surface_body(surface);
    if (!A || body < 0) return false;
    const double radius = entry.geometry.radius;
    if (!(radius > 0)) {
      problems_.error(surface.problem("a surface is touched by a sphere: give the contact its \"radius\" [m]"));
      return false;
    }
    entry.geometry = PointOnPlane(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
    entry.geometry.radius = radius;
    entry.A = *A, entry.B.body = body;
    entry.surface.emplace().body = body;
    return true;
  }

  // [{"surface": "plate"}, {"plane": ...}] or [{"surface": "upper"}, {"surface": "lower"}]
  bool read_surface_first(const Value& first, const Value& second, const Value& contact, ContactEntry& entry) {
    const int body = surface_body(first);
    if (const Value* radius = contact.find("radius")) {
      problems_.error(radius->problem("a radius belongs to a sphere: [marker, {\"surface\": body}]"));
      return false;
    }
    if (!is_surface(second) && !is_plane(second)) {
      problems_.error(second.problem(
          "expected {\"plane\": {\"point\": ..., \"normal\": ...}} or {\"surface\": body} against the first surface; a "
          "sphere's marker stands before the surface"));
      return false;
    }
    if (body < 0) return false;
    SurfaceSide side;
    side.body = body;
    entry.A.body = body;
    if (is_plane(second)) {
      side.against = SurfaceSide::Against::plane;
      if (!read_plane(second, entry)) return false;
    } else {
      side.against = SurfaceSide::Against::surface;
      entry.B.body = side.other = surface_body(second);
      if (side.other < 0) return false;
      entry.geometry = PointOnPlane(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
    }
    if (!other_may_touch(side, second, contact, entry)) return false;
    entry.surface = std::move(side);
    return true;
  }

  // False, with a problem reported: the other side of the contact is on the same body, or is a surface on which points
  // cannot slide.
  bool other_may_touch(const SurfaceSide& side, const Value& second, const Value& contact, const ContactEntry& entry) {
    const std::string& name = model_.bodies[std::size_t(side.body)].name;
    if (entry.B.body == side.body) {
      problems_.error(contact.problem(
          is_plane(second)
              ? fmt::format("this plane is carried by bodies.{}, whose surface is to touch it", name)
              : fmt::format("the surface of bodies.{} against itself is not possible: its points are nearest to "
                            "themselves; name two bodies, or a marker of the sheet and a plane",
                            name)));
      return false;
    }
    if (side.other >= 0 && !dynamic_cast<const SlidingSurface*>(model_.bodies[std::size_t(side.other)].body.get())) {
      problems_.error(second.problem("points of another surface cannot slide on this one; name it first"));
      return false;
    }
    return true;
  }

  void add_friction(const Value& value, const Component& contact_law, ContactEntry& entry) {
    auto [law, origin] = plugin::make<Component>(registry_, Kind::friction, value, model_.world, problems_);
    if (!law) return;
    const auto* coulomb = dynamic_cast<const SetValuedFriction*>(law.get());
    const auto* smooth = dynamic_cast<const SmoothFriction*>(law.get());
    if (!coulomb == !smooth)
      throw plugin::PluginError(origin, "load",
                                "a friction law is either a SetValuedFriction or a SmoothFriction, exactly one");
    if (const char* const why = why_apart(contact_law, *law)) problems_.error(value.problem(why));
    if (entry.surface) {
      entry.surface->friction = smooth;
      entry.surface->friction_law = std::move(law);
      return;
    }
    entry.coulomb = coulomb, entry.smooth = smooth;
    entry.friction = std::move(law);
    entry.friction_origin = origin;
  }

  void refuse_keys_of_other_contacts(const Value& value, const Value& reaches) {
    for (const char* key : {"radius", "friction"})
      if (const Value* other = value.find(key))
        problems_.error(
            other->problem("it belongs to a contact with a plane or a surface; this one waits for a joint's row"));
    if (const Value* own = reaches.find("between"))
      problems_.error(own->problem("the markers stand in the contact's own \"between\""));
    if (const Value* own = reaches.find("friction"))
      problems_.error(own->problem("this joint is no bearing: it only says what the contact waits for; remove it"));
  }

  // "reaches": a joint with one row; "between": its markers.
  bool read_limit(const Value& value, ContactEntry& entry) {
    const Value& reaches = *value.find("reaches");
    auto [joint, origin] = plugin::make<Constraint>(registry_, Kind::joint, reaches, model_.world, problems_);
    RowLimit limit;
    limit.origin = origin;
    limit.markers = markers_.markers_of(value, joint.get());
    refuse_keys_of_other_contacts(value, reaches);
    if (const Value* from = value.find("from")) {
      const auto side = from->read_text(problems_);
      if (side && *side != "above" && *side != "below")
        problems_.error(from->problem(fmt::format("found \"{}\", expected \"above\" or \"below\"", *side)));
      if (side == "below") limit.side = -1;
    }
    if (!joint || limit.markers.empty()) return false;
    if (const int rows = joint->row_count(model_.world.space); rows != 1) {
      problems_.error(reaches.problem(
          fmt::format("found a joint of {} rows, expected one of a single row, such as distance", rows)));
      return false;
    }
    limit.joint = std::move(joint);
    entry.A = limit.markers[0], entry.B = limit.markers[1];
    entry.geometry =
        PointOnPlane(Vec3::Zero(dimension(model_.world.space)), Vec3::Unit(dimension(model_.world.space), 0));
    entry.limit = std::move(limit);
    return true;
  }

  bool read_sides(const Value& first, const Value& second, const Value& contact, ContactEntry& entry) {
    if (is_surface(first)) return read_surface_first(first, second, contact, entry);
    if (is_surface(second)) return read_sphere_on_surface(first, second, entry);
    if (is_plane(first)) {
      problems_.error(first.problem("a plane stands second, behind what touches it"));
      return false;
    }
    const auto A = markers_.marker(first);
    if (!read_plane(second, entry) || !A) return false;
    entry.A = *A;
    return true;
  }

  void add(ContactEntry entry, const Value& value, std::unique_ptr<Component> law, const plugin::Origin& origin) {
    const bool on_surface = entry.surface.has_value();
    entry.restitution = dynamic_cast<const Restitution*>(law.get());
    entry.force = dynamic_cast<const ContactForce*>(law.get());
    if (!entry.restitution == !entry.force)
      throw plugin::PluginError(origin, "load", "a contact law is either a Restitution or a ContactForce, exactly one");
    const auto* points_law = dynamic_cast<const ForceBySurfacePoints*>(law.get());
    const bool by_points = points_law != nullptr;
    if (by_points != on_surface)
      return problems_.error(value.problem(
          by_points ? "this law acts at the points of a surface: expected {\"surface\": body} in \"between\""
                    : "this law acts at one point; a surface takes one that acts at all of its points, such as "
                      "\"penalty\". Of a body with a surface single markers take this law: [\"BODY.MARKER\", "
                      "{\"plane\": ...}], or against a sphere [\"BODY.MARKER\", \"SPHERE.CENTRE\"] with \"reaches\": "
                      "{\"type\": \"distance\", \"length\": radius}"));
    // Points chosen by the surface represent unequal areas; only a law weighted by area can use them.
    constexpr double no_sphere = std::numeric_limits<double>::infinity();
    if (on_surface && entry.surface->against != SurfaceSide::Against::sphere &&
        std::isinf(points_law->spacing(no_sphere)) && points_law->weight(1) == points_law->weight(2))
      return problems_.error(value.problem(
          "each point bears a force of its own here, not one by its area: say how far the points are apart, "
          "\"spacing\": ... [m]"));
    if (const Value* friction = value.find("friction")) add_friction(*friction, *law, entry);
    entry.law = std::move(law);
    entry.origin = origin;
    model_.contacts.push_back(std::move(entry));
  }

  MarkerInput& markers_;
  Model& model_;
  plugin::Registry& registry_;
  Problems& problems_;
};

}  // namespace

void add_contact(const std::string& name, const Value& value, MarkerInput& markers, Model& model,
                 plugin::Registry& registry, Problems& problems) {
  ContactInput(markers, model, registry, problems).read(name, value);
}

}  // namespace trammel::model
