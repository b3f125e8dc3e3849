#include "report/series.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace trammel::report {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::ifstream opened(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
  return in;
}

long long count_lines(const std::filesystem::path& file) {
  std::ifstream in = opened(file);
  std::vector<char> block(1 << 16);
  long long lines = 0;
  while (in.read(block.data(), std::streamsize(block.size())) || in.gcount() > 0)
    lines += std::count(block.begin(), block.begin() + in.gcount(), '\n');
  return lines;
}

// The least and the largest value of a column over an interval of rows, and which came first.
struct Extremes {
  double least = nan, largest = nan;
  long long least_at = 0, largest_at = 0;

  void take(double x, long long row) {
    if (!(x >= least)) least = x, least_at = row;  // NaN: the first one
    if (!(x <= largest)) largest = x, largest_at = row;
  }
  double first() const { return least_at <= largest_at ? least : largest; }
  double second() const { return least_at <= largest_at ? largest : least; }
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, std::size_t most_numbers) : file_(file), in_(opened(file)) {
    std::string header;
    std::getline(in_, header);
    for (std::size_t from = 0; from <= header.size();) {
      const std::size_t to = std::min(header.find(',', from), header.size());
      series_.names.push_back(header.substr(from, to - from));
      from = to + 1;
    }
    series_.rows = std::max(0LL, count_lines(file) - 1);
    series_.columns.resize(series_.names.size());
    const auto most_rows = std::max<long long>(200, (long long)(most_numbers / series_.names.size()));
    if (series_.rows > most_rows) series_.interval = (2 * series_.rows + most_rows - 1) / most_rows;
    row_.resize(series_.names.size()), extremes_.resize(series_.names.size());
  }

  Series read() {
    std::string line;
    for (long long k = 0; k < series_.rows && std::getline(in_, line); ++k) {
      parse(line, k + 2);
      series_.interval == 1 ? add_row(row_) : gather(k);
    }
    if (gathered_ > 0) add_interval();
    return std::move(series_);
  }

 private:
  void parse(const std::string& line, long long number) {
    const char *at = line.data(), *end = at + line.size();
    for (std::size_t c = 0; c < row_.size(); ++c) {
      const auto [next, error] = std::from_chars(at, end, row_[c]);
      const bool last = c + 1 == row_.size();
      if (error != std::errc() || (last ? next != end : next == end || *next != ','))
        throw std::runtime_error(fmt::format("{}:{}: expected {} numbers", file_.string(), number, row_.size()));
      at = next + 1;
    }
  }

  void add_row(const std::vector<double>& row) {
    for (std::size_t c = 0; c < row.size(); ++c) series_.columns[c].push_back(row[c]);
  }

  void gather(long long k) {
    for (std::size_t c = 0; c < row_.size(); ++c) extremes_[c].take(row_[c], k);
    if (++gathered_ == series_.interval) add_interval();
  }

  void add_interval() {
    for (std::size_t c = 0; c < row_.size(); ++c) {
      series_.columns[c].push_back(extremes_[c].first());
      series_.columns[c].push_back(extremes_[c].second());
    }
    extremes_.assign(row_.size(), {});
    gathered_ = 0;
  }

  std::filesystem::path file_;
  std::ifstream in_;
  Series series_;
  std::vector<double> row_;
  std::vector<Extremes> extremes_;
  long long gathered_ = 0;
};

}  // namespace

Series read_series(const std::filesystem::path& file, std::size_t most_numbers) {
  return Reader(file, most_numbers).read();
}

}  // namespace trammel::report
