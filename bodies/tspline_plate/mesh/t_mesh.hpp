// A T-mesh for bicubic T-splines: lines of two knot vectors, of which only parts may be drawn.
//
// The knot vectors are open (four equal knots at both ends), so lines 0 to 3 of each direction lie on the border: the
// frame. Frame lines are drawn in full, and whatever reaches the border runs on through the frame; that gives the
// border its second row of anchors. Interior knots may stand twice at most: a plate needs C1.
// Sederberg, Zheng, Bakenov, Nasri, ACM Trans. Graph. 22(3), 2003; index space as in Bazilevs et al., CMAME 199, 2010.
#pragma once

#include <span>
#include <vector>

#include "tspline_plate/mesh/edge_map.hpp"

namespace trammel::plate {

inline constexpr int degree = 3;

// A line that is only partly drawn, in the numbers of the distinct knots (0: the border): u = u_line from v_from to
// v_to.
struct PartialLine {
  int direction, line, from, to;
};

class TMesh {
 public:
  // All lines are drawn in full except those listed. Distinct knots with their multiplicities inside (1 or 2).
  // Throws std::invalid_argument: knots unsorted, C0 lines, pieces that dangle or turn a corner.
  static TMesh tensor(std::span<const double> u, std::span<const double> v, std::span<const PartialLine> partial = {});
  static TMesh uniform(int elements_u, int elements_v);  // on the unit square

  void shift(double by);  // all knots u

  const EdgeMap& edges() const { return edges_; }
  const std::vector<double>& knots(int d) const { return knots_[std::size_t(d)]; }
  double knot(int d, int line) const { return knots_[std::size_t(d)][std::size_t(line)]; }

  // The faces that have an area, by rows from below: the plate's elements.
  std::vector<Box<int>> elements() const;
  Box<double> parameters(const Box<int>& box) const;
  Box<int> indices(const Box<double>& box) const;  // of an element that exists

  // A piece of a line between two drawn lines; on the border it runs through the frame.
  void draw(int d, int line, int from, int to);
  // Both half-lines of every element named by its box: each splits in four. New knots halve the element unless a line
  // of another element already passes its middle half; knots are copied, so equal lines stay equal. `alongside` gets
  // the same new lines, undrawn.
  void cross(std::span<const Box<double>> elements, EdgeMap* alongside = nullptr);

 private:
  TMesh(std::vector<double> u, std::vector<double> v);
  void check() const;
  int middle_line(int d, double low, double high, EdgeMap* alongside);

  std::array<std::vector<double>, 2> knots_;
  EdgeMap edges_;
};

}  // namespace trammel::plate
