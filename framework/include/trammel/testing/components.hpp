// Checks of bodies, joints, forces and contact laws: the properties that assembly relies on, tested at random states by
// differences and balances. `register_suite` of testing/suites.hpp makes one test of each check:
//
//     const auto make = trammel::from_entry<trammel::Body>("build/lib/trammel",
//                                                          R"({"type": "rigid_body", "mass": 2, "inertia": 0.3})");
//     const bool registered = trammel::register_suite("RigidBody", trammel::body_checks(make));
//
// Differences are extrapolated from ten step sizes with an error estimate (Ridders). The allowed deviation is 20 times
// this estimate plus the function's round-off divided by the step. A relative error of 1e-6 in a derivative is
// detected.
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

// Builds a component from its entry in a scene, as a run does, with the plugins in `folder` (the path of a library or
// of a folder of libraries). If the entry is refused, the exception's text is the message that a user would see.
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

// The test states of a body: its initial state with random displacements up to `q` (as increments) and rates up to `v`.
// The largest difference steps are a quarter of these. Choose values over which the body's functions are smooth.
struct BodyStates {
  double q = 0.3, v = 1;
  int count = 4;
  unsigned seed = 1;
};
std::vector<Check> body_checks(const MakerOf<Body>& make, const BodyStates& states = {});

// Whether the reaction acts on A. It does not for a load, which acts on B only, and for gears, whose bearings carry
// part of it.
enum class Reaction { on_A, outside };
std::vector<Check> joint_checks(const MakerOf<Constraint>& make, Space space = Space::planar,
                                Reaction reaction = Reaction::on_A);
std::vector<Check> force_checks(const MakerOf<Force>& make, Space space = Space::planar,
                                Reaction reaction = Reaction::on_A);

// The impact in which a compliant law is tested, and the law's claim about its force at first touch.
struct ContactClaims {
  double mass = 1;               // [kg]
  double speed = 1;              // [m/s] of approach
  bool starts_from_zero = true;  // false: the force jumps at touch because of a damper, as in the Kelvin-Voigt law
};
std::vector<Check> contact_force_checks(const MakerOf<ContactForce>& make, const ContactClaims& claims = {});
std::vector<Check> restitution_checks(const MakerOf<Restitution>& make);

}  // namespace trammel
