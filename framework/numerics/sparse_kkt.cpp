#include "numerics/sparse_kkt.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace trammel::numerics {

namespace {

// Of S's and G's scales. Large beside its round-off, so that corrections converge; its square root is the
// singular value, relative to the largest, below which rows count as redundant.
constexpr double regularisation = 1e-12;
// Pivots of redundant rows of a long chain: above their round-off.
constexpr double dependent = 1e-11;
// Redundant rows part by no more than this where they are violated, the largest rank tolerance of kkt.hpp.
constexpr double parting = 1e-2;

// Corrects until the residual stops to fall: `residual(r)` fills r and returns its norm, `correct(r)` uses it.
template <class Residual, class Correct>
double refine(Residual&& residual, Correct&& correct, double enough, int most, Vec& r) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0;; ++i) {
    const double now = residual(r);
    if (!(now > enough) || i == most || !(now < 0.9 * before)) return now;
    before = now;
    correct(r);
  }
}

}  // namespace

void add_rows_times(const std::vector<BodyBlock>& bodies, double c, const Vec& x, Vec& rc) {
  for (const BodyBlock& body : bodies)
    for (std::size_t i = 0; i < body.rows.size() && body.rows[i] < rc.size(); ++i)
      rc(body.rows[i]) += c * body.Gt.col(Eigen::Index(i)).dot(x.segment(body.v0, body.Gt.rows()));
}

namespace {

void add_columns(const BodyBlock& body, const Mat& columns, double c, const Vec& y, Vec& r) {
  for (std::size_t i = 0; i < body.rows.size() && body.rows[i] < y.size(); ++i)
    r.segment(body.v0, columns.rows()) += c * y(body.rows[i]) * columns.col(Eigen::Index(i));
}

}  // namespace

void add_rows_force(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r) {
  for (const BodyBlock& body : bodies) add_columns(body, body.Gt, c, y, r);
}

void add_reaction(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r) {
  for (const BodyBlock& body : bodies) add_columns(body, body.Wt, c, y, r);
}

void add_mass_times(const std::vector<BodyBlock>& bodies, double c, const Vec& a, Vec& r) {
  for (const BodyBlock& body : bodies)
    r.segment(body.v0, body.M.rows()).noalias() += c * (body.M * a.segment(body.v0, body.M.rows()));
}

bool SparseMassKkt::factorise(const std::vector<BodyBlock>& bodies, int nc, Metric metric, double rank_tolerance) {
  nc_ = nc;
  factors_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Factor& factor = factors_[k];
    if (metric == Metric::mass) factor.mass.compute(bodies[k].M);
    if (metric == Metric::identity) factor.mass.compute(Mat::Identity(bodies[k].M.rows(), bodies[k].M.rows()));
    if (factor.mass.info() != Eigen::Success) return false;
    factor.Y = bodies[k].Gt;
    factor.mass.matrixL().solveInPlace(factor.Y);
  }
  redundant_ = false;
  if (nc == 0) return true;
  assemble(bodies, 0);
  bool safe = ldlt_.info() == Eigen::Success;
  if (safe) {
    const Vec pivots = ldlt_.permutationP().transpose() * Vec(ldlt_.vectorD());
    safe = (pivots.array() > 100 * rank_tolerance * rank_tolerance * diagonal_.array()).all();
  }
  if (safe) return true;
  redundant_ = true;
  rank_tolerance_ = rank_tolerance;
  regular_ = false;
  if (nc < long_chain) {
    regularise(bodies);
    return true;
  }
  if (!std::exchange(pattern_known_, true)) semidefinite_.analyse(schur_.matrix());
  semidefinite_.factorise(schur_.matrix(), dependent);
  return true;
}

// Large beside the complement's round-off, so that corrections converge and the unreachable is told from the rest.
void SparseMassKkt::regularise(const std::vector<BodyBlock>& bodies) {
  eps_ = std::max(1e-10, rank_tolerance_ * rank_tolerance_) * diagonal_.maxCoeff();
  assemble(bodies, eps_);
  regular_ = true;
}

void SparseMassKkt::assemble(const std::vector<BodyBlock>& bodies, double eps) {
  const bool fresh = schur_.fill(nc_, nc_, [&](RecordedMatrix& S) {
    diagonal_.setConstant(nc_, eps);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const std::vector<int>& rows = bodies[k].rows;
      const Mat& Y = factors_[k].Y;
      for (std::size_t j = 0; j < rows.size() && rows[j] < nc_; ++j) {
        diagonal_(rows[j]) += Y.col(Eigen::Index(j)).squaredNorm();
        for (std::size_t i = j; i < rows.size() && rows[i] < nc_; ++i)
          S.add(rows[i], rows[j], Y.col(Eigen::Index(i)).dot(Y.col(Eigen::Index(j))));
      }
    }
    for (int i = 0; i < nc_; ++i) S.add(i, i, eps);
  });
  if (fresh) ldlt_.analyzePattern(schur_.matrix()), pattern_known_ = false;
  ldlt_.factorize(schur_.matrix());
}

void SparseMassKkt::move(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& y, Vec& x) {
  x = b;
  add_rows_force(bodies, -1, y, x);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    auto segment = x.segment(bodies[k].v0, bodies[k].M.rows());
    factors_[k].mass.solveInPlace(segment);
  }
}

