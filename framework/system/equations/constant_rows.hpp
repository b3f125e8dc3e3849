// Rows of joints that are linear in the coordinates (LinearRows): g = G q + g_0 with constant G, of which only non-zero
// entries are stored. In a truss of bars these are the rows of all pins.
#pragma once

#include <vector>

#include <trammel/types.hpp>

namespace trammel::model {

class ConstantRows {
 public:
  void clear();
  // begins a row: the following markers and entries belong to it
  void add_row(int row, double g_0);
  // begins a marker: the following entries belong to it
  void add_marker();
  void add_entry(int coordinate, int velocity, double derivative);  // 0 is not stored
  // Writes the rows to their positions. Sums are formed marker by marker, so that coinciding points give exactly 0.
  void evaluate(const Vec& q, const Vec& v, Vec& g, Vec& g_dot, Vec& gamma) const;

 private:
  struct Row {
    int row, end;  // end of the row's markers
    double g_0;
  };
  struct Entry {
    int coordinate, velocity;
    double derivative;
  };
  std::vector<Row> rows_;
  std::vector<int> markers_;  // end of each marker's entries
  std::vector<Entry> entries_;
};

}  // namespace trammel::model
