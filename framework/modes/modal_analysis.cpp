#include "modes/modal_analysis.hpp"

#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/result.hpp"
#include "compatibility/scene_check.hpp"
#include "modes/krylov_modes.hpp"
#include "modes/matrix_files.hpp"
#include "modes/mode_shapes.hpp"
#include "modes/normal_modes.hpp"
#include "modes/steady_linearisation.hpp"
#include "run/run_failed.hpp"
#include "simulate/results/checkpoint.hpp"
#include "simulate/results/log_file.hpp"
#include "simulate/results/results_folder.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/blame.hpp"
#include "simulate/start/crash_witness.hpp"
#include "simulate/watch/theory_watch.hpp"
#include "statics/load_path.hpp"

namespace trammel::simulate {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

constexpr Eigen::Index null_space_limit = 1500, undamped_limit = 500,
                       damped_limit = 200;   // a few seconds of dense matrices
constexpr double accelerates = 1e-6;         // [m/s^2, rad/s^2] smaller ones get no line in the summary
constexpr const char* run_to_state = "run";  // the folder below ours, of the run to the state that is analysed

// The scene at the state that the options ask for, with contacts as they are there.
class Posed {
 public:
  Posed(const scene::Scene& scene, plugin::Registry& registry, const ModesOptions& options)
      : setup_(set_up(scene, registry, purpose_of(scene.root()), options.witness)) {
    scene::Problems problems;
    compatibility::check_modes(*setup_.model, scene.root(), registry, problems);
    problems.throw_if_any();
    try {
      pose(scene, options);
    } catch (...) {
      const bool built = simulator_ || statics_;
      rethrow_blamed(setup_, built ? system().last_call() : model::CallSite{}, scene.root(), state_.t);
    }
  }

  model::AssembledSystem& system() { return simulator_ ? simulator_->system() : *statics_; }
  const State& state() const { return state_; }
  const SteadyMotion& motion() const { return motion_; }  // no rates: the state is not steady
  const std::string& what() const { return what_; }
  Setup& setup() { return setup_; }

 private:
  void pose(const scene::Scene& scene, const ModesOptions& options) {
    const auto follow = [&] {
      scope_.emplace(options.witness, setup_, system(), CrashWitness::Clock{&state_.t, nullptr});
    };
    if (!setup_.integrator)
      of_statics(options, follow);
    else
      in_motion(scene, options, follow);
    TheoryWatch theories(system().model());
    if (options.steady) {
      if (!state_.v.isZero(0) && state_.v.size() > undamped_limit)
        throw RunFailed(fmt::format("a model of {} coordinates is too large for the modes of a motion: {} at most",
                                    state_.v.size(), undamped_limit));
      const auto found = find_steady_motion(system(), state_);
      if (const auto* why = std::get_if<std::string>(&found))
        throw RunFailed(fmt::format("no steady motion was found from the state at t = {:.9g}: {}", state_.t, *why));
      motion_ = std::get<SteadyMotion>(found);
      state_ = motion_.state;
      what_ = "in steady motion from " + what_;
    } else if (!state_.v.isZero(0) && state_.v.size() <= undamped_limit) {
      motion_ = steady_as_it_is(system(), state_);
    }
    if (const std::string impossible = theories.look(state_.t, state_.q); !impossible.empty())
      throw RunFailed(fmt::format("at t = {:.9g}: {}", state_.t, impossible));
    for (const std::string& warning : theories.warnings()) setup_.warnings.push_back(warning);
  }

  template <class Follow>
  void of_statics(const ModesOptions& options, Follow follow) {
    if (options.from) throw RunFailed("--from needs a scene with an integrator: statics write no checkpoints");
    statics_.emplace(setup_.model);
    follow();
    model::Modes open;
    open.contacts.resize(setup_.model->contacts.size());
    statics_->set_modes(open);
    if (options.at) {
      path_.emplace(*statics_, setup_.settings, setup_.initial);
      do path_->advance();
      while (!path_->at_end());
      state_ = path_->state();
      state_.a = Vec::Zero(setup_.model->sizes.nv);
      what_ = "the equilibrium under the loads of that time";
    } else {
      state_ = setup_.initial;
      settle();
      what_ = "the start of the scene";
    }
  }

