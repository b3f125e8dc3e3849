// Long trusses of bars by their end points, as scenes/truss has them, with the exact accelerations of their one degree
// of freedom:
//
//     I(theta) theta'' + I'(theta)/2 theta'^2 + U'(theta) = 0,    x'' = dx/dtheta theta'' + d2x/dtheta2 theta'^2
//
// A planar scissor mast on a base (S1), a triangular prismatic mast on a base (S2) and a closed hoop that floats (S3).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "linear/bodies/body_block.hpp"

namespace trammel::numerics::test {

using std::numbers::pi;

// A quantity's value and first two derivatives by theta.
struct Curve {
  double value = 0, first = 0, second = 0;
};

class Truss {
 public:
  static Truss mast(int n, double theta, double theta_dot);
  static Truss prismatic_mast(int n, double theta, double theta_dot);
  static Truss hoop(int n, double theta, double theta_dot);

  std::vector<BodyBlock> bodies;
  int rows = 0, redundant = 0;
  Vec b, c, exact;  // forces, right sides of the rows, accelerations

 private:
  using Point = std::array<Curve, 3>;
  struct Bar {
    Point from, to;
  };
  struct Marker {
    int bar;
    double at;  // 0: from, 1: to
  };
  struct Inertia {
    double value, slope;  // I, I'
  };

  Truss(int dimension, double theta, double theta_dot) : dim_(dimension), theta_(theta), theta_dot_(theta_dot) {}
  int add_bar(double mass, double at_from, double at_to, const Point& from, const Point& to);
  void finish_bars();
  // Rows: sum of weight_i x_i along `axis`.
  void add_row(const std::vector<std::pair<Marker, Vec>>& gradient, double right);
  void pin(Marker A, Marker B);
  void spring(Marker A, Marker B, double stiffness, double length);
  void hinge(const std::array<Marker, 3>& at, double cosine, double length);
  void finish(Inertia I, double slope_of_U);

  Vec place(Marker m, double Curve::*of) const {
    const Bar& bar = bars_[std::size_t(m.bar)];
    Vec x(dim_);
    for (int i = 0; i < dim_; ++i) x(i) = (1 - m.at) * bar.from[std::size_t(i)].*of + m.at * bar.to[std::size_t(i)].*of;
    return x;
  }
  Vec velocity(Marker m) const { return theta_dot_ * place(m, &Curve::first); }

