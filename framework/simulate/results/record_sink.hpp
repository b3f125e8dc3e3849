// Where a run's records and events go: to files (Recorder), or to memory (study/cases/series.hpp).
#pragma once

#include "simulate/results/contact_event.hpp"
#include "simulate/results/ledger.hpp"
#include "simulate/results/refine_event.hpp"

namespace trammel::simulate {

class RecordSink {
 public:
  virtual ~RecordSink() = default;
  // At multiples of record.every; the system may be left at any point. `steps`: accepted so far.
  virtual void row(model::AssembledSystem& system, const State& state, const Ledger::Totals& books,
                   long long steps) = 0;
  virtual void event(const ContactEvent& event) = 0;
  virtual void event(const RefineEvent& event) = 0;
};

}  // namespace trammel::simulate
