// The page of a study's report: curves of kept cases, reductions over a number that varies, the table of the cases.
#pragma once

#include "report/page.hpp"
#include "study/study_results.hpp"

namespace trammel::study {

report::Page page_of(const StudyContent& content, const std::string& verdict);

}  // namespace trammel::study
