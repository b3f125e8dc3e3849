#include "study/study_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "simulate/results/provenance.hpp"
#include "simulate/results/results_folder.hpp"
#include "study/journal.hpp"
#include "study/study_results.hpp"
#include "study/workers.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

CaseResult result_of(const Study& study, const SceneSource& source, plugin::Registry& registry, std::size_t i,
                     simulate::CrashWitness* witness) {
  CaseResult result;
  try {
    const scene::Scene scene = source.with(study.overrides(i));
    CaseOptions options;
    options.keep = SeriesSink::Keep::energies;
    options.witness = witness;
    result = run_case(scene, registry, options);
  } catch (const scene::SceneError& e) {
    result.reason = e.what();
  }
  return result;
}

// Loads what the cases need, once, before processes are forked.
void load_components(const SceneSource& source, const Study& study, plugin::Registry& registry) {
  try {
    const scene::Scene scene = source.with(study.overrides(0));
    simulate::set_up(scene, registry, simulate::purpose_of(scene.root()));
  } catch (const std::exception&) {  // the case itself tells
  }
}

class StudyRun {
 public:
  StudyRun(const Study& study, const std::string& file, plugin::Registry& registry, const StudyOptions& options)
      : study_(study),
        registry_(registry),
        options_(options),
        source_(study.scene_file(), study.set()),
        content_{study, fs::absolute(file).string(), 0, options.shard, {}, {}} {
    const scene::Scene base = source_.with();
    content_.scene_hash = base.hash();
    load_components(source_, study, registry);
    content_.made = simulate::provenance(base, options.command, registry.identities());
  }

  StudyReport operator()() {
    take_finished();
    const std::vector<std::size_t> tasks = missing(content_);
    simulate::write_whole(options_.out / study_json, to_json(content_, "running").dump(2) + "\n");
    Journal journal(options_.out);
    finished_ = content_.records.size(), all_ = finished_ + tasks.size();
    bool whole = run(tasks, journal);
    if (whole && !again_.empty()) {
      const std::vector<std::size_t> second = std::exchange(again_, {});  // once: what ended them may end all
      whole = run(second, journal);
    }
    return write_results(content_, options_.out, !whole);
  }

 private:
  void take_finished() {
    for (CaseRecord& r : read_journal(options_.out))
      if (r.index < study_.size() && options_.shard.has(r.index) && r.key == study_.key(r.index, content_.scene_hash))
        content_.records[r.index] = std::move(r);
  }

  bool run(const std::vector<std::size_t>& tasks, Journal& journal) {
    Workers workers;
    workers.jobs = options_.jobs;
    workers.interrupt = options_.interrupt;
    workers.work = [this](std::size_t i) {
      return to_line(record_of(study_, i, study_.key(i, content_.scene_hash),
                               result_of(study_, source_, registry_, i, options_.witness)));
    };
    workers.answer = [&](std::size_t i, const std::string& line) { take(i, line, journal); };
    workers.lost = [&](const Lost& lost) {
      if (lost.outside) return again_.push_back(lost.task);
      CaseResult result;
      result.status = CaseResult::Status::failed, result.reason = lost.why;
      take(lost.task, to_line(record_of(study_, lost.task, study_.key(lost.task, content_.scene_hash), result)),
           journal);
    };
    return workers.run(tasks);
  }

  void take(std::size_t i, const std::string& line, Journal& journal) {
    journal.add(line);
    content_.records[i] = from_line(line).value();
    if (options_.progress) options_.progress(++finished_, all_);
  }

  const Study& study_;
  plugin::Registry& registry_;
  const StudyOptions& options_;
  SceneSource source_;
  StudyContent content_;
  std::vector<std::size_t> again_;
  std::size_t finished_ = 0, all_ = 0;
};

json read_study_json(const fs::path& folder) {
  std::ifstream in(folder / study_json);
  const json all = json::parse(in, nullptr, false);
  if (!all.is_object() || !all.contains("trammel_study"))
    throw simulate::FolderRefused(
        fmt::format("{} holds no results of 'trammel study': it has no study.json", folder.string()));
  return all;
}

}  // namespace

StudyReport run_study(const Study& study, const std::string& file, plugin::Registry& registry,
                      const StudyOptions& options) {
  return StudyRun(study, file, registry, options)();
}

StudyReport merge_studies(const std::vector<fs::path>& folders, const StudyOptions& options) {
  const json first = read_study_json(folders.front());
  const std::string definition = first.at("definition"), hash = first.at("scene_hash");
  for (const fs::path& folder : folders) {
    const json other = read_study_json(folder);
    if (other.at("definition") != definition || other.at("scene_hash") != hash)
      throw simulate::FolderRefused(fmt::format("{} and {} are of different studies: their {} differs",
                                                folders.front().string(), folder.string(),
                                                other.at("scene_hash") != hash ? "scene" : "definition"));
  }
  const Study study = Study::restore(definition, first.at("file"));
  StudyContent content{study, first.at("file"), std::stoull(hash, nullptr, 16), {}, {}, {}};
  for (const char* key : {"made", "versions", "plugins"}) content.made[key] = first.at(key);
  for (const fs::path& folder : folders)
    for (CaseRecord& r : read_journal(folder))
      if (r.index < study.size() && r.key == study.key(r.index, content.scene_hash))
        content.records[r.index] = std::move(r);
  std::set<std::uint64_t> there;
  for (const CaseRecord& old : read_journal(options.out)) there.insert(old.key);
  Journal journal(options.out);
  for (const auto& [i, r] : content.records)
    if (!there.contains(r.key)) journal.add(to_line(r));
  return write_results(content, options.out, false);
}

StudyReport estimate_study(const Study& study, plugin::Registry& registry) {
  constexpr double a_minute = 60;
  const SceneSource source(study.scene_file(), study.set());
  std::set<std::size_t> tried = {0, study.size() / 2, study.size() - 1};
  double seconds = 0, most = 0;
  std::size_t failed = 0;
  result_of(study, source, registry, 0, nullptr);  // loads the plugins
  for (const std::size_t i : tried) {
    const CaseResult r = result_of(study, source, registry, i, nullptr);
    seconds += r.cpu + r.cpu_set_up, most = std::max(most, r.cpu + r.cpu_set_up);
    failed += r.done() ? 0 : 1;
  }
  const double each = seconds / double(tried.size()), whole = each * double(study.size());
  const auto shards =
      std::min<long long>((long long)(study.size()), std::max(1LL, std::llround(std::ceil(whole / a_minute))));
  StudyReport report;
  report.json =
      json{{"status", "estimated"},       {"cases", study.size()}, {"tried", tried.size()}, {"failed", failed},
           {"cpu_time_per_case_s", each}, {"longest_s", most},     {"cpu_time_s", whole},   {"shards", shards}}
          .dump(2);
  report.summary = fmt::format(
      "{} cases of {:.3g} s each (of {} tried, the longest took {:.3g} s{}): {:.3g} s of CPU time in all, {:.3g} s on "
      "{} cores here.\nFor a minute each: {} shard{} (--shard I/{})",
      study.size(), each, tried.size(), most, failed ? fmt::format(", {} failed", failed) : "", whole,
      whole / cores_at_hand(), cores_at_hand(), shards, shards == 1 ? "" : "s", shards);
  return report;
}

}  // namespace trammel::study
