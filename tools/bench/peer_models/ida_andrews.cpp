// Andrews' squeezing mechanism for IDA, in the angles a_k of its seven bodies from the x axis, as index 2:
//
//   a' = v,   M(a) v' = f(a, v) - G^T lambda,   0 = G v
//
// Each point is a sum of arms that turn with one angle each, so M couples three pairs of angles only, and derivatives
// of
// G^T lambda by a are diagonal.
//
//   ida_andrews TOLERANCE        observes beta, theta, gamma, phi, delta, Omega, epsilon

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "ida_run.hpp"

namespace {

constexpr double m2 = 0.00365, m4 = 0.00706, m6 = 0.00706;                                           // [kg]
constexpr double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, xc = 0.014, yc = 0.072;  // [m]
constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, ss = 0.035;
constexpr double sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308, tb = 0.00916;
constexpr double u = 0.04, ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;
constexpr double c0 = 4530, l0 = 0.07785, mom = 0.033;  // [N/m], [m], [N m]

constexpr int bodies = 7, loops = 3, rows = 2 * loops;
constexpr int at_v = bodies, at_lambda = 2 * bodies, size = at_lambda + rows;

struct Vec {
  double x, y;
};
Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y};
}
Vec operator*(double s, Vec a) {
  return {s * a.x, s * a.y};
}
double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y;
}
Vec quarter_turn(Vec a) {
  return {-a.y, a.x};
}

constexpr double square(double x) {
  return x * x;
}

/// The diagonal of M [kg m^2]: of a body about the pin it turns on, with the mass of the body at its end.
constexpr std::array<double, bodies> diagonal = {
    2.194e-6 + 0.04325 * square(ra) + m2 * square(rr),
    4.41e-7 + m2* square(da),
    5.255e-6 + 0.02373 * (square(sa) + square(sb)),
    5.667e-7 + m4* square(e - ea),
    1.169e-5 + 0.0705 * (square(ta) + square(tb)) + m4* square(zt),
    5.667e-7 + m6* square(zf - fa),
    1.912e-5 + 0.05498 * (square(ua) + square(ub)) + m6* square(u),
};

/// M_ij = p cos(a_i - a_j) + q sin(a_i - a_j).
struct Pair {
  int i, j;
  double p, q;
};
constexpr std::array<Pair, 3> pairs = {{
    {0, 1, -m2* rr* da, 0},
    {3, 4, 0, m4* zt*(e - ea)},
    {6, 5, 0, m6* u*(zf - fa)},
}};

/// What an angle turns in the loops: E by way of bodies 1 and 2, less E by way of 3, of 5 and 4, of 7 and 6.
struct Arm {
  Vec along;  // in the body [m]
  std::array<int, loops> sign;
};
constexpr std::array<Arm, bodies> arms = {{
    {{rr, 0}, {1, 1, 1}},
    {{-d, 0}, {1, 1, 1}},
    {{0, -ss}, {-1, 0, 0}},
    {{0, -e}, {0, -1, 0}},
    {{zt, 0}, {0, -1, 0}},
    {{zf, 0}, {0, 0, -1}},
    {{0, -u}, {0, 0, -1}},
}};

/// The sum of the multipliers that act along an arm.
Vec on(const Arm& arm, const double* lambda) {
  Vec sum{0, 0};
  for (int l = 0; l < loops; ++l) sum = sum + arm.sign[l] * Vec{lambda[2 * l], lambda[2 * l + 1]};
  return sum;
}

struct Torque {
  double value, slope;  // [N m], and by the angle
};

/// The arms turned to their angles.
class Place {
 public:
  std::array<Vec, bodies> along, across;  // across: the derivative of `along` by the angle

  explicit Place(const double* angles) {
    for (int k = 0; k < bodies; ++k) {
      cos_[k] = std::cos(angles[k]);
      sin_[k] = std::sin(angles[k]);
      along[k] = turned(k, arms[k].along);
      across[k] = quarter_turn(along[k]);
    }
  }

  /// M_ij and its derivative by a_i.
  std::pair<double, double> coupling(const Pair& p) const {
    const double cos = cos_[p.i] * cos_[p.j] + sin_[p.i] * sin_[p.j];
    const double sin = sin_[p.i] * cos_[p.j] - cos_[p.i] * sin_[p.j];
    return {p.p * cos + p.q * sin, p.q * cos - p.p * sin};
  }

  /// Of the spring between C and D, on body 3 about B.
  Torque spring() const {
    const Vec D = turned(2, {sd, -sc}), D_1 = quarter_turn(D), reach = D + Vec{xb - xc, yb - yc};
    const double length = std::sqrt(dot(reach, reach)), length_1 = dot(reach, D_1) / length;
    const double stiffness = c0 * (1 - l0 / length);
    return {-stiffness * dot(reach, D_1),
            -stiffness * (dot(D_1, D_1) - dot(reach, D)) - c0 * l0 / length * square(length_1)};
  }

 private:
  std::array<double, bodies> cos_, sin_;

  Vec turned(int k, Vec a) const { return {a.x * cos_[k] - a.y * sin_[k], a.x * sin_[k] + a.y * cos_[k]}; }
};

