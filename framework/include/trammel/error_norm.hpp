// Forwards to the header's present place.
#pragma once

#include <trammel/methods/error_norm.hpp>
