// Work in child processes, each with a time limit: a job that crashes, hangs, ends its process or prints affects no
// other.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace trammel::kit {

struct Job {
  std::function<std::string()> work;  // its answer; runs in the child
  std::chrono::milliseconds limit = std::chrono::seconds(20);
};

struct Ending {
  enum class How { answered, crashed, timed_out } how = How::crashed;
  std::string answer;   // of `answered`
  std::string cause;    // otherwise: "Segmentation fault", "it ended the process with code 0"
  std::string printed;  // the beginning of what it wrote to standard output and standard error
  double seconds = 0;
};

// Runs the jobs, `parallel` at a time, and reports each ending, in the jobs' order. Throws std::system_error if the
// system gives no process.
void run_in_children(const std::vector<Job>& jobs, int parallel,
                     const std::function<void(std::size_t job, const Ending& ending)>& ended);
Ending run_in_child(const Job& job);

}  // namespace trammel::kit
