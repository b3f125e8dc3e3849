#include <trammel/testing/suites.hpp>

using namespace trammel;

const bool registered =
    register_suite("Heun", integrator_checks(from_plugin(HEUN, "heun"), {.order = 2, .steps = 64, .real_limit = 2}));
