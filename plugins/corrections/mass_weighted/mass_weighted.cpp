// The change of least kinetic energy, equivalent to ideal internal forces: see row_projection.hpp. It preserves the
// centre of mass and the linear and angular momentum; the kinetic energy never increases.
#include <trammel/plugin.hpp>

#include "../row_projection.hpp"

using MassWeighted = trammel::RowProjection<trammel::Blend{.c_m = 1}>;

TRAMMEL_PLUGIN(trammel::correction<MassWeighted>("mass_weighted",
                                                 "positions, velocities: the change that internal forces would make")
                   .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77"))