  int dim_;
  double theta_, theta_dot_;
  std::vector<Bar> bars_;
  std::vector<double> right_;
};

inline int Truss::add_bar(double mass, double at_from, double at_to, const Point& from, const Point& to) {
  BodyBlock body;
  body.v0 = 2 * dim_ * int(bodies.size());
  body.M.setZero(2 * dim_, 2 * dim_);
  for (int i = 0; i < dim_; ++i) {
    body.M(i, i) = mass / 3 + at_from, body.M(dim_ + i, dim_ + i) = mass / 3 + at_to;
    body.M(i, dim_ + i) = body.M(dim_ + i, i) = mass / 6;
  }
  bodies.push_back(std::move(body));
  bars_.push_back({from, to});
  return int(bodies.size()) - 1;
}

inline void Truss::finish_bars() {
  b.setZero(2 * dim_ * int(bodies.size()));
  for (int k = 0; k < int(bodies.size()); ++k) {
    const Marker from{k, 0}, to{k, 1};
    const Vec d = place(to, &Curve::value) - place(from, &Curve::value), d_dot = velocity(to) - velocity(from);
    const double L = d.norm();
    add_row({{from, -d / L}, {to, d / L}}, -d_dot.squaredNorm() / L);
  }
}

inline void Truss::add_row(const std::vector<std::pair<Marker, Vec>>& gradient, double right) {
  for (const auto& [marker, direction] : gradient) {
    BodyBlock& body = bodies[std::size_t(marker.bar)];
    if (body.rows.empty() || body.rows.back() != rows) {
      body.rows.push_back(rows);
      body.Gt.conservativeResize(2 * dim_, Eigen::Index(body.rows.size()));
      body.Gt.rightCols(1).setZero();
    }
    body.Gt.rightCols(1).col(0).head(dim_) += (1 - marker.at) * direction;
    body.Gt.rightCols(1).col(0).tail(dim_) += marker.at * direction;
  }
  right_.push_back(right);
  ++rows;
}

inline void Truss::pin(Marker A, Marker B) {
  for (int i = 0; i < dim_; ++i) add_row({{A, -Vec::Unit(dim_, i)}, {B, Vec::Unit(dim_, i)}}, 0);
}

inline void Truss::spring(Marker A, Marker B, double stiffness, double length) {
  const Vec d = place(B, &Curve::value) - place(A, &Curve::value);
  const Vec pull = stiffness * (d.norm() - length) / d.norm() * d;
  for (const auto& [marker, sign] : {std::pair{A, 1.0}, {B, -1.0}}) {
    b.segment(2 * dim_ * marker.bar, dim_) += sign * (1 - marker.at) * pull;
    b.segment(2 * dim_ * marker.bar + dim_, dim_) += sign * marker.at * pull;
  }
}

// (S . S' - cos |S|^2) / L = 0, S and S' the sides that follow each other.
inline void Truss::hinge(const std::array<Marker, 3>& at, double cosine, double length) {
  const Vec S = place(at[1], &Curve::value) - place(at[0], &Curve::value),
            T = place(at[2], &Curve::value) - place(at[1], &Curve::value);
  const Vec S_dot = velocity(at[1]) - velocity(at[0]), T_dot = velocity(at[2]) - velocity(at[1]);
  const Vec by_S = (T - 2 * cosine * S) / length, by_T = S / length;
  add_row({{at[0], -by_S}, {at[1], by_S - by_T}, {at[2], by_T}},
          -2 * (S_dot.dot(T_dot) - cosine * S_dot.squaredNorm()) / length);
}

inline void Truss::finish(Inertia I, double slope_of_U) {
  const double acceleration = -(I.slope / 2 * theta_dot_ * theta_dot_ + slope_of_U) / I.value;
  exact.resize(b.size());
  for (int k = 0; k < int(bars_.size()); ++k)
    for (const double at : {0.0, 1.0})
      exact.segment(dim_ * (2 * k + int(at)), dim_) =
          acceleration * place({k, at}, &Curve::first) + theta_dot_ * theta_dot_ * place({k, at}, &Curve::second);
  c = Eigen::Map<const Vec>(right_.data(), Eigen::Index(right_.size()));
}

inline Truss Truss::mast(int n, double theta, double theta_dot) {
  constexpr double a = 0.5, m = 0.2, mj = 0.05, mt = 0.5, k = 40, l_0 = 0.3;
  const double s = std::sin(theta), co = std::cos(theta);
  Truss truss(2, theta, theta_dot);
  const auto point = [&](int i, double side) {
    return Point{Curve{2 * a * i * co, -2 * a * i * s, -2 * a * i * co},
                 Curve{side * a * s, side * a * co, -side * a * s}, Curve{}};
  };
  for (int i = 0; i < n; ++i) {  // bars 2 i (down) and 2 i + 1 (up)
    const double tip = i == n - 1 ? mj + mt : 0;
    truss.add_bar(m, mj, tip, point(i, 1), point(i + 1, -1));
    truss.add_bar(m, mj, tip, point(i, -1), point(i + 1, 1));
  }
  truss.finish_bars();
  for (int i = 0; i < n; ++i) {
    truss.pin({2 * i + 1, 0.5}, {2 * i, 0.5});
    truss.spring({2 * i, 0}, {2 * i + 1, 0}, k, l_0);
    if (i == 0) continue;
    truss.pin({2 * i - 1, 1}, {2 * i, 0});
    truss.pin({2 * i - 2, 1}, {2 * i + 1, 0});
  }
  truss.spring({2 * n - 1, 1}, {2 * n - 2, 1}, k, l_0);
  truss.add_row({{{0, 0}, Vec::Unit(2, 0)}}, 0);
  truss.add_row({{{1, 0}, Vec::Unit(2, 0)}}, 0);
  truss.add_row({{{1, 0.5}, Vec::Unit(2, 1)}}, 0);
  const double N = n, of_sin = m * N * (4 * N * N - 1) / 3 + 2 * mj * N * (N + 1) * (2 * N + 1) / 3 + 4 * mt * N * N,
               of_cos = mj * (N + 1) + mt;
  truss.finish({2 * a * a * (of_sin * s * s + of_cos * co * co + m * N / 3), 4 * a * a * (of_sin - of_cos) * s * co},
               (N + 1) * k * (2 * a * s - l_0) * 2 * a * co);
  return truss;
}

inline Truss Truss::prismatic_mast(int n, double theta, double theta_dot) {
  constexpr double a = 0.5, m = 0.2, mj = 0.05, mt = 0.3, k = 60, s_0 = 0.5;
  const double s = std::sin(theta), co = std::cos(theta), root = std::sqrt(3.0);
  Truss truss(3, theta, theta_dot);
  truss.redundant = 6 * n - 2;
  const auto point = [&](int j, int corner) {
    const double phi = 2 * pi * (corner % 3) / 3, x = 2 * a * std::cos(phi) / root, y = 2 * a * std::sin(phi) / root,
                 z = 2 * a * j;
    return Point{Curve{x * co, -x * s, -x * co}, Curve{y * co, -y * s, -y * co}, Curve{z * s, z * co, -z * s}};
  };
  const auto up = [](int j, int corner) { return 6 * j + 2 * (corner % 3); };
  const auto down = [](int j, int corner) { return 6 * j + 2 * (corner % 3) + 1; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 3; ++i) {
      truss.add_bar(m, mj, j == n - 1 ? mj + mt : 0, point(j, i), point(j + 1, i + 1));
      truss.add_bar(m, 0, 0, point(j, i + 1), point(j + 1, i));
    }
  truss.finish_bars();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 3; ++i) {
      truss.pin({up(j, i), 0.5}, {down(j, i), 0.5});
      truss.pin({up(j, i), 0}, {down(j, i + 2), 0});
      truss.pin({down(j, i), 1}, {up(j, i + 2), 1});
      if (j > 0) truss.pin({down(j - 1, i), 1}, {up(j, i), 0});
      truss.spring({up(j, i), 0}, {down(j, i), 0}, k, s_0);
      if (j == n - 1) truss.spring({up(j, i), 1}, {down(j, i), 1}, k, s_0);
    }
  for (int i = 0; i < 3; ++i) {
    const double phi = 2 * pi * i / 3;
    truss.add_row({{{up(0, i), 0}, Vec::Unit(3, 2)}}, 0);
    truss.add_row({{{up(0, i), 0}, Vec3(Eigen::Vector3d(-std::sin(phi), std::cos(phi), 0))}}, 0);
  }
  const double N = n, of_sin = mj * (N + 1) + mt + m * N / 2,
               of_cos = mj * N * (N + 1) * (2 * N + 1) / 2 + 3 * mt * N * N + m * N * (4 * N * N - 1) / 2;
  truss.finish({4 * a * a * (of_sin * s * s + of_cos * co * co + m * N / 2), 8 * a * a * (of_sin - of_cos) * s * co},
               -3 * (N + 1) * k * (2 * a * co - s_0) * 2 * a * s);
  return truss;
}

