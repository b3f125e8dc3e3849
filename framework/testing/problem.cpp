// A Problem as a System: dense, by a complete orthogonal decomposition of the whole saddle-point matrix
//
//     [S G^T; G 0] (x, y) = (b, c)        y of minimum norm where rows repeat
//
// (Golub and Van Loan, section 5.5), derivatives by central differences. It shares no code with the framework's assembly, so
// that an integrator fails for its own reasons only.
#include <Eigen/Dense>
#include <cmath>

#include <trammel/testing_problems.hpp>

namespace trammel {
namespace {

class ProblemSystem final : public System {
 public:
  explicit ProblemSystem(Problem p) : p_(std::move(p)) {
    Vec q, v;
    p_.exact(0, q, v);
    n_ = v.size();
    m_ = rows(0, q, v).g.size();
    // Masses differ by 1e9: the saddle-point matrix is scaled to entries about 1 before it is decomposed. One factor for all
    // multipliers keeps their minimum norm.
    scale_.resize(n_ + m_);
    scale_.head(n_) = p_.M.diagonal().cwiseSqrt().cwiseInverse();
    const double largest = (rows(0, q, v).G * scale_.head(n_).asDiagonal()).cwiseAbs().sum();
    scale_.tail(m_).setConstant(m_ ? 1 / largest : 1);
  }
  Sizes sizes() const override { return {int(n_), int(n_), int(m_)}; }
  void rate(const Vec&, const Vec& v, Vec& q_dot) const override { q_dot = v; }
  void normalise(Vec&) const override {}
  void retract(const Vec& q, const Vec& dq, Vec& q_new) const override { q_new = q + dq; }
  void difference(const Vec& q1, const Vec& q0, Vec& dq) const override { dq = q1 - q0; }

  void move_to(double t, const Vec& q, const Vec& v) override {
    t_ = t, q_ = q, v_ = v;
    rows_ = rows(t, q, v);
    g_dot_ = rows_.G * v + rows_.g_t;
  }
  const Vec& f() override { return f_ = p_.force(t_, q_, v_); }
  const Vec& g() override { return rows_.g; }
  const Vec& g_dot() override { return g_dot_; }
  void add_mass_times(double c, const Vec& a, Vec& r) override { r += c * (p_.M * a); }
  void add_reaction(double c, const Vec& lambda, Vec& r) override { add_rows_force(c, lambda, r); }
  void add_rows_times(double c, const Vec& x, Vec& rc) override { rc += c * (rows_.G * x); }
  void add_rows_force(double c, const Vec& mu, Vec& r) override { r += c * (rows_.G.transpose() * mu); }
  // A problem that does not conserve its energy names no potential.
  Energy energy() override {
    const double kinetic = 0.5 * v_.dot(p_.M * v_);
    if (!p_.energy.value) return {.kinetic = kinetic, .potential = std::nan("")};
    return {.kinetic = kinetic, .potential = p_.energy.value({t_, q_, v_, {}, {}}) - kinetic};
  }

  void accelerate(Stabilisation s, Vec& a, Vec& lambda) override {
    solve(factored(p_.M), f(), rows_.gamma - 2 * s.alpha * g_dot_ - s.beta * s.beta * rows_.g, a, lambda);
  }
  void factorise(Blend c, const Vec&, const Vec& lambda, Factors which) override {
    kept_[int(which)] = factored(c.c_m * p_.M + tangent(c, lambda) + c.c_1 * Mat::Identity(n_, n_));
  }
  bool correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors which) override {
    solve(kept_[int(which)], -r, -rc, da, dlambda);
    return da.allFinite() && dlambda.allFinite();
  }

 private:
  using Factored = Eigen::CompleteOrthogonalDecomposition<Mat>;

  Rows rows(double t, const Vec& q, const Vec& v) const {
    return p_.rows ? p_.rows(t, q, v) : Rows{Vec(0), Vec(0), Vec(0), Mat(0, n_)};
  }
  Mat tangent(const Blend& c, const Vec& lambda) const {
    Mat T = Mat::Zero(n_, n_);
    const double d = 1e-6;
    for (Eigen::Index j = 0; (c.c_d != 0 || c.c_k != 0) && j < n_; ++j) {
      const Vec e = d * Vec::Unit(n_, j);
      const Rows up = rows(t_, q_ + e, v_), down = rows(t_, q_ - e, v_);
      const Vec K = p_.force(t_, q_ - e, v_) - p_.force(t_, q_ + e, v_) + (up.G - down.G).transpose() * lambda;
      const Vec D = p_.force(t_, q_, v_ - e) - p_.force(t_, q_, v_ + e);
      T.col(j) = (c.c_k * K + c.c_d * D) / (2 * d);
    }
    return T;
  }
  Factored factored(const Mat& S) const {
    Mat A = Mat::Zero(n_ + m_, n_ + m_);
    A.topLeftCorner(n_, n_) = S;
    A.bottomLeftCorner(m_, n_) = rows_.G;
    A.topRightCorner(n_, m_) = rows_.G.transpose();
    return Factored(scale_.asDiagonal() * A * scale_.asDiagonal());
  }
  void solve(const Factored& s, const Vec& b, const Vec& c, Vec& x, Vec& y) const {
    Vec right(n_ + m_);
    right << b, c;
    const Vec z = scale_.cwiseProduct(s.solve(scale_.cwiseProduct(right)));
    x = z.head(n_);
    y = z.tail(m_);
  }

  Problem p_;
  Eigen::Index n_ = 0, m_ = 0;
  Vec scale_;
  double t_ = 0;
  Vec q_, v_, f_, g_dot_;
  Rows rows_;
  Factored kept_[2];
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
