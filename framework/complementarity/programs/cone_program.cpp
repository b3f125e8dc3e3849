#include "complementarity/programs/cone_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

using Eigen::Index;
using ConstBlock = Eigen::VectorBlock<const Vec>;

constexpr int most_iterations = 50;
constexpr double accurate = 1e-12;  // residuals and gap, of numbers of the order of 1
constexpr double implied = 1e-15;   // pivot of a row that follows from others, of the largest one
constexpr double large = 1e3;       // x from which on the round-off of G x exceeds `accurate`
constexpr double largest = 1e6;     // x that may occur where forces balance each other
// Residuals and gap that have been below this grow by round-off only. Before, they may grow on the way to large forces
// that balance each other.
constexpr double nearly_solved = 1e-6;

// The cone x_0 >= |x_1|; its product is the Jordan algebra's.
double J_norm(const ConstBlock& x) {
  const double tail = x.tail(x.size() - 1).norm();
  return std::sqrt(std::max(0.0, (x[0] - tail) * (x[0] + tail)));
}

Vec product(const ConstBlock& x, const ConstBlock& y) {
  Vec p(x.size());
  p[0] = x.dot(y);
  p.tail(x.size() - 1) = x[0] * y.tail(x.size() - 1) + y[0] * x.tail(x.size() - 1);
  return p;
}

// x with product(x, y) = p
Vec quotient(const ConstBlock& p, const ConstBlock& y) {
  const Index n = y.size() - 1;
  const double norm = J_norm(y) * J_norm(y);
  Vec x(n + 1);
  x[0] = (y[0] * p[0] - y.tail(n).dot(p.tail(n))) / norm;
  x.tail(n) = (p.tail(n) - x[0] * y.tail(n)) / y[0];
  return x;
}

// The largest step along d that stays in the cone.
double longest(const ConstBlock& x, const ConstBlock& d) {
  const Index n = x.size() - 1;
  const double a = d[0] * d[0] - d.tail(n).squaredNorm(), b = x[0] * d[0] - x.tail(n).dot(d.tail(n)),
               c = J_norm(x) * J_norm(x);
  double step = d[0] < 0 ? -x[0] / d[0] : 1e300;
  const double discriminant = b * b - a * c;
  if (discriminant >= 0) {  // a t^2 + 2 b t + c = 0
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    for (const double t : {a != 0 ? q / a : -1.0, q != 0 ? c / q : -1.0})
      if (t > 0) step = std::min(step, t);
  }
  return step;
}

struct Cone {
  Index first, size;
};

// A matrix of one block for each cone.
class Blocks {
 public:
  void set_zero(const std::vector<Cone>& cones) {
    cones_ = &cones;
    blocks_.resize(cones.size());
    for (std::size_t c = 0; c < cones.size(); ++c) blocks_[c].setZero(cones[c].size, cones[c].size);
  }
  Mat& operator[](std::size_t c) { return blocks_[c]; }

  Vec operator*(const Vec& x) const {
    Vec y(x.size());
    for (std::size_t c = 0; c < blocks_.size(); ++c) {
      const auto [first, size] = (*cones_)[c];
      y.segment(first, size) = blocks_[c].lazyProduct(x.segment(first, size));
    }
    return y;
  }
  friend Mat operator*(const Mat& G, const Blocks& B) {
    Mat product(G.rows(), G.cols());
    for (std::size_t c = 0; c < B.blocks_.size(); ++c) {
      const auto [first, size] = (*B.cones_)[c];
      product.middleCols(first, size) = G.middleCols(first, size).lazyProduct(B.blocks_[c]);
    }
    return product;
  }

 private:
  const std::vector<Cone>* cones_ = nullptr;
  std::vector<Mat> blocks_;
};

