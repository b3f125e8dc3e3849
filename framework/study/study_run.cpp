#include "study/study_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "scene/fnv_hash.hpp"
#include "simulate/results/provenance.hpp"
#include "simulate/results/results_folder.hpp"
#include "simulate/start/setup.hpp"
#include "study/cases/kept_case.hpp"
#include "study/cases/workers.hpp"
#include "study/journal.hpp"
#include "study/study_results.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// A study's scenes, each read once, and its cases.
class Cases {
 public:
  Cases(const Study& study, plugin::Registry& registry) : study_(study), registry_(registry) {
    for (const std::string& file : study.scene_files()) sources_.emplace_back(file, study.set());
  }

  scene::Scene scene(std::size_t i) const { return sources_[study_.scene_of(i)].with(study_.overrides(i)); }
  // Without the cases' values.
  scene::Scene first_scene() const { return sources_.front().with(); }

  std::uint64_t scene_hash() const {
    if (sources_.size() == 1) return first_scene().hash();
    scene::FnvHash hash;
    for (const SceneSource& source : sources_) hash.number(source.with().hash());
    return hash.value();
  }

  // In memory without a folder.
  CaseResult run(std::size_t i, const std::optional<fs::path>& folder, simulate::CrashWitness* witness) const {
    CaseResult result;
    try {
      CaseOptions options;
      options.keep = SeriesSink::Keep::energies;
      options.witness = witness;
      return folder ? run_kept_case(scene(i), registry_, *folder, options) : run_case(scene(i), registry_, options);
    } catch (const scene::SceneError& e) {
      result.reason = e.what();
    }
    return result;
  }

  // Loads the components of the cases once, before processes are forked.
  void load_components() const {
    std::set<std::size_t> loaded;
    for (std::size_t i = 0; i < study_.size() && loaded.size() < sources_.size(); ++i) {
      if (!loaded.insert(study_.scene_of(i)).second) continue;
      try {
        const scene::Scene of_case = scene(i);
        simulate::set_up(of_case, registry_, simulate::purpose_of(of_case.root()));
      } catch (const std::exception&) {  // the case itself reports it
      }
    }
  }

 private:
  const Study& study_;
  plugin::Registry& registry_;
  std::vector<SceneSource> sources_;
};

// Folders of cases are replaced as a whole, but not a link or a folder of that name that is somebody's own.
void refuse_cases_of_others(const fs::path& out) {
  const fs::file_status cases = fs::symlink_status(out / cases_folder);
  if (!fs::exists(cases) || (simulate::shows_results(out) && !fs::is_symlink(cases))) return;
  throw simulate::FolderRefused(fmt::format(
      "cannot write results to {0}: it has a folder {1}/, where a study keeps and replaces its cases' results, which "
      "{2}; --out names another folder",
      out.string(), cases_folder,
      fs::is_symlink(cases) ? "is a symbolic link" : "nothing there shows to be of an older study"));
}

fs::path folder_of(const fs::path& out, std::size_t i) {
  return out / cases_folder / std::to_string(i);
}

// Removes folders of the shard's cases without a record: of an older study, or unfinished.
void remove_others(const fs::path& out, const Shard& shard, const CaseRecords& records) {
  std::error_code error;
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(out / cases_folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool number = name.find_first_not_of("0123456789") == name.npos && name.size() < 10;
    if (number && shard.has(std::stoul(name)) && !records.contains(std::stoul(name))) others.push_back(entry.path());
  }
  for (const fs::path& other : others) fs::remove_all(other, error);
}

class StudyRun {
 public:
  StudyRun(const Study& study, const std::string& file, plugin::Registry& registry, const StudyOptions& options)
      : study_(study),
        options_(options),
        cases_(study, registry),
        content_{study, options.out, fs::absolute(file).string(), 0, options.shard, {}, {}} {
    if (study.keep()) refuse_cases_of_others(options.out);
    content_.scene_hash = cases_.scene_hash();
    cases_.load_components();
    content_.made = simulate::provenance(cases_.first_scene(), options.command, registry.identities());
  }

