// Every component that Trammel ships goes through the checks that authors of others use, in every form that differs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include <trammel/testing/suites.hpp>

#include "support/made.hpp"

namespace trammel::test {
namespace {

const std::string folder = TRAMMEL_BUILD_DIR "/lib/trammel";

struct Shipped {
  std::string name, form, entry;  // name: as in a scene
  Space space = Space::planar;
};
World world_of(const Shipped& s) {
  World world = s.space == Space::planar ? planar() : spatial();
  if (s.name == "slider_crank_rod") world.gravity.setZero();  // the body has no gravity
  return world;
}
std::string suite(const std::string& kind, const Shipped& s) {
  return kind + "_" + s.name + (s.form.empty() ? "" : "_" + s.form);
}

const char* const plain_beam = R"({"type": "assumed_mode_beam", "length": 1, "area": 3.14e-4, "second_moment": 7.85e-9,
  "density": 2766.7, "youngs_modulus": 6.8952e10, "angle": 0.7,
  "markers": {"middle": 0.4}, )";
std::string beam(const std::string& more, const char* static_functions = "false") {
  return fmt::format(R"({}"modes": {{"axial": 3, "transverse": 3, "static_axial": {}, "static_transverse": {}}}, {}}})",
                     plain_beam, static_functions, static_functions, more);
}
const std::string hinge = R"("mount": {"hinge": [0.3, -0.1]}, "hub_radius": 0.2, "hub_inertia": 0.05)";

const std::vector<Shipped>& bodies() {
  static const std::vector<Shipped> all = {
      {"rigid_body", "",
       R"({"type": "rigid_body", "mass": 2, "inertia": 0.3, "angle": 0.4, "markers": {"tip": [0.6, 0.1]}})"},
      {"rigid_body", "spatial",
       R"({"type": "rigid_body", "mass": 2, "inertia": [0.3, 0.5, 0.4, 0.05, -0.1, 0.02], "axis": [1, 2, 0], "angle": 0.4,
           "markers": {"tip": [0.6, 0.1, -0.3]}})",
       Space::spatial},
      {"slider_crank_rod", "", R"({"type": "slider_crank_rod", "angle": 0.4})"},
      {"point_mass", "planar", R"({"type": "point_mass", "mass": 2.5})"},
      {"point_mass", "spatial", R"({"type": "point_mass", "mass": 2.5})", Space::spatial},
      {"bar", "planar", R"({"type": "bar", "mass": 2.5, "from": [0.3, -1], "to": [2.3, 3], "end_masses": [0.4, 1.1],
        "markers": {"beyond": 1.2}})"},
      {"bar", "spatial", R"({"type": "bar", "mass": 2.5, "from": [0.3, -1, 1], "to": [2.3, 3, -2]})", Space::spatial},
      {"assumed_mode_beam", "hinged", beam(hinge)},
      {"assumed_mode_beam", "driven", beam(hinge + R"x(, "torque": "=3*sin(5*t)")x")},
      {"assumed_mode_beam", "clamped", beam(R"("mount": {"clamped": [0, 0]})")},
      {"assumed_mode_beam", "with_static_functions", beam(hinge, "true")},
      {"assumed_mode_beam", "free_with_static_functions", beam(R"("mount": {"free": [0.5, 1]})", "true")},
      {"assumed_mode_beam", "free", beam(R"("mount": {"free": [0.5, 1]})")},
      {"assumed_mode_beam", "linear", beam(hinge + R"(, "coupling": "linear")")},
      {"assumed_mode_beam", "uncoupled", beam(hinge + R"(, "coupling": "none")")},
      {"assumed_mode_beam", "uncoupled_clamped", beam(R"("mount": {"clamped": [0, 0]}, "coupling": "none")")},
      {"moving_base", "planar",
       R"x({"type": "moving_base", "x": "=0.3*sin(2*t)", "y": "=0.1*t^2", "angle": "=0.4*cos(3*t)",
        "markers": {"corner": [1.5, -0.7]}})x"},
      {"moving_base", "spatial", R"x({"type": "moving_base", "x": "=0.3*sin(2*t)", "y": "=t", "z": "=0.1*t^3",
        "angle": "=0.4*cos(3*t)", "axis": [1, 2, -2], "markers": {"corner": [1.5, -0.7, 0.4]}})x",
       Space::spatial},
      // Large, so that random displacements of a metre stay smooth.
      {"tspline_plate", "", R"({"type": "tspline_plate", "thickness": 3, "density": 0.01, "youngs_modulus": 10,
        "geometry": {"along_u": [30, 0, 0], "along_v": [0, 30, 0]}, "mesh": {"elements": "1x1"}})",
       Space::spatial},
      {"tspline_plate", "joined", R"({"type": "tspline_plate", "thickness": 3, "density": 0.01, "youngs_modulus": 10,
        "patches": {"a": {"geometry": {"along_u": [30, 0, 0], "along_v": [0, 30, 0]}, "mesh": {"elements": "1x1"}},
                    "b": {"geometry": {"origin": [30, 0, 0], "along_u": [20, 0, 0], "along_v": [0, 30, 0]},
                          "mesh": {"elements": "1x1"}}},
        "joined": {"middle": {"from": "a.u1", "to": "b.u0"}}})",
       Space::spatial},
  };
  return all;
}
// Amplitudes of some per cent of the beam's length, where every term counts.
BodyStates states_of(const Shipped& s) {
  if (s.name == "slider_crank_rod") return {.q = 1e-3, .v = 1};
  return s.name == "assumed_mode_beam" ? BodyStates{.q = 0.02, .v = 2} : BodyStates{.q = 1, .v = 3};
}

