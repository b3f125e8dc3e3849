// Speeds [m/s] below which a law's impacts have no rebound, and its friction sticks: those that the law names, else the
// scene's.
#pragma once

#include "run/contact_scale.hpp"

namespace trammel::simulate {

double capture_speed(const model::ContactEntry& contact, const Scale& scale);  // of a Restitution
double stick_speed(const model::ContactEntry& contact, const Scale& scale);    // of a SetValuedFriction

}  // namespace trammel::simulate
