// cases.ndjson: the finished cases, one per line, in the order in which they ended. It survives a kill; an incomplete
// last line is removed.
#pragma once

#include <filesystem>

#include "simulate/results/log_file.hpp"
#include "study/case_record.hpp"

namespace trammel::study {

inline constexpr const char* journal_name = "cases.ndjson";

// Whole lines of a journal; none if there is no file. Damaged lines are left out.
std::vector<CaseRecord> read_journal(const std::filesystem::path& folder);

class Journal {
 public:
  // Continues after the last complete line of the folder's journal. Throws OutputError.
  explicit Journal(const std::filesystem::path& folder);
  void add(const std::string& line);  // written at once
 private:
  simulate::LogFile log_;
};

}  // namespace trammel::study
