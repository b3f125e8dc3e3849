// What a column of the results is: unit, meaning, and the path of the scene that it belongs to.
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

// Of an observable: "beam.tip.y", "contacts.tip.gap", "beam.angle". All unit "" where nothing is known.
Quantity observable_quantity(std::string_view observable, const model::Model& model);
// Of a column of series.csv that is always there: t, energies, norms.
Quantity fixed_quantity(std::string_view column);
// Of a column of events.csv.
Quantity event_quantity(std::string_view column);

}  // namespace trammel::simulate
