// Unknowns that rows of the form a (x_i - x_j) = c merge into one: coordinates of points that joints hold together.
//
//     x_j = X_u(j) + o_j        u(j): the merged unknown, o_j: sum of c/a along the tree from its root to j
//
// Then a system of bodies in natural coordinates has only the unknowns of its points, without round-off. A row between
// unknowns that are already merged adds no information: it is idle.
#pragma once

#include <array>
#include <vector>

#include "linear/bodies/body_block.hpp"

namespace trammel::numerics {

class MergedUnknowns {
 public:
  void find(const std::vector<BodyBlock>& bodies, int nv, int nc);  // among the first nc rows
  // Number of rows that are known to keep that form.
  static int count_constant_rows(const std::vector<BodyBlock>& bodies, int nc);
  void take_none(int nv, int nc);                               // no unknowns are merged
  bool still_hold(const std::vector<BodyBlock>& bodies) const;  // the rows found still have that form

  int count() const { return count_; }
  int of(int j) const { return merged_[std::size_t(j)]; }
  bool takes(int row) const { return takes_[std::size_t(row)]; }
  int idle() const { return idle_; }

  void offsets(const Vec& c, Vec& o) const;
  // Writes the rows' multipliers to y, from r = b - M x - G^T y without them; r is overwritten.
  void multipliers(Vec& r, Vec& y) const;

 private:
  // x_to = x_from +- c/a; roots of the trees come first.
  struct Link {
    int from, to, row;
    double a;  // coefficient of x_to in the row
  };
  struct Place {
    std::size_t body = 0;
    Eigen::Index column = 0, at = 0;
  };
  struct Difference {
    std::array<Place, 2> places;
    double a[2] = {0, 0};
    int entries = 0;
    bool constant = true;
    void add(const Place& place, double value);
    bool merges() const { return entries == 2 && a[0] == -a[1] && places[0].body != places[1].body; }
  };
  static std::vector<Difference> differences(const std::vector<BodyBlock>& bodies, int nc);
  void join(const std::vector<BodyBlock>& bodies, const std::vector<Difference>& rows);
  void number(const std::vector<std::vector<Link>>& at);

  std::vector<int> merged_;
  std::vector<char> takes_;
  std::vector<Link> links_;
  std::vector<std::array<Place, 2>> places_;  // of the merging rows that may change
  int count_ = 0, idle_ = 0;
};

}  // namespace trammel::numerics
