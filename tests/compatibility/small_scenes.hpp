// Scenes of some milliseconds that exercise one need, one pair of laws, one kind of body.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "compatibility/matrix.hpp"

namespace trammel::test {

using json = nlohmann::json;

inline json entry(const compatibility::Form& form, json more = json::object()) {
  more["type"] = form.type;
  if (!form.parameter.empty()) more[form.parameter] = form.choice;
  return more;
}

inline json scene(const char* space, json gravity, json bodies) {
  return {{"trammel", 1},
          {"space", space},
          {"gravity", std::move(gravity)},
          {"bodies", std::move(bodies)},
          {"simulate", {{"until", 0.02}}},
          {"record", {{"every", 0.01}}}};
}

inline json floor() {
  return {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}}}};
}

// 1 kg that strikes the floor after 5 ms, slips, and comes to rest against friction of 0.3 soon after.
inline json falling_point() {
  return scene("planar", {0, -9.81},
               {{"b", {{"type", "point_mass"}, {"mass", 1}, {"position", {0, 0.00012}}, {"velocity", {0.02, 0}}}}});
}

// With the parameters that laws must be given.
inline json contact_entry(const compatibility::Form& form) {
  if (form.type == "continuous_force") return entry(form, {{"stiffness", 1e6}, {"restitution", 0.5}});
  if (form.type == "penalty") return entry(form, {{"stiffness", 1e7}, {"radius", 0.1}});
  return entry(form);
}
inline json friction_entry(const compatibility::Form& form) {
  if (form.type == "coulomb") return entry(form, {{"static", 0.4}, {"kinetic", 0.3}, {"stick_speed", 1e-5}});
  return entry(form, {{"coefficient", 0.3}, {"critical_velocity", 1e-2}});
}

inline json plate() {
  return {{"type", "tspline_plate"},
          {"thickness", 0.05},
          {"density", 1000},
          {"youngs_modulus", 1e7},
          {"poissons_ratio", 0.3},
          {"geometry", {{"along_u", {1, 0, 0}}, {"along_v", {0, 1, 0}}}},
          {"mesh", {{"elements", "1x1"}}},
          {"edges", {{"u0", "clamped"}}}};
}

// The pair between a point and the floor, a ball and a plate, or in a joint.
inline json with_laws(const compatibility::LawPair& laws) {
  json all;
  if (!laws.contact) {
    all = scene("planar", {0, -9.81},
                {{"b", {{"type", "rigid_body"}, {"mass", 1}, {"inertia", 0.1}, {"velocity", {0.02, 0}}}}});
    all["joints"]["j"] = {{"type", "prismatic"}, {"between", {"ground", "b.com"}}, {"axis", {1, 0}}};
    all["joints"]["j"]["friction"] = friction_entry(*laws.friction);
    return all;
  }
  if (laws.contact->type == "penalty") {
    all = scene(
        "spatial", {0, 0, -9.81},
        {{"plate", plate()},
         {"b", {{"type", "point_mass"}, {"mass", 1}, {"position", {0.6, 0.5, 0.12512}}, {"velocity", {0.02, 0, 0}}}}});
    all["contacts"]["c"] = contact_entry(*laws.contact);
    all["contacts"]["c"]["between"] = {"b.com", {{"surface", "plate"}}};
  } else {
    all = falling_point();
    all["contacts"]["c"] = contact_entry(*laws.contact);
    all["contacts"]["c"]["between"] = {"b.point", floor()};
  }
  if (laws.friction) all["contacts"]["c"]["friction"] = friction_entry(*laws.friction);
  return all;
}

inline json pendulum() {
  json all = scene("planar", {0, -9.81},
                   {{"b",
                     {{"type", "rigid_body"},
                      {"mass", 1},
                      {"inertia", 0.1},
                      {"position", {1, 0}},
                      {"markers", {{"pin", {-1, 0}}}}}}});
  all["joints"]["j"] = {{"type", "revolute"}, {"between", {"ground", "b.pin"}}};
  return all;
}

inline json with_need(compatibility::Need need) {
  using compatibility::Need;
  json all = pendulum();
  switch (need) {
    case Need::rows:
    case Need::error_estimate:
      return all;
    case Need::redundant_rows:
      all["joints"]["repeats"] = all["joints"]["j"];
      return all;
    case Need::friction: {
      all = scene("planar", {0, -9.81},
                  {{"b", {{"type", "rigid_body"}, {"mass", 1}, {"inertia", 0.1}, {"velocity", {0.02, 0}}}}});
      all["joints"]["j"] = {{"type", "prismatic"},
                            {"between", {"ground", "b.com"}},
                            {"axis", {1, 0}},
                            {"friction", {{"type", "coulomb"}, {"static", 0.4}, {"kinetic", 0.3}}}};
      return all;
    }
    case Need::jumps:
      all = falling_point();
      all["contacts"]["c"] = {{"type", "continuous_force"},
                              {"stiffness", 1e6},
                              {"between", {"b.point", floor()}},
                              {"friction",
                               {{"type", "coulomb"},
                                {"static", 0.4},
                                {"kinetic", 0.3},
                                {"method", "lcp_every_step"},
                                {"stick_speed", 1e-5}}}};
      return all;
    case Need::rotations:
      return scene(
          "spatial", {0, 0, -9.81},
          {{"b",
            {{"type", "rigid_body"}, {"mass", 1}, {"inertia", {0.1, 0.12, 0.05}}, {"angular_velocity", {1, 20, 2}}}}});
    case Need::events:
      all = falling_point();
      all["contacts"]["c"] = {
          {"type", "continuous_force"}, {"stiffness", 1e6}, {"restitution", 0.5}, {"between", {"b.point", floor()}}};
      return all;
  }
  return all;
}

// [s] Twenty steps to the end.
inline double step_of(const json& scene) {
  return scene.at("simulate").at("until").get<double>() / 20;
}

// One body of each kind that ships; null: unknown.
inline json with_body(const std::string& type) {
  if (type == "point_mass") return scene("planar", {0, -9.81}, {{"b", {{"type", type}, {"mass", 1}}}});
  if (type == "rigid_body") return with_need(compatibility::Need::rotations);
  if (type == "bar")
    return scene("planar", {0, -9.81}, {{"b", {{"type", type}, {"mass", 1}, {"from", {0, 0}}, {"to", {1, 1}}}}});
  if (type == "moving_base") {
    json all = pendulum();
    all["bodies"]["base"] = {{"type", type}, {"x", "=0.01*sin(50*t)"}, {"markers", {{"m", {0, 0}}}}};
    all["joints"]["j"]["between"] = {"base.m", "b.pin"};
    all["initial"] = {{"consistent", "project"}};
    return all;
  }
  if (type == "assumed_mode_beam")
    return scene("planar", {0, -9.81},
                 {{"b",
                   {{"type", type},
                    {"length", 1},
                    {"area", 3e-4},
                    {"second_moment", 8e-9},
                    {"density", 2800},
                    {"youngs_modulus", 3e7},
                    {"mount", {{"clamped", {0, 0}}}},
                    {"modes", {{"axial", 1}, {"transverse", 1}}}}}});
  if (type == "slider_crank_rod") {
    json all = scene("planar", {0, 0}, {{"b", {{"type", type}, {"angle", 0.4}}}});
    all["simulate"]["until"] = 2e-5;  // its axial motion has 1e5 rad/s
    all["record"]["every"] = 1e-5;
    return all;
  }
  if (type == "tspline_plate") return scene("spatial", {0, 0, -9.81}, {{"b", plate()}});
  return {};
}

}  // namespace trammel::test
