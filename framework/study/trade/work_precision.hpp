// Error and work of each method at some of its levels.
//
// With a target the search is adaptive: the next level of a method is the loosest one at which its error is expected to
// meet the target, on a straight line of log error over level through what is known, with the slope of its order before
// two runs are known. A method ends when the loosest level that meets the target is known with the one before it, or
// when it would cost more than three times the cheapest one so far. Without a target all methods run at every other
// level as far as the budget goes.
#pragma once

#include <map>
#include <optional>

#include "study/trade/reference.hpp"

namespace trammel::study {

struct Timing {
  double least = 0, most = 0;  // [s] of CPU time
  int repetitions = 0;
};

struct Sample {
  int level = 0;
  CaseResult::Status status = CaseResult::Status::done;
  std::string reason;
  Error error;
  CaseCounts counts;
  Timing cpu;
  bool deceived = false;  // finished with an error above ten times its tolerance
  bool done() const { return status == CaseResult::Status::done; }
};

struct Course {
  Method method;
  std::map<int, Sample> samples;  // by level
  std::string ended;              // why no further levels were run
  int deceived() const;
};

class WorkPrecision {
 public:
  WorkPrecision(const Methods& methods, const TradeReference& reference, const Measure& measure, Runner& run);

  void search(double target);
  void scan(int stride);
  // Runs five interleaved repetitions of the settings that may be on the front: cheaper than `factor` times the best.
  void repeat(double target, double factor);

  const std::vector<Course>& courses() const { return courses_; }
  // The cheapest setting that meets the target.
  std::optional<std::pair<std::size_t, int>> best(double target) const;
  const Sample& sample(std::pair<std::size_t, int> which) const {
    return courses_[which.first].samples.at(which.second);
  }
  int full_grid() const;  // runs of all methods at all levels
  int runs() const { return runs_; }

 private:
  std::optional<int> next_level(const Course& course, double target) const;
  double expected_cost(const Course& course, int level) const;  // [s]; 0: unknown
  void drop_expensive(std::vector<std::pair<std::size_t, int>>& which, double target);
  void run(const std::vector<std::pair<std::size_t, int>>& which, double limit);
  Sample sample_of(const Method& method, int level, const CaseResult& result) const;

  const TradeReference& reference_;
  const Measure& measure_;
  Runner& run_;
  std::vector<Course> courses_;
  int runs_ = 0;
};

}  // namespace trammel::study
