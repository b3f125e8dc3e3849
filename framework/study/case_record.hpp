// The data that a study keeps of one case: a line of cases.ndjson, a row of study.csv.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/cases/case_run.hpp"
#include "study/study_file.hpp"

namespace trammel::study {

struct CaseRecord {
  std::size_t index = 0;
  std::uint64_t key = 0;  // Study::key
  std::uint64_t scene_hash = 0;
  std::string status, reason;
  std::vector<double> values;  // of the reductions; NaN where a run has none
  CaseCounts counts;
  double t_end = 0, cpu = 0;  // [s] reached; of set-up and simulation

  bool done() const { return status == "done"; }
};

CaseRecord record_of(const Study& study, std::size_t index, std::uint64_t key, const CaseResult& result);

std::string to_line(const CaseRecord& record);                 // JSON, ends with a new line
std::optional<CaseRecord> from_line(const std::string& line);  // empty: damaged

// By case. If a case has several records, the last one counts.
using CaseRecords = std::map<std::size_t, CaseRecord>;

// study.csv and study.npz, the same bytes for the same records: no times are in them.
std::string csv(const Study& study, const CaseRecords& records);
void write_npz(const std::filesystem::path& file, const Study& study, const CaseRecords& records);

}  // namespace trammel::study
