#include "model/joint_friction_input.hpp"

#include <fmt/format.h>

#include "plugin/parameters.hpp"

namespace trammel::model {
namespace {

using scene::Problems;
using scene::Value;

// True if the joint supports the friction of the scene; otherwise reports what it lacks.
bool can_rub(const BearingJoint* bearing, const ContactEntry& entry, const World& world, const Value& joint,
             const Value& friction, Problems& problems) {
  if (!bearing) {
    problems.error(friction.problem(
        "this joint has no bearing that could rub; a joint with one free motion beside its bearing, such as prismatic "
        "or revolute, takes friction"));
    return false;
  }
  try {
    bearing->check_bearings(world);
  } catch (const ParameterError& e) {
    problems.error(plugin::refused(joint, e));
    return false;
  }
  if (!entry.coulomb) return true;
  if (entry.coulomb->decide() == SetValuedFriction::Decide::every_evaluation)
    problems.error(friction.problem(
        "friction that is decided at every evaluation takes the normal force as given; that of a joint's bearing "
        "follows from its reaction: use \"method\": \"events\""));
  else if (bearing->driven())
    problems.error(friction.problem(
        "the joint's motion follows a law of time, so that friction could not hold it; a smooth law, such as "
        "regularized_coulomb, gives the force that the drive has to overcome"));
  else
    return true;
  return false;
}

}  // namespace

void add_joint_friction(const Value& joint, const Value& friction, Model& model, plugin::Registry& registry,
                        Problems& problems) {
  auto [law, origin] = plugin::make<Component>(registry, Kind::friction, friction, model.world, problems);
  if (!law) return;
  const JointEntry& of = model.joints.back();
  ContactEntry entry;
  entry.name = of.name;
  entry.origin = of.origin, entry.friction_origin = origin;
  entry.coulomb = dynamic_cast<const SetValuedFriction*>(law.get());
  entry.smooth = dynamic_cast<const SmoothFriction*>(law.get());
  if (!entry.coulomb == !entry.smooth)
    throw plugin::PluginError(origin, "load",
                              "a friction law is either a SetValuedFriction or a SmoothFriction, exactly one");
  const auto* bearing = dynamic_cast<const BearingJoint*>(of.joint.get());
  if (!can_rub(bearing, entry, model.world, joint, friction, problems)) return;
  entry.A = of.markers[0], entry.B = of.markers[1];
  const int dim = dimension(model.world.space);
  entry.geometry = PointOnPlane(Vec3::Zero(dim), Vec3::Unit(dim, 0));
  entry.friction = std::move(law);
  entry.joint = JointBearing{int(model.joints.size()) - 1, bearing};
  model.contacts.push_back(std::move(entry));
}

}  // namespace trammel::model
