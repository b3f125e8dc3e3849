// The files of a run from its start to its end: an emptied folder, room for the end on a full disk, logs, and
// result.json.
#pragma once

#include <optional>

#include "commands/result.hpp"
#include "simulate/results/recorder.hpp"
#include "simulate/start/crash_witness.hpp"

namespace trammel::simulate {

class RunRecords {
 public:
  // All live longer.
  RunRecords(const scene::Scene& scene, const RunOptions& options, const Setup& setup)
      : scene_(scene), options_(options), setup_(setup) {}
  ~RunRecords() { leave(); }
  RunRecords(const RunRecords&) = delete;
  RunRecords& operator=(const RunRecords&) = delete;

  // Without `keep`, which a resumed run goes on from, an older run's results are removed. Throws OutputError.
  void open(const std::optional<Recorder::Lengths>& keep, Recorder::Books books);
  Recorder* recorder() { return recorder_ ? &*recorder_ : nullptr; }  // null: not open
  void give_room() { reserve_.reset(); }                              // for the last lines and a checkpoint
  void remove();                                                      // all of it: the scene was wrong

  // Everything known is kept; what cannot be written any more is said in the reason. `json` and `text` give result.json
  // and the summary of outcomes.
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
  void leave();  // the result stands: nobody replaces it any more

  const scene::Scene& scene_;
  const RunOptions& options_;
  const Setup& setup_;
  std::optional<Reserve> reserve_;
  std::optional<Recorder> recorder_;
  std::optional<LastResult> last_result_;
};

}  // namespace trammel::simulate
