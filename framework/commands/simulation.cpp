// `trammel run`: set-up, logs, the loop, checkpoints, and the results, however the run ends.
#include "commands/simulation.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <ctime>
#include <optional>

#include <fmt/format.h>

#include "commands/ending.hpp"
#include "commands/run_records.hpp"
#include "commands/slow_steps.hpp"
#include "diagnose/conflict.hpp"
#include "run/run_failed.hpp"
#include "simulate/results/checkpoint.hpp"
#include "simulate/results/results_folder.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/blame.hpp"

namespace trammel::simulate {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds(Clock::duration d) {
  return std::chrono::duration<double>(d).count();
}
double cpu_now() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

constexpr double between_checkpoints = 2;      // [s] wall-clock
constexpr double share_of_checkpoints = 0.05;  // of the time at most: checkpoints are rarer on a slow disk
constexpr double between_progress = 0.1;       // [s]
// [s] The clock is read after as many steps as take about this long, and after so many at the latest.
constexpr double least_between_looks = 1e-3, most_between_looks = 4e-3;
constexpr long long most_steps_between_looks = 1 << 16;

class Run {
 public:
  Run(const scene::Scene& scene, plugin::Registry& registry, const RunOptions& options)
      : scene_(scene),
        options_(options),
        hash_(resume_hash(scene.root())),
        setup_(set_up(scene, registry, Purpose::motion, options.witness, chosen_before())),
        records_(scene, options, setup_) {}

  RunReport operator()() {
    std::vector<Simulator::LevelCorrection> corrections;
    for (const auto& c : setup_.corrections) corrections.push_back({c.level, c.correction.get(), &c.origin});
    simulator_.emplace(setup_.model, *setup_.integrator, setup_.settings, std::move(corrections));
    if (options_.witness)
      options_.witness->follow(setup_, simulator_->system(), {&simulator_->state().t, &simulator_->statistics().steps});
    try {
      open();
      loop();
      finish();
    } catch (...) {
      fail(ending(setup_, scene_.root(), now()));
    }
    return std::move(report_);
  }

 private:
  // The integrator that Trammel chose for the run that is resumed; empty: none. resume() reports faults of checkpoints.
  std::string chosen_before() const {
    if (!options_.resume) return "";
    for (const char* name : {newest_checkpoint, checkpoint_before}) {
      try {
        return read_checkpoint(options_.out / name, hash_).value("chosen_integrator", "");
      } catch (const std::exception&) {
      }
    }
    return "";
  }
  RunPoint now() {
    const double t = simulator_->state().t;
    return {t, step(), fmt::format("at t = {:.9g} s, step {}: ", t, step()), simulator_->system().last_call()};
  }
  // Rows that no motion satisfies may be the cause, although the method gives another reason.
  std::string contradiction() {
    try {
      const Conflict conflict = simulator_->conflict();
      return conflict.empty() ? "" : "; " + description(conflict);
    } catch (const std::exception&) {
      return "";  // a component throws there; the failure itself is reported
    }
  }
  long long step() const { return simulator_->statistics().steps + 1; }

  void fail(const Ending& e) {
    if (e.cause == Ending::Cause::output) return out_of_room(e.reason);
    if (e.cause == Ending::Cause::scene) {
      if (!options_.resume) records_.remove();  // the start has shown that the scene is wrong
    } else {
      end(Status::failed,
          e.reason + (e.cause == Ending::Cause::rows ? contradiction() : "") + simulator_->circumstances());
    }
    report_.no_motion = true;
    if (e.thrown) std::rethrow_exception(e.thrown);
  }

  void open() {
    wall_start_ = Clock::now();
    cpu_start_ = cpu_now();
    std::optional<Recorder::Lengths> keep;
    if (options_.resume) keep = resume();
    records_.open(keep, Recorder::Books::kept);
    if (!options_.resume) simulator_->start(setup_.initial);
  }

