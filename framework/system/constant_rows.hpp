// Rows of joints that are linear in the coordinates (LinearRows): g = G q + g_0 with constant G, of which only what differs from 0 is
// kept. In a truss of bars these are the rows of all pins.
#pragma once

#include <vector>

#include <trammel/types.hpp>

namespace trammel::model {

class ConstantRows {
 public:
  void clear();
  void add_row(int row, double g_0);                                // those that follow are of it
  void add_marker();                                                // and those of one of its markers
  void add_entry(int coordinate, int velocity, double derivative);  // 0 leaves no trace
  // Into their places. Summed marker by marker: points that coincide to the last digit leave no rounding.
  void evaluate(const Vec& q, const Vec& v, Vec& g, Vec& g_dot, Vec& gamma) const;

 private:
  struct Row {
    int row, end;  // of its markers
    double g_0;
  };
  struct Entry {
    int coordinate, velocity;
    double derivative;
  };
  std::vector<Row> rows_;
  std::vector<int> markers_;  // ends of their entries
  std::vector<Entry> entries_;
};

}  // namespace trammel::model
