#pragma once

namespace trammel::bench {

void register_all();  // each program's own

}  // namespace trammel::bench
