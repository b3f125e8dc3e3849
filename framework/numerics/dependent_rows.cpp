#include "numerics/dependent_rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "numerics/elimination_order.hpp"

namespace trammel::numerics {

namespace {

// Of entries beside a row's length. Larger ones count: a long mast is soft by them.
constexpr double round_off = 1e-13;

// Columns are tied that occur in one row.
Graph ties_of_columns(const SparseRows& G) {
  Graph ties(static_cast<std::size_t>(G.cols()));
  for (int i = 0; i < G.rows(); ++i)
    for (SparseRows::InnerIterator one(G, i); one; ++one)
      for (SparseRows::InnerIterator other(G, i); other; ++other)
        if (one.col() != other.col()) ties[std::size_t(one.col())].push_back(int(other.col()));
  for (std::vector<int>& tied : ties) {
    std::sort(tied.begin(), tied.end());
    tied.erase(std::unique(tied.begin(), tied.end()), tied.end());
  }
  return ties;
}

std::vector<int> places(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[std::size_t(order[k])] = int(k);
  return place;
}

class Triangle {
 public:
  Triangle(int columns, double tolerance)
      : tolerance_(tolerance),
        rows_(static_cast<std::size_t>(columns)),
        left_(rows_.size(), 0.0),
        of_row_(rows_.size(), 0.0),
        is_active_(rows_.size(), 0) {}

  // What is left of a row that is given by put(), of length 1. False: nothing.
  bool take() {
    while (!active_.empty()) {
      const int k = next();
      if (std::abs(left_[std::size_t(k)]) <= round_off) continue;
      if (is_nothing(k)) return forget();
      Row& row = rows_[std::size_t(k)];
      if (row.empty()) {
        keep(k, row);
        return true;
      }
      rotate(k, row);
    }
    return false;
  }
  void put(int place, double value) {
    touch(place);
    left_[std::size_t(place)] += value;
  }

 private:
  struct Entry {
    int place;
    double value;
  };
  using Row = std::vector<Entry>;  // the diagonal first

  void touch(int place) {
    if (is_active_[std::size_t(place)]) return;
    is_active_[std::size_t(place)] = 1;
    left_[std::size_t(place)] = 0;
    active_.push_back(place);
    std::push_heap(active_.begin(), active_.end(), std::greater<>());
  }
  bool is_nothing(int k) const {
    const auto add = [this](double sum, int place) {
      return sum + left_[std::size_t(place)] * left_[std::size_t(place)];
    };
    return std::accumulate(active_.begin(), active_.end(), add(0, k), add) <= tolerance_ * tolerance_;
  }
  bool forget() {
    for (const int place : active_) is_active_[std::size_t(place)] = 0;
    active_.clear();
    return false;
  }
  int next() {
    std::pop_heap(active_.begin(), active_.end(), std::greater<>());
    const int k = active_.back();
    active_.pop_back();
    is_active_[std::size_t(k)] = 0;
    return k;
  }
  void keep(int k, Row& row) {
    row.push_back({k, left_[std::size_t(k)]});
    for (const int place : active_) {
      row.push_back({place, left_[std::size_t(place)]});
      is_active_[std::size_t(place)] = 0;
    }
    active_.clear();
  }
  // The row of R and what is left, so that the latter has no part at k any more.
  void rotate(int k, Row& row) {
    const double r = row.front().value, a = left_[std::size_t(k)], length = std::hypot(r, a);
    const double cos = r / length, sin = a / length;
    for (std::size_t i = 1; i < row.size(); ++i) {
      touch(row[i].place);
      of_row_[std::size_t(row[i].place)] = row[i].value;
    }
    row.assign(1, {k, length});
    for (const int place : active_) {
      double &one = of_row_[std::size_t(place)], &other = left_[std::size_t(place)];
      row.push_back({place, cos * one + sin * other});
      other = cos * other - sin * one;
      one = 0;
    }
  }

  double tolerance_;
  std::vector<Row> rows_;     // of R, by the place of their diagonal
  std::vector<double> left_;  // of the row at hand, at its active places
  std::vector<double> of_row_;
  std::vector<char> is_active_;
  std::vector<int> active_;  // a heap, the first place on top
};

}  // namespace

std::vector<int> dependent_rows(const SparseRows& G, double tolerance) {
  const std::vector<int> weight(std::size_t(G.cols()), 1);
  const std::vector<int> place = places(by_dissection(ties_of_columns(G), weight));
  Triangle triangle(int(G.cols()), tolerance);
  std::vector<int> dependent;
  for (int i = 0; i < G.rows(); ++i) {
    const double length = G.row(i).norm();
    for (SparseRows::InnerIterator entry(G, i); entry; ++entry)
      if (entry.value() != 0) triangle.put(place[std::size_t(entry.col())], entry.value() / length);
    if (!triangle.take()) dependent.push_back(i);
  }
  return dependent;
}

}  // namespace trammel::numerics
