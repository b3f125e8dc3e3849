// A Problem as a System: dense, by a complete orthogonal decomposition of the whole saddle-point matrix
//
//     [S W^T; G 0] (x, y) = (b, c)        y of minimum norm where rows repeat; W = G without friction
//
// (Golub and Van Loan, section 5.5), derivatives by central differences. It shares no code with the framework's
// assembly, so that an integrator fails for its own reasons only.
//
// Not trammel/decompositions.hpp: the kit counts what a method and libtrammel allocate, and must not count this.
#include <Eigen/Dense>
#include <cmath>

#include <trammel/rigid_motions.hpp>
#include <trammel/testing/problems.hpp>

namespace trammel {
namespace {

class ProblemSystem final : public System, public HasRigidMotions {
 public:
  explicit ProblemSystem(Problem p) : p_(std::move(p)) {
    Vec q, v;
    p_.exact(0, q, v);
    n_ = v.size();
    nq_ = int(q.size());
    m_ = rows(0, q, v).g.size();
    // Masses differ by 1e9: the saddle-point matrix is scaled to entries about 1 before it is decomposed. One factor
    // for all multipliers keeps their minimum norm.
    scale_.resize(n_ + m_);
    scale_.head(n_) = p_.M.diagonal().cwiseSqrt().cwiseInverse();
    const double largest = m_ ? (rows(0, q, v).G * scale_.head(n_).asDiagonal()).cwiseAbs().sum() : 1;
    scale_.tail(m_).setConstant(1 / largest);
  }
  Sizes sizes() const override { return {nq_, int(n_), int(m_)}; }
  void rate(const Vec& q, const Vec& v, Vec& q_dot) const override { q_dot = on_.rate ? on_.rate(q, v) : v; }
  void normalise(Vec& q) const override {
    if (on_.normalise) q = on_.normalise(q);
  }
  void retract(const Vec& q, const Vec& dq, Vec& q_new) const override { q_new = moved(q, dq); }
  void difference(const Vec& q1, const Vec& q0, Vec& dq) const override {
    dq = on_.difference ? on_.difference(q1, q0) : Vec(q1 - q0);
  }

  void move_to(double t, const Vec& q, const Vec& v) override {
    t_ = t, q_ = q, v_ = v;
    M_ = mass(q);
    rows_ = rows(t, q, v);
    g_dot_ = rows_.G * v + rows_.g_t;
  }
  const Vec& f() override { return f_ = p_.force(t_, q_, v_); }
  const Vec& g() override { return rows_.g; }
  const Vec& g_dot() override { return g_dot_; }
  void add_mass_times(double c, const Vec& a, Vec& r) override { r += c * (M_ * a); }
  void add_reaction(double c, const Vec& lambda, Vec& r) override { r += c * (W().transpose() * lambda); }
  void add_rows_times(double c, const Vec& x, Vec& rc) override { rc += c * (rows_.G * x); }
  void add_rows_force(double c, const Vec& mu, Vec& r) override { r += c * (rows_.G.transpose() * mu); }
  // A problem that does not conserve its energy names no potential.
  Energy energy() override {
    const double kinetic = 0.5 * v_.dot(M_ * v_);
    if (!p_.energy.value) return {.kinetic = kinetic, .potential = std::nan("")};
    return {.kinetic = kinetic, .potential = p_.energy.value({t_, q_, v_, {}, {}}) - kinetic};
  }

  void accelerate(Stabilisation s, Vec& a, Vec& lambda) override {
    solve(factored(M_, W()), f(), rows_.gamma - 2 * s.alpha * g_dot_ - s.beta * s.beta * rows_.g, a, lambda);
  }
  void factorise(Blend c, const Vec& a, const Vec& lambda, Factors which) override {
    const Mat S = c.c_m * M_ + tangent(c, a, lambda) + c.c_1 * Mat::Identity(n_, n_);
    finite_[int(which)] = S.allFinite();
    kept_[int(which)] = factored(S, which == Factors::iteration ? W() : rows_.G);
  }
  bool correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors which) override {
    // A rank-revealing decomposition treats NaN as 0.
    if (!finite_[int(which)] || !r.allFinite() || !rc.allFinite()) return false;
    solve(kept_[int(which)], -r, -rc, da, dlambda);
    return da.allFinite() && dlambda.allFinite();
  }

