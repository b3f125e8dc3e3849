// The pictures of `trammel check --report`: of an integrator its measured orders, spectral radius, drifts, work against
// precision beside every built-in, and the honesty of its error estimate.
#pragma once

#include "report/page.hpp"
#include "testing/kit/integrators/work_precision.hpp"
#include "testing/kit/run.hpp"
#include "testing/kit/subject.hpp"

namespace trammel::kit {

// The verdicts as sentences and a table; for every kind.
report::Page verdict_page(const Verdicts& verdicts);

void add_orders(report::Page& page, const Subject& s);
void add_spectral_radius(report::Page& page, const Subject& s);
void add_drifts(report::Page& page, const Subject& s);
void add_work_precision(report::Page& page, const Subject& s, const std::vector<Contender>& others);
void add_honesty(report::Page& page, const Subject& s);

// All of them for the component of the request, beside the integrators that are installed. Executes the plugin's code:
// call it in a child process.
report::Page measured_page(const Request& request, const Surveyed& component, report::Page page);

// A page as text and back, from the child that measured it.
std::string text_of(const report::Page& page);
report::Page page_of_text(const std::string& text);

}  // namespace trammel::kit
