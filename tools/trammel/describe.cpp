// trammel describe COMPONENT: its manual page, from its declaration.
#include <fmt/format.h>

#include "arguments.hpp"
#include "input.hpp"
#include "plugin/describe.hpp"

namespace trammel::tool {

namespace {

Exit describe(const Arguments& arguments) {
  plugin::Registry registry;
  load_plugins(arguments, registry);
  try {
    const char* separator = "";
    for (const plugin::Entry* entry : registry.find_any(arguments.operand())) {
      fmt::print("{}{}", separator, plugin::describe(*entry));
      separator = "\n";
    }
  } catch (const plugin::UnknownComponent& unknown) {
    throw UsageError(unknown.what());
  }
  return Exit::done;
}

}  // namespace

Command describe_command() {
  return {"describe",
          "COMPONENT",
          "Show a component's manual page: equations' source, parameters, units, ranges.",
          {kPlugin},
          describe};
}

}  // namespace trammel::tool
