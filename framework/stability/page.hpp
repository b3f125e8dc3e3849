// What `trammel stability` measures of an integrator, as a page of figures and tables.
#pragma once

#include "report/page.hpp"
#include "stability/integrator_under_test.hpp"
#include "study/cases/batch.hpp"

namespace trammel::stability {

// Maps over omega h, regions of explicit methods, Baumgarte's region, formulations at small steps: what applies to the
// method; the sentences say what does not.
report::Page measure(const IntegratorUnderTest& subject);

// The largest bounded step on a scene with each of these changes, which all name the same paths; one without paths: the
// scene as it is.
report::Page measure_on_scene(const IntegratorUnderTest& subject, const study::SceneSource& source,
                              plugin::Registry& registry, const std::vector<study::Overrides>& changes);

}  // namespace trammel::stability
