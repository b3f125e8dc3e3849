// Runs a study's cases on all cores and writes its folder; joins the folders of shards.
//
//     study.csv, study.npz   a row per case, in the study's order: values, reductions, counts, status
//     study.json             how it was made, failures, missing cases, the page of its report
//     cases.ndjson           the journal: only cases that are not in it are run when the study is run again
//     cases/0, cases/1, ...  with "keep": each case's results, as `trammel run` or `trammel static` writes them
//
// A case that fails is a row with its reason. Shard I of N runs the cases i with i mod N = I - 1.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/case_record.hpp"
#include "study/study_file.hpp"

namespace trammel::study {

inline constexpr const char* cases_folder = "cases";

struct Shard {
  int index = 1, of = 1;  // from 1
  bool has(std::size_t i) const { return i % std::size_t(of) == std::size_t(index - 1); }
};

struct StudyOptions {
  std::filesystem::path out;  // made if missing
  Shard shard;
  int jobs = 0;  // processes; 0: one for each core at hand
  simulate::Interrupt* interrupt = nullptr;
  simulate::CrashWitness* witness = nullptr;
  std::vector<std::string> command;
  std::function<void(std::size_t done, std::size_t of)> progress;
};

struct StudyReport {
  enum class Status { done, all_failed, incomplete, interrupted };
  Status status = Status::done;
  std::string json;     // as in study.json
  std::string summary;  // a few lines for a person
};

StudyReport run_study(const Study& study, const std::string& file, plugin::Registry& registry,
                      const StudyOptions& options);

// `folders` are results of run_study for the same study. Throws FolderRefused if they do not belong together. Missing
// cases are named and make the study incomplete.
StudyReport merge_studies(const std::vector<std::filesystem::path>& folders, const StudyOptions& options);

// Runs three cases; a sentence for a person, and as JSON.
StudyReport estimate_study(const Study& study, plugin::Registry& registry);

}  // namespace trammel::study
