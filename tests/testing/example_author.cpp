// The example of framework/testing/README.md.
#include <trammel/testing/suites.hpp>

using namespace trammel;

const bool registered =
    register_integrator_suite("RungeKutta4", from_plugin(TRAMMEL_BUILD_DIR "/lib/trammel", "runge_kutta_4"),
                              {.order = 4,
                               .steps = 32,
                               .imaginary_limit = 2.828427,
                               .real_limit = 2.785294,
                               .energy = 1e-5,
                               .constraints = 1e-4});
