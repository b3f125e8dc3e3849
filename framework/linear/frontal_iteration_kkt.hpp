// The saddle-point system with a sparse S,
//
//     [S W^T] [x]   [b]
//     [G  0 ] [y] = [c]        S nv x nv; G and W: nc x nv
//
// by elimination in fronts (frontal_factors.hpp): a plate of thousands of coordinates, a chain of thousands of links.
// The columns of S are scaled to size one, and those of W with them, so that pivots show dependent rows for any masses
// and units:
//
//     [D S D    D W^T E] [D^-1 x]   [D b]        D, E diagonal, of powers of two, which cause no rounding
//     [E G D       0   ] [E^-1 y] = [E c]
//
// If rows depend on each other, or exchanges within fronts are not sufficient, the slower sparse LU of
// sparse_iteration_kkt.hpp takes over, unscaled: y is then of minimum norm, and other singularities are reported. The
// pattern is analysed when it grows: once per mesh, and when contacts reach new places.
#pragma once

#include <trammel/types.hpp>

#include "linear/fronts/frontal_factors.hpp"
#include "linear/kkt.hpp"
#include "linear/sparse/sparse_sum.hpp"
#include "linear/sparse_iteration_kkt.hpp"

namespace trammel::numerics {

class FrontalIterationKkt {
 public:
  // The sum of S, W^T and G. Entries added before the first `factorise` reserve places that are kept.
  SparseSum& sum() { return full_; }
  // `additions()` adds everything to the sum; it may be run twice. `independent()` returns whether the rows are
  // independent; it is called where small pivots leave this open.
  template <class Independent, class Additions>
  void factorise(int nv, int nc, Independent&& independent, Additions&& additions) {
    full_.fill(nv + nc, additions);
    nv_ = nv;
    by_fronts_ = factorise_sum() && (pivots_are_safe() || independent());
    if (!by_fronts_) fall_back();
  }
  void measure_by(Levers levers) { levers_ = std::move(levers); }
  template <class Additions>
  void factorise(int nv, const Mat& G, double rank_tolerance, Additions&& additions) {
    safe_pivot_ = 100 * rank_tolerance;
    factorise(
        nv, int(G.rows()), [&] { return rank_of_rows(G, rank_tolerance, levers_) == G.rows(); }, additions);
  }
  // False: not solvable (singular beyond redundant rows), or not finite.
  [[nodiscard]] bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);

 private:
  bool factorise_sum();
  void find_scale();
  bool pivots_are_safe() const;
  void fall_back();

  SparseSum full_;
  FrontalFactors fronts_;
  SparseIterationKkt fallback_;
  bool by_fronts_ = false, finite_ = true;
  int nv_ = 0, analysed_ = 0;  // analysed_: number of patterns analysed
  double safe_pivot_ = 1e-5;   // relative to its column
  Vec scale_;                  // D and E
  Vec right_, solution_;
  Levers levers_;
};

}  // namespace trammel::numerics
