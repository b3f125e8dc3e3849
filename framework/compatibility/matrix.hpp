// The matrix of support: which integrator takes what, which laws of contact and friction go together and what they
// need, what corrections correct, what bodies bring. It follows from the components alone, by the rules that also
// refuse scenes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <trammel/correction.hpp>

#include "compatibility/forms.hpp"
#include "compatibility/need.hpp"
#include "plugin/registry.hpp"

namespace trammel::compatibility {

struct IntegratorForm {
  Form form;
  std::vector<Need> takes;
  bool dense_output = false, maps_history = false;  // abilities DenseOutput, Resizable; without: restarts
};

// A contact law alone, with a friction law, or a friction law in a joint (no contact).
struct LawPair {
  std::optional<Form> contact, friction;
  std::string why_not;       // why they do not go together; empty: they do
  std::vector<Need> needs;   // of the integrator
  bool fixed_steps = false;  // and nothing else
  std::string why_no_statics, why_no_modes;
};

struct CorrectionForm {
  Form form;
  std::vector<Correction::Level> levels;
  bool needs_momentum = false;  // of every body
};

struct BodyKind {
  std::string type;
  bool rows = false, refines = false;  // needs them of the integrator
  bool rotations = false;              // in a spatial scene
  bool momentum = false, exact_tangent = false, surface = false, fields = false, theory_limit = false;
};

struct Matrix {
  std::vector<IntegratorForm> integrators;
  std::vector<LawPair> laws;
  std::vector<CorrectionForm> corrections;
  std::vector<BodyKind> bodies;
};

// Loads every library of the search path.
Matrix matrix(plugin::Registry& registry);

std::string text(const Matrix& matrix);  // tables for a terminal
nlohmann::ordered_json to_json(const Matrix& matrix);

const char* to_string(Correction::Level level);

}  // namespace trammel::compatibility