  void loop() {
    const Clock::time_point began = Clock::now();
    shown_t_ = simulator_->state().t, shown_steps_ = simulator_->statistics().steps;
    Clock::time_point checked = began, checkpointed = began, shown = began;
    double pause = between_checkpoints;
    SlowSteps slow_steps(simulator_->state().t, simulator_->statistics().steps);
    long long stride = 1, since = 0;  // steps between readings of the clock
    for (;;) {
      const bool more = simulator_->advance(*records_.recorder());
      require_arithmetic(settings_, setup_, simulator_->state().t, step());
      records_.recorder()->check();  // between steps, where a checkpoint is possible
      if (!more) return;
      // After at least one step, which writes the events of the start.
      if (options_.interrupt && options_.interrupt->heed()) {
        status_ = Status::interrupted;
        return;
      }
      if (++since < stride) continue;
      since = 0;
      const Clock::time_point now = Clock::now();
      const double passed = seconds(now - checked);
      if (passed < least_between_looks && stride < most_steps_between_looks)
        stride *= 2;
      else if (passed > most_between_looks && stride > 1)
        stride /= 2;
      checked = now;
      if (const std::string slow = slow_steps.look(cpu_now() - cpu_start_, setup_, *simulator_); !slow.empty())
        warn(slow);
      if (options_.progress && seconds(now - shown) >= between_progress) show(), shown = now;
      if (seconds(now - checkpointed) < pause) continue;
      write();
      checkpointed = Clock::now();
      pause = std::max(between_checkpoints, seconds(checkpointed - now) / share_of_checkpoints);
    }
  }

  void warn(const std::string& warning) {
    simulator_->warn(warning);
    if (options_.warn) options_.warn(warning);
  }

  void show() {
    const Statistics& s = simulator_->statistics();
    const double t = simulator_->state().t;
    const double step = s.steps > shown_steps_ ? (t - shown_t_) / double(s.steps - shown_steps_) : 0;
    options_.progress({t, setup_.settings.until, s.steps, int(s.impacts), s.events, step});
    shown_t_ = t, shown_steps_ = s.steps;
  }

  void finish() {
    write();
    if (options_.progress) show();
    end(status_, status_ == Status::interrupted ? fmt::format("interrupted at t = {:.9g} s after {} steps",
                                                              simulator_->state().t, simulator_->statistics().steps)
                                                : "");
  }

  Cost cost() const {
    return {before_.wall + seconds(Clock::now() - wall_start_), before_.cpu + (cpu_now() - cpu_start_)};
  }

  static void archive_lengths(Archive& archive, Recorder::Lengths& lengths) {
    const auto part = [&archive](const std::string& name, LogPart& log) {
      archive("bytes_" + name, log.bytes);
      auto checksum = std::bit_cast<long long>(log.checksum);
      archive("checksum_" + name, checksum);
      log.checksum = std::bit_cast<std::uint64_t>(checksum);
    };
    part("series", lengths.series), part("events", lengths.events);
    part("animation", lengths.animation), part("fields", lengths.fields);
    archive("field_times", lengths.field_times);
  }

  // Logs first: a checkpoint never refers to bytes that are not on the disk.
  void write() {
    records_.recorder()->sync();
    nlohmann::json data = nlohmann::json::object();
    JsonArchive archive(data, JsonArchive::Direction::write);
    simulator_->archive(archive);
    Recorder::Lengths lengths = records_.recorder()->lengths();
    archive_lengths(archive, lengths);
    Cost so_far = cost();
    archive("wall", so_far.wall), archive("cpu", so_far.cpu);
    data["chosen_integrator"] = setup_.chosen;
    write_checkpoint(options_.out / newest_checkpoint, hash_, data);
  }

  struct Checkpoint {
    fs::path file;
    nlohmann::json data;
    Recorder::Lengths lengths;
  };

  // Throws SceneError unless the checkpoint is complete, of this scene, and fits the logs as they are now.
  Checkpoint read(const char* name) {
    Checkpoint found{options_.out / name, {}, {}};
    found.data = read_checkpoint(found.file, hash_);
    fitting(found, [&](JsonArchive& archive) { archive_lengths(archive, found.lengths); });
    if (const std::string damage = Recorder::damage(options_.out, found.lengths); !damage.empty())
      refuse_checkpoint(found.file, damage);
    return found;
  }

