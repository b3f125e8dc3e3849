#include "testing/kit/check.hpp"

namespace trammel::kit {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::failed:
      return "failed";
    case Verdict::warned:
      return "warned";
    case Verdict::skipped:
      return "skipped";
    case Verdict::crashed:
      return "crashed";
    case Verdict::timed_out:
      return "timed out";
  }
  return "";
}

Finding finding(const Report& report) {
  return {report.holds ? Verdict::passed : Verdict::failed, report.table};
}

}  // namespace trammel::kit
