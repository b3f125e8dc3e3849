// Maps velocities from the null space of the rows at the step's end to that at the corrected position:
//
//     V = null(G(q)),   V' = null(G(q')),   v = V Z + v_rows      V'^T V = X S Y^T  (singular values)
//     v' = V' X Y^T Z + v_t                 v_t: least norm with G v_t = -g_t
//
// X Y^T is the rotation that brings V nearest to V' (Procrustes). It preserves the coefficients Z and hence the norm of
// v, or the kinetic energy if the bases are orthonormal in M. Momenta change by a term of second order in the
// correction. If the rows permit no motion, as in a truss that has locked, v' = v_t.
//
// Matrices are dense: the cost grows with the cube of the sizes. Chen Xiangyang, Chinese J. Comput. Mech. 19, 74-77
// (2002), section 4.
#include <Eigen/SVD>

#include <trammel/correction.hpp>
#include <trammel/decompositions.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

// Relative to 1 and the velocities: rates of the rows that are round-off of G v.
constexpr double no_rate = 1e-14;
constexpr double redundant = 1e-9;  // pivots: redundant rows differ by the square of the violation

class NullSpaceRotation final : public Correction {
 public:
  enum class Metric { mass, identity };
  Metric metric = Metric::mass;

  bool corrects(Level level) const override { return level == Level::velocity; }

  // With v = L^-T w (M = L L^T, or L = 1) the metric of w is Euclidean and its rows are B = G L^-T.
  Outcome apply(Level, System& s, const Step& step, State& state) override {
    if (s.sizes().nc == 0) return Outcome::accept();
    move(s, step.uncorrected);
    const Vec w = L_.transpose() * state.v;
    const Mat V = null_space(B_);
    const Vec free = V.transpose() * w;
    move(s, state);
    const Mat V_new = null_space(B_);
    if (V.cols() != V_new.cols())
      return Outcome::reject("the rank of the rows changes with the correction of the positions");
    Vec moving = s.g_dot();  // g_t
    s.add_rows_times(-1, state.v, moving);
    Vec w_new = V_new * (nearest_rotation(V_new.transpose() * V) * free);
    if (!moving.isZero(no_rate * (1 + w.norm()))) w_new -= cod_.solve(moving);
    state.v = L_.transpose().triangularView<Eigen::Upper>().solve(w_new);
    return Outcome::accept();
  }

 private:
  // Computes L_ and B_ = G L^-T at a state; the columns of G are its products with unit vectors.
  void move(System& s, const State& state) {
    s.move_to(state.t, state.q, state.v);
    const auto nv = Eigen::Index(s.sizes().nv), nc = Eigen::Index(s.sizes().nc);
    L_.setIdentity(nv, nv);
    Mat M = Mat::Zero(nv, nv);
    B_.setZero(nc, nv);
    for (Eigen::Index j = 0; j < nv; ++j) {
      const Vec unit = Vec::Unit(nv, j);
      Vec column = Vec::Zero(nv), row = Vec::Zero(nc);
      if (metric == Metric::mass) s.add_mass_times(1, unit, column), M.col(j) = column;
      s.add_rows_times(1, unit, row), B_.col(j) = row;
    }
    if (metric == Metric::mass) L_ = Eigen::LLT<Mat>(M).matrixL();
    B_ = L_.triangularView<Eigen::Lower>().solve(B_.transpose()).transpose();
  }

  Mat null_space(const Mat& B) {
    cod_.setThreshold(redundant);
    cod_.compute(B);
    const Mat Z = cod_.matrixZ();  // B = Q [T 0; 0 0] Z
    const auto rank = cod_.rank();
    return (cod_.colsPermutation() * Z.transpose()).rightCols(B.cols() - rank);
  }

  // X Y^T of A = X S Y^T. An empty matrix, which JacobiSVD does not accept, is returned unchanged.
  static Mat nearest_rotation(const Mat& A) {
    if (A.size() == 0) return A;
    const Eigen::JacobiSVD<Mat> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return svd.matrixU() * svd.matrixV().transpose();
  }

  Mat L_, B_;
  Eigen::CompleteOrthogonalDecomposition<Mat> cod_;
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::correction<NullSpaceRotation>("null_space_rotation", "velocities: turned with the null space of the rows")
        .source("Chen Xiangyang 2002, Chinese J. Comput. Mech. 19, 74-77")
        .choice("metric", &NullSpaceRotation::metric,
                {{"mass", NullSpaceRotation::Metric::mass}, {"identity", NullSpaceRotation::Metric::identity}},
                {.doc = "what stays: the kinetic energy, or the norm of v"}))
