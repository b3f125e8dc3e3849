// A folder of its own for the records of a benchmark's run, removed at the end.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace trammel::bench {

struct RecordsFolder {
  std::filesystem::path path;
  RecordsFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "trammel_bench_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder: " + name);
    path = name;
  }
  ~RecordsFolder() { std::filesystem::remove_all(path); }
  RecordsFolder(const RecordsFolder&) = delete;
  RecordsFolder& operator=(const RecordsFolder&) = delete;
};

}  // namespace trammel::bench
