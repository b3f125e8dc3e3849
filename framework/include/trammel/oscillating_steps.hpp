// Forwards to the header's present place.
#pragma once

#include <trammel/methods/oscillating_steps.hpp>
