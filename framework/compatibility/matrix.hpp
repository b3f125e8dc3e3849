// The matrix of all combinations: what each integrator accepts, which laws of contact and friction can be combined and
// what they need, what corrections correct, what bodies need and offer. It is derived from the components, by the rules
// that also refuse scenes.
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
  std::string why_not;       // why they cannot be combined; empty: they can
  std::vector<Need> needs;   // of the integrator
  bool fixed_steps = false;  // fixed steps only
  std::string why_no_statics, why_no_modes;
};

struct CorrectionForm {
  Form form;
  std::vector<Correction::Level> levels;
  bool needs_momentum = false;  // of every body
};

struct BodyKind {
  std::string type;
  bool rows = false, refines = false;  // the integrator must accept them
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
