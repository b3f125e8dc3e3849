// trammel --version [--json]: the program and how it was built, and the hash of every plugin library that is found.
#pragma once

namespace trammel::tool {

void print_version(bool as_json);

}  // namespace trammel::tool
