#include "simulate/redundancy.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "numerics/dependent_rows.hpp"

namespace trammel::simulate {

std::vector<RedundantRows> redundant_rows(model::AssembledSystem& system, const State& state) {
  system.move_to(state.t, state.q, state.v);
  const std::vector<int> dependent = numerics::dependent_rows(system.sparse_rows(), rank_tolerance);
  std::vector<RedundantRows> found;
  auto row = dependent.begin();
  for (const model::RowGroup& group : row_groups(system.model())) {
    RedundantRows here{group.path, {}, group.count};
    for (; row != dependent.end() && *row < group.first + group.count; ++row) here.rows.push_back(*row - group.first);
    if (!here.rows.empty()) found.push_back(std::move(here));
  }
  return found;
}

std::string told(const RedundantRows& here) {
  std::vector<int> numbers;
  for (const int row : here.rows) numbers.push_back(row + 1);
  return fmt::format("{}: row{} {} of {} follow{} from the rows before", here.path, numbers.size() > 1 ? "s" : "",
                     fmt::join(numbers, ", "), here.of, numbers.size() > 1 ? "" : "s");
}

}  // namespace trammel::simulate
