// The smallest change of the coordinates themselves, by the Moore-Penrose inverse of G: see row_projection.hpp. It does not know
// masses, so centre of mass and momentum move with it.
#include <trammel/plugin.hpp>

#include "../row_projection.hpp"

using MinimumNorm = trammel::RowProjection<trammel::Blend{.c_m = 0, .c_1 = 1}>;

TRAMMEL_PLUGIN(trammel::correction<MinimumNorm>("minimum_norm",
                                                "positions, velocities: the smallest change of the coordinates")
                   .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77"))
