// The change of least kinetic energy, as ideal internal forces would make it: see row_projection.hpp. Positions keep their centre of
// mass, velocities their linear and angular momentum; kinetic energy never grows.
#include <trammel/plugin.hpp>

#include "../row_projection.hpp"

using MassWeighted = trammel::RowProjection<trammel::Blend{.c_m = 1}>;

TRAMMEL_PLUGIN(trammel::correction<MassWeighted>("mass_weighted",
                                                 "positions, velocities: the change that internal forces would make")
                   .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77"))