  // Reads the previous checkpoint if the newest is damaged, or if the logs are shorter than it states.
  Checkpoint read() {
    try {
      return read(newest_checkpoint);
    } catch (const scene::SceneError& newest) {
      std::optional<Checkpoint> before;
      try {
        before = read(checkpoint_before);
      } catch (const scene::SceneError&) {
      }
      if (!before) throw;
      setup_.warnings.push_back(fmt::format("{}; the run went on from {}", newest.what(), checkpoint_before));
      return std::move(*before);
    }
  }

  Recorder::Lengths resume() {
    Checkpoint found = read();
    fitting(found, [&](JsonArchive& archive) {
      simulator_->archive(archive);
      archive("wall", before_.wall), archive("cpu", before_.cpu);
      if (found.lengths.field_times < 0 || found.lengths.field_times > (long long)(setup_.settings.field_times.size()))
        throw std::out_of_range("field_times");
      if (found.data.at("chosen_integrator").get<std::string>() != setup_.chosen)
        throw std::invalid_argument("chosen_integrator");
    });
    simulator_->resume();
    if (simulator_->state().t > setup_.settings.until)
      refuse_checkpoint(found.file, fmt::format("it has reached t = {:.9g} s already, the scene ends at {:.9g} s",
                                                simulator_->state().t, setup_.settings.until));
    return found.lengths;
  }

  // Any exception while reading means that the checkpoint does not fit the scene and the program.
  template <class Read>
  static void fitting(Checkpoint& found, Read read) {
    try {
      JsonArchive archive(found.data, JsonArchive::Direction::read);
      read(archive);
    } catch (const std::exception& e) {
      refuse_checkpoint(
          found.file,
          fmt::format("its content does not fit this scene and program ({}); start the run anew", e.what()));
    }
  }

  // Gives the reserved room to the last lines and a checkpoint. A limit on the length of one file may still stop a log.
  void out_of_room(std::string reason) {
    records_.give_room();
    if (Recorder* const recorder = records_.recorder()) {
      reason += fmt::format("; t = {:.9g} s was reached", simulator_->state().t);
      try {
        write();
        reason += ", and all of it is kept: make room and go on with --resume";
      } catch (const OutputError&) {
        if (const std::string missing = recorder->missing(); !missing.empty()) reason += "; " + missing;
        std::error_code error;
        if (fs::exists(options_.out / newest_checkpoint, error))
          reason += "; --resume goes on from the last checkpoint";
      }
    }
    end(Status::failed, reason);
  }

  void end(Status status, const std::string& reason) {
    report_ = records_.end(
        {status, reason, cost(), options_.resume, options_.command},
        [&](const Outcomes& outcomes) { return result_json(scene_, setup_, *simulator_, outcomes); },
        [&](const Outcomes& outcomes) { return summary(scene_, setup_, *simulator_, outcomes, options_.out); });
    report_.t = simulator_->state().t, report_.cpu = cost().cpu, report_.last_good = simulator_->last_good();
  }

  const scene::Scene& scene_;
  const RunOptions& options_;
  plugin::ProcessSettings settings_;
  std::uint64_t hash_;
  Setup setup_;
  std::optional<Simulator> simulator_;
  RunRecords records_;  // after the members that its witness reads
  Status status_ = Status::done;
  RunReport report_;
  Clock::time_point wall_start_;
  double cpu_start_ = 0;
  double shown_t_ = 0;  // at the last progress
  long long shown_steps_ = 0;
  Cost before_;
};

}  // namespace

RunReport run(const scene::Scene& scene, plugin::Registry& registry, const RunOptions& options) {
  return Run(scene, registry, options)();
}

std::string validate(const scene::Scene& scene, plugin::Registry& registry, CrashWitness* witness) {
  std::string text;
  for (const std::string& warning : set_up(scene, registry, purpose_of(scene.root()), witness).warnings)
    text += warning + "\n";
  return text;
}

}  // namespace trammel::simulate
