// One step of the trapezoidal rule, driven by hand on linear systems whose iteration matrix is wrong by a known amount:
// each increment of Newton's iteration then leaves the part theta of the error before it.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include <trammel/methods/newmark_step.hpp>
#include <trammel/testing/problems.hpp>

namespace trammel::test {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

// Unit masses on springs: f_i = -k_i (q_i - rest_i).
struct Springs {
  Vec k, rest, q, v;
  std::function<Vec(const Vec& q)> force = {};  // in place of the springs' own
  std::function<Problem::Rows(const Vec& q, const Vec& v)> rows = {};
  double theta = 0;
  double hides = 1;            // the first coordinate's entry of the first matrix is this many times as large
  int coordinates_beside = 0;  // coordinates without velocity, at 1e6, after the others
  mutable int residuals = 0, factorisations = 0;

  Vec forces(const Vec& at) const { return force ? force(at) : Vec(-k.cwiseProduct(at.head(k.size()) - rest)); }
  std::unique_ptr<System> system() const {
    Problem p;
    p.name = "springs";
    p.closed_form = false;
    const Eigen::Index n = k.size();
    p.M = Mat::Identity(n, n);
    p.force = [this](double, const Vec& at, const Vec&) { return ++residuals, forces(at); };
    if (rows) p.rows = [this](double, const Vec& at, const Vec& u) { return rows(at, u); };
    p.tangent = [this, n](const Blend& c, const Vec&, const Vec&) -> Mat {
      const double of_first = factorisations++ == 0 ? hides : 1;
      Vec S = (Vec::Ones(n) + c.c_k * k) / (1 - theta);
      S[0] *= of_first;
      return (S - Vec::Ones(n)).asDiagonal();
    };
    p.exact = [this](double, Vec& at, Vec& u) { at = place(), u = v; };
    if (coordinates_beside > 0) {
      p.manifold.retract = [n](const Vec& at, const Vec& dq) {
        Vec moved = at;
        moved.head(n) += dq;
        return moved;
      };
    }
    return p.system();
  }
  Vec place() const {
    Vec all(q.size() + coordinates_beside);
    all << q, Vec::Constant(coordinates_beside, 1e6);
    return all;
  }
  State start(System& s) const {
    State now{0, place(), v, {}, {}};
    s.move_to(0, now.q, now.v);
    s.accelerate({}, now.a, now.lambda);
    return now;
  }
};

inline Springs one_spring(double k, double q, double v) {
  return {.k = Vec::Constant(1, k), .rest = Vec::Zero(1), .q = Vec::Constant(1, q), .v = Vec::Constant(1, v)};
}

struct Previous {
  Vec a;
  double ratio = 1;
};

// A step of the trapezoidal rule, an increment at a time.
struct Trapezoidal {
  NewmarkStep step;
  System& s;
  State now, next;
  double h, c_q, c_v;

  Trapezoidal(System& system, const State& from, double size)
      : s(system), now(from), h(size), c_q(size * size / 4), c_v(size / 2) {}
  void begin(const Previous& before = {}) {
    step.dq = h * now.v + c_q * now.a;
    step.v = now.v + c_v * now.a;
    step.begin(s, now, h, c_q, c_v, next);
    step.extrapolate(now, before.a, before.ratio, next);
  }
  Vec residual() {
    step.move(s, now, next);
    Vec r = -s.f();
    s.add_reaction(1, next.lambda, r);
    s.add_mass_times(1, next.a, r);
    return r;
  }
  void correct() { step.correct(s, {1, c_v, c_q}, residual(), next); }
  int iterate() {
    int n = 0;
    for (; step.iterating(); ++n) correct();
    return n;
  }
  // Of springs: a of the step's end.
  Vec exact(const Springs& of) const {
    const Vec at = now.q.head(of.k.size()) + step.dq - of.rest;
    return -of.k.cwiseProduct(at).cwiseQuotient(Vec::Ones(of.k.size()) + c_q * of.k);
  }
};

}  // namespace trammel::test
