// Compares two results folders: files, the first different row and column, the number of equal digits, and how the
// results were made.
//
// Times of computing, dates and command lines always differ and do not count. In tables (CSV) and lines of JSON
// (NDJSON) the first difference is reported by row and column, and the largest one of the whole file. The digits that
// two numbers share are -log10(|a - b| / max(|a|, |b|)), 17 at most.
#pragma once

#include <filesystem>
#include <string>

namespace trammel::study {

struct Comparison {
  bool equal = true;  // of the results; the way they were made may differ
  std::string text, json;
};

// Throws FolderRefused if one of them is no folder of results.
Comparison compare(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace trammel::study
