// trammel schema: the JSON Schema of scenes with the available components, for editors.
#include <fmt/format.h>

#include "arguments.hpp"
#include "input.hpp"
#include "plugin/describe.hpp"
#include "run/setting_parts.hpp"

namespace trammel::tool {

namespace {

Exit schema(const Arguments& arguments) {
  plugin::Registry registry;
  load_plugins(arguments, registry);
  fmt::print("{}\n", plugin::schema(registry.all(), simulate::setting_parts()));
  return Exit::done;
}

}  // namespace

Command schema_command() {
  return {"schema", "", "Print the JSON Schema of scene files; editors complete and check with it.", {kPlugin}, schema};
}

}  // namespace trammel::tool
