#include "model/constant_rows.hpp"

namespace trammel::model {

void ConstantRows::clear() {
  rows_.clear();
  entries_.clear();
}

void ConstantRows::add_row(int row, double g_0) {
  rows_.push_back({row, int(entries_.size()), g_0});
}

void ConstantRows::add_entry(int coordinate, int velocity, double derivative) {
  if (derivative == 0) return;
  entries_.push_back({coordinate, velocity, derivative});
  rows_.back().end = int(entries_.size());
}

void ConstantRows::evaluate(const Vec& q, const Vec& v, Vec& g, Vec& g_dot, Vec& gamma) const {
  const Entry* entry = entries_.data();
  for (const Row& row : rows_) {
    double value = row.g_0, rate = 0;
    for (const Entry* const end = entries_.data() + row.end; entry != end; ++entry) {
      value += entry->derivative * q[entry->coordinate];
      rate += entry->derivative * v[entry->velocity];
    }
    g[row.row] = value, g_dot[row.row] = rate, gamma[row.row] = 0;
  }
}

}  // namespace trammel::model
