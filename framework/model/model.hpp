// The assembled scene: bodies, joints, forces and contacts with their places in the system's vectors. Constant after it
// is built (but for a refinement, which builds the layout anew); shared by every System that works on it.
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

namespace trammel::model {

// A marker by its place: of a body, or a fixed frame of the ground (body = -1).
struct MarkerRef {
  int body = -1;
  int marker = 0;  // of the body; for the ground: index into Model::ground_frames
};

// Each entry carries where its component comes from, so that a fault is charged to it.
struct BodyEntry {
  std::string name;
  plugin::Origin origin;
  std::unique_ptr<Body> body;
  // Place of its segment in q and v.
  int q0 = 0, v0 = 0, nq = 0, nv = 0;
  int row = 0, rows = 0;  // of its own, in g
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
  int row = 0, rows = 0;  // place in g
};

struct ForceEntry {
  std::string name;
  plugin::Origin origin;
  std::unique_ptr<Force> force;
  MarkerRef A, B;
  bool from_outside = false;  // "on": A is not a part of the scene, but the frame that the force is given in
};

// A point of A, or a disk or sphere around it, against a plane carried by B: gap = n . (x_A - p) - radius, p and n in B's axes;
// n points to the free side.
struct PointOnPlane {
  PointOnPlane() = default;
  PointOnPlane(const Vec3& p, const Vec3& n);  // n of length 1
  Vec3 point, normal;
  double radius = 0;  // [m]
  Mat3 tangents;      // columns in B's axes: fixed in B, so that slip is measured in the same directions throughout
};

// A row of a joint that may have one sign only: gap = side g, until the contact closes and holds it at 0.
struct RowLimit {
  plugin::Origin origin;
  std::unique_ptr<Constraint> joint;         // of one row
  const ReactionTangent* tangent = nullptr;  // ability, looked up once
  std::vector<MarkerRef> markers;
  double side = 1;  // -1: the row comes from below
};

// The points of a body's surface against a sphere around A, the plane of B, or the nearest points of another body's surface; the
// forces act at all points that are reached (surface_contact.hpp).
struct SurfaceSide {
  enum class Against { sphere, plane, surface };
  Against against = Against::sphere;
  int body = -1;                                    // whose points: of B against a sphere, else of A
  int other = -1;                                   // against a surface: that of B
  const ForceBySurfacePoints* by_points = nullptr;  // of the contact's law
  std::unique_ptr<Component> friction_law;          // null: frictionless
  const SmoothFriction* friction = nullptr;
};

// Where a joint rubs: a contact that is always closed, whose normal force is the load of the joint's bearings (joint_friction.hpp)
// and whose only tangent is the motion that the joint leaves free.
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
  PointOnPlane geometry;          // of a surface against a sphere the radius alone, against a surface nothing
  std::optional<RowLimit> limit;  // in its place
  std::optional<SurfaceSide> surface;
  std::optional<JointBearing> joint;  // then there is no law
  std::unique_ptr<Component> law;
  // The law's kind, looked up once; at most one is set.
  const Restitution* restitution = nullptr;
  const ContactForce* force = nullptr;
  std::unique_ptr<Component> friction;  // null: frictionless
  // Its kind, looked up once; at most one is set.
  const SetValuedFriction* coulomb = nullptr;
  const SmoothFriction* smooth = nullptr;
};

// A frame fixed in the world.
struct GroundFrame {
  Vec3 x;
  double angle = 0;                                 // in space about `axis`
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
  Sizes sizes;       // nc counts the rows of bodies and joints alone
  bool flat = true;  // no rotation part anywhere: q is a plain vector
  bool constant_mass = true;

  // Places every body and joint in q, v and g. Called after the entries are complete, and after a refinement.
  void lay_out();
};

// Neighbouring rows of one source: "bodies.rod", "joints.hinge".
struct RowGroup {
  std::string path;  // in the scene
  int first = 0, count = 0;
};
std::vector<RowGroup> row_groups(const Model& model);  // all rows but those of contacts, in their order

// Rows of the contact's geometry: row 0 the gap, G, g_t and gamma of the normal direction; with `tangents` further rows
// are the directions along B's tangents: g is the coordinate of A in B's plane, its rate the slip velocity. Where such a
// row is held the coordinate at which sticking began is subtracted; the geometry does not know it.
void contact_rows(const PointOnPlane& plane, const Motion& A, const Motion& B, bool tangents, Rows& rows);
// The gap alone, between a sphere around A and the point B of a surface that is nearest to it; both radii in `reach`.
void surface_row(double reach, const Motion& A, const Motion& B, Rows& rows);

}  // namespace trammel::model
