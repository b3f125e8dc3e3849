// Forwards to the header's present place.
#pragma once

#include <trammel/testing/measurements.hpp>