const std::vector<Shipped>& joints() {
  static const std::vector<Shipped> all = {
      {"revolute", "", R"({"type": "revolute"})"},
      {"revolute", "driven", R"({"type": "revolute", "angle": "=sin(3*t)*0.3+2*t"})"},
      {"revolute", "spatial", R"({"type": "revolute", "axis": [1, 2, -1], "axis_b": [0, 1, 1]})", Space::spatial},
      {"revolute", "spatial_driven", R"({"type": "revolute", "axis": [1, 2, -1], "angle": "=sin(3*t)*0.3+t"})",
       Space::spatial},
      {"spherical", "", R"({"type": "spherical"})"},
      {"spherical", "spatial", R"({"type": "spherical"})", Space::spatial},
      {"universal", "", R"({"type": "universal", "axis": [1, 2, -1], "axis_b": [0, 1, 1]})", Space::spatial},
      {"cylindrical", "", R"({"type": "cylindrical", "axis": [1, 2, -1], "axis_b": [0, 1, 1]})", Space::spatial},
      {"cylindrical", "driven",
       R"({"type": "cylindrical", "axis": [1, 2, -1], "position": "=sin(2*t)*0.4", "angle": "=t^2"})", Space::spatial},
      {"prismatic", "position", R"({"type": "prismatic", "axis": [3, 1], "position": "=cos(2*t)*0.4"})"},
      {"prismatic", "spatial",
       R"({"type": "prismatic", "axis": [1, 2, -1], "orientation": [2, 1, 0, -1], "angle": 0.3})", Space::spatial},
      {"prismatic", "spatial_driven",
       R"({"type": "prismatic", "axis": [1, 2, -1], "angle": "=sin(2*t)*1", "position": "=t^2"})", Space::spatial},
      {"fixed", "spatial", R"({"type": "fixed", "orientation": [2, 1, 0, -1]})", Space::spatial},
      {"fixed", "spatial_driven", R"({"type": "fixed", "axis": [0, 1, 3], "angle": "=(1+t)^2-3*t"})", Space::spatial},
      {"point_on_line", "", R"({"type": "point_on_line", "axis": [1, -2], "position": "=cos(2*t)*0.4"})"},
      {"point_on_line", "spatial", R"({"type": "point_on_line", "axis": [1, -2, 2]})", Space::spatial},
      {"point_on_plane", "", R"({"type": "point_on_plane", "normal": [1, 3], "height": "=0.2*t^2"})"},
      {"point_on_plane", "spatial", R"({"type": "point_on_plane", "normal": [1, 3, 1], "height": "=0.2*t^2"})",
       Space::spatial},
      {"gear", "", R"({"type": "gear", "teeth": [12, 17], "internal": true, "phase": 0.3})"},
      {"gear", "spatial", R"({"type": "gear", "teeth": [12, 17], "axis": [1, 2, 0], "axis_b": [0, 1, 1]})",
       Space::spatial},
      {"equal_distance", "", R"({"type": "equal_distance", "length": 0.7})"},
      {"equal_distance", "spatial", R"({"type": "equal_distance"})", Space::spatial},
      {"synchronising_hinge", "", R"({"type": "synchronising_hinge", "angle": 0.6, "length": 0.7})"},
      {"synchronising_hinge", "spatial", R"({"type": "synchronising_hinge", "angle": 0.6})", Space::spatial},
      {"straight_hinge", "", R"({"type": "straight_hinge", "length": 0.7})"},
      {"straight_hinge", "spatial", R"({"type": "straight_hinge"})", Space::spatial},
      {"coplanar", "", R"({"type": "coplanar", "length": 0.7})", Space::spatial},
      {"prismatic", "", R"({"type": "prismatic", "axis": [2, 1], "angle": 0.3})"},
      {"prismatic", "driven", R"({"type": "prismatic", "axis": [0, 1], "angle": "=sin(3*t)*0.4"})"},
      {"fixed", "", R"({"type": "fixed", "angle": -0.2})"},
      {"fixed", "driven", R"({"type": "fixed", "angle": "=(1+t)^2-3*t"})"},
      {"distance", "", R"({"type": "distance", "length": 1.3})"},
      {"distance", "driven", R"({"type": "distance", "length": "=sin(2*t)*0.4+1.3"})"},
      {"distance", "spatial", R"({"type": "distance", "length": 1.3})", Space::spatial},
      {"distance", "spatial_driven", R"({"type": "distance", "length": "=sin(2*t)*0.4+1.3"})", Space::spatial},
  };
  return all;
}

