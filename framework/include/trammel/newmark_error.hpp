// Forwards to the header's present place.
#pragma once

#include <trammel/methods/newmark_error.hpp>