inline Truss Truss::hoop(int n, double theta, double theta_dot) {
  constexpr double a = 0.5, m = 0.2, mj = 0.1, k = 100, d_0 = 0.3;
  const double s = std::sin(theta), co = std::cos(theta), half = pi / n;
  Truss truss(3, theta, theta_dot);
  truss.redundant = n + 7;
  const auto point = [&](int i, double side) {
    const double phi = 2 * half * (i % n), x = a * std::cos(phi) / std::sin(half),
                 y = a * std::sin(phi) / std::sin(half), z = side * a;
    return Point{Curve{x * co, -x * s, -x * co}, Curve{y * co, -y * s, -y * co}, Curve{z * s, z * co, -z * s}};
  };
  const auto down = [n](int i) { return 2 * (i % n); };  // starts at an upper point
  const auto up = [n](int i) { return 2 * (i % n) + 1; };
  for (int i = 0; i < n; ++i) {
    truss.add_bar(m, mj, 0, point(i, 1), point(i + 1, -1));
    truss.add_bar(m, mj, 0, point(i, -1), point(i + 1, 1));
  }
  truss.finish_bars();
  for (int i = 0; i < n; ++i) {
    truss.pin({up(i), 0.5}, {down(i), 0.5});
    truss.pin({up(i), 1}, {down(i + 1), 0});
    truss.pin({down(i), 1}, {up(i + 1), 0});
    truss.hinge({Marker{down(i), 0}, {down(i + 1), 0}, {down(i + 2), 0}}, std::cos(2 * half), a);
    truss.hinge({Marker{up(i), 0}, {up(i + 1), 0}, {up(i + 2), 0}}, std::cos(2 * half), a);
    truss.spring({down(i), 0}, {up(i), 0}, k, d_0);
  }
  const double N = n, of_sin = 2 * N * (mj / (4 * std::pow(std::sin(half), 2)) + m / (4 * std::pow(std::tan(half), 2))),
               of_cos = N * mj / 2;
  truss.finish({4 * a * a * (of_sin * s * s + of_cos * co * co + N * m / 6), 8 * a * a * (of_sin - of_cos) * s * co},
               N * k * (2 * a * s - d_0) * 2 * a * co);
  return truss;
}

}  // namespace trammel::numerics::test
