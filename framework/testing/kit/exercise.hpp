// A short use of a component as a run would use it: every function of its interface, at a few states.
#pragma once

#include <string>

#include "testing/kit/subject.hpp"

namespace trammel::kit {

// Uses the component and returns "" or what was not finite: "the force at t = 0.3 is not finite". A component that is
// not defined somewhere (OutsideDomain) and a step that is rejected are no faults. `seen`: every number that came back.
std::string exercise(const Subject& subject, Component& component, std::vector<double>* seen = nullptr);

}  // namespace trammel::kit
