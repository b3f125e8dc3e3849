// Reads the markers between which a joint, force or contact of a scene acts.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "model/model.hpp"
#include "scene/value.hpp"

namespace trammel::model {

class MarkerInput {
 public:
  MarkerInput(Model& model, scene::Problems& problems) : model_(model), problems_(problems) {}

  // If a body is missing because of other problems, reports of unknown names would be misleading.
  void a_body_is_missing() { missing_bodies_ = true; }

  std::optional<MarkerRef> marker(const scene::Value& value);
  // Reports a problem if `component` needs an orientation of its k-th marker, which is read from `name` and has none.
  void check_orientation(const Component* component, std::size_t k, MarkerRef marker, const scene::Value& name);
  // The entries of "between", in the required number; nullptr: a problem was reported.
  const scene::Items* between(const scene::Value& object, std::size_t count = 2);
  // A joint's markers, not all on one body; empty: a problem was reported. `joint` is null if it could not be made.
  std::vector<MarkerRef> markers_of(const scene::Value& object, const Constraint* joint);

 private:
  Model& model_;
  scene::Problems& problems_;
  bool missing_bodies_ = false;
};

}  // namespace trammel::model
