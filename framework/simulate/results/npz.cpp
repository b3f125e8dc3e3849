#include "simulate/results/npz.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/crc.hpp>

#include "simulate/results/log_file.hpp"

namespace trammel::simulate {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are in memory");

constexpr std::uint32_t largest_32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint16_t zip64_field = 1, version = 45;  // 4.5: ZIP64
constexpr std::uint32_t no_date = 0x00210000;           // 1980-01-01, the first one

// Numbers of a ZIP archive are little-endian.
template <class T>
void put(std::string& bytes, T x) {
  char raw[sizeof(T)];
  std::memcpy(raw, &x, sizeof(T));
  bytes.append(raw, sizeof(T));
}
void put16(std::string& bytes, std::size_t x) {
  put(bytes, std::uint16_t(x));
}
void put32(std::string& bytes, std::uint64_t x) {
  put(bytes, std::uint32_t(std::min<std::uint64_t>(x, largest_32)));
}

// Magic, version 1.0, the length of the dictionary, and the dictionary, so that data begin at a multiple of 64 bytes.
std::string npy_header(std::string_view type, const NpzFile::Shape& shape) {
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                                       fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  constexpr std::size_t before = 10, alignment = 64;
  const std::size_t length = before + dictionary.size() + 1;
  dictionary.append((alignment - length % alignment) % alignment, ' ').push_back('\n');
  std::string header("\x93NUMPY\x01\x00", 8);
  put16(header, dictionary.size());
  return header + dictionary;
}

std::size_t count(const NpzFile::Shape& shape) {
  std::size_t n = 1;
  for (const std::size_t length : shape) n *= length;
  return n;
}

template <class T>
std::string_view bytes_of(const NpzFile::Shape& shape, std::span<const T> values) {
  if (count(shape) != values.size())
    throw std::length_error(fmt::format("{} values for an array of {}", values.size(), count(shape)));
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

// The code points of a UTF-8 text; a byte that is not UTF-8 stands for itself.
std::u32string code_points(const std::string& text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
    char32_t point = more == 0 ? first : first & (0x3f >> more);
    if (i + more >= text.size()) point = first;
    const std::size_t used = i + more < text.size() ? more : 0;
    for (std::size_t k = 1; k <= used; ++k) point = (point << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3f);
    points.push_back(point);
    i += used + 1;
  }
  return points;
}

// The fields common to local and central headers: version, flags, method (stored), date, checksum.
void put_common(std::string& bytes, std::uint32_t checksum) {
  put16(bytes, version), put16(bytes, 0), put16(bytes, 0);
  put32(bytes, no_date);
  put32(bytes, checksum);
}

}  // namespace

void NpzFile::add(std::string_view name, const Shape& shape, std::span<const double> values) {
  add_member(name, npy_header("<f8", shape), bytes_of(shape, values));
}

void NpzFile::add(std::string_view name, const Shape& shape, std::span<const std::int64_t> values) {
  add_member(name, npy_header("<i8", shape), bytes_of(shape, values));
}

void NpzFile::add(std::string_view name, std::span<const std::string> texts) {
  std::vector<std::u32string> all;
  std::size_t width = 1;  // NumPy knows no text of width 0
  for (const std::string& text : texts) width = std::max(width, all.emplace_back(code_points(text)).size());
  std::string data;
  for (std::u32string& text : all) {
    text.resize(width, U'\0');
    for (const char32_t point : text) put(data, std::uint32_t(point));
  }
  add_member(name, npy_header(fmt::format("<U{}", width), {texts.size()}), data);
}

void NpzFile::add_member(std::string_view name, const std::string& header, std::string_view data) {
  boost::crc_32_type checksum;
  checksum.process_bytes(header.data(), header.size());
  checksum.process_bytes(data.data(), data.size());
  const Member member{std::string(name) + ".npy", header.size() + data.size(), bytes_.size(), checksum.checksum()};
  // Sizes are always written in the ZIP64 field, as by numpy.savez.
  put32(bytes_, 0x04034b50);
  put_common(bytes_, member.checksum);
  put32(bytes_, largest_32), put32(bytes_, largest_32);
  put16(bytes_, member.name.size()), put16(bytes_, 20);
  bytes_ += member.name;
  put16(bytes_, zip64_field), put16(bytes_, 16);
  put(bytes_, member.size), put(bytes_, member.size);
  bytes_.append(header).append(data);
  members_.push_back(member);
}

void NpzFile::add_directory() {
  const std::uint64_t begin = bytes_.size();
  for (const Member& member : members_) {
    put32(bytes_, 0x02014b50);
    put16(bytes_, version);
    put_common(bytes_, member.checksum);
    put32(bytes_, largest_32), put32(bytes_, largest_32);
    put16(bytes_, member.name.size()), put16(bytes_, 28), put16(bytes_, 0);
    put16(bytes_, 0), put16(bytes_, 0), put32(bytes_, 0);
    put32(bytes_, largest_32);
    bytes_ += member.name;
    put16(bytes_, zip64_field), put16(bytes_, 24);
    put(bytes_, member.size), put(bytes_, member.size), put(bytes_, member.place);
  }
  const std::uint64_t size = bytes_.size() - begin, end = bytes_.size(), number = members_.size();
  put32(bytes_, 0x06064b50), put(bytes_, std::uint64_t(44));  // ZIP64 end, and where it is
  put16(bytes_, version), put16(bytes_, version), put32(bytes_, 0), put32(bytes_, 0);
  put(bytes_, number), put(bytes_, number), put(bytes_, size), put(bytes_, begin);
  put32(bytes_, 0x07064b50), put32(bytes_, 0), put(bytes_, end), put32(bytes_, 1);
  put32(bytes_, 0x06054b50), put16(bytes_, 0), put16(bytes_, 0);
  put16(bytes_, std::min<std::uint64_t>(number, 0xffff)), put16(bytes_, std::min<std::uint64_t>(number, 0xffff));
  put32(bytes_, size), put32(bytes_, begin), put16(bytes_, 0);
}

void NpzFile::close() {
  add_directory();
  write_whole(file_, bytes_);
}

}  // namespace trammel::simulate
