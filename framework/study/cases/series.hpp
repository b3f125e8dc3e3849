// The records of a run in memory, in place of series.csv and events.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulate/results/observable.hpp"
#include "simulate/results/record_sink.hpp"

namespace trammel::study {

// Rows at the times of the records; `names` are those of the columns without t.
struct Series {
  std::vector<std::string> names;
  std::vector<double> t;       // [s]
  std::vector<double> values;  // row after row

  std::size_t rows() const { return t.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * names.size() + column]; }
  std::optional<std::size_t> column(std::string_view name) const;
};

class SeriesSink final : public simulate::RecordSink {
 public:
  // energies: energy_kinetic, ..., energy_dissipated after the observed columns (series_columns.hpp).
  enum class Keep { observed, energies };
  SeriesSink(const std::vector<simulate::Column>& columns, Keep keep);

  void row(model::AssembledSystem& system, const State& state, const simulate::Ledger::Totals& books,
           long long steps) override;
  void event(const simulate::ContactEvent& event) override { events_.push_back(event); }
  void event(const simulate::RefineEvent&) override {}

  Series& series() { return series_; }
  std::vector<simulate::ContactEvent>& events() { return events_; }

 private:
  const std::vector<simulate::Column>& columns_;
  Keep keep_;
  Series series_;
  std::vector<simulate::ContactEvent> events_;
};

}  // namespace trammel::study
