#include "study/study_file.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "model/scene_keys.hpp"
#include "scene/fnv_hash.hpp"
#include "scene/suggestion.hpp"
#include "simulate/results/provenance.hpp"
#include "simulate/results/series_columns.hpp"
#include "study/cases/json_text.hpp"
#include "study/samples.hpp"

namespace trammel::study {
namespace {

using scene::Problems;
using scene::Value;
using Type = Value::Type;

// limit of Boost's table for Sobol's sequence: 3667
constexpr std::size_t most_cases = 10'000'000, most_dimensions = 3000;

const std::string scene_path = "scene";  // in "vary": varies the scene itself

const std::vector<std::string>& modes() {
  static const std::vector<std::string> all = {"grid", "zip", "random", "sobol", "list"};
  return all;
}

std::optional<std::size_t> read_count(const Value& value, Problems& problems) {
  const auto n = value.read_integer(problems);
  if (!n) return std::nullopt;
  if (*n >= 1 && std::size_t(*n) <= most_cases) return std::size_t(*n);
  problems.error(value.problem(fmt::format("found {}, expected 1 to {}", *n, most_cases)));
  return std::nullopt;
}

// {"from": 0.1, "to": 10, "count": 5, "scale": "log"}; `counted`: "count" is expected.
std::optional<std::pair<Range, std::size_t>> read_range(const Value& value, bool counted, Problems& problems) {
  const std::vector<std::string> keys = counted ? std::vector<std::string>{"from", "to", "count", "scale"}
                                                : std::vector<std::string>{"from", "to", "scale"};
  if (!model::check_keys(value, keys, problems)) return std::nullopt;
  std::pair<Range, std::size_t> range{{}, 0};
  bool complete = true;
  const auto number = [&](const char* key, double& x) {
    const Value* given = value.find(key);
    const auto read = given ? given->read_number(problems) : std::nullopt;
    if (!given) problems.error(value.problem(fmt::format("has no \"{}\"", key)));
    complete = complete && read;
    x = read.value_or(0);
  };
  number("from", range.first.from), number("to", range.first.to);
  if (counted) {
    const Value* count = value.find("count");
    if (!count) problems.error(value.problem("has no \"count\""));
    const auto n = count ? read_count(*count, problems) : std::nullopt;
    complete = complete && n;
    range.second = n.value_or(0);
  }
  if (const Value* scale = value.find("scale")) {
    const std::string name = scale->read_text(problems).value_or("");
    range.first.logarithmic = name == "log";
    if (name != "log" && name != "linear")
      problems.error(scale->problem(fmt::format("found \"{}\", expected \"linear\" or \"log\"{}", name,
                                                scene::did_you_mean(name, {"linear", "log"})))),
          complete = false;
    if (complete && range.first.logarithmic && !(range.first.from > 0 && range.first.to > 0))
      problems.error(value.problem("a logarithmic scale needs \"from\" and \"to\" above 0")), complete = false;
  }
  return complete ? std::optional(range) : std::nullopt;
}

std::vector<std::string> read_values(const Value& value, Problems& problems) {
  std::vector<std::string> texts;
  if (value.type() == Type::array) {
    for (const Value& item : value.items()) texts.push_back(json_text(item));
    if (texts.empty()) problems.error(value.problem("found an empty list, expected values"));
  } else if (value.type() == Type::object) {
    if (const auto range = read_range(value, true, problems))
      for (std::size_t k = 0; k < range->second; ++k)
        texts.push_back(
            fmt::format("{}", range->first.at(range->second == 1 ? 0 : double(k) / double(range->second - 1))));
  } else {
    problems.error(value.problem(fmt::format("found {}, expected a list of values or a range", value.type_name())));
  }
  return texts;
}

// The place in the file that gives the value of a path in case i.
const Value& place_of(const Value& vary, std::size_t i, const std::string& path) {
  const Value& one = vary.type() == Type::array ? vary.items()[i] : vary;
  const Value* named = one.find(path);
  return named ? *named : one;
}

}  // namespace

Study::Study(scene::Scene definition) : definition_(std::move(definition)) {}

Study Study::load(const std::string& file, const std::vector<scene::Override>& overrides) {
  Study study(scene::Scene::load(file, overrides));
  Problems problems;
  study.read(problems);
  if (problems.empty()) study.check_against_scenes(problems);
  problems.throw_if_any();
  return study;
}

Study Study::restore(const std::string& text, const std::string& file) {
  Study study(scene::Scene::parse(text, file));
  Problems problems;
  study.read(problems);
  problems.throw_if_any();
  return study;
}

void Study::read(Problems& problems) {
  const Value& root = definition_.root();
  if (root.type() != Type::object) return problems.error(root.problem("expected a study: an object"));
  if (const Value* scene = root.find("trammel"); scene && !root.find("study"))
    return problems.error(scene->problem("this file is a scene, and no study: trammel run takes it"));
  model::check_keys(root,
                    {"study", "title", "scene", "set", "mode", "vary", "count", "seed", "reduce", "keep", "figures",
                     "parameters", "include"},
                    problems);
  const Value* version = root.find("study");
  if (!version || version->type() != Type::number || version->number() != 1)
    problems.error((version ? *version : root).problem("expected \"study\": 1, the version of this format"));
  if (const Value* set = root.find("set")) {
    if (set->type() != Type::object) problems.error(set->problem("expected an object of values by dotted path"));
    if (set->type() == Type::object)
      for (const auto& [path, value] : set->members()) set_.push_back({path, json_text(value)});
  }
  if (!root.find("vary"))
    problems.error(root.problem("has no \"vary\": values by dotted path, or a list of cases"));
  else
    read_vary(root, problems);
  if (problems.empty()) read_scenes(root, problems);
  if (const Value* keep = root.find("keep")) keep_ = keep->read_boolean(problems).value_or(false);
  if (const Value* reduce = root.find("reduce")) {
    reductions_ = read_reductions(*reduce, problems);
    scene::FnvHash hash;
    hash.text(json_text(*reduce));
    reductions_hash_ = hash.value();
  }
  if (problems.empty()) read_figures(root, problems);
}

void Study::read_figures(const Value& root, Problems& problems) {
  const Value* figures = root.find("figures");
  if (!figures) return;
  if (!keep_) problems.error(figures->problem("they show records of the cases: add \"keep\": true to the study"));
  figures_ = study::read_figures(*figures, paths_, cases_, problems);
}

// Files are relative to the one that names them.
void Study::read_scenes(const Value& root, Problems& problems) {
  const Value &vary = *root.find("vary"), *common = root.find("scene");
  const auto column = std::size_t(std::find(paths_.begin(), paths_.end(), scene_path) - paths_.begin());
  const auto common_name = common ? common->read_text(problems) : std::nullopt;
  if (common && !common_name) return;
  for (const auto& values : cases_) {
    const bool own = column < paths_.size() && !values[column].empty();
    if (!own && !common) return problems.error(root.problem("has no \"scene\": the file that it runs"));
    const Value& named_by = own ? place_of(vary, scene_of_.size(), scene_path) : *common;
    if (own && values[column].front() != '"')
      return problems.error(named_by.problem(fmt::format("found {}, expected a file's name", values[column])));
    const auto folder = std::filesystem::path(named_by.position().file).parent_path();
    const std::string file = (folder / (own ? without_quotes(values[column]) : *common_name)).string();
    const auto found = std::find(scene_files_.begin(), scene_files_.end(), file);
    scene_of_.push_back(std::size_t(found - scene_files_.begin()));
    if (found == scene_files_.end()) scene_files_.push_back(file);
  }
}

void Study::read_list(const Value& list, Problems& problems) {
  for (const Value& one : list.items()) {
    if (one.type() != Type::object) {
      problems.error(one.problem(fmt::format("found {}, expected values by dotted path", one.type_name())));
      continue;
    }
    for (const auto& [path, value] : one.members())
      if (std::find(paths_.begin(), paths_.end(), path) == paths_.end()) paths_.push_back(path);
  }
  for (const Value& one : list.items()) {
    std::vector<std::string>& values = cases_.emplace_back();
    for (const std::string& path : paths_) {
      const Value* value = one.find(path);
      values.push_back(value ? json_text(*value) : "");
    }
  }
  if (list.items().empty()) problems.error(list.problem("found an empty list, expected cases"));
}

// The mode's name; nothing: there is no such mode.
std::optional<std::string> Study::read_mode(const Value& root, Problems& problems) const {
  const Value* mode = root.find("mode");
  std::string name = root.find("vary")->type() == Type::array ? "list" : "grid";
  if (mode) name = mode->read_text(problems).value_or(name);
  if (std::find(modes().begin(), modes().end(), name) != modes().end()) return name;
  problems.error(mode->problem(fmt::format("found \"{}\"{}", name, scene::did_you_mean(name, modes()))));
  return std::nullopt;
}

void Study::read_vary(const Value& root, Problems& problems) {
  const Value& vary = *root.find("vary");
  const std::optional<std::string> mode = read_mode(root, problems);
  if (!mode) return;
  const bool sampled = mode == "random" || mode == "sobol";
  for (const char* key : {"count", "seed"})
    if (const Value* given = root.find(key); given && !sampled)
      problems.error(given->problem("only \"random\" and \"sobol\" have one"));
  if (mode == "list") {
    if (vary.type() != Type::array) return problems.error(vary.problem("expected a list of cases"));
    return read_list(vary, problems);
  }
  if (vary.type() != Type::object)
    return problems.error(vary.problem(fmt::format("found {}, expected values by dotted path", vary.type_name())));
  if (vary.members().empty()) return problems.error(vary.problem("found nothing that varies"));
  for (const auto& [path, value] : vary.members()) paths_.push_back(path);
  sampled ? read_samples(root, *mode, problems) : read_combinations(vary, *mode, problems);
}

void Study::read_samples(const Value& root, const std::string& mode, Problems& problems) {
  const Value& vary = *root.find("vary");
  std::vector<Range> ranges;
  for (const auto& [path, value] : vary.members())
    if (const auto range = read_range(value, false, problems)) ranges.push_back(range->first);
  if (!problems.empty()) return;
  const Value *count = root.find("count"), *seed = root.find("seed");
  if (!count) return problems.error(root.problem("has no \"count\": the number of samples"));
  const auto n = read_count(*count, problems);
  const auto start = seed ? seed->read_integer(problems) : std::optional<int>();
  if (paths_.size() > most_dimensions) problems.error(vary.problem("has too many paths to sample"));
  if (!n || !problems.empty()) return;
  const auto points =
      mode == "random" ? random_points(*n, ranges.size(), std::uint64_t(start.value_or(1)))
                       : sobol_points(*n, ranges.size(), start ? std::optional(std::uint64_t(*start)) : std::nullopt);
  for (const auto& point : points) {
    auto& values = cases_.emplace_back();
    for (std::size_t k = 0; k < ranges.size(); ++k) values.push_back(fmt::format("{}", ranges[k].at(point[k])));
  }
}

void Study::read_combinations(const Value& vary, const std::string& mode, Problems& problems) {
  std::vector<std::vector<std::string>> lists;
  for (const auto& [path, value] : vary.members()) lists.push_back(read_values(value, problems));
  if (!problems.empty()) return;
  mode == "zip" ? combine_one_of_each(vary, lists, problems) : combine_each_with_each(vary, lists, problems);
}

void Study::combine_one_of_each(const Value& vary, const std::vector<std::vector<std::string>>& lists,
                                Problems& problems) {
  const std::size_t length = lists[0].size();
  for (std::size_t k = 1; k < lists.size(); ++k)
    if (lists[k].size() != length)
      problems.error(vary.members()[k].second.problem(
          fmt::format("has {} values, \"{}\" has {}: \"zip\" takes one of each", lists[k].size(), paths_[0], length)));
  if (!problems.empty()) return;
  for (std::size_t i = 0; i < length; ++i) {
    auto& values = cases_.emplace_back();
    for (const auto& list : lists) values.push_back(list[i]);
  }
}

void Study::combine_each_with_each(const Value& vary, const std::vector<std::vector<std::string>>& lists,
                                   Problems& problems) {
  std::vector<std::size_t> lengths;
  double product = 1;
  for (const auto& list : lists) lengths.push_back(list.size()), product *= double(list.size());
  if (product > double(most_cases))
    return problems.error(vary.problem(fmt::format("a grid of {} cases; {} are the most", product, most_cases)));
  for (const auto& tuple : grid(lengths)) {
    auto& values = cases_.emplace_back();
    for (std::size_t k = 0; k < lists.size(); ++k) values.push_back(lists[k][tuple[k]]);
  }
}

// Checks each path alone, with each scene that has it, so that all wrong ones are reported at their places.
void Study::check_against_scenes(Problems& problems) const {
  const Value &root = definition_.root(), &vary = *root.find("vary");
  const Value *common = root.find("scene"), *set = root.find("set");
  for (std::size_t which = 0; which < scene_files_.size(); ++which) {
    if (std::error_code error; !std::filesystem::exists(scene_files_[which], error)) {
      problems.error((common ? *common : vary).problem(fmt::format("no such file: {}", scene_files_[which])));
      continue;
    }
    const SceneSource source(scene_files_[which]);
    // an error of the scene itself is reported as by `trammel validate`
    check_observed(source.with(), which, problems);
    const auto check = [&](const Value& at, const std::string& path, const std::string& value) {
      try {
        source.with({{path, value}});
      } catch (const scene::SceneError& e) {
        for (const scene::Problem& p : e.problems())
          problems.error(at.problem(p.path.empty() ? p.message : p.path + ": " + p.message));
      }
    };
    if (set)
      for (const auto& [path, value] : set->members()) check(value, path, json_text(value));
    for (std::size_t k = 0; k < paths_.size(); ++k)
      for (std::size_t i = 0; i < size() && paths_[k] != scene_path; ++i) {
        if (scene_of_[i] != which || cases_[i][k].empty()) continue;
        check(place_of(vary, i, paths_[k]), paths_[k], cases_[i][k]);
        break;
      }
  }
}

void Study::check_observed(const scene::Scene& scene, std::size_t which, Problems& problems) const {
  const Value* observe = scene.root().at_path("record.observe");
  std::vector<std::string> columns = {"t"};
  const auto add = [&columns](const auto& more) { columns.insert(columns.end(), more.begin(), more.end()); };
  add(simulate::energy_columns), add(simulate::book_columns);
  if (keep_) add(simulate::norm_columns);
  if (observe && observe->type() == Type::object)
    for (const auto& [name, what] : observe->members()) columns.push_back(name);
  const auto is_set = [&](const std::string& name) {
    return std::any_of(set_.begin(), set_.end(), [&](const auto& o) { return o.path == "record.observe." + name; });
  };
  const auto check = [&](const std::string& column, const Value& named_by) {
    if (std::find(columns.begin(), columns.end(), column) == columns.end() && !is_set(column))
      problems.error(
          named_by.problem(fmt::format("{} observes no \"{}\"{}", which > 0 ? scene_files_[which] : "the scene", column,
                                       scene::did_you_mean(column, columns))));
  };
  const Value& root = definition_.root();
  for (const Reduction& one : reductions_) check(one.observe, *root.find("reduce")->find(one.name)->find("observe"));
  for (std::size_t k = 0; k < figures_.size(); ++k)
    if (std::any_of(figures_[k].cases.begin(), figures_[k].cases.end(),
                    [&](std::size_t i) { return scene_of_[i] == which; }))
      for (const std::string& column : figures_[k].observe)
        check(column, *root.find("figures")->items()[k].find("observe"));
}

std::string Study::title() const {
  const Value* title = definition_.root().find("title");
  return title && title->type() == Type::text ? title->text() : "";
}

std::vector<scene::Override> Study::overrides(std::size_t i) const {
  std::vector<scene::Override> all;
  for (std::size_t k = 0; k < paths_.size(); ++k)
    if (!cases_[i][k].empty() && paths_[k] != scene_path) all.push_back({paths_[k], cases_[i][k]});
  return all;
}

std::uint64_t Study::key(std::size_t i, std::uint64_t scene_hash) const {
  scene::FnvHash hash;
  hash.number(scene_hash), hash.number(reductions_hash_), hash.text(simulate::build_info().commit);
  for (std::size_t k = 0; k < paths_.size(); ++k) hash.text(paths_[k]), hash.text(cases_[i][k]);
  return hash.value();
}

}  // namespace trammel::study