// eps (S + eps)^-1 keeps the part of r in the null space of S and shrinks the rest by eps/sigma^2; applied twice it leaves
// nothing else. Round-off asks for more passes.
void SparseMassKkt::remove_null_part(Vec& r) {
  for (int pass = 0; pass < 3; ++pass) {
    dy_ = eps_ * ldlt_.solve(r);
    r -= eps_ * ldlt_.solve(dy_);
  }
}

// x += M^-1 G^T dy, until the rows G x = c hold as well as they can. False: they contradict each other.
bool SparseMassKkt::conjugate_gradients(const std::vector<BodyBlock>& bodies, const Vec& c, Vec& x, Vec& y) {
  constexpr int most = 60;
  constexpr double enough = 1e-28;  // of the squared error, in the norm of the energy
  const double scale = std::max(c.lpNorm<Eigen::Infinity>(), x.lpNorm<Eigen::Infinity>());
  const Vec zero = Vec::Zero(x.size());
  double first = 0, before = 0;
  for (int i = 0; i < most; ++i) {
    residual_ = -c;
    add_rows_times(bodies, 1, x, residual_);
    dy_ = residual_;
    semidefinite_.solve(dy_);
    const double error = residual_.dot(dy_);
    if (i == 0) first = error;
    // Near round-off errors grow again.
    if (!(error > enough * first) || (error < 1e-20 * first && error > before)) break;
    if (i == 0)
      along_ = dy_;
    else
      along_ = dy_ + error / before * along_;
    move(bodies, zero, along_, moved_);  // -M^-1 G^T along
    right_.setZero(nc_);
    add_rows_times(bodies, -1, moved_, right_);
    const double step = error / along_.dot(right_);
    if (!std::isfinite(step)) return false;
    x += step * moved_;
    y += step * along_;
    before = error;
  }
  return residual_.lpNorm<Eigen::Infinity>() <= 1e-10 * scale;
}

void SparseMassKkt::solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  y.setZero(nc_);
  move(bodies, b, y, x);
  if (nc_ == 0) return;
  if (redundant_ && !regular_) {
    if (conjugate_gradients(bodies, c, x, y)) return;
    regularise(bodies);
    y.setZero(nc_);
    move(bodies, b, y, x);
  }
  const double scale = std::max(c.lpNorm<Eigen::Infinity>(), x.lpNorm<Eigen::Infinity>());
  const auto residual = [&](Vec& r) {
    r = -c;
    add_rows_times(bodies, 1, x, r);
    if (redundant_) remove_null_part(r);  // redundant rows that contradict each other, by drift or by their laws
    return r.lpNorm<Eigen::Infinity>();
  };
  const auto correct = [&](const Vec& r) {
    dy_ = ldlt_.solve(r);
    y += dy_;
    move(bodies, b, y, x);
  };
  refine(residual, correct, 4 * std::numeric_limits<double>::epsilon() * scale, redundant_ ? 40 : 4, residual_);
  if (redundant_) remove_null_part(y);  // round-off over eps
}

void SparseIterationKkt::add_rows(const std::vector<BodyBlock>& bodies, int nv, int nc, bool coupled,
                                  RecordedMatrix& m) {
  for (const BodyBlock& body : bodies) {
    const Mat& Wt = coupled ? body.Wt : body.Gt;
    for (std::size_t i = 0; i < body.rows.size(); ++i)
      for (int j = 0; j < int(body.Gt.rows()); ++j) {
        m.add(nv + body.rows[i], body.v0 + j, body.Gt(j, Eigen::Index(i)));
        m.add(body.v0 + j, nv + body.rows[i], Wt(j, Eigen::Index(i)));
      }
  }
  for (int i = 0; i < nc; ++i) m.add(nv + i, nv + i, 0);
}

void SparseIterationKkt::factorise_full(int nv, int nc, bool fresh) {
  nv_ = nv;
  regular_ = full_.matrix();
  double S = 0, G = 0;
  for (int j = 0; j < nv; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(regular_, j); it; ++it)
      (it.row() < nv ? S : G) = std::max(it.row() < nv ? S : G, std::abs(it.value()));
  const double eps = S > 0 ? regularisation * G * G / S : 0;
  for (int i = 0; i < nc; ++i) regular_.coeffRef(nv + i, nv + i) -= eps;
  if (fresh) lu_.analyzePattern(regular_);
  lu_.factorize(regular_);
  failed_ = lu_.info() != Eigen::Success;
}

bool SparseIterationKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (failed_ || !b.allFinite() || !c.allFinite()) return false;
  right_.resize(b.size() + c.size());
  right_ << b, c;
  solution_ = lu_.solve(right_);
  const auto residual = [&](Vec& r) {
    r = right_;
    r.noalias() -= full_.matrix() * solution_;
    return r.norm();
  };
  const auto correct = [&](const Vec& r) { solution_ += lu_.solve(r); };
  const double left = refine(residual, correct, 1e-15 * right_.norm(), 40, residual_);
  x = solution_.head(nv_);
  y = solution_.tail(c.size());
  if (!solution_.allFinite()) return false;
  if (left <= 1e-6 * right_.norm()) return true;
  // What no x reaches is left: where redundant rows differ, by round-off or as far as Newton's iteration still has to go.
  const double of_rows = residual_.tail(c.size()).norm();
  residual_.head(nv_).setZero();
  right_.noalias() = full_.matrix().transpose() * residual_;
  return std::sqrt(std::max(0.0, left * left - of_rows * of_rows)) <= 1e-6 * b.norm() + 1e-13 * full_.matrix().norm() &&
         right_.head(nv_).norm() <= parting * of_rows;
}

}  // namespace trammel::numerics
