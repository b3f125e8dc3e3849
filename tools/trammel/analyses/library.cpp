// What the program finds in libtrammel_commands.so.
#include "analyses.hpp"
#include "analyses/after_run.hpp"
#include "analyses/commands.hpp"

extern "C" __attribute__((visibility("default"))) const trammel::tool::Analyses* trammel_analyses() {
  using namespace trammel::tool;
  static const Analyses all{{static_command(), modes_command(), explain_command(), study_command(), trade_command(),
                             compare_command(), check_command(), stability_command()},
                            verify,
                            find_remedy};
  return &all;
}
