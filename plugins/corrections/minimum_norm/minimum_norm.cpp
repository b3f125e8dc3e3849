// The change of least norm of the coordinates, by the Moore-Penrose inverse of G: see row_projection.hpp. It does not
// use the masses and therefore changes the centre of mass and the momentum.
#include <trammel/plugin.hpp>

#include "../row_projection.hpp"

using MinimumNorm = trammel::RowProjection<trammel::Blend{.c_m = 0, .c_1 = 1}>;

TRAMMEL_PLUGIN(trammel::correction<MinimumNorm>("minimum_norm",
                                                "positions, velocities: the smallest change of the coordinates")
                   .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77"))