// The rows of a program as combinations of the order of 1: D^-1 Q^T [G u] = D^-1 R P^T, with a decomposition [G u] P =
// Q R and its pivots D. Columns of thin cones are small, and what only they add to the rows would be lost in round-off
// beside the others, in the normal equations twice. Householder's reflections keep each column accurate relative to its
// own size, and a row's pivot is its largest entry.
class PivotedRows {
 public:
  explicit PivotedRows(const ConeProgram& program) : program_(program) {
    const Index columns = program.G.cols(), s = program.u.size() > 0 ? 1 : 0;
    Mat rows(program.G.rows(), columns + s);
    rows.leftCols(columns) = program.G;
    if (s) rows.col(columns) = program.u;
    const Eigen::ColPivHouseholderQR<Mat> qr(rows);
    const Vec pivots = qr.matrixQR().diagonal().cwiseAbs();
    Index rank = 0;
    while (rank < pivots.size() && pivots[rank] > implied * pivots[0]) ++rank;
    const auto scaling = pivots.head(rank).cwiseInverse().asDiagonal();
    pivoted_ = first_columns_of_q(qr, rank) * scaling;
    const Mat R = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
    rows = scaling * R * qr.colsPermutation().inverse();
    program_.G = rows.leftCols(columns);
    if (s) program_.u = rows.col(columns);
    program_.r = pivoted_.transpose() * program.r;
  }
  const ConeProgram& program() const { return program_; }
  // Of the original rows, for those of the combinations.
  Vec multipliers(const Vec& y) const { return pivoted_ * y; }

 private:
  ConeProgram program_;
  Mat pivoted_;  // columns: combinations of the original rows
};

// Its dual: D x - G^T y = z,  u . y = -1,  z in the cones.
class InteriorPoint {
 public:
  explicit InteriorPoint(const ConeProgram& program)
      : D_(program.D), G_(program.G), u_(program.u), r_(program.r), wanted_(program.wanted) {
    Index first = 0;
    for (const Index size : program.cones) {
      cones_.push_back({first, size});
      first += size;
    }
    now_.x.setZero(first);
    for (const Cone& c : cones_) now_.x[c.first] = 1;
    z_ = scaled_ = now_.x;
    now_.y.setZero(r_.size());
  }

