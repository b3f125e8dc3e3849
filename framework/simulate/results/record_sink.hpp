// Destination of a run's records and events: files (Recorder) or memory (study/cases/series.hpp).
#pragma once

#include "simulate/results/contact_event.hpp"
#include "simulate/results/ledger.hpp"
#include "simulate/results/refine_event.hpp"

namespace trammel::simulate {

class RecordSink {
 public:
  virtual ~RecordSink() = default;
  // Called at multiples of record.every; may move the system. `steps`: accepted so far.
  virtual void row(model::AssembledSystem& system, const State& state, const Ledger::Totals& books,
                   long long steps) = 0;
  virtual void event(const ContactEvent& event) = 0;
  virtual void event(const RefineEvent& event) = 0;
};

}  // namespace trammel::simulate