class Andrews : public peers::Dae {
 public:
  void residual(double, const double* y, const double* y_dot, double* r) const override {
    const Place at(y);
    const double *v = y + at_v, *a = y_dot + at_v, *lambda = y + at_lambda;
    for (int k = 0; k < bodies; ++k) {
      r[k] = y_dot[k] - v[k];
      r[at_v + k] = diagonal[k] * a[k] + dot(at.across[k], on(arms[k], lambda));
    }
    for (const Pair& p : pairs) {
      const auto [c, c_1] = at.coupling(p);
      r[at_v + p.i] += c * a[p.j] - c_1 * square(v[p.j]);
      r[at_v + p.j] += c * a[p.i] + c_1 * square(v[p.i]);
    }
    r[at_v] -= mom;
    r[at_v + 2] -= at.spring().value;
    for (int l = 0; l < loops; ++l) {
      Vec g_dot{0, 0};
      for (int k = 0; k < bodies; ++k) g_dot = g_dot + arms[k].sign[l] * v[k] * at.across[k];
      r[at_lambda + 2 * l] = g_dot.x;
      r[at_lambda + 2 * l + 1] = g_dot.y;
    }
  }

  void jacobian(double, double alpha, const double* y, const double* y_dot, SUNMatrix J) const override {
    const Place at(y);
    const double *v = y + at_v, *a = y_dot + at_v, *lambda = y + at_lambda;
    const auto entry = [&](int row, int column) -> double& { return SM_ELEMENT_D(J, row, column); };
    for (int k = 0; k < bodies; ++k) {
      entry(k, k) = alpha;
      entry(k, at_v + k) = -1;
      entry(at_v + k, k) = -dot(at.along[k], on(arms[k], lambda));
      entry(at_v + k, at_v + k) = alpha * diagonal[k];
    }
    for (const Pair& p : pairs) {
      const auto [c, c_1] = at.coupling(p);
      const double r_i = c_1 * a[p.j] + c * square(v[p.j]), r_j = c_1 * a[p.i] - c * square(v[p.i]);
      entry(at_v + p.i, p.i) += r_i;
      entry(at_v + p.i, p.j) -= r_i;
      entry(at_v + p.j, p.i) += r_j;
      entry(at_v + p.j, p.j) -= r_j;
      entry(at_v + p.i, at_v + p.j) = alpha * c - 2 * c_1 * v[p.j];
      entry(at_v + p.j, at_v + p.i) = alpha * c + 2 * c_1 * v[p.i];
    }
    entry(at_v + 2, 2) -= at.spring().slope;
    for (int k = 0; k < bodies; ++k) {
      for (int l = 0; l < loops; ++l) {
        const Vec G = arms[k].sign[l] * at.across[k], G_v = -v[k] * arms[k].sign[l] * at.along[k];
        const int x = at_lambda + 2 * l, y = x + 1;
        entry(at_v + k, x) = entry(x, at_v + k) = G.x;
        entry(at_v + k, y) = entry(y, at_v + k) = G.y;
        entry(x, k) = G_v.x;
        entry(y, k) = G_v.y;
      }
    }
  }

  /// At rest, with the accelerations and multipliers of that place.
  peers::Start start() const {
    constexpr double beta = -0.0617138900142764496, gamma = 0.455279819163070380, phi = 0.222668390165885885;
    constexpr double delta = 0.487364979543842551, epsilon = 1.23054744454982119;
    peers::Start s{{beta, beta, gamma, phi + delta, delta, epsilon - phi, epsilon}, {}, {}};
    s.y.resize(size, 0);
    s.y_dot.resize(size, 0);
    s.differential.resize(size, 0);
    std::fill_n(s.differential.begin(), at_lambda, 1);

    // With v = 0 the rows G v = 0 hold for v' too.
    const Place at(s.y.data());
    constexpr int n = bodies + rows;
    Eigen::Matrix<double, n, n> A = Eigen::Matrix<double, n, n>::Zero();
    Eigen::Matrix<double, n, 1> b = Eigen::Matrix<double, n, 1>::Zero();
    for (int k = 0; k < bodies; ++k) {
      A(k, k) = diagonal[k];
      for (int l = 0; l < loops; ++l) {
        const Vec G = arms[k].sign[l] * at.across[k];
        const int x = bodies + 2 * l, y = x + 1;
        A(k, x) = A(x, k) = G.x;
        A(k, y) = A(y, k) = G.y;
      }
    }
    for (const Pair& p : pairs) A(p.i, p.j) = A(p.j, p.i) = at.coupling(p).first;
    b(0) = mom;
    b(2) = at.spring().value;
    const Eigen::Matrix<double, n, 1> x = A.partialPivLu().solve(b);
    std::copy_n(x.data(), bodies, s.y_dot.begin() + at_v);
    std::copy_n(x.data() + bodies, rows, s.y.begin() + at_lambda);
    return s;
  }
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const Andrews andrews;
  const double tolerance = std::atof(arguments[1]);
  peers::Measured m = peers::run(andrews, andrews.start(), {tolerance, tolerance, tolerance}, 0.03);
  for (auto& [t, y] : m.series) y = {y[0], y[1] - y[0], y[2], y[3] - y[4], y[4], y[5] - y[6], y[6]};
  peers::print(m);
}
