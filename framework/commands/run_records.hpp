// The files of a run from its start to its end: it empties the folder, reserves room on the disk for the last lines,
// opens the logs, and writes result.json.
#pragma once

#include <optional>

#include "commands/result.hpp"
#include "simulate/results/recorder.hpp"
#include "simulate/start/crash_witness.hpp"

namespace trammel::simulate {

class RunRecords {
 public:
  // Keeps references to all arguments.
  RunRecords(const scene::Scene& scene, const RunOptions& options, const Setup& setup)
      : scene_(scene), options_(options), setup_(setup) {}
  ~RunRecords() { leave(); }
  RunRecords(const RunRecords&) = delete;
  RunRecords& operator=(const RunRecords&) = delete;

  // `keep`: lengths of the logs at which a resumed run continues; without it the results of an older run are removed.
  // Throws OutputError.
  void open(const std::optional<Recorder::Lengths>& keep, Recorder::Books books);
  Recorder* recorder() { return recorder_ ? &*recorder_ : nullptr; }  // null: not open
  void give_room() { reserve_.reset(); }                              // to the last lines and a checkpoint
  void remove();                                                      // removes all files: the scene is wrong

  // Writes what is known; the reason names what cannot be written. `json` and `text` give result.json and the summary
  // of outcomes.
  template <class Json, class Text>
  RunReport end(Outcomes outcomes, Json json, Text text) {
    flush(outcomes);
    RunReport report;
    report.result_json = json(outcomes);
    write_result(report.result_json, outcomes);
    report.summary = text(outcomes);
    report.status = outcomes.status, report.reason = outcomes.reason;
    leave();
    return report;
  }

 private:
  void flush(Outcomes& outcomes);
  void write_result(const std::string& json, Outcomes& outcomes);
  void leave();  // from here on the witness of crashes writes no result

  const scene::Scene& scene_;
  const RunOptions& options_;
  const Setup& setup_;
  std::optional<Reserve> reserve_;
  std::optional<Recorder> recorder_;
  std::optional<LastResult> last_result_;
};

}  // namespace trammel::simulate
