// trammel --version [--json]: by what a result was made, and the hash of every plugin that is found.
#pragma once

namespace trammel::tool {

void print_version(bool as_json);

}  // namespace trammel::tool
