// The saddle-point systems of kkt.hpp for many bodies, by sparse direct factorisations:
//
//     [S W^T] [x]   [b]
//     [G  0 ] [y] = [c]
//
//  - Mass: S = M, one dense block a body, and W = G. The Schur complement G M^-1 G^T is a sum over bodies, each giving a
//    block on the rows that touch it; sparse LDL^T, ordered once for a pattern (approximate minimum degree).
//  - Iteration: S any sparse matrix, W any. Sparse LU with partial pivoting of the whole.
//
// Redundant rows: the factorised matrix is the complement plus eps I (Iteration: -eps I in the corner), and residuals of the
// unchanged equations are corrected with it. This is a proximal point iteration: its steps lie in the range of the rows, so
// y comes out as the one of minimum norm, and directions of the rows with sigma^2 < eps count as redundant. x is unique.
//
// Long chains have such directions that are not redundant: their softest sigma falls with n^-2 (masts) or n^-3 (hoops). From
// `long_chain` rows on redundant ones are left to conjugate gradients on the complement, which they see as a product of its factors,
// so with sigma and not its square against round-off, preconditioned by semidefinite_ldlt.hpp. Then y is a solution of few entries
// on redundant rows, not the one of minimum norm. Rows that contradict each other go the other way.
#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include "numerics/recorded_matrix.hpp"
#include "numerics/semidefinite_ldlt.hpp"

namespace trammel::numerics {

// What one body contributes: its mass and the rows of G that touch it.
struct BodyBlock {
  int v0 = 0;             // place of its velocities
  Mat M;                  // n x n
  std::vector<int> rows;  // ascending
  Mat Gt;                 // n x rows.size(): those rows of G, transposed, its own columns
  Mat Wt;                 // of W, where it is not G
};

// rc += c G x,  r += c G^T y,  r += c W^T y,  r += c M a. Rows beyond the length of rc or y are left out.
void add_rows_times(const std::vector<BodyBlock>& bodies, double c, const Vec& x, Vec& rc);
void add_rows_force(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r);
void add_reaction(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r);
void add_mass_times(const std::vector<BodyBlock>& bodies, double c, const Vec& a, Vec& r);

class SparseMassKkt {
 public:
  static constexpr int long_chain = 1000;
  enum class Metric { mass, mass_of_before, identity };  // what stands for M; of_before: its factors are kept
  // Of the first nc rows. False: a body's mass is not positive definite. `rank_tolerance` as in kkt.hpp.
  bool factorise(const std::vector<BodyBlock>& bodies, int nc, Metric metric, double rank_tolerance = 1e-7);
  // The bodies are those of `factorise`.
  void solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  bool redundant() const { return redundant_; }

 private:
  struct Factor {
    Eigen::LLT<Mat> mass;
    Mat Y;  // L^-1 G^T
  };
  void assemble(const std::vector<BodyBlock>& bodies, double eps);
  void move(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& y, Vec& x);  // x = M^-1 (b - G^T y)

  void regularise(const std::vector<BodyBlock>& bodies);
  void remove_null_part(Vec& r);
  bool conjugate_gradients(const std::vector<BodyBlock>& bodies, const Vec& c, Vec& x, Vec& y);

  int nc_ = 0;
  double eps_ = 0;  // while redundant
  double rank_tolerance_ = 0;
  bool redundant_ = false;
  bool regular_ = false;  // ldlt_ is that of the complement plus eps
  std::vector<Factor> factors_;
  RecordedMatrix schur_;  // lower triangle
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt_;
  SemidefiniteLdlt semidefinite_;
  bool pattern_known_ = false;  // to semidefinite_
  Vec diagonal_, z_, residual_, dy_, along_, moved_, right_;
};

class SparseIterationKkt {
 public:
  // `tangent(add)` calls add(i, j, value) for every entry of S (nv x nv). Coupled: the bodies' Wt count, else W = G.
  template <class Tangent>
  void factorise(const std::vector<BodyBlock>& bodies, int nv, int nc, bool coupled, Tangent&& tangent) {
    const bool fresh = full_.fill(nv + nc, nv + nc, [&](RecordedMatrix& m) {
      tangent([&m](int i, int j, double value) { m.add(i, j, value); });
      add_rows(bodies, nv, nc, coupled, m);
    });
    factorise_full(nv, nc, fresh);
  }
  // False: not solvable, or not finite.
  [[nodiscard]] bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);

 private:
  void add_rows(const std::vector<BodyBlock>& bodies, int nv, int nc, bool coupled, RecordedMatrix& m);
  void factorise_full(int nv, int nc, bool fresh);

  RecordedMatrix full_;
  Eigen::SparseMatrix<double> regular_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
  int nv_ = 0;
  bool failed_ = false;
  Vec right_, solution_, residual_;
};

}  // namespace trammel::numerics
