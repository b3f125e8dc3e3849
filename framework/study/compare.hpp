// What differs between two results folders: files, the first row and column, by how many digits, and what differs in
// how they were made.
//
// Times of computing, dates and command lines differ always and do not count. In tables (CSV) and lines of JSON
// (NDJSON) the first difference is told by row and column, and over the whole file the largest: the digits that two
// numbers share are -log10(|a - b| / max(|a|, |b|)), 17 at most.
#pragma once

#include <filesystem>
#include <string>

namespace trammel::study {

struct Comparison {
  bool equal = true;  // of results; how they were made may differ
  std::string text, json;
};

// Throws FolderRefused if one of them is no folder of results.
Comparison compare(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace trammel::study
