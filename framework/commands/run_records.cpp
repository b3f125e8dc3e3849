#include "commands/run_records.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulate/results/results_folder.hpp"

namespace trammel::simulate {
namespace {

namespace fs = std::filesystem;

// Room reserved for the end of a run on a full disk [bytes]: three buffers of logs and the result; each number of the
// checkpoint.
constexpr long long room_for_logs = 1 << 19, room_per_number = 256;

void add_reason(Outcomes& outcomes, const std::string& reason) {
  outcomes.reason += (outcomes.reason.empty() ? "" : "; ") + reason;
  outcomes.status = Status::failed;
}

}  // namespace

void RunRecords::open(const std::optional<Recorder::Lengths>& keep, Recorder::Books books) {
  if (!keep) {
    std::error_code error;
    fs::create_directories(options_.out, error);
    if (error)
      throw OutputError(fmt::format("cannot make the results folder {}: {}", options_.out.string(), error.message()));
    remove_results(options_.out);
  }
  write_whole(options_.out / "scene.resolved.json", scene_.resolved());
  const Sizes& sizes = setup_.model->sizes;
  reserve_.emplace(options_.out, room_for_logs + room_per_number * (sizes.nq + sizes.nv + sizes.nc));
  recorder_.emplace(options_.out, *setup_.model, setup_.columns, keep, setup_.settings.field_times, books);
  last_result_.emplace(options_.out,
                       result_head(scene_, setup_, {Status::failed, "", {}, options_.resume, options_.command}));
  if (options_.witness) options_.witness->record_with(*recorder_, *last_result_);
}

void RunRecords::remove() {
  leave();
  recorder_.reset();
  remove_results(options_.out);
}

void RunRecords::flush(Outcomes& outcomes) {
  give_room();
  try {
    if (recorder_) recorder_->flush();
  } catch (const OutputError& e) {
    if (outcomes.reason.empty()) outcomes.reason = e.what();
    outcomes.status = Status::failed;
  }
}

void RunRecords::write_result(const std::string& json, Outcomes& outcomes) {
  try {
    write_whole(options_.out / "result.json", json);
  } catch (const OutputError& e) {
    add_reason(outcomes, e.what());
  }
}

void RunRecords::leave() {
  if (options_.witness) options_.witness->leave();
}

}  // namespace trammel::simulate
