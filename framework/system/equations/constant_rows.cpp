#include "system/equations/constant_rows.hpp"

namespace trammel::model {

void ConstantRows::clear() {
  rows_.clear();
  markers_.clear();
  entries_.clear();
}

void ConstantRows::add_row(int row, double g_0) {
  rows_.push_back({row, int(markers_.size()), g_0});
}

void ConstantRows::add_marker() {
  markers_.push_back(int(entries_.size()));
  rows_.back().end = int(markers_.size());
}

void ConstantRows::add_entry(int coordinate, int velocity, double derivative) {
  if (derivative == 0) return;
  entries_.push_back({coordinate, velocity, derivative});
  markers_.back() = int(entries_.size());
}

void ConstantRows::evaluate(const Vec& q, const Vec& v, Vec& g, Vec& g_dot, Vec& gamma) const {
  const Entry* entry = entries_.data();
  int marker = 0;
  for (const Row& row : rows_) {
    double value = row.g_0, rate = 0;
    for (; marker < row.end; ++marker) {
      double place = 0, speed = 0;
      for (const Entry* const end = entries_.data() + markers_[std::size_t(marker)]; entry != end; ++entry) {
        place += entry->derivative * q[entry->coordinate];
        speed += entry->derivative * v[entry->velocity];
      }
      value += place, rate += speed;
    }
    g[row.row] = value, g_dot[row.row] = rate, gamma[row.row] = 0;
  }
}

}  // namespace trammel::model
