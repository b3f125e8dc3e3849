// Runs a scene given as text or file in this process and reads back what it wrote.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "commands/simulation.hpp"
#include "scene/value.hpp"

#include "support/made.hpp"

namespace trammel::test {

using Overrides = std::vector<scene::Override>;

// A line of events.csv.
struct Event {
  double t = 0;
  std::string kind, contact;
  std::map<std::string, double> detail;  // impulse, approach, separation, energy_lost
};

struct Finished {
  simulate::RunReport report;
  nlohmann::json result;  // result.json
  std::map<std::string, std::vector<double>> series;
  std::vector<Event> events;

  bool done() const { return report.status == simulate::Status::done; }
  double end(const std::string& column) const { return series.at(column).back(); }
  std::vector<Event> of_kind(const std::string& kind) const;
};

// Removed with everything in it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);

std::vector<std::string> split(const std::string& line, char separator);

std::map<std::string, std::vector<double>> read_series(const std::filesystem::path& file);

std::vector<Event> read_events(const std::filesystem::path& file);

using Runner = simulate::RunReport (*)(const scene::Scene&, plugin::Registry&, const simulate::RunOptions&);

Finished run_scene(const scene::Scene& scene, bool with_events = true, Runner run = simulate::run);

Finished run_text(const std::string& text, const Overrides& overrides = {});

// `trammel static` of a text.
Finished run_static(const std::string& text, const Overrides& overrides = {});

// A scene of the repository.
Finished run_file(const std::string& file, const Overrides& overrides = {});

}  // namespace trammel::test
