// The fronts in which a saddle-point system of bodies is eliminated, and the contents of each (equations:
// frontal_kkt.hpp).
//
// Rows between equal coordinates merge unknowns (merged_unknowns.hpp). Merged unknowns of the same bodies form one
// point; bodies and the other rows are the cliques of points for the tree (elimination_tree.hpp). A row or a body's
// mass belongs to the first front that eliminates one of its points. A row may later gain an entry for another point:
// then everything is laid out again.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "linear/bodies/body_block.hpp"
#include "linear/bodies/merged_unknowns.hpp"
#include "linear/bodies/row_places.hpp"
#include "linear/order/elimination_tree.hpp"

namespace trammel::numerics {

class FrontLayout {
 public:
  // A column of a body's Gt, which is part of a row of the front; or, with row -1, a body's mass. `map`: the front's
  // column for each of the body's `size` velocities from v0 on; -1: none.
  struct Source {
    int body, column, row, map = 0, size = 0, v0 = 0;
    bool constant = false;  // known never to change
  };
  struct Child {
    int front, map;  // map: the parent's column for each of its boundary
  };
  struct Range {
    int begin = 0, end = 0;
  };
  struct Front {
    int eliminated = 0, unknowns = 0;  // the other unknowns are the boundary
    int first_unknown = 0, first_row = 0;
    int own_rows = 0, most_rows = 0;  // most_rows: with those of all children
    Range rows, masses, children;
    int boundary() const { return unknowns - eliminated; }
  };

  // Whether rows between equal coordinates merge unknowns, or are treated like other rows.
  enum class Unknowns { merged, apart };
  // For the first nc rows, with the points at which they do not vanish now.
  void build(const std::vector<BodyBlock>& bodies, int nc, Unknowns = Unknowns::merged);
  // Adds the points at which they did not vanish before.
  void extend(const std::vector<BodyBlock>& bodies);
  // True if the layout was built for these rows and bodies.
  bool is_built_for(const std::vector<BodyBlock>& bodies, int nc) const { return rows_of_bodies_.are_of(bodies, nc); }
  bool merges_still_hold(const std::vector<BodyBlock>& bodies) const { return merged_.still_hold(bodies); }

  const MergedUnknowns& merged() const { return merged_; }
  const std::vector<Front>& fronts() const { return fronts_; }  // children first
  std::size_t all_unknowns() const { return unknowns_.size(); }
  std::size_t all_own_rows() const { return own_rows_.size(); }
  const int* unknowns(const Front& front) const { return unknowns_.data() + front.first_unknown; }
  int own_row(std::size_t i) const { return own_rows_[i]; }     // rows of a front, from its first_row on
  std::span<const Source> sources() const { return sources_; }  // front by front, rows before masses
  std::span<const Source> rows(const Front& front) const { return part(sources_, front.rows); }
  std::span<const Source> masses(const Front& front) const { return part(sources_, front.masses); }
  std::span<const Child> children(const Front& front) const { return part(children_, front.children); }
  const int* map(int at) const { return maps_.data() + at; }

 private:
  // The contents of each front.
  struct Parts {
    std::vector<std::vector<int>> rows;
    std::vector<std::vector<Source>> sources, masses;
  };
  using KnownMaps = std::map<std::vector<int>, int>;  // with their positions
  int place_map(std::vector<int> map, KnownMaps& known);
  template <class T>
  static std::span<const T> part(const std::vector<T>& all, Range range) {
    return {all.data() + range.begin, all.data() + range.end};
  }
  std::vector<int> find_points(const std::vector<BodyBlock>& bodies, std::vector<int>& weight) const;
  void find_rows(const std::vector<BodyBlock>& bodies, const std::vector<int>& point);
  Parts divide(const std::vector<BodyBlock>& bodies, const std::vector<int>& point) const;
  void place(const std::vector<BodyBlock>& bodies, const std::vector<int>& point);
  int take_unknowns(const Front& front, const std::vector<int>& points, const std::vector<std::vector<int>>& of_point,
                    std::vector<int>& column);
  Range take_sources(const std::vector<BodyBlock>& bodies, std::vector<Source>& some, const std::vector<int>& point,
                     const std::vector<int>& column, KnownMaps& known);

  int nc_ = -1;
  RowPlaces rows_of_bodies_;
  MergedUnknowns merged_;
  std::vector<std::vector<int>> points_of_row_;  // at which it was ever found not to vanish
  EliminationTree tree_;
  std::vector<Front> fronts_;
  std::vector<int> unknowns_, own_rows_;
  std::vector<int> maps_;  // maps of fronts, stored once if they are equal
  std::vector<Source> sources_;
  std::vector<Child> children_;
};

}  // namespace trammel::numerics
