// Forwards to the header's present place.
#pragma once

#include <trammel/methods/alpha_method.hpp>
