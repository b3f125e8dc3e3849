// Tasks on all cores, in forked processes that share what was loaded before: the registry and the scene's text.
//
// Each worker takes the next task, and its answer, a string of bytes, comes back through a pipe. A task that ends its
// worker (a crash of a plugin) is reported and the others go on in a new worker. Answers come in any order.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "run/interrupt.hpp"

namespace trammel::study {

struct Lost {
  std::size_t task = 0;
  std::string why;       // "its process was ended by signal 11"
  bool outside = false;  // by SIGKILL or SIGTERM: from outside, or for lack of memory; may be tried again
};

struct Workers {
  int jobs = 0;                                                      // 0: one for each core at hand
  std::function<std::string(std::size_t task)> work;                 // in a worker
  std::function<void(std::size_t task, const std::string&)> answer;  // here
  std::function<void(const Lost&)> lost;                             // here
  // ends the workers; their present tasks get no answer
  simulate::Interrupt* interrupt = nullptr;

  // False: interrupted. Throws std::system_error if no process can be made.
  bool run(std::span<const std::size_t> tasks) const;
};

int cores_at_hand();  // number of cores that this process may use

}  // namespace trammel::study
