// The assembled scene: bodies, joints, forces and contacts with their positions in the system's vectors. It is constant
// after it was built, except that a refinement computes a new layout, and shared by every System that uses it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <trammel/body.hpp>
#include <trammel/contact.hpp>
#include <trammel/force.hpp>
#include <trammel/friction.hpp>
#include <trammel/joint.hpp>
#include <trammel/joint_friction.hpp>

#include "plugin/plugin_error.hpp"
#include "scene/laws/resolution.hpp"

namespace trammel::model {

// Index of a marker: of a body, or a fixed frame of the ground (body = -1).
struct MarkerRef {
  int body = -1;
  int marker = 0;  // of the body; for the ground: index into Model::ground_frames
};

// Each entry carries where its component comes from, so that a fault is charged to it.
struct BodyEntry {
  std::string name;
  plugin::Origin origin;
  std::unique_ptr<Body> body;
  // Position of its segments in q and v.
  int q0 = 0, v0 = 0, nq = 0, nv = 0;
  int row = 0, rows = 0;  // of the body's own rows in g
  std::vector<Coordinates::Part> parts;
  // Abilities, looked up once.
  const MassAndForce* mass_and_force = nullptr;
  const ExactTangent* tangent = nullptr;
  const CarriedStress* carried_stress = nullptr;
  const ReactionDerivative* reaction_derivative = nullptr;
  const Constrained* constrained = nullptr;
  const Observed* observed = nullptr;
  const Drawn* drawn = nullptr;
  const HasMomentum* momentum = nullptr;
  Refinable* refinable = nullptr;
  const Surface* surface = nullptr;
  const SampledSurface* samples = nullptr;
  const SlidingSurface* sliding = nullptr;
};

struct JointEntry {
  std::string name;
  plugin::Origin origin;
  std::unique_ptr<Constraint> joint;
  const ReactionTangent* tangent = nullptr;  // ability, looked up once
  std::vector<MarkerRef> markers;
  int row = 0, rows = 0;  // position in g
};

struct ForceEntry {
  std::string name;
  plugin::Origin origin;
  std::unique_ptr<Force> force;
  const WrenchTangent* tangent = nullptr;  // ability, looked up once
  MarkerRef A, B;
  bool from_outside = false;  // "on": A is not a part of the scene, but the frame that the force is given in
};

// A point of A, or a disk or sphere around it, against a plane carried by B: gap = n . (x_A - p) - radius, p and n in
// B's axes; n points to the free side.
struct PointOnPlane {
  PointOnPlane() = default;
  PointOnPlane(const Vec3& p, const Vec3& n);  // n of length 1
  Vec3 point, normal;
  double radius = 0;  // [m]
  Mat3 tangents;      // columns in B's axes, fixed in B, so that the directions of slip do not change
};

// A one-sided joint row: gap = side g >= 0; the row is active (g = 0) while the contact is closed.
struct RowLimit {
  plugin::Origin origin;
  std::unique_ptr<Constraint> joint;         // of one row
  const ReactionTangent* tangent = nullptr;  // ability, looked up once
  std::vector<MarkerRef> markers;
  double side = 1;  // -1: g <= 0 while open
};

// The points of a body's surface against a sphere around A, the plane of B, or the nearest points of another body's
// surface. Forces act at all points with a negative gap (surface_contact.hpp).
struct SurfaceSide {
  enum class Against { sphere, plane, surface };
  Against against = Against::sphere;
  int body = -1;                                    // the body with the points: B against a sphere, else A
  int other = -1;                                   // against another surface: the body B
  const ForceBySurfacePoints* by_points = nullptr;  // ability of the contact's law
  std::unique_ptr<Component> friction_law;          // null: frictionless
  const SmoothFriction* friction = nullptr;
};

// Friction in a joint: a contact that is always closed. Its normal force is the load of the joint's bearings
// (joint_friction.hpp); its only tangent is the free motion of the joint.
struct JointBearing {
  int joint = -1;                         // in Model::joints
  const BearingJoint* bearing = nullptr;  // its ability
};

struct ContactEntry {
  std::string name;
  plugin::Origin origin;           // of its law; of joint friction, of the joint
  plugin::Origin friction_origin;  // of its friction law
  std::string path() const { return (joint ? "joints." : "contacts.") + name; }  // in the scene
  MarkerRef A, B;
  PointOnPlane geometry;          // surface against sphere: only the radius; surface against surface: unused
  std::optional<RowLimit> limit;  // instead of a plane
  std::optional<SurfaceSide> surface;
  std::optional<JointBearing> joint;  // if set, there is no contact law
  std::unique_ptr<Component> law;
  // The law's kind, looked up once; at most one is set.
  const Restitution* restitution = nullptr;
  const ContactForce* force = nullptr;
  std::unique_ptr<Component> friction;  // null: frictionless
  // The kind of the friction law, looked up once; at most one is set.
  const SetValuedFriction* coulomb = nullptr;
  const SmoothFriction* smooth = nullptr;
};

// A frame fixed in the world.
struct GroundFrame {
  Vec3 x;
  double angle = 0;                                 // [rad] in space about `axis`
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // of length 1
};

struct Model {
  World world;
  std::vector<BodyEntry> bodies;
  std::map<std::string, int, std::less<>> body_named;  // in a scene
  std::vector<JointEntry> joints;
  std::vector<ForceEntry> forces;
  std::vector<ContactEntry> contacts;
  std::vector<GroundFrame> ground_frames = {GroundFrame{}};
  std::vector<scene::LawOfTime> laws;  // of all components, each once, without constants
  Sizes sizes;                         // nc: rows of bodies and joints, without contacts
  bool flat = true;                    // no rotation part anywhere: q is a plain vector
  bool constant_mass = true;

  // Assigns positions in q, v and g to every body and joint. Called when the entries are complete and after a
  // refinement.
  void lay_out();
};

// Consecutive rows of one source: "bodies.rod", "joints.hinge".
struct RowGroup {
  std::string path;  // in the scene
  int first = 0, count = 0;
};
std::vector<RowGroup> row_groups(const Model& model);  // all rows except those of contacts, in order

// Rows of the contact's geometry. Row 0: the gap, with G, g_t and gamma of the normal direction. With `tangents`,
// further rows in the directions of B's tangents: g is the coordinate of A in B's plane, its rate the slip velocity.
// For a sticking contact the caller subtracts the coordinate at which sticking began.
void contact_rows(const PointOnPlane& plane, const Motion& A, const Motion& B, bool tangents, Rows& rows);
// The row of the gap between a sphere around A and the nearest point B of a surface; `reach` is the sum of both radii.
void surface_row(double reach, const Motion& A, const Motion& B, Rows& rows);

}  // namespace trammel::model
