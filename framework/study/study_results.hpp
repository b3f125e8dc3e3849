// Writes study.json, study.csv and study.npz from the present records.
#pragma once

#include <cstdint>

#include <nlohmann/json.hpp>

#include "study/study_run.hpp"

namespace trammel::study {

inline constexpr const char* study_json = "study.json";

struct StudyContent {
  const Study& study;
  std::filesystem::path folder;  // of the results
  std::string file;              // of the study, absolute
  std::uint64_t scene_hash = 0;  // of the scene without the values of cases
  Shard shard;
  CaseRecords records;
  nlohmann::ordered_json made;  // provenance
};

// Cases of the shard that have no record.
std::vector<std::size_t> missing(const StudyContent& content);
nlohmann::ordered_json to_json(const StudyContent& content, const char* status);
// Writes all files; the summary states the outcome.
StudyReport write_results(const StudyContent& content, bool interrupted);

}  // namespace trammel::study
