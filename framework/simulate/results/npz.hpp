// NumPy's .npz: arrays by name in one file, for numpy.load.
//
//     NpzFile file("series.npz");
//     file.add("t", {n}, t), file.add("shape", {n, 2}, xy);     // the last index runs fastest
//     file.close();
//
// A ZIP archive of stored (not compressed) members NAME.npy, little-endian; larger than 4 GiB by ZIP64. The same arrays
// give the same bytes: members have no date. Formats: NumPy Enhancement Proposal 1; PKWARE APPNOTE.TXT 6.3.10, sections
// 4.3.7, 4.3.12, 4.3.14 to 4.3.16 and 4.5.3.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trammel::simulate {

class NpzFile {
 public:
  using Shape = std::vector<std::size_t>;

  explicit NpzFile(std::filesystem::path file) : file_(std::move(file)) {}

  // The product of the shape's lengths is the number of values. Names are unique. Throws std::length_error.
  void add(std::string_view name, const Shape& shape, std::span<const double> values);
  void add(std::string_view name, const Shape& shape, std::span<const std::int64_t> values);
  void add(std::string_view name, std::span<const std::string> texts);  // UTF-8; one dimension, fixed width

  // Writes the file and renames it into place; without `close` nothing is written. Throws OutputError.
  void close();

 private:
  struct Member {
    std::string name;
    std::uint64_t size = 0, place = 0;  // [bytes]
    std::uint32_t checksum = 0;
  };
  void add_member(std::string_view name, const std::string& header, std::string_view data);
  void add_directory();

  std::filesystem::path file_;
  std::string bytes_;
  std::vector<Member> members_;
};

}  // namespace trammel::simulate
