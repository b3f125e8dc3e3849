// Checks of bodies, joints, forces and contact laws: what each owes the assembly, tried at random states against differences
// and balances. `register_suite` of testing_suites.hpp makes a test of each:
//
//     const bool registered = trammel::register_suite("RigidBody", trammel::body_checks(
//         trammel::from_entry<trammel::Body>("build/lib/trammel", R"({"type": "rigid_body", "mass": 2, "inertia": 0.3})")));
//
// Differences are extrapolated from ten step sizes (Ridders) and bring their own error; what is compared may be off by 20
// times that and by round-off of the compared function over the step, nothing else. A relative error of 1e-6 is found.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <trammel/body.hpp>
#include <trammel/contact.hpp>
#include <trammel/force.hpp>
#include <trammel/joint.hpp>
#include <trammel/testing/measurements.hpp>

namespace trammel {

// Gives a fresh, prepared component at each call.
template <class T>
using MakerOf = std::function<std::unique_ptr<T>()>;

// As a run makes it: its entry in a scene, from the plugins in `folder` (a path to a library or a folder of them).
// Throws what the user would read when the entry is refused.
std::unique_ptr<Component> make_component(const std::string& folder, Kind kind, const std::string& entry,
                                          const World& world);

template <class T>
constexpr Kind kind_of = std::is_same_v<T, Body>            ? Kind::body
                         : std::is_base_of_v<Constraint, T> ? Kind::joint
                         : std::is_same_v<T, Force>         ? Kind::force
                                                            : Kind::contact;

template <class T>
MakerOf<T> from_entry(const std::string& folder, const std::string& entry, const World& world = {}) {
  return [=] {
    std::unique_ptr<Component> made = make_component(folder, kind_of<T>, entry, world);
    return std::unique_ptr<T>(&dynamic_cast<T&>(*made.release()));
  };
}

// Where a body is tried: its initial state displaced at random by up to `q` (as increments), with rates up to `v`. The
// derivatives' largest steps are a quarter of these: choose them so that the body's functions are smooth over them.
struct BodyStates {
  double q = 0.3, v = 1;
  int count = 4;
  unsigned seed = 1;
};
std::vector<Check> body_checks(const MakerOf<Body>& make, const BodyStates& states = {});

// A load acts on B only and owes no reaction; the bearings of gears take part of theirs.
enum class Reaction { on_A, outside };
std::vector<Check> joint_checks(const MakerOf<Constraint>& make, Space space = Space::planar,
                                Reaction reaction = Reaction::on_A);
std::vector<Check> force_checks(const MakerOf<Force>& make, Space space = Space::planar,
                                Reaction reaction = Reaction::on_A);

// The impact that a compliant law is tried in, and what the law says of the moment of touch.
struct ContactClaims {
  double mass = 1;               // [kg]
  double speed = 1;              // [m/s] of approach
  bool starts_from_zero = true;  // false: a damper acts at once, as in Kelvin and Voigt's law
};
std::vector<Check> contact_force_checks(const MakerOf<ContactForce>& make, const ContactClaims& claims = {});
std::vector<Check> restitution_checks(const MakerOf<Restitution>& make);

}  // namespace trammel
