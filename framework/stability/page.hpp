// What `trammel stability` measures of an integrator, as a page of figures and tables.
#pragma once

#include "report/page.hpp"
#include "stability/integrator_under_test.hpp"

namespace trammel::stability {

// Maps over omega h, regions of explicit methods, Baumgarte's region, formulations at small steps: what applies to the
// method; the sentences say what does not.
report::Page measure(const IntegratorUnderTest& subject);

}  // namespace trammel::stability
