#include "modes/krylov_modes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <Eigen/SparseCore>

#include <trammel/decompositions.hpp>

namespace trammel::simulate {
namespace {

using Complex = std::complex<double>;
using CVec = Eigen::VectorXcd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr int block = 8;           // more than the six rigid motions of a free body
constexpr int most_blocks = 60;    // beyond those that `count` fills
constexpr double accuracy = 1e-9;  // of theta, by its residual
// sigma relative to omega^2 of a random motion, which is near that of the stiffest motion.
constexpr double below_mean = 1e-7;
constexpr double independent = 1e-8;  // least part of a direction outside the basis

// [K W^T; G 0] and its parts at the state.
class Pencil {
 public:
  Pencil(model::AssembledSystem& system, const State& s) : system_(system), s_(s) {
    system_.move_to(s.t, s.q, s.v);
    K = system_.sparse_tangent({0, 0, 1}, s.a, s.lambda);
    D = system_.sparse_tangent({0, 1, 0}, s.a, s.lambda);
    no_rows_ = Vec::Zero(system_.sizes().nc);
  }

  Vec mass_times(const Vec& x) {
    Vec r = Vec::Zero(x.size());
    system_.add_mass_times(1, x, r);
    return r;
  }
  void factorise(Blend blend) { system_.factorise(blend, s_.a, s_.lambda); }
  // S x + W^T mu = b, G x = 0
  Vec solve(const Vec& b) {
    Vec x, mu;
    if (!system_.correct(-b, no_rows_, x, mu) || !x.allFinite())
      throw model::NotSolvable("the shifted stiffness matrix is singular: no modes were found");
    return x;
  }
  bool symmetric() const {
    double most = 0, apart = 0;
    const Sparse difference = K - Sparse(K.transpose());
    for (Eigen::Index i = 0; i < difference.nonZeros(); ++i)
      apart = std::max(apart, std::abs(difference.valuePtr()[i]));
    for (Eigen::Index i = 0; i < K.nonZeros(); ++i) most = std::max(most, std::abs(K.valuePtr()[i]));
    return apart <= skew_by_differences * most;
  }
  // x^H K x is no more than the round-off of its terms.
  bool no_stiffness(const CVec& x, double noise) const {
    const Vec size = x.cwiseAbs();
    const CVec Kx = K * x;
    const Vec terms = K.cwiseAbs() * size;
    return std::abs(x.dot(Kx)) <= noise * size.dot(terms);
  }

  Sparse K, D;

 private:
  model::AssembledSystem& system_;
  const State& s_;
  Vec no_rows_;
};

Vec random_vector(Eigen::Index n, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  Vec x(n);
  for (double& entry : x) entry = normal(generator);
  return x;
}

// A basis orthonormal in `inner` that grows by blocks, and T of each of its vectors.
template <class Operator>
class KrylovBasis {
 public:
  KrylovBasis(Operator& T, Eigen::Index n) : T_(T), V_(n, 0), TV_(n, 0) {
    std::mt19937 generator(1);
    next_.resize(n, block);
    for (int j = 0; j < block; ++j) next_.col(j) = T_(random_vector(n, generator));  // within G x = 0
  }

  // False: the Krylov space is exhausted, so the modes found are exact.
  bool grow() {
    const Eigen::Index before = V_.cols();
    for (Eigen::Index j = 0; j < next_.cols(); ++j) {
      Vec x = next_.col(j);
      double length = std::sqrt(x.dot(T_.inner(x)));
      const double whole = length;
      for (int twice = 0; twice < 2 && V_.cols() > 0; ++twice) {
        x -= V_ * (V_.transpose() * T_.inner(x));
        length = std::sqrt(std::max(0.0, x.dot(T_.inner(x))));
      }
      if (!(length > independent * whole)) continue;
      V_.conservativeResize(Eigen::NoChange, V_.cols() + 1);
      V_.col(V_.cols() - 1) = x / length;
    }
    TV_.conservativeResize(Eigen::NoChange, V_.cols());
    for (Eigen::Index j = before; j < V_.cols(); ++j) TV_.col(j) = T_(V_.col(j));
    next_ = TV_.rightCols(V_.cols() - before);
    return V_.cols() > before;
  }

  // V^T T V in that inner product.
  Mat projected() const {
    Mat inner(V_.rows(), V_.cols());
    for (Eigen::Index j = 0; j < V_.cols(); ++j) inner.col(j) = T_.inner(TV_.col(j));
    return V_.transpose() * inner;
  }
  CVec vector(const CVec& y) const { return V_ * y; }
  double residual(Complex theta, const CVec& y) const {
    const CVec r = TV_ * y - theta * (V_ * y);
    const Vec re = r.real(), im = r.imag();
    return std::sqrt(re.dot(T_.inner(re)) + im.dot(T_.inner(im)));
  }
  Eigen::Index size() const { return V_.cols(); }

