// Speed against accuracy on a user's own scene: the cheapest method and model for a required accuracy, and how far the
// result can be trusted.
//
//     reference -> work and precision of the methods -> the choice -> fidelity of the model -> verified -> trade.json
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/cases/scene_source.hpp"
#include "study/trade/fidelity_study.hpp"
#include "study/trade/work_precision.hpp"

namespace trammel::study {

struct TradeOptions {
  std::filesystem::path out;             // trade.json, trade.csv, choice.json, scene.chosen.json; made if missing
  std::optional<double> target;          // largest scaled error
  std::vector<std::string> observe;      // columns that count; empty: all
  enum class Search { adaptive, grid };  // grid: every method at every level, to judge the search by
  Search search = Search::adaptive;
  double budget = 60;  // [s] of CPU time
  int jobs = 0;
  simulate::Interrupt* interrupt = nullptr;
  std::vector<std::string> command;
  // Called after each run: the part of the budget that is spent, and the present activity.
  std::function<void(double spent, const std::string&)> progress;
};

struct Choice {
  std::string integrator;       // the setting, for a person
  Overrides overrides;          // of the scene
  double error = 0;             // claimed: the measured error plus the floor of the references
  double cpu = 0, own_cpu = 0;  // [s] of the choice, and of the scene as it is
  double own_error = 0;
  bool own_done = false;
};

struct TradeReport {
  std::optional<Choice> choice;  // none: no target, or nothing meets it
  std::string json, summary;
  bool done = false;  // there is a reference
};

// Reads the scene. Throws SceneError if it is wrong, is one of statics, or observes nothing or no such column.
void require_observed(const SceneSource& source, plugin::Registry& registry, const std::vector<std::string>& names);

TradeReport trade(const SceneSource& source, plugin::Registry& registry, const TradeOptions& options);

}  // namespace trammel::study
