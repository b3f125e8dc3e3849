// The logs of a run: series.csv, events.csv, animation.ndjson and fields.ndjson in the results folder.
#pragma once

#include <optional>

#include "simulate/pictures/animation_line.hpp"
#include "simulate/pictures/field_line.hpp"
#include "simulate/results/event_line.hpp"
#include "simulate/results/log_file.hpp"
#include "simulate/results/observable.hpp"
#include "simulate/results/record_sink.hpp"

namespace trammel::simulate {

// 2-norms over the active rows.
struct ConstraintNorms {
  double position = 0;      // of g
  double velocity = 0;      // of G v + g_t
  double acceleration = 0;  // of G a - gamma with the integrator's own a
  void raise_to(const ConstraintNorms& other);
};
// The system must be at `state`.
ConstraintNorms constraint_norms(model::AssembledSystem& system, const State& state, Vec& scratch);

class Recorder final : public RecordSink {
 public:
  enum class Books { kept, none };  // kept: rows contain the energy supplied and dissipated
  struct Lengths {
    LogPart series, events, animation, fields;
    long long field_times = 0;  // number of field times already passed
  };
  // A new folder's logs, or those of an interrupted run shortened to `keep`. The first row at or after each of
  // `field_times`, which ascend, goes to fields.ndjson, too.
  Recorder(const std::filesystem::path& folder, const model::Model& model, std::vector<Column> columns,
           std::optional<Lengths> keep, std::vector<double> field_times = {}, Books books = Books::kept);

  void row(model::AssembledSystem& system, const State& state, const Ledger::Totals& books = {},
           long long steps = 0) override;
  void event(const ContactEvent& event) override;
  void event(const RefineEvent& event) override;
  void flush();                  // throws OutputError, after trying all files
  void sync();                   // the same, and synchronises the disk
  void check() const;            // throws OutputError if a file could not take its lines; nothing is lost yet
  std::string missing();         // which files lack how many lines that could not be written; empty: none
  void rescue() const noexcept;  // for a signal handler: writes whole lines that are still in memory
  Lengths lengths() const;
  // Why the logs in a folder no longer begin with `keep`; empty: they do.
  static std::string damage(const std::filesystem::path& folder, const Lengths& keep);

 private:
  std::string header() const;
  void show_fields(const State& state);
  template <class Event>
  void log(const Event& event);
  std::vector<LogFile*> files();
  std::vector<Column> columns_;
  Books books_;
  std::optional<LogFile> series_, events_, animation_, fields_;
  EventLine event_line_;
  AnimationLine animation_line_;
  FieldLine field_line_;
  std::vector<double> field_times_;
  std::size_t next_field_time_ = 0;
  Vec scratch_;
};

}  // namespace trammel::simulate