  template <class Follow>
  void in_motion(const scene::Scene& scene, const ModesOptions& options, Follow follow) {
    std::vector<Simulator::LevelCorrection> corrections;
    for (const auto& c : setup_.corrections) corrections.push_back({c.level, c.correction.get(), &c.origin});
    simulator_.emplace(setup_.model, *setup_.integrator, setup_.settings, std::move(corrections));
    follow();
    const std::optional<fs::path> folder = options.from ? options.from
                                           : options.at ? std::optional(options.out / run_to_state)
                                                        : std::nullopt;
    if (folder) {
      nlohmann::json data = read_checkpoint(*folder / newest_checkpoint, resume_hash(scene.root()));
      try {
        JsonArchive archive(data, JsonArchive::Direction::read);
        simulator_->archive(archive);
      } catch (const std::exception& e) {
        refuse_checkpoint(*folder / newest_checkpoint,
                          fmt::format("its content does not fit this scene and program ({})", e.what()));
      }
      what_ = options.from ? "the checkpoint in " + folder->string() : "a run to that time";
    } else {
      simulator_->start(setup_.initial);
      what_ = "the start of the scene";
    }
    state_ = simulator_->state();
    settle();
  }

  void settle() {
    system().move_to(state_.t, state_.q, state_.v);
    system().accelerate({}, state_.a, state_.lambda);
  }

  Setup setup_;
  std::optional<Simulator> simulator_;
  std::optional<model::AssembledSystem> statics_;
  std::optional<LoadPath> path_;  // owns the contacts' modes
  State state_;
  SteadyMotion motion_;
  std::string what_;
  std::optional<WitnessScope> scope_;  // last, because it refers to the members above
};

double hertz(double angular) {
  return angular / (2 * std::numbers::pi);
}

class Report {
 public:
  Report(const scene::Scene& scene, Posed& posed, const Spectrum& spectrum)
      : scene_(scene), posed_(posed), spectrum_(spectrum) {}

  json result(const Outcomes& outcomes) const {
    json modes = json::array();
    for (std::size_t i = 0; i < spectrum_.modes.size(); ++i) {
      const Mode& mode = spectrum_.modes[i];
      modes.push_back({{"mode", i + 1},
                       {"kind", to_string(mode.kind)},
                       {"frequency_hz", hertz(mode.lambda.imag())},
                       {"frequency_rad_s", mode.lambda.imag()},
                       {"damping_ratio", mode.damping_ratio()},
                       {"eigenvalue", {{"real", mode.lambda.real()}, {"imaginary", mode.lambda.imag()}}}});
    }
    json all = result_head(scene_, posed_.setup(), outcomes);
    const Sizes n = posed_.system().sizes();
    all.update(json{{"analysis", "modes"},
                    {"state", posed_.what()},
                    {"t", posed_.state().t},
                    {"largest_speed", size(posed_.state().v)},
                    {"largest_acceleration", size(posed_.state().a)},
                    {"coefficients", spectrum_.frozen ? "frozen" : "constant"},
                    {"frame_rate", {spectrum_.frame_rate(0), spectrum_.frame_rate(1), spectrum_.frame_rate(2)}},
                    {"sizes", {{"nq", n.nq}, {"nv", n.nv}, {"nc", n.nc}}},
                    {"redundant_rows", spectrum_.redundant},
                    {"degrees_of_freedom", spectrum_.degrees},
                    {"unstable", unstable()},
                    {"modes", modes},
                    {"cpu_time_s", outcomes.cost.cpu},
                    {"warnings", posed_.setup().warnings}});
    return all;
  }

