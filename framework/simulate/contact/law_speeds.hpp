// Speeds [m/s] below which impacts have no rebound and friction sticks: those that the law names, otherwise those of
// the scene.
#pragma once

#include "run/contact_scale.hpp"

namespace trammel::simulate {

double capture_speed(const model::ContactEntry& contact, const Scale& scale);  // of a Restitution
double stick_speed(const model::ContactEntry& contact, const Scale& scale);    // of a SetValuedFriction

}  // namespace trammel::simulate
