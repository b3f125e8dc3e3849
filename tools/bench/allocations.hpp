// How often this program asked for memory so far.
#pragma once

namespace trammel::bench {

long long allocations();

}  // namespace trammel::bench