  StudyReport operator()() {
    take_finished();
    const std::vector<std::size_t> tasks = missing(content_);
    simulate::write_whole(options_.out / study_json, to_json(content_, "running").dump(2) + "\n");
    Journal journal(options_.out);
    finished_ = content_.records.size(), all_ = finished_ + tasks.size();
    bool whole = run(tasks, journal);
    if (whole && !again_.empty()) {
      const std::vector<std::size_t> second = std::exchange(again_, {});  // only once: what ended them may end all
      whole = run(second, journal);
    }
    return write_results(content_, !whole);
  }

 private:
  void take_finished() {
    for (CaseRecord& r : read_journal(options_.out))
      if (r.index < study_.size() && options_.shard.has(r.index) && r.key == study_.key(r.index, content_.scene_hash))
        if (r.status == "refused" || !study_.keep() || fs::exists(folder_of(options_.out, r.index)))
          content_.records[r.index] = std::move(r);
    if (study_.keep()) remove_others(options_.out, options_.shard, content_.records);
  }

  bool run(const std::vector<std::size_t>& tasks, Journal& journal) {
    Workers workers;
    workers.jobs = options_.jobs;
    workers.interrupt = options_.interrupt;
    workers.work = [this](std::size_t i) {
      const auto folder = study_.keep() ? std::optional(folder_of(options_.out, i)) : std::nullopt;
      return to_line(record_of(study_, i, study_.key(i, content_.scene_hash), cases_.run(i, folder, options_.witness)));
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
  const StudyOptions& options_;
  Cases cases_;
  StudyContent content_;
  std::vector<std::size_t> again_;
  std::size_t finished_ = 0, all_ = 0;
};

void copy_case(const fs::path& from, const fs::path& to) {
  std::error_code none;
  if (!fs::exists(from, none) || fs::equivalent(from, to, none)) return;  // it was refused, or is there already
  fs::create_directories(to);
  fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

bool is_hash(const std::string& text) {
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == text.npos;
}

json read_study_json(const fs::path& folder) {
  std::ifstream in(folder / study_json);
  json all = json::parse(in, nullptr, false);
  if (!all.is_object() || !all.contains("trammel_study"))
    throw simulate::FolderRefused(
        fmt::format("{} holds no results of 'trammel study': it has no study.json", folder.string()));
  const auto text = [&all](const char* key) { return all.contains(key) && all[key].is_string(); };
  if (!text("definition") || !text("file") || !text("scene_hash") || !is_hash(all["scene_hash"]))
    throw simulate::FolderRefused(
        fmt::format("{} is damaged: it lacks the study's definition, file or scene_hash; the command that made it "
                    "writes it again",
                    (folder / study_json).string()));
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
  StudyContent content{study, options.out, first.at("file"), std::stoull(hash, nullptr, 16), {}, {}, {}};
  if (study.keep()) refuse_cases_of_others(options.out);
  for (const char* key : {"made", "versions", "plugins"}) content.made[key] = first.value(key, json());
  for (const fs::path& folder : folders)
    for (CaseRecord& r : read_journal(folder)) {
      if (r.index >= study.size() || r.key != study.key(r.index, content.scene_hash)) continue;
      if (study.keep()) copy_case(folder_of(folder, r.index), folder_of(options.out, r.index));
      content.records[r.index] = std::move(r);
    }
  std::set<std::uint64_t> there;
  for (const CaseRecord& old : read_journal(options.out)) there.insert(old.key);
  Journal journal(options.out);
  for (const auto& [i, r] : content.records)
    if (!there.contains(r.key)) journal.add(to_line(r));
  return write_results(content, false);
}

StudyReport estimate_study(const Study& study, plugin::Registry& registry) {
  constexpr double a_minute = 60;
  const Cases cases(study, registry);
  const std::set<std::size_t> tried = {0, study.size() / 2, study.size() - 1};
  double seconds = 0, most = 0;
  std::size_t failed = 0;
  cases.load_components();
  for (const std::size_t i : tried) {
    const CaseResult r = cases.run(i, {}, nullptr);
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
