#include "model/build.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "model/scene_keys.hpp"
#include "plugin/parameters.hpp"
#include "scene/suggestion.hpp"

namespace trammel::model {
namespace {

using plugin::Made;
using plugin::Registry;
using scene::Problems;
using scene::Value;

class Builder {
 public:
  Builder(const Value& root, Registry& registry, Problems& problems)
      : root_(root), registry_(registry), problems_(problems), model_(std::make_shared<Model>()) {}

  std::shared_ptr<Model> build() {
    check_keys(root_,
               {"trammel", "title", "description", "plugins", "space", "gravity", "parameters", "bodies", "joints",
                "forces", "contacts", "integrator", "corrections", "initial", "simulate", "static", "record"},
               problems_);
    read_version();
    read_world();
    each("bodies", [this](const std::string& name, const Value& value) { add_body(name, value); });
    if (model_->bodies.empty() && problems_.empty()) problems_.error(root_.problem("the scene has no bodies"));
    each("joints", [this](const std::string& name, const Value& value) { add_joint(name, value); });
    each("forces", [this](const std::string& name, const Value& value) { add_force(name, value); });
    each("contacts", [this](const std::string& name, const Value& value) { add_contact(name, value); });
    model_->lay_out();
    return model_;
  }

 private:
  void read_version() {
    const Value* version = root_.find("trammel");
    if (!version) return problems_.error(root_.problem("\"trammel\": 1 is missing: the version of the scene format"));
    const auto number = version->read_integer(problems_);
    if (number && *number != 1)
      problems_.error(version->problem(fmt::format("found version {} of the scene format, expected 1", *number)));
  }

  void read_world() {
    if (const Value* space = root_.find("space")) {
      const auto text = space->read_text(problems_);
      if (text && *text != "planar" && *text != "spatial")
        problems_.error(space->problem(fmt::format("found \"{}\", expected \"planar\" or \"spatial\"", *text)));
      if (text && *text == "spatial") model_->world.space = Space::spatial;
    }
    const Space space = model_->world.space;
    model_->world.gravity = Vec3::Zero(dimension(space));
    if (const Value* gravity = root_.find("gravity"))
      if (const auto g = read_vector(*gravity, space, problems_)) model_->world.gravity = *g;
    model_->ground_frames[0].x = Vec3::Zero(dimension(space));
  }

  template <class Add>
  void each(const char* group, Add add) {
    const Value* objects = root_.find(group);
    if (!objects) return;
    if (objects->type() != Value::Type::object)
      return problems_.error(
          objects->problem(fmt::format("found {}, expected an object keyed by name", objects->type_name())));
    for (const auto& [name, value] : objects->members()) {
      if (!can_be_a_name(name))
        problems_.error(value.problem(cannot_be_a_name(name)));
      else if (value.type() != Value::Type::object)
        problems_.error(value.problem(fmt::format("found {}, expected an object with \"type\"", value.type_name())));
      else
        add(name, value);
    }
  }

  // Part of paths, "beam.tip.y", like the names of bodies.
  void check_marker_names(const Body& body, const Value& value) {
    const Value* given = value.find("markers");
    for (const std::string& marker : body.markers())
      if (!can_be_a_name(marker)) {
        const Value* at = given ? given->find(marker) : nullptr;
        problems_.error((at ? *at : value).problem(cannot_be_a_name(marker)));
      }
  }

  static bool can_be_a_name(const std::string& name) {
    return !name.empty() && name.find_first_of(".,\"\n\r") == std::string::npos;
  }
  static std::string cannot_be_a_name(const std::string& name) {
    return fmt::format("\"{}\" cannot be a name: names are not empty and have no dot, comma or quote", name);
  }

