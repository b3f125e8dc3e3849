// The results of a trade, and its files: trade.json, trade.csv, choice.json, scene.chosen.json.
#pragma once

#include "study/trade/ensemble.hpp"
#include "study/trade/trade.hpp"

namespace trammel::study {

// Three errors that are easily confused, in the same scale.
struct SeparateErrors {
  double integration = 0;            // the choice against the reference, contacts resolved finely in both
  std::optional<double> contact;     // what a finer treatment of contacts changes; scenes without contacts have none
  std::optional<double> truncation;  // what the finest model tried changes
};

struct TradeContent {
  const SceneSource& source;
  const TradeOptions& options;
  Methods methods;
  std::optional<TradeReference> reference;
  std::string no_reference;  // why
  double target = 0;         // of the search: not below the references' floor
  std::vector<Course> courses;
  int search_runs = 0, full_grid = 0;
  std::optional<Choice> choice;
  std::vector<std::string> equal;  // other settings within the spread of the choice
  std::optional<SeparateErrors> separate;
  std::vector<RungResult> rungs;
  std::vector<std::string> dropped;  // rungs that the choice takes
  std::vector<Distribution> distributions;
  std::string no_distributions;
  double cpu = 0;  // [s] spent
  int runs = 0;
};

TradeReport write_trade(const TradeContent& content, plugin::Registry& registry);

}  // namespace trammel::study
