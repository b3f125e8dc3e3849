// The saddle-point system of many coordinates and few rows,
//
//     [S W^T] [x]   [b]
//     [G  0 ] [y] = [c]        S sparse, nv x nv; G and W: nc x nv
//
// front by front (frontal_factors.hpp): a plate of thousands of coordinates. Where rows depend on each other, or exchanges within fronts
// do not serve, by the slower sparse LU of sparse_kkt.hpp: y is then of minimum norm, and what is singular beyond the rows is told.
// The pattern is analysed when it widens: once per mesh, and as contacts reach what they have not touched.
#pragma once

#include <trammel/types.hpp>

#include "linear/fronts/frontal_factors.hpp"
#include "linear/kkt.hpp"
#include "linear/sparse_kkt.hpp"
#include "linear/sparse/sparse_sum.hpp"

namespace trammel::numerics {

class FrontalIterationKkt {
 public:
  // The sum of S, W^T and G; what it is given before the first `factorise` to reserve stays.
  SparseSum& sum() { return full_; }
  // `additions()` adds all of it to the sum; it may be run twice.
  template <class Additions>
  void factorise(int nv, const Mat& G, double rank_tolerance, Additions&& additions) {
    full_.fill(nv + int(G.rows()), additions);
    factorise_sum(nv, G, rank_tolerance);
  }
  // False: not solvable (singular beyond redundant rows), or not finite.
  [[nodiscard]] bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);

 private:
  void factorise_sum(int nv, const Mat& G, double rank_tolerance);
  bool rows_are_independent(const Mat& G, double rank_tolerance) const;

  SparseSum full_;
  FrontalFactors fronts_;
  SparseIterationKkt fallback_;
  bool by_fronts_ = false, finite_ = true;
  int nv_ = 0, analysed_ = 0;  // analysed_: patterns
  Vec right_, solution_;
};

}  // namespace trammel::numerics