  std::string csv() const {
    std::string text = "mode,kind,frequency_hz,frequency_rad_s,damping_ratio,real,imaginary\n";
    for (std::size_t i = 0; i < spectrum_.modes.size(); ++i) {
      const Mode& m = spectrum_.modes[i];
      text += fmt::format("{},{},{:.15g},{:.15g},{:.15g},{:.15g},{:.15g}\n", i + 1, to_string(m.kind),
                          hertz(m.lambda.imag()), m.lambda.imag(), m.damping_ratio(), m.lambda.real(), m.lambda.imag());
    }
    return text;
  }

  std::string summary(const fs::path& folder) const {
    std::string text = title_of(scene_) + "\n" + state_lines() + mode_table();
    for (const std::string& warning : posed_.setup().warnings) text += line("warning", warning);
    return text + line("results", folder.string());
  }

 private:
  static std::string line(const char* what, const std::string& value) {
    return fmt::format("  {:<12}{}\n", what, value);
  }

  std::string state_lines() const {
    const State& s = posed_.state();
    const Sizes n = posed_.system().sizes();
    std::string text = line("state", fmt::format("t = {:.9g}, {}", s.t, posed_.what()));
    if (size(s.v) > 0)
      text += line("", fmt::format("in {}motion, up to {:.3g} (m/s, rad/s){}", spectrum_.frozen ? "" : "steady ",
                                   size(s.v), spectrum_.frozen ? ": coefficients frozen there" : ""));
    if (const Eigen::Vector3d& w = spectrum_.frame_rate; w.norm() > 0)
      text += line("frame", fmt::format("turns at ({:.9g}, {:.9g}, {:.9g}) rad/s; frequencies are those seen from it",
                                        w(0), w(1), w(2)));
    if (size(s.a) > accelerates && spectrum_.frozen)
      text += line("", fmt::format("not in equilibrium: it accelerates by up to {:.3g} (m/s^2, rad/s^2)", size(s.a)));
    const std::string redundant =
        spectrum_.redundant ? fmt::format(" ({} redundant)", spectrum_.redundant) : std::string();
    return text + line("freedom", spectrum_.degrees < 0 ? fmt::format("nv = {}, nc = {}", n.nv, n.nc)
                                                        : fmt::format("{} of nv = {}, nc = {}{}", spectrum_.degrees,
                                                                      n.nv, n.nc, redundant));
  }

  std::string mode_table() const {
    if (spectrum_.modes.empty()) return line("modes", "none: nothing can move");
    std::string text = fmt::format("\n  {:>4}  {:>14}  {:>14}  {:>14}  {:>14}\n", "mode", "frequency [Hz]", "[rad/s]",
                                   "damping ratio", "growth [1/s]");
    for (std::size_t i = 0; i < spectrum_.modes.size(); ++i) {
      const Mode& m = spectrum_.modes[i];
      const bool plain = m.kind == Mode::Kind::oscillation;
      text += fmt::format("  {:>4}  {:>14.8g}  {:>14.8g}  {:>14.6g}  {:>14.6g}{}\n", i + 1, hertz(m.lambda.imag()),
                          m.lambda.imag(), m.damping_ratio() + 0.0, m.lambda.real() + 0.0,
                          plain ? "" : fmt::format("  {}", to_string(m.kind)));
    }
    if (unstable() > 0)
      text += fmt::format("\n  unstable    {} of these modes grow{}\n", unstable(), unstable() == 1 ? "s" : "");
    return text;
  }

  static double size(const Vec& x) { return x.size() ? x.lpNorm<Eigen::Infinity>() : 0; }
  int unstable() const {
    int sum = 0;
    for (const Mode& mode : spectrum_.modes) sum += mode.unstable();
    return sum;
  }

