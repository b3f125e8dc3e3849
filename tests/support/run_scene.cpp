#include "support/run_scene.hpp"
#include "statics/static_run.hpp"

#include <unistd.h>

#include <iterator>

namespace trammel::test {

std::vector<Event> Finished::of_kind(const std::string& kind) const {
  std::vector<Event> some;
  for (const Event& event : events)
    if (event.kind == kind) some.push_back(event);
  return some;
}

Folder::Folder() {
  static int count = 0;
  path_ = std::filesystem::path(testing::TempDir()) / fmt::format("trammel_run_{}_{}", ::getpid(), ++count);
  std::filesystem::remove_all(path_);
}
Folder::~Folder() {
  std::filesystem::remove_all(path_);
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, separator);) cells.push_back(cell);
  return cells;
}

std::map<std::string, std::vector<double>> read_series(const std::filesystem::path& file) {
  std::map<std::string, std::vector<double>> series;
  std::istringstream in(read_text(file));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split(line, ',');
  for (const std::string& name : names) series[name];
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line, ',');
    if (cells.size() != names.size()) throw std::runtime_error("a row of another length: " + line);
    for (std::size_t i = 0; i < cells.size(); ++i) series[names[i]].push_back(std::strtod(cells[i].c_str(), nullptr));
  }
  return series;
}

std::vector<Event> read_events(const std::filesystem::path& file) {
  std::vector<Event> events;
  std::istringstream in(read_text(file));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split(line, ',');
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line, ',');
    Event event{std::strtod(cells.at(0).c_str(), nullptr), cells.at(1), cells.at(2), {}};
    for (std::size_t i = 3; i < cells.size(); ++i)
      if (!cells[i].empty()) event.detail[names.at(i)] = std::strtod(cells[i].c_str(), nullptr);
    events.push_back(std::move(event));
  }
  return events;
}

Finished run_scene(const scene::Scene& scene, bool with_events, Runner run) {
  const Folder folder;
  simulate::RunOptions options;
  options.out = folder.path();
  Finished finished;
  finished.report = run(scene, registry(), options);
  finished.result = nlohmann::json::parse(finished.report.result_json);
  finished.series = read_series(folder.path() / "series.csv");
  if (with_events) finished.events = read_events(folder.path() / "events.csv");
  return finished;
}

Finished run_text(const std::string& text, const Overrides& overrides) {
  return run_scene(scene::Scene::parse(text, "test.json", overrides));
}

Finished run_static(const std::string& text, const Overrides& overrides) {
  return run_scene(scene::Scene::parse(text, "test.json", overrides), true, simulate::run_static);
}

Finished run_file(const std::string& file, const Overrides& overrides) {
  return run_scene(scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/" + file, overrides));
}

}  // namespace trammel::test