const std::vector<Shipped>& forces() {
  static const std::vector<Shipped> all = {
      {"spring_damper", "", R"({"type": "spring_damper", "stiffness": 40, "damping": 3, "length": 0.7})"},
      {"spring_damper", "spring", R"({"type": "spring_damper", "stiffness": 40, "length": 0.7})"},
      {"spring_damper", "damper", R"({"type": "spring_damper", "damping": 3})"},
      {"spring_damper", "spatial", R"({"type": "spring_damper", "stiffness": 40, "damping": 3, "length": 0.7})",
       Space::spatial},
      {"hinge_spring", "", R"({"type": "hinge_spring", "stiffness": 2, "arms": [1.65, 1.7]})"},
      {"hinge_spring", "spatial", R"({"type": "hinge_spring", "stiffness": 2, "arms": 1.9})", Space::spatial},
      {"torsional_spring", "", R"({"type": "torsional_spring", "stiffness": 12, "damping": 0.8, "angle": 0.4})"},
      {"torsional_spring", "spatial",
       R"({"type": "torsional_spring", "stiffness": 12, "damping": 0.8, "angle": 0.4, "axis": [1, 2, -1]})",
       Space::spatial},
      {"bushing", "", R"({"type": "bushing", "stiffness": [40, 7], "damping": [1, 2], "torsional_stiffness": 3})"},
      {"bushing", "spatial", R"({"type": "bushing", "stiffness": [40, 7, 20], "damping": [1, 2, 0.5],
        "torsional_stiffness": [3, 5, 2], "torsional_damping": [0.3, 0.1, 0.2]})",
       Space::spatial},
      {"drive", "", R"({"type": "drive", "stall": 4, "free_speed": 30, "command": "=cos(t)*0.8"})"},
      {"drive", "spatial", R"({"type": "drive", "stall": 4, "free_speed": 30, "axis": [1, 2, -1]})", Space::spatial},
      {"load", "torque", R"({"type": "load", "torque": {"x": 1, "y": "=-4*t"}, "frame": "body"})", Space::spatial},
      {"load", "", R"({"type": "load", "force": {"x": "=3*t", "y": -2}, "moment": "=cos(t)*1"})"},
      {"load", "follower", R"({"type": "load", "force": {"x": 5, "y": "=sin(t)*1"}, "frame": "body"})"},
      {"load", "spatial", R"({"type": "load", "force": {"x": 1, "z": "=-4*t"}})", Space::spatial},
  };
  return all;
}

