#include "study/cases/series.hpp"

#include <algorithm>

#include "simulate/results/series_columns.hpp"

namespace trammel::study {

std::optional<std::size_t> Series::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt : std::optional(std::size_t(found - names.begin()));
}

SeriesSink::SeriesSink(const std::vector<simulate::Column>& columns, Keep keep) : columns_(columns), keep_(keep) {
  for (const simulate::Column& column : columns) series_.names.push_back(column.name);
  if (keep != Keep::energies) return;
  series_.names.insert(series_.names.end(), simulate::energy_columns.begin(), simulate::energy_columns.end());
  series_.names.insert(series_.names.end(), simulate::book_columns.begin(), simulate::book_columns.end());
}

void SeriesSink::row(model::AssembledSystem& system, const State& state, const simulate::Ledger::Totals& books,
                     long long) {
  simulate::Moment moment(system, state);
  series_.t.push_back(state.t);
  for (const simulate::Column& column : columns_) series_.values.push_back(column.value(moment));
  if (keep_ != Keep::energies) return;
  const Energy& e = moment.energy();
  series_.values.insert(series_.values.end(),
                        {e.kinetic, e.potential, e.elastic, e.total(), books.supplied, books.dissipated});
}

}  // namespace trammel::study