  void add_body(const std::string& name, const Value& value) {
    for (const char* reserved : {"ground", "energy", "contacts", "joints"})
      if (name == reserved)
        problems_.error(value.problem(fmt::format("a body cannot be called \"{}\": observables use this name", name)));
    auto [body, origin] = plugin::make<Body>(registry_, Kind::body, value, model_->world, problems_);
    if (!body) {
      missing_bodies_ = true;
      return;
    }
    check_marker_names(*body, value);
    BodyEntry entry;
    entry.name = name;
    entry.tangent = dynamic_cast<const ExactTangent*>(body.get());
    entry.reaction_derivative = dynamic_cast<const ReactionDerivative*>(body.get());
    entry.observed = dynamic_cast<const Observed*>(body.get());
    entry.drawn = dynamic_cast<const Drawn*>(body.get());
    entry.body = std::move(body);
    model_->body_named.emplace(name, int(model_->bodies.size()));
    model_->bodies.push_back(std::move(entry));
  }

  // A marker; while a body is missing because of other problems, unknown names would be false alarms.
  std::optional<MarkerRef> marker(const Value& value) {
    if (!missing_bodies_) return read_marker(value, *model_, problems_);
    Problems ignored;
    return read_marker(value, *model_, ignored);
  }

  // The entries of "between", as many as are wanted; nullptr: reported.
  const scene::Items* between(const Value& object, std::size_t count = 2) {
    static const char* const numbers[] = {"two", "three", "four"};
    static const char* const lists[] = {"[A, B]", "[A, B, C]", "[A, B, C, D]"};
    const Value* markers = object.find("between");
    if (!markers) {
      problems_.error(object.problem(fmt::format("\"between\": {} is missing: the {} markers it acts between",
                                                 lists[count - 2], numbers[count - 2])));
      return nullptr;
    }
    if (markers->type() != Value::Type::array || markers->items().size() != count) {
      problems_.error(
          markers->problem(fmt::format("expected {} entries: \"between\": {}", numbers[count - 2], lists[count - 2])));
      return nullptr;
    }
    return &markers->items();
  }

  // A joint's markers, not all of one body; empty: reported.
  std::vector<MarkerRef> markers_of(const Value& object, const Constraint* joint) {
    const scene::Items* names = between(object, joint ? std::size_t(joint->marker_count()) : 2);
    if (!names) return {};
    std::vector<MarkerRef> markers;
    for (const Value& name : *names)
      if (const auto found = marker(name)) markers.push_back(*found);
    if (markers.size() != names->size()) return {};
    for (const MarkerRef& other : markers)
      if (other.body != markers[0].body) return markers;
    const char* const all = markers.size() == 2 ? "both" : "all";
    const int body = markers[0].body;
    problems_.error(object.problem(
        body < 0 ? fmt::format("{} markers are fixed in the world; a joint ties a body to something else", all)
                 : fmt::format("{} markers belong to bodies.{}; a joint ties a body to something else", all,
                               model_->bodies[std::size_t(body)].name)));
    return {};
  }

  void add_joint(const std::string& name, const Value& value) {
    auto [joint, origin] = plugin::make<Constraint>(registry_, Kind::joint, value, model_->world, problems_);
    std::vector<MarkerRef> markers = markers_of(value, joint.get());
    if (!joint || markers.empty()) return;
    JointEntry entry;
    entry.name = name;
    entry.joint = std::move(joint);
    entry.markers = std::move(markers);
    model_->joints.push_back(std::move(entry));
  }

  void add_force(const std::string& name, const Value& value) {
    auto [force, origin] = plugin::make<Force>(registry_, Kind::force, value, model_->world, problems_);
    std::optional<MarkerRef> A, B;
    if (const Value* on = value.find("on")) {
      if (value.find("between")) problems_.error(on->problem("give either \"on\" or \"between\", not both"));
      A = MarkerRef{}, B = marker(*on);
    } else if (!value.find("between")) {
      problems_.error(value.problem("give \"between\": [A, B], or \"on\": A for a force from outside"));
    } else if (const scene::Items* pair = between(value)) {
      A = marker((*pair)[0]), B = marker((*pair)[1]);
    }
    if (!force || !A || !B) return;
    ForceEntry entry;
    entry.name = name;
    entry.force = std::move(force);
    entry.A = *A, entry.B = *B;
    model_->forces.push_back(std::move(entry));
  }

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
      const auto B = marker(*on);
      if (!B) return false;
      entry.B = *B;
    }
    if (!plane->find("point") || !plane->find("normal")) return false;
    const auto point = read_vector(*plane->find("point"), model_->world.space, problems_);
    const auto normal = read_vector(*plane->find("normal"), model_->world.space, problems_);
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