std::string compliant(const std::string& damping, double e) {
  return R"({"type": "continuous_force", "stiffness": 1e8, "damping": ")" + damping + R"(", "restitution": )" +
         std::to_string(e) + "}";
}
const std::vector<Shipped>& compliant_contacts() {
  static const std::vector<Shipped> all = {
      {"continuous_force", "none", compliant("none", 0.3)},
      {"continuous_force", "hunt_crossley", compliant("hunt_crossley", 0.3)},
      {"continuous_force", "lankarani_nikravesh", compliant("lankarani_nikravesh", 0.3)},
      {"continuous_force", "paper", compliant("paper", 0.3)},
      {"continuous_force", "flores", compliant("flores", 0.3)},
      {"continuous_force", "flores_nearly_plastic", compliant("flores", 0.05)},
      {"penalty", "elastic", R"({"type": "penalty", "stiffness": 1e8})"},
  };
  return all;
}
const std::vector<Shipped>& set_valued_contacts() {
  static const std::vector<Shipped> all = {
      {"constraint_method", "", R"({"type": "constraint_method", "restitution": 0.3})"},
      {"constraint_method", "poisson", R"({"type": "constraint_method", "restitution": 0.3, "impact_law": "poisson"})"},
      {"constraint_method", "energetic",
       R"({"type": "constraint_method", "restitution": 0.3, "impact_law": "energetic"})"},
      {"latch", "", R"({"type": "latch"})"},
      {"constraint_method", "elastic", R"({"type": "constraint_method", "restitution": 1, "capture_speed": 1e-3})"},
  };
  return all;
}

bool register_all() {
  for (const Shipped& s : bodies())
    register_suite(suite("Body", s), body_checks(from_entry<Body>(folder, s.entry, world_of(s)), states_of(s)));
  for (const Shipped& s : joints())
    register_suite(suite("Joint", s), joint_checks(from_entry<Constraint>(folder, s.entry, world_of(s)), s.space,
                                                   s.name == "gear" ? Reaction::outside : Reaction::on_A));
  for (const Shipped& s : forces())
    register_suite(suite("Force", s), force_checks(from_entry<Force>(folder, s.entry, world_of(s)), s.space,
                                                   s.name == "load" ? Reaction::outside : Reaction::on_A));
  for (const Shipped& s : compliant_contacts())
    register_suite(suite("Contact", s), contact_force_checks(from_entry<ContactForce>(folder, s.entry)));
  for (const Shipped& s : set_valued_contacts())
    register_suite(suite("Contact", s), restitution_checks(from_entry<Restitution>(folder, s.entry)));
  return true;
}
const bool registered = register_all();

TEST(ShippedComponents, AreAllChecked) {
  std::set<std::pair<Kind, std::string>> checked;
  for (const Shipped& s : bodies()) checked.insert({Kind::body, s.name});
  for (const Shipped& s : joints()) checked.insert({Kind::joint, s.name});
  for (const Shipped& s : forces()) checked.insert({Kind::force, s.name});
  for (const Shipped& s : compliant_contacts()) checked.insert({Kind::contact, s.name});
  for (const Shipped& s : set_valued_contacts()) checked.insert({Kind::contact, s.name});
  for (const plugin::Entry* entry : registry().all()) {
    const Kind kind = entry->declaration.kind;
    if (kind != Kind::body && kind != Kind::joint && kind != Kind::force && kind != Kind::contact) continue;
    EXPECT_TRUE(checked.contains({kind, entry->declaration.name}))
        << to_string(kind) << " " << entry->declaration.name << " has no line in " << __FILE__;
  }
}

}  // namespace
}  // namespace trammel::test
