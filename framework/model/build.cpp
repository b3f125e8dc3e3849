#include "model/build.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <trammel/awaits_contact.hpp>

#include "model/contact_input.hpp"
#include "model/joint_friction_input.hpp"
#include "model/marker_input.hpp"
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
      : root_(root),
        registry_(registry),
        problems_(problems),
        model_(std::make_shared<Model>()),
        markers_(*model_, problems) {}

  std::shared_ptr<Model> build() {
    check_keys(
        root_,
        {"trammel", "$schema", "title", "description", "include", "plugins", "space", "gravity", "parameters", "bodies",
         "joints", "forces", "contacts", "integrator", "corrections", "initial", "simulate", "static", "record"},
        problems_);
    for (const char* key : {"$schema", "title", "description"})
      if (const Value* text = root_.find(key)) text->read_text(problems_);
    read_version();
    read_world();
    each("bodies", [this](const std::string& name, const Value& value) { add_body(name, value); });
    if (model_->bodies.empty() && problems_.empty()) problems_.error(root_.problem("the scene has no bodies"));
    each("joints", [this](const std::string& name, const Value& value) { add_joint(name, value); });
    each("forces", [this](const std::string& name, const Value& value) { add_force(name, value); });
    each("contacts", [this](const std::string& name, const Value& value) {
      add_contact(name, value, markers_, *model_, registry_, problems_);
    });
    check_awaited_contacts();
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

  // Names of markers are parts of paths such as "beam.tip.y", so the rule for names of bodies applies to them, too.
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
      markers_.a_body_is_missing();
      return;
    }
    check_marker_names(*body, value);
    BodyEntry entry;
    entry.name = name;
    entry.origin = origin;
    entry.tangent = dynamic_cast<const ExactTangent*>(body.get());
    entry.reaction_derivative = dynamic_cast<const ReactionDerivative*>(body.get());
    entry.observed = dynamic_cast<const Observed*>(body.get());
    entry.drawn = dynamic_cast<const Drawn*>(body.get());
    entry.body = std::move(body);
    model_->body_named.emplace(name, int(model_->bodies.size()));
    model_->bodies.push_back(std::move(entry));
  }

  void add_joint(const std::string& name, const Value& value) {
    auto [joint, origin] = plugin::make<Constraint>(registry_, Kind::joint, value, model_->world, problems_);
    std::vector<MarkerRef> markers = markers_.markers_of(value, joint.get());
    if (!joint || markers.empty()) return;
    JointEntry entry;
    entry.name = name;
    entry.origin = origin;
    entry.joint = std::move(joint);
    entry.markers = std::move(markers);
    model_->joints.push_back(std::move(entry));
    if (const Value* friction = value.find("friction"))
      add_joint_friction(value, *friction, *model_, registry_, problems_);
  }

  void add_force(const std::string& name, const Value& value) {
    auto [force, origin] = plugin::make<Force>(registry_, Kind::force, value, model_->world, problems_);
    std::optional<MarkerRef> A, B;
    if (const Value* on = value.find("on")) {
      if (value.find("between")) problems_.error(on->problem("give either \"on\" or \"between\", not both"));
      A = MarkerRef{}, B = markers_.marker(*on);
    } else if (!value.find("between")) {
      problems_.error(value.problem("give \"between\": [A, B], or \"on\": A for a force from outside"));
    } else if (const scene::Items* pair = markers_.between(value)) {
      A = markers_.marker((*pair)[0]), B = markers_.marker((*pair)[1]);
    }
    if (!force || !A || !B) return;
    if (const Value* on = value.find("on"))
      markers_.check_orientation(force.get(), 1, *B, *on);
    else
      for (std::size_t k = 0; k < 2; ++k)
        markers_.check_orientation(force.get(), k, k == 0 ? *A : *B, value.find("between")->items()[k]);
    ForceEntry entry;
    entry.name = name;
    entry.origin = origin;
    entry.force = std::move(force);
    entry.A = *A, entry.B = *B;
    entry.from_outside = value.find("on") != nullptr;
    model_->forces.push_back(std::move(entry));
  }

  void check_awaited_contacts() {
    std::vector<std::string> names;
    if (const Value* contacts = root_.find("contacts"); contacts && contacts->type() == Value::Type::object)
      for (const auto& [name, value] : contacts->members()) names.push_back(name);
    for (const BodyEntry& entry : model_->bodies) {
      const auto* body = dynamic_cast<const AwaitsContact*>(entry.body.get());
      const std::string awaited = body ? body->awaited_contact() : "";
      if (awaited.empty() || std::find(names.begin(), names.end(), awaited) != names.end()) continue;
      problems_.error(plugin::refused(
          *root_.find("bodies")->find(entry.name),
          ParameterError(body->where_awaited(),
                         fmt::format("no contact \"{}\"{}", awaited, scene::did_you_mean(awaited, names)))));
    }
  }

  const Value& root_;
  Registry& registry_;
  Problems& problems_;
  std::shared_ptr<Model> model_;
  MarkerInput markers_;
};

}  // namespace

std::shared_ptr<Model> build(const Value& root, Registry& registry, Problems& problems) {
  return Builder(root, registry, problems).build();
}

}  // namespace trammel::model
