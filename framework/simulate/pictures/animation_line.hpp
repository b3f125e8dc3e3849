// A line of animation.ndjson: the visible things at one time, in world axes [m, N], five digits.
//
//     {"t": 0.18, "shapes": {"beam": [[x, y], ...]},                   outlines of bodies
//      "faces": {"plate": {"points": [...], "values": [...], "quads": [[a, b, c, d, outline], ...]}},
//      "joints": {"hinge": [x, y]},
//      "balls": {"ball.com": [x, y, z]},                               centres of contacts with a radius
//      "contacts": {"tip": [[x, y], [Fx, Fy]]},                        closed ones, with the force on their first side
//      "forces": {"spring": [[x, y], [x, y], [Fx, Fy]]}}               its two ends, and the force on the second
//
// Forces of contacts are the integrator's own multipliers: nothing is solved for a picture.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <trammel/faces.hpp>
#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class AnimationLine {
 public:
  explicit AnimationLine(const model::Model& model);
  bool possible() const { return possible_; }  // some body is drawn
  // The system must be at `state`.
  void append(model::AssembledSystem& system, const State& state, std::string& out);

 private:
  struct Faced {
    const model::BodyEntry* entry;
    const HasFaces* faces;
  };
  struct Ball {
    std::string name;
    model::MarkerRef centre;
  };
  void shapes(const State& state, std::string& out);
  void faces(const State& state, std::string& out);
  void joints(model::AssembledSystem& system, std::string& out);
  void contacts(model::AssembledSystem& system, const State& state, std::string& out);
  void forces(model::AssembledSystem& system, const State& state, std::string& out);

  const model::Model& model_;
  bool possible_ = false;
  std::vector<Faced> faced_;
  std::vector<Ball> balls_;
  Mat shape_;
  FaceMesh mesh_;
};

// The things that do not move: {"space", "planes": [{"contact", "point", "normal"}], "balls": {"ball.com": radius},
// "joints": {"hinge": number of rows}, "face_values": {"plate": "von Mises stress on the top [Pa]"}}.
nlohmann::ordered_json still_picture(model::AssembledSystem& system);

}  // namespace trammel::simulate
