// Unknowns that rows of the form a (x_i - x_j) = c make one: coordinates of points that joints hold together.
//
//     x_j = X_u(j) + o_j        u(j) the merged unknown, o_j what the rows' right sides add up to on the way to j
//
// Such rows leave a system of bodies in natural coordinates with as many unknowns as its points have, and no round-off.
// A row between unknowns that others have merged already says nothing new: it is idle.
#pragma once

#include <array>
#include <vector>

#include "linear/bodies/body_block.hpp"

namespace trammel::numerics {

class MergedUnknowns {
 public:
  void find(const std::vector<BodyBlock>& bodies, int nv, int nc);  // among the first nc rows
  // Rows of that form that are known to keep it.
  static int count_constant_rows(const std::vector<BodyBlock>& bodies, int nc);
  void take_none(int nv, int nc);                         // each unknown stays by itself
  bool hold(const std::vector<BodyBlock>& bodies) const;  // the rows found are of that form still

  int count() const { return count_; }
  int of(int j) const { return merged_[std::size_t(j)]; }
  bool takes(int row) const { return takes_[std::size_t(row)]; }
  int idle() const { return idle_; }

  void offsets(const Vec& c, Vec& o) const;
  // The rows' multipliers into y, from r = b - M x - G^T y without them, which is used up.
  void multipliers(Vec& r, Vec& y) const;

 private:
  // x_to = x_from +- c/a; roots of the trees come first.
  struct Link {
    int from, to, row;
    double a;  // of x_to in the row
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
  std::vector<std::array<Place, 2>> places_;  // of the rows taken that may change
  int count_ = 0, idle_ = 0;
};

}  // namespace trammel::numerics
