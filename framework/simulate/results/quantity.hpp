// Unit and meaning of a column of the results, and the path in the scene to which it belongs.
#pragma once

#include <string>
#include <string_view>

#include "model/model.hpp"

namespace trammel::simulate {

struct Quantity {
  std::string unit;     // "m/s"; "1": a number without one
  std::string meaning;  // "position of the marker along y"
  std::string path;     // "bodies.beam", "contacts.tip"; empty: of the whole system
};

// For an observable: "beam.tip.y", "contacts.tip.gap", "beam.angle". The unit is "" if nothing is known.
Quantity observable_quantity(std::string_view observable, const model::Model& model);
// For a column of series.csv that is always present: t, energies, norms.
Quantity fixed_quantity(std::string_view column);
// For a column of events.csv.
Quantity event_quantity(std::string_view column);

}  // namespace trammel::simulate
