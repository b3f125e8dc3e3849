// Where the plugins of tests/faults/plugins are built, and folders to put copies of them into.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace trammel {

inline std::filesystem::path library(const std::string& name) {
  return std::filesystem::path(TRAMMEL_TEST_PLUGINS) / (name + ".so");
}

inline std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return (std::ostringstream() << stream.rdbuf()).str();
}

inline void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

// An empty folder for one test, gone afterwards.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "trammel_test_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path copy(const std::string& name, const std::string& as) const {
    std::filesystem::copy_file(library(name), path_ / as);
    return path_ / as;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace trammel