  // Ends at round-off, which grows once it is reached.
  ConeSolution solve() {
    ConeSolution best;
    best.off = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_iterations; ++i) {
      primal_ = r_ - G_ * now_.x;
      if (has_s()) primal_ -= now_.s * u_;
      dual_ = D_.cwiseProduct(now_.x) - G_.transpose() * now_.y - z_;
      free_ = has_s() ? -1 - u_.dot(now_.y) : 0;
      const double gap = now_.x.dot(z_);
      const double terms = std::max(1.0, now_.x.lpNorm<Eigen::Infinity>() / large);
      now_.off = std::max({primal_.norm() / terms, dual_.norm(), std::abs(free_), gap});
      if (now_.off < best.off) best = now_;
      if (const double most = most_s(); most < wanted_) {
        best.s = most;
        break;
      }
      const bool worse = !(now_.off < 1e3 * best.off) && (best.off < nearly_solved || !std::isfinite(now_.off));
      if (now_.off < accurate || worse || !step(gap / double(cones_.size()))) break;
    }
    return best;
  }

 private:
  // If D = 0 and z' = -G^T y, s <= (-r.y - x.z') / -u.y for all x, where x.z' is not negative in the cones. What z'
  // leaves them by counts for an x of any size that may occur.
  double most_s() const {
    if (!has_s() || !(u_.dot(now_.y) < 0)) return std::numeric_limits<double>::infinity();
    const Vec by_y = z_ + dual_;
    double outside = 0;
    for (const Cone& c : cones_)
      outside = std::max(outside, by_y.segment(c.first + 1, c.size - 1).norm() - by_y[c.first]);
    return (r_.dot(now_.y) - largest * outside) / u_.dot(now_.y);
  }
  bool has_s() const { return u_.size() > 0; }
  static ConstBlock of(const Vec& v, const Cone& c) { return v.segment(c.first, c.size); }

  bool step(double mu) {
    scale();
    factorise();
    Vec right = -scaled_;
    if (!direction(right)) return false;
    double reach = std::min({1.0, reach_of(now_.x, dx_), reach_of(z_, dz_)});
    const double centre = std::pow(1 - reach, 3);
    const Vec dx_scaled = W_inverse_ * dx_, dz_scaled = W_ * dz_;
    for (const Cone& c : cones_) {
      Vec p = -product(of(scaled_, c), of(scaled_, c)) - product(of(dx_scaled, c), of(dz_scaled, c));
      p[0] += centre * mu;
      right.segment(c.first, c.size) = quotient(ConstBlock(p, 0, p.size()), of(scaled_, c));
    }
    if (!direction(right)) return false;
    reach = std::min(1.0, 0.99 * std::min(reach_of(now_.x, dx_), reach_of(z_, dz_)));
    now_.x += reach * dx_, z_ += reach * dz_, now_.y += reach * dy_, now_.s += reach * ds_;
    return true;
  }

  // W with W z = W^-1 x, symmetric, and (1 + W D W)^-1.
  void scale() {
    W_.set_zero(cones_), W_inverse_.set_zero(cones_), yields_.set_zero(cones_);
    for (std::size_t i = 0; i < cones_.size(); ++i) {
      const Cone& c = cones_[i];
      const auto x = of(now_.x, c), z = of(z_, c);
      const double nx = J_norm(x), nz = J_norm(z), gamma = std::sqrt((1 + x.dot(z) / (nx * nz)) / 2);
      Vec w = x / nx;
      w[0] += z[0] / nz;
      w.tail(c.size - 1) -= z.tail(c.size - 1) / nz;
      w /= 2 * gamma;
      const double eta = std::sqrt(nx / nz);
      Mat& W = W_[i];
      W = w * w.transpose() / (1 + w[0]);
      W.row(0) = w.transpose(), W.col(0) = w;
      W.diagonal().tail(c.size - 1).array() += 1;
      Mat& inverse = W_inverse_[i];
      inverse = W / eta;
      inverse.row(0).tail(c.size - 1) *= -1, inverse.col(0).tail(c.size - 1) *= -1;
      W *= eta;
      const Mat stiff = Mat::Identity(c.size, c.size) + W * D_.segment(c.first, c.size).asDiagonal() * W;
      yields_[i] = stiff.inverse();
    }
    scaled_ = W_ * z_;
  }

  // K is positive definite inside the cones, but nearly singular where one of the rows determines s instead of x.
  // K + weight u u^T is not, and has the same solution, since u . dy is known.
  void factorise() {
    const Mat GW = G_ * W_;
    GWY_ = GW * yields_;
    K_.noalias() = GWY_ * GW.transpose();
    Mat regular = K_;
    if (has_s()) {
      weight_ = K_.trace() / u_.squaredNorm();
      regular.selfadjointView<Eigen::Lower>().rankUpdate(u_, weight_);
    }
    ldlt_.compute(regular);
    if (has_s()) by_s_ = ldlt_.solve(u_);
  }

  // K dy + u ds = r,  u . dy = free
  void solve_rows(const Vec& r, double free, Vec& dy, double& ds) const {
    if (!has_s()) {
      dy = ldlt_.solve(r);
      ds = 0;
      return;
    }
    const Vec right = r + weight_ * free * u_;
    dy = ldlt_.solve(right);
    ds = (u_.dot(dy) - free) / u_.dot(by_s_);
    dy -= ds * by_s_;
  }

  // W^-1 dx + W dz = right, and the linear equations.
  bool direction(const Vec& right) {
    const Vec r = primal_ - GWY_ * (right - W_ * dual_);
    solve_rows(r, free_, dy_, ds_);
    Vec left = r - K_ * dy_, more;
    if (has_s()) left -= ds_ * u_;
    double more_s = 0;
    solve_rows(left, has_s() ? free_ - u_.dot(dy_) : 0, more, more_s);
    dy_ += more, ds_ += more_s;
    if (!dy_.allFinite() || !std::isfinite(ds_)) return false;
    dx_ = W_ * (yields_ * (right - W_ * (dual_ - G_.transpose() * dy_)));
    dz_ = dual_ - G_.transpose() * dy_ + D_.cwiseProduct(dx_);
    return true;
  }

  double reach_of(const Vec& from, const Vec& along) const {
    double least = 1e300;
    for (const Cone& c : cones_) least = std::min(least, longest(of(from, c), of(along, c)));
    return least;
  }

  const Vec& D_;
  const Mat& G_;
  const Vec &u_, &r_;
  double wanted_;
  std::vector<Cone> cones_;
  ConeSolution now_;
  Vec z_, scaled_;
  Vec primal_, dual_, dx_, dy_, dz_;
  double free_ = 0, ds_ = 0;
  Blocks W_, W_inverse_, yields_;
  Mat GWY_, K_;
  double weight_ = 0;  // of u u^T, added to K
  Vec by_s_;
  Eigen::LDLT<Mat> ldlt_;  // pivots on the largest diagonal entry, which thin cones need for accuracy
};

}  // namespace

ConeSolution solve_cone_program(const ConeProgram& program) {
  const PivotedRows rows(program);
  ConeSolution solution = InteriorPoint(rows.program()).solve();
  solution.y = rows.multipliers(solution.y);
  return solution;
}

}  // namespace trammel::complementarity