  // {"surface": "plate"}: of a body that has one; -1: reported.
  int surface_body(const Value& value) {
    check_keys(value, {"surface"}, problems_);
    const auto name = value.find("surface")->read_text(problems_);
    if (!name) return -1;
    std::vector<std::string> with_surface;
    for (int b = 0; b < int(model_->bodies.size()); ++b) {
      const BodyEntry& candidate = model_->bodies[std::size_t(b)];
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
    const auto A = marker(ball);
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
    const std::string& name = model_->bodies[std::size_t(body)].name;
    if (entry.B.body == body) {
      problems_.error(contact.problem(
          is_plane(second)
              ? fmt::format("this plane is carried by bodies.{}, whose surface is to touch it", name)
              : fmt::format("the surface of bodies.{} against itself is not possible: its points are nearest to "
                            "themselves; name two bodies, or a marker of the sheet and a plane",
                            name)));
      return false;
    }
    if (side.other >= 0 && !dynamic_cast<const SlidingSurface*>(model_->bodies[std::size_t(side.other)].body.get())) {
      problems_.error(second.problem("points of another surface cannot slide on this one; name it first"));
      return false;
    }
    entry.surface = std::move(side);
    return true;
  }

  void add_surface_friction(const Value& value, ContactEntry& entry) {
    auto [law, origin] = plugin::make<Component>(registry_, Kind::friction, value, model_->world, problems_);
    if (!law) return;
    entry.surface->friction = dynamic_cast<const SmoothFriction*>(law.get());
    if (!entry.surface->friction)
      problems_.error(value.problem(
          "on a surface friction is a force at each point: it takes a smooth law such as regularized_coulomb"));
    entry.surface->friction_law = std::move(law);
  }

  void add_friction(const Value& value, ContactEntry& entry) {
    if (entry.surface) return add_surface_friction(value, entry);
    auto [law, origin] = plugin::make<Component>(registry_, Kind::friction, value, model_->world, problems_);
    if (!law) return;
    entry.coulomb = dynamic_cast<const SetValuedFriction*>(law.get());
    entry.smooth = dynamic_cast<const SmoothFriction*>(law.get());
    if (!entry.coulomb == !entry.smooth)
      throw plugin::PluginError(origin, "load",
                                "a friction law is either a SetValuedFriction or a SmoothFriction, exactly one");
    entry.friction = std::move(law);
    if (entry.restitution && entry.coulomb && entry.coulomb->decide() == SetValuedFriction::Decide::every_evaluation)
      problems_.error(
          value.problem("friction that is decided at every evaluation takes the normal force as given: it needs a "
                        "compliant contact, such "
                        "as continuous_force"));
  }

  // "reaches": a joint of one row, "between": its markers.
  bool read_limit(const Value& value, ContactEntry& entry) {
    const Value& reaches = *value.find("reaches");
    auto [joint, origin] = plugin::make<Constraint>(registry_, Kind::joint, reaches, model_->world, problems_);
    RowLimit limit;
    limit.markers = markers_of(value, joint.get());
    for (const char* key : {"radius", "friction"})
      if (const Value* other = value.find(key))
        problems_.error(
            other->problem("it belongs to a contact with a plane or a surface; this one waits for a joint's row"));
    if (const Value* own = reaches.find("between"))
      problems_.error(own->problem("the markers stand in the contact's own \"between\""));
    if (const Value* from = value.find("from")) {
      const auto side = from->read_text(problems_);
      if (side && *side != "above" && *side != "below")
        problems_.error(from->problem(fmt::format("found \"{}\", expected \"above\" or \"below\"", *side)));
      if (side == "below") limit.side = -1;
    }
    if (!joint || limit.markers.empty()) return false;
    if (const int rows = joint->row_count(model_->world.space); rows != 1) {
      problems_.error(reaches.problem(
          fmt::format("found a joint of {} rows, expected one of a single row, such as distance", rows)));
      return false;
    }
    limit.joint = std::move(joint);
    entry.A = limit.markers[0], entry.B = limit.markers[1];
    entry.geometry =
        PointOnPlane(Vec3::Zero(dimension(model_->world.space)), Vec3::Unit(dimension(model_->world.space), 0));
    entry.limit = std::move(limit);
    return true;
  }

  void add_contact(const std::string& name, const Value& value) {
    ContactEntry entry;
    entry.name = name;
    auto [law, origin] = plugin::make<Component>(registry_, Kind::contact, value, model_->world, problems_);
    if (value.find("reaches")) {
      if (!read_limit(value, entry) || !law) return;
      return add_contact(std::move(entry), value, std::move(law), origin);
    }
    if (const Value* from = value.find("from"))
      problems_.error(from->problem("it says from where \"reaches\" is approached, which is missing"));
    const scene::Items* pair = between(value);
    if (!pair) return;
    if (const Value* radius = value.find("radius")) {
      entry.geometry.radius = radius->read_number(problems_).value_or(0);
      if (entry.geometry.radius < 0)
        problems_.error(radius->problem(fmt::format("found {}, expected a radius >= 0 [m]", entry.geometry.radius)));
    }
    if (!read_sides((*pair)[0], (*pair)[1], value, entry) || !law) return;
    add_contact(std::move(entry), value, std::move(law), origin);
  }

  bool read_sides(const Value& first, const Value& second, const Value& contact, ContactEntry& entry) {
    if (is_surface(first)) return read_surface_first(first, second, contact, entry);
    if (is_surface(second)) return read_sphere_on_surface(first, second, entry);
    if (is_plane(first)) {
      problems_.error(first.problem("a plane stands second, behind what touches it"));
      return false;
    }
    const auto A = marker(first);
    if (!read_plane(second, entry) || !A) return false;
    entry.A = *A;
    return true;
  }

  void add_contact(ContactEntry entry, const Value& value, std::unique_ptr<Component> law,
                   const plugin::Origin& origin) {
    const bool on_surface = entry.surface.has_value();
    entry.restitution = dynamic_cast<const Restitution*>(law.get());
    entry.force = dynamic_cast<const ContactForce*>(law.get());
    if (!entry.restitution == !entry.force)
      throw plugin::PluginError(origin, "load", "a contact law is either a Restitution or a ContactForce, exactly one");
    const bool by_points = dynamic_cast<const ForceBySurfacePoints*>(law.get()) != nullptr;
    if (by_points != on_surface)
      return problems_.error(value.problem(
          by_points
              ? "this law acts at the points of a surface: expected {\"surface\": body} in \"between\""
              : "this law acts at one point; a surface takes one that acts at all of its points, such as \"penalty\". "
                "Of a body with a surface single markers take this law: [\"BODY.MARKER\", {\"plane\": ...}], or "
                "against "
                "a sphere [\"BODY.MARKER\", \"SPHERE.CENTRE\"] with \"reaches\": {\"type\": \"distance\", \"length\": "
                "radius}"));
    if (const Value* friction = value.find("friction")) add_friction(*friction, entry);
    entry.law = std::move(law);
    model_->contacts.push_back(std::move(entry));
  }

  const Value& root_;
  Registry& registry_;
  Problems& problems_;
  std::shared_ptr<Model> model_;
  bool missing_bodies_ = false;
};

}  // namespace

std::shared_ptr<Model> build(const Value& root, Registry& registry, Problems& problems) {
  return Builder(root, registry, problems).build();
}

}  // namespace trammel::model
