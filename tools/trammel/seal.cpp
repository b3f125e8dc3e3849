// trammel seal LIB: write the checksum of a plugin's code into it.
#include "plugin/seal.hpp"

#include "arguments.hpp"

namespace trammel::tool {

namespace {

Exit run_seal(const Arguments& arguments) {
  plugin::seal(arguments.operand());
  return Exit::done;
}

}  // namespace

Command seal_command() {
  return {"seal",
          "LIB",
          "Write the checksum of a plugin's code into its file: it is refused if it is damaged afterwards.",
          {},
          run_seal};
}

}  // namespace trammel::tool
