// Base of small test systems: dense, solved by a pivoted LU of the whole saddle-point matrix, derivatives by differences.
// It shares no code with the framework's assembly, so an integrator's test fails for the integrator's reasons only.
#pragma once

#include <Eigen/Dense>
#include <cmath>

#include <trammel/system.hpp>

namespace trammel::test {

class DenseSystem : public System {
 public:
  long long evaluations = 0, factorisations = 0;

  void rate(const Vec&, const Vec& v, Vec& q_dot) const override { q_dot = v; }
  void normalise(Vec&) const override {}
  void retract(const Vec& q, const Vec& dq, Vec& q_new) const override { q_new = q + dq; }
  void difference(const Vec& q1, const Vec& q0, Vec& dq) const override { dq = q1 - q0; }

  void move_to(double t, const Vec& q, const Vec& v) override {
    t_ = t, q_ = q, v_ = v;
    rows(t, q, v, rows_);
    g_dot_ = rows_.G * v + rows_.g_t;
  }
  const Vec& f() override {
    ++evaluations;
    return f_ = force(t_, q_, v_);
  }
  const Vec& g() override { return rows_.g; }
  const Vec& g_dot() override { return g_dot_; }
  void add_mass_times(double c, const Vec& a, Vec& r) override { r += c * (mass() * a); }
  void add_reaction(double c, const Vec& lambda, Vec& r) override { add_rows_force(c, lambda, r); }
  void add_rows_times(double c, const Vec& x, Vec& rc) override { rc += c * (rows_.G * x); }
  void add_rows_force(double c, const Vec& mu, Vec& r) override { r += c * (rows_.G.transpose() * mu); }
  // Forces need not have a potential here.
  Energy energy() override { return {.kinetic = 0.5 * v_.dot(mass() * v_), .potential = std::nan("")}; }

  void accelerate(Stabilisation s, Vec& a, Vec& lambda) override {
    const Vec b = rows_.gamma - 2 * s.alpha * g_dot_ - s.beta * s.beta * rows_.g;
    Factored saddle = factored(mass());
    solve(saddle, f(), b, a, lambda);
  }
  void factorise(Blend c, const Vec& a, const Vec& lambda, Factors which) override {
    ++factorisations;
    kept_[int(which)] = factored(c.c_m * mass() + tangent(c.c_d, c.c_k, a, lambda));
  }
  bool correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors which) override {
    solve(kept_[int(which)], -r, -rc, da, dlambda);
    return da.allFinite() && dlambda.allFinite();
  }

 protected:
  struct Rows {
    Vec g, g_t, gamma;
    Mat G;
  };
  virtual Mat mass() const = 0;
  virtual Vec force(double t, const Vec& q, const Vec& v) const = 0;
  virtual void rows(double, const Vec&, const Vec& v, Rows& r) const { r = {Vec(0), Vec(0), Vec(0), Mat(0, v.size())}; }
  // c_d D + c_k K; constant masses.
  virtual Mat tangent(double c_d, double c_k, const Vec&, const Vec& lambda) const {
    const Eigen::Index n = v_.size();
    Mat T = Mat::Zero(n, n);
    const double d = 1e-6;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Vec e = d * Vec::Unit(n, j);
      Vec q_up, q_down;
      retract(q_, e, q_up);
      retract(q_, -e, q_down);
      Rows up, down;
      rows(t_, q_up, v_, up);
      rows(t_, q_down, v_, down);
      const Vec K = -(force(t_, q_up, v_) - force(t_, q_down, v_)) + (up.G - down.G).transpose() * lambda;
      const Vec D = -(force(t_, q_, v_ + e) - force(t_, q_, v_ - e));
      T.col(j) = (c_k * K + c_d * D) / (2 * d);
    }
    return T;
  }

 private:
  struct Factored {
    Eigen::PartialPivLU<Mat> lu;
    Eigen::Index n = 0, m = 0;
  };
  Factored factored(const Mat& S) const {
    Factored f{{}, S.rows(), rows_.G.rows()};
    Mat A = Mat::Zero(f.n + f.m, f.n + f.m);
    A.topLeftCorner(f.n, f.n) = S;
    A.bottomLeftCorner(f.m, f.n) = rows_.G;
    A.topRightCorner(f.n, f.m) = rows_.G.transpose();
    if (A.size()) f.lu.compute(A);
    return f;
  }
  static void solve(const Factored& s, const Vec& b, const Vec& c, Vec& x, Vec& y) {
    Vec right(s.n + s.m);
    right << b, c;
    const Vec z = right.size() ? Vec(s.lu.solve(right)) : right;
    x = z.head(s.n);
    y = z.tail(s.m);
  }

  double t_ = 0;
  Vec q_, v_, f_, g_dot_;
  Rows rows_;
  Factored kept_[2];
};

}  // namespace trammel::test
