// trammel compare A B: what differs between two results folders.
#include <fmt/format.h>

#include "arguments.hpp"
#include "input.hpp"
#include "next.hpp"
#include "study/compare.hpp"

namespace trammel::tool {

namespace {

Exit run_compare(const Arguments& arguments) {
  if (arguments.operands().size() != 2)
    throw UsageError("'trammel compare' needs two results folders: trammel compare A B");
  const study::Comparison comparison = study::compare(arguments.operands()[0], arguments.operands()[1]);
  if (arguments.has(kJson.name))
    print_json_text(comparison.json);
  else
    print_line(comparison.text);
  print_next(arguments, {"trammel", "report", arguments.operands()[0], arguments.operands()[1]});
  return comparison.equal ? Exit::done : Exit::failed;
}

}  // namespace

Command compare_command() {
  return {"compare",
          "A B",
          "Compare two results folders: which files differ, where first, by how many digits, and how each was made.",
          {kJson},
          run_compare,
          2};
}

}  // namespace trammel::tool