 private:
  Operator& T_;
  Mat V_, TV_, next_;
};

struct InverseIteration {
  Pencil& pencil;
  Vec operator()(const Vec& x) const { return pencil.solve(pencil.mass_times(x)); }
  Vec inner(const Vec& x) const { return pencil.mass_times(x); }
};

// z = (x, w / s): s scales both parts alike.
struct FirstOrder {
  Pencil& pencil;
  double sigma;
  Vec operator()(const Vec& z) const {
    const Eigen::Index n = z.size() / 2;
    const Vec x = z.head(n), w = sigma * z.tail(n);
    const Vec u = pencil.solve(-pencil.mass_times(w + sigma * x) - pencil.D * x);
    Vec out(2 * n);
    out << u, (x + sigma * u) / sigma;
    return out;
  }
  Vec inner(const Vec& z) const { return z; }
};

struct Pair {
  Complex lambda, theta;
  CVec y;
};

bool lower(const Pair& a, const Pair& b) {
  return std::abs(a.lambda) < std::abs(b.lambda);
}

// Extends the basis until the lowest `count` eigenpairs of the projected operator, given by `pairs`, have converged.
template <class Operator, class Pairs>
std::vector<Pair> converge(KrylovBasis<Operator>& basis, int count, Pairs&& pairs) {
  const int most = most_blocks + count / 2;
  for (int i = 0; i < most; ++i) {
    const bool grown = basis.grow();
    if (grown && basis.size() < count + block) continue;
    std::vector<Pair> found = pairs(basis.projected());
    std::stable_sort(found.begin(), found.end(), lower);
    if (int(found.size()) > count) found.resize(std::size_t(count));
    const bool converged = std::all_of(found.begin(), found.end(), [&](const Pair& p) {
      return basis.residual(p.theta, p.y) <= accuracy * std::abs(p.theta);
    });
    if (converged || !grown) return found;
  }
  throw model::NotSolvable(
      fmt::format("the lowest {} modes did not converge in {} vectors; ask for fewer", count, basis.size()));
}

// Of a random motion that satisfies the rows.
struct Mean {
  double omega2;   // [1/s^2]
  double damping;  // |D x| / |M x| [1/s]
};
Mean mean_of(Pencil& pencil, Eigen::Index n) {
  std::mt19937 generator(2);
  pencil.factorise({1, 0, 0});
  const Vec x = pencil.solve(pencil.mass_times(random_vector(n, generator))), Mx = pencil.mass_times(x);
  const double omega2 = std::abs(x.dot(pencil.K * x)) / x.dot(Mx);
  return {omega2 > 0 && std::isfinite(omega2) ? omega2 : 1, (pencil.D * x).norm() / Mx.norm()};
}

void require_at_rest(const model::AssembledSystem& system, const State& state) {
  const Sizes sizes = system.sizes();
  Mat unused = Mat::Zero(sizes.nv, 1);
  const bool turns = add_turning(system.model(), state.v, unused, unused) || sizes.nc > 0;
  if (turns && !state.v.isZero(0))
    throw model::NotSolvable(
        fmt::format("a model of {} coordinates is too large for the modes of a state in motion; those of "
                    "a state at rest can be found",
                    sizes.nv));
}

// (K - lambda^2 M) x = 0 by theta = 1 / (omega^2 + shift).
std::vector<Pair> undamped_pairs(const Mat& H, double shift) {
  const Mat symmetric = (H + H.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Mat> solver(symmetric);
  std::vector<Pair> all;
  for (Eigen::Index i = 0; i < H.rows(); ++i) {
    const double theta = solver.eigenvalues()(i), omega2 = 1 / theta - shift, omega = std::sqrt(std::abs(omega2));
    if (theta == 0) continue;
    all.push_back(
        {omega2 < 0 ? Complex(omega, 0) : Complex(0, omega), theta, solver.eigenvectors().col(i).cast<Complex>()});
  }
  return all;
}

// Of each complex pair the one with a positive imaginary part, by theta = 1 / (lambda - sigma).
std::vector<Pair> damped_pairs(const Mat& H, double sigma) {
  const Eigen::EigenSolver<Mat> solver(H);
  const auto thetas = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  std::vector<Pair> all;
  for (Eigen::Index i = 0; i < H.rows(); ++i) {
    if (thetas(i) == 0.0) continue;
    const Complex lambda = sigma + 1.0 / thetas(i);
    if (lambda.imag() >= 0) all.push_back({lambda, thetas(i), vectors.col(i)});
  }
  return all;
}

class LowestModes {
 public:
  LowestModes(model::AssembledSystem& system, const State& state, int count)
      : pencil_(system, state),
        n_(system.sizes().nv),
        count_(count),
        mean_(mean_of(pencil_, n_)),
        shift_(below_mean * mean_.omega2),
        noise_(noise_of_stiffness(system.model())) {}

  Spectrum find() {
    spectrum_.damped = !pencil_.symmetric() || mean_.damping > no_damping * std::sqrt(shift_);
    spectrum_.damped ? find_damped() : find_undamped();
    return spectrum_;
  }

 private:
  void find_undamped() {
    pencil_.factorise({shift_, 0, 1});
    InverseIteration T{pencil_};
    KrylovBasis<InverseIteration> basis(T, n_);
    keep(converge(basis, count_, [&](const Mat& H) { return undamped_pairs(H, shift_); }), basis);
  }

  void find_damped() {
    const double sigma = std::sqrt(shift_);
    pencil_.factorise({sigma * sigma, sigma, 1});
    FirstOrder T{pencil_, sigma};
    KrylovBasis<FirstOrder> basis(T, 2 * n_);
    keep(converge(basis, count_, [&](const Mat& H) { return damped_pairs(H, sigma); }), basis);
  }

  template <class Basis>
  void keep(const std::vector<Pair>& pairs, const Basis& basis) {
    for (const Pair& p : pairs) {
      const CVec x = basis.vector(p.y).head(n_);
      const bool slow = std::norm(p.lambda) <= shift_;
      spectrum_.modes.push_back(
          made_mode(p.lambda, x, slow && pencil_.no_stiffness(x, noise_), std::sqrt(mean_.omega2)));
    }
  }

  Pencil pencil_;
  Eigen::Index n_;
  int count_;
  Mean mean_;
  double shift_;  // [1/s^2] where the inverse iteration converges fastest: omega^2 = -shift
  double noise_;
  Spectrum spectrum_;
};

}  // namespace

Spectrum krylov_modes(model::AssembledSystem& system, const State& state, int count) {
  require_at_rest(system, state);
  return LowestModes(system, state, count).find();
}

}  // namespace trammel::simulate
