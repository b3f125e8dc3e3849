// The columns of series.csv other than the observed ones.
//
//     t, the observed, energies of the state, the books of the analysis, norms of the constraints, steps
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

namespace trammel::simulate {

constexpr std::array<std::string_view, 4> energy_columns = {"energy_kinetic", "energy_potential", "energy_elastic",
                                                            "energy_total"};
// In motions only: E_start + supplied - dissipated is the energy expected at t (ledger.hpp).
constexpr std::array<std::string_view, 2> book_columns = {"energy_supplied", "energy_dissipated"};
constexpr std::array<std::string_view, 3> norm_columns = {"constraint_position", "constraint_velocity",
                                                          "constraint_acceleration"};
// In motions only: accepted steps so far.
constexpr std::array<std::string_view, 1> step_columns = {"steps"};

// No observed column may have one of these names.
constexpr bool is_fixed_column(std::string_view name) {
  const auto holds = [name](const auto& columns) {
    return std::find(columns.begin(), columns.end(), name) != columns.end();
  };
  return name == "t" || holds(energy_columns) || holds(book_columns) || holds(norm_columns) || holds(step_columns);
}

}  // namespace trammel::simulate
