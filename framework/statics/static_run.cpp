// `trammel static`: set-up, load path, records, results.
#include "statics/static_run.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/ending.hpp"
#include "commands/run_records.hpp"
#include "simulate/start/blame.hpp"
#include "statics/load_path.hpp"

namespace trammel::simulate {
namespace {

using json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

class StaticRun {
 public:
  StaticRun(const scene::Scene& scene, plugin::Registry& registry, const RunOptions& options)
      : scene_(scene),
        options_(options),
        setup_(set_up(scene, registry, Purpose::statics, options.witness)),
        records_(scene, options, setup_),
        system_(setup_.model),
        scope_(options.witness, setup_, system_, {&setup_.settings.start, nullptr}),
        path_(system_, setup_.settings, setup_.initial) {}

  RunReport operator()() {
    if (options_.witness) options_.witness->follow(setup_, system_, {&path_.state().t, nullptr});
    try {
      records_.open(std::nullopt, Recorder::Books::none);
      load();
    } catch (...) {
      const Ending e = ending(setup_, scene_.root(), now());
      if (e.cause == Ending::Cause::scene)
        records_.remove();
      else
        end(Status::failed, e.reason);
      if (e.thrown) std::rethrow_exception(e.thrown);
    }
    return std::move(report_);
  }

 private:
  long long step() const { return (long long)(path_.steps().size()) + 1; }

  RunPoint now() {
    const double t = path_.state().t;
    return {t, step(), fmt::format("after t = {:.9g}: ", t), system_.last_call()};
  }

  void load() {
    while (!path_.at_end()) {
      if (options_.interrupt && options_.interrupt->heed())
        return end(Status::interrupted, fmt::format("interrupted at t = {:.9g}", path_.state().t));
      path_.advance();
      require_arithmetic(settings_, setup_, path_.state().t, step());
      records_.recorder()->row(system_, path_.state());
      records_.recorder()->flush();
      system_.move_to(path_.state().t, path_.state().q, path_.state().v);
      energy_ = system_.energy();
      if (path_.steps().size() == 1) energy_start_ = energy_;
      if (options_.progress) options_.progress({path_.state().t, setup_.settings.until, step() - 1, 0, 0, 0});
    }
    end(Status::done, "");
  }

  void end(Status status, const std::string& reason) {
    Outcomes outcomes{status, reason, {}, false, options_.command};
    outcomes.cost.wall = std::chrono::duration<double>(Clock::now() - began_).count();
    outcomes.cost.cpu = double(std::clock() - cpu_began_) / CLOCKS_PER_SEC;
    report_ = records_.end(
        outcomes,
        [&](const Outcomes& all) { return result(all).dump(2, ' ', false, json::error_handler_t::replace) + "\n"; },
        [&](const Outcomes& all) { return text(all); });
  }

  int iterations() const {
    int sum = 0;
    for (const LoadStep& s : path_.steps()) sum += s.iterations;
    return sum;
  }

  json result(const Outcomes& outcomes) {
    json steps = json::array();
    for (const LoadStep& s : path_.steps())
      steps.push_back({{"t", s.t}, {"iterations", s.iterations}, {"parts", s.parts}, {"unbalanced", s.unbalanced}});
    json all = result_head(scene_, setup_, outcomes);
    all.update(json{{"analysis", "static"},
                    {"t_start", setup_.settings.start},
                    {"t_end", path_.state().t},
                    {"t_until", setup_.settings.until},
                    {"wall_time_s", outcomes.cost.wall},
                    {"cpu_time_s", outcomes.cost.cpu},
                    {"newton_iterations", iterations()},
                    {"load_steps", steps},
                    {"factorizations", system_.counts().factorizations},
                    {"energy_start", to_json(energy_start_)},
                    {"energy_end", to_json(energy_)},
                    {"sizes", {{"nq", system_.sizes().nq}, {"nv", system_.sizes().nv}, {"nc", system_.sizes().nc}}},
                    {"warnings", warnings()},
                    {"columns", columns_json(setup_, Recorder::Books::none)},
                    {"drawing", drawing_json(system_, path_.state())}});
    return all;
  }

  // About the worst step that was computed by forces: the remaining r may be round-off of the stiffest motion, or more.
  std::vector<std::string> warnings() const {
    std::vector<std::string> all = setup_.warnings;
    const std::vector<std::string> of_path = path_.warnings();
    all.insert(all.end(), of_path.begin(), of_path.end());
    const LoadStep* worst = nullptr;
    for (const LoadStep& s : path_.steps())
      if (s.by_forces > 0 && s.unbalanced > std::max(setup_.settings.load_tolerance, worst ? worst->unbalanced : 0))
        worst = &s;
    if (worst)
      all.push_back(fmt::format(
          "static.tolerance: {:.3g} of the load is left unbalanced at t = {:.6g}, not {:.3g}: what is softest is lost "
          "in round-off of what is stiffest. Newton's last increment there displaced by {:.2g} (m, rad) at most",
          worst->unbalanced, worst->t, setup_.settings.load_tolerance, worst->by_forces));
    return all;
  }

  std::string text(const Outcomes& outcomes) const {
    std::string all = title_of(scene_) + "\n";
    const auto line = [&all](const char* what, const std::string& value) {
      all += fmt::format("  {:<12}{}\n", what, value);
    };
    const std::size_t steps = path_.steps().empty() ? 0 : path_.steps().size() - 1;
    line("loaded", fmt::format("{:.6g} to {:.6g} in {} step{}; {} iterations of Newton's method, nv = {}, nc = {}",
                               setup_.settings.start, path_.state().t, steps, steps == 1 ? "" : "s", iterations(),
                               system_.sizes().nv, system_.sizes().nc));
    if (!path_.steps().empty())
      line("balance", fmt::format("{:.3g} of the load is left unbalanced", path_.steps().back().unbalanced));
    line("energy", fmt::format("elastic {:.9g} J -> {:.9g} J, potential {:.9g} J -> {:.9g} J", energy_start_.elastic,
                               energy_.elastic, energy_start_.potential, energy_.potential));
    line("cost", fmt::format("{:.3g} s of CPU time", outcomes.cost.cpu));
    for (const std::string& warning : warnings()) line("warning", warning);
    line("results", options_.out.string());
    if (!outcomes.reason.empty()) line(to_string(outcomes.status), outcomes.reason);
    return all;
  }

  const scene::Scene& scene_;
  const RunOptions& options_;
  plugin::ProcessSettings settings_;
  Setup setup_;
  RunRecords records_;
  model::AssembledSystem system_;
  WitnessScope scope_;  // refers to the members above it
  LoadPath path_;
  Energy energy_start_, energy_;
  RunReport report_;
  Clock::time_point began_ = Clock::now();
  std::clock_t cpu_began_ = std::clock();
};

}  // namespace

RunReport run_static(const scene::Scene& scene, plugin::Registry& registry, const RunOptions& options) {
  return StaticRun(scene, registry, options)();
}

}  // namespace trammel::simulate