  const scene::Scene& scene_;
  Posed& posed_;
  const Spectrum& spectrum_;
};

// The modes as seen from a frame that rotates with the steady motion.
Spectrum steady_spectrum(const Linearisation& l, int count) {
  Spectrum spectrum = dense_modes(l, count);
  spectrum.frame_rate = l.frame_rate;
  return spectrum;
}

Spectrum spectrum_of(Posed& posed, const ModesOptions& options) {
  const State& s = posed.state();
  const int count = options.count;
  if (!s.a.allFinite()) throw RunFailed(fmt::format("at t = {:.9g}: the accelerations are not finite", s.t));
  if (s.q.size() > null_space_limit) return krylov_modes(posed.system(), s, count);
  const bool moves = !s.v.isZero(0);
  if (moves && !posed.motion().rates.empty()) {
    if (const auto l = linearise_steady(posed.system(), posed.motion())) return steady_spectrum(*l, count);
    if (options.steady)
      throw RunFailed(
          "the motion is steady, but small motions about it have coefficients that change with time: something without "
          "symmetry about an axis turns against what holds it. It has no modes; runs from states nearby show how it "
          "goes on");
  }
  const Linearisation l = linearise(posed.system(), s);
  const bool dense = l.M.rows() <= (l.D.isZero(0) ? undamped_limit : damped_limit) || count > l.M.rows() / 3;
  Spectrum spectrum = dense ? dense_modes(l, count) : krylov_modes(posed.system(), s, count);
  spectrum.frozen = moves;
  return spectrum;
}

// Runs the scene to the time `options.at`, into a folder of its own.
RunReport run_to_state_of(const scene::Scene& scene, plugin::Registry& registry, const ModesOptions& options) {
  RunOptions to_there;
  to_there.out = options.out / run_to_state;
  to_there.command = options.command;
  to_there.interrupt = options.interrupt;
  to_there.witness = options.witness;
  return run(scene, registry, to_there);
}

void write_files(const scene::Scene& scene, Posed& posed, const ModesOptions& options, const Spectrum& spectrum,
                 const Report& report, const std::string& result) {
  write_whole(options.out / "scene.resolved.json", scene.resolved());
  write_whole(options.out / "modes.json", result);
  write_whole(options.out / "modes.csv", report.csv());
  write_whole(options.out / "shapes.csv", shapes_csv(posed.system(), posed.state(), spectrum.modes));
  if (options.matrices) write_matrices(*options.matrices, matrices(posed.system(), posed.state()));
}

}  // namespace

RunReport analyse_modes(const scene::Scene& scene, plugin::Registry& registry, const ModesOptions& options) {
  const bool ran = options.at && purpose_of(scene.root()) == Purpose::motion;
  if (!options.from) refuse_files_of_others(options.out / run_to_state, Analysis::motion);
  if (ran)
    if (RunReport to_there = run_to_state_of(scene, registry, options); to_there.status != Status::done)
      return to_there;
  const std::clock_t began = std::clock();
  Posed posed(scene, registry, options);
  if (const auto n = posed.state().q.size(); options.matrices && n > null_space_limit)
    throw RunFailed(
        fmt::format("--matrices writes dense matrices: {} coordinates are too many, {} at most", n, null_space_limit));
  try {
    const Spectrum spectrum = spectrum_of(posed, options);
    Outcomes outcomes;
    outcomes.command = options.command;
    outcomes.cost.cpu = double(std::clock() - began) / CLOCKS_PER_SEC;
    const Report report(scene, posed, spectrum);
    RunReport done;
    done.result_json = report.result(outcomes).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    std::error_code error;
    fs::create_directories(options.out, error);
    remove_results(options.out);
    if (!ran && !options.from) remove_results(options.out / run_to_state);  // of an older analysis
    write_files(scene, posed, options, spectrum, report, done.result_json);
    done.summary = report.summary(options.out);
    return done;
  } catch (...) {
    rethrow_blamed(posed.setup(), posed.system().last_call(), scene.root(), posed.state().t);
  }
}

}  // namespace trammel::simulate