  bool rigid_motions(double, const Vec& q, Mat& r) override {
    if (p_.rigid_motions) r = p_.rigid_motions(q);
    return bool(p_.rigid_motions);
  }

 private:
  using Rows = Problem::Rows;
  using Factored = Eigen::CompleteOrthogonalDecomposition<Mat>;

  Rows rows(double t, const Vec& q, const Vec& v) const {
    return p_.rows ? p_.rows(t, q, v) : Rows{Vec(0), Vec(0), Vec(0), Mat(0, n_)};
  }
  Vec moved(const Vec& q, const Vec& dq) const { return on_.retract ? on_.retract(q, dq) : Vec(q + dq); }
  Mat mass(const Vec& q) const { return p_.mass ? p_.mass(q) : p_.M; }
  Mat tangent(const Blend& c, const Vec& a, const Vec& lambda) const {
    Mat T = Mat::Zero(n_, n_);
    if (c.c_d == 0 && c.c_k == 0) return T;
    if (p_.tangent) T = p_.tangent(c, q_, v_);
    const double d = 1e-6;
    for (Eigen::Index j = 0; j < n_ && (m_ > 0 || p_.mass || !p_.tangent); ++j) {
      const Vec e = d * Vec::Unit(n_, j), plus = moved(q_, e), minus = moved(q_, -e);
      Vec K = (W(rows(t_, plus, v_)) - W(rows(t_, minus, v_))).transpose() * lambda, D = Vec::Zero(n_);
      if (p_.mass) K += (mass(plus) - mass(minus)) * a;
      if (!p_.tangent) {
        K += p_.force(t_, minus, v_) - p_.force(t_, plus, v_);
        D = p_.force(t_, q_, v_ - e) - p_.force(t_, q_, v_ + e);
      }
      T.col(j) += (c.c_k * K + c.c_d * D) / (2 * d);
    }
    return T;
  }
  static const Mat& W(const Rows& rows) { return rows.W.size() ? rows.W : rows.G; }
  const Mat& W() const { return W(rows_); }
  Factored factored(const Mat& S, const Mat& W) const {
    Mat A = Mat::Zero(n_ + m_, n_ + m_);
    A.topLeftCorner(n_, n_) = S;
    A.bottomLeftCorner(m_, n_) = rows_.G;
    A.topRightCorner(n_, m_) = W.transpose();
    return A.size() ? Factored(Mat(scale_.asDiagonal() * A * scale_.asDiagonal())) : Factored();
  }
  void solve(const Factored& s, const Vec& b, const Vec& c, Vec& x, Vec& y) const {
    Vec right(n_ + m_);
    right << b, c;
    const Vec scaled = scale_.cwiseProduct(right);
    const Vec z = right.size() ? Vec(scale_.cwiseProduct(s.solve(scaled))) : right;
    x = z.head(n_);
    y = z.tail(m_);
  }

  Problem p_;
  const Manifold& on_ = p_.manifold;
  int nq_ = 0;
  Eigen::Index n_ = 0, m_ = 0;
  Vec scale_;
  Mat M_;
  double t_ = 0;
  Vec q_, v_, f_, g_dot_;
  Rows rows_;
  Factored kept_[2];
  bool finite_[2] = {};
};

}  // namespace

std::unique_ptr<System> Problem::system() const {
  return std::make_unique<ProblemSystem>(*this);
}

State Problem::solution(double t) const {
  State s;
  s.t = t;
  exact(t, s.q, s.v);
  ProblemSystem system(*this);
  system.move_to(t, s.q, s.v);
  system.accelerate({}, s.a, s.lambda);
  return s;
}

}  // namespace trammel
