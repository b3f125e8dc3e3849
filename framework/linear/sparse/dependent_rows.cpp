#include "linear/sparse/dependent_rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "linear/order/elimination_order.hpp"

namespace trammel::numerics {

namespace {

// Relative to a row of length 1. Entries below `round_off` are left out. `eps` is R's diagonal where there is no row
// yet: it must be below round-off, because a row that is a sum of others times large numbers, as in long hoops, seems
// new by eps times these numbers.
constexpr double round_off = 1e-15, eps = 1e-17;

std::vector<std::vector<int>> columns_of_rows(const SparseRows& G) {
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(G.rows()));
  for (int i = 0; i < G.rows(); ++i)
    for (SparseRows::InnerIterator entry(G, i); entry; ++entry) columns[std::size_t(i)].push_back(int(entry.col()));
  return columns;
}

std::vector<int> places(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[std::size_t(order[k])] = int(k);
  return place;
}

// R^T R = G^T G + eps^2 1 for the rows taken. For a new row r, the rotations with the rows of R lengthen their
// diagonals by a total factor of sqrt(1 + r (R^T R)^-1 r^T); times eps this is the length of r's component
// perpendicular to the rows before.
class Triangle {
 public:
  explicit Triangle(int columns)
      : rows_(static_cast<std::size_t>(columns)),
        left_(rows_.size(), 0.0),
        of_row_(rows_.size(), 0.0),
        is_active_(rows_.size(), 0) {}

  // Sets an entry of the next row, which has length 1.
  void put(int place, double value) {
    touch(place);
    left_[std::size_t(place)] += value;
  }
  // Adds that row, or leaves R unchanged if its new component is at most `tolerance`.
  bool take(double tolerance) {
    before_.clear();
    double part = eps;
    while (!active_.empty())
      if (const int k = next(); std::abs(left_[std::size_t(k)]) > round_off) part *= rotate(k, rows_[std::size_t(k)]);
    if (part > tolerance) return true;
    for (Row& row : before_) rows_[std::size_t(row.front().place)] = std::move(row);
    return false;
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
  int next() {
    std::pop_heap(active_.begin(), active_.end(), std::greater<>());
    const int k = active_.back();
    active_.pop_back();
    is_active_[std::size_t(k)] = 0;
    return k;
  }
  // Rotates row k of R with the rest of the new row, which then has no entry at k. Returns the factor by which the
  // diagonal grows.
  double rotate(int k, Row& row) {
    if (row.empty()) row.push_back({k, eps});
    const double r = row.front().value, a = left_[std::size_t(k)], length = std::hypot(r, a);
    const double cos = r / length, sin = a / length;
    for (std::size_t i = 1; i < row.size(); ++i) {
      touch(row[i].place);
      of_row_[std::size_t(row[i].place)] = row[i].value;
    }
    before_.push_back(std::move(row));
    row.assign(1, {k, length});
    for (const int place : active_) {
      double &one = of_row_[std::size_t(place)], &other = left_[std::size_t(place)];
      row.push_back({place, cos * one + sin * other});
      other = cos * other - sin * one;
      one = 0;
    }
    return length / r;
  }

  std::vector<Row> rows_;     // of R, by the place of their diagonal; empty: eps only
  std::vector<Row> before_;   // those that the present row has changed, each once
  std::vector<double> left_;  // of the present row, at its active places
  std::vector<double> of_row_;
  std::vector<char> is_active_;
  std::vector<int> active_;  // a heap, the first place on top
};

double length_of(const SparseRows& G, int row) {
  double sum = 0;
  for (SparseRows::InnerIterator entry(G, row); entry; ++entry) sum += entry.value() * entry.value();
  return std::sqrt(sum);
}

}  // namespace

std::vector<int> dependent_rows(const SparseRows& G, double tolerance) {
  const std::vector<int> weight(std::size_t(G.cols()), 1);
  const std::vector<int> place = places(by_dissection(graph_of(columns_of_rows(G), weight.size()), weight));
  Triangle triangle(int(G.cols()));
  std::vector<int> dependent;
  for (int i = 0; i < G.rows(); ++i) {
    const double length = length_of(G, i);
    for (SparseRows::InnerIterator entry(G, i); entry; ++entry)
      if (entry.value() != 0) triangle.put(place[std::size_t(entry.col())], entry.value() / length);
    if (!triangle.take(tolerance)) dependent.push_back(i);
  }
  return dependent;
}

}  // namespace trammel::numerics
