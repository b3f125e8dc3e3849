// Simeon's flexible slider-crank for IDA, in p = (phi1, phi2, x3, q1, ..., q4), as index 2:
//
//   p' = v,   M(p) v' = f(p, v) - G^T lambda,   0 = G v + g_t
//
// The rod's relative motion in its frame: s = s_0 + S q its first moment, J = J_0 + 2 c.q + q.M_q q its inertia about
// the pin,
// E the turn by 90 degrees; b + B^T q couples turn and modes, B = -B^T.
//
//   ida_slider_crank TOLERANCE        relative; a hundredth of it is absolute. Observes p

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "ida_run.hpp"

namespace {

using Eigen::Matrix4d, Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector4d;
using Vec = Eigen::Matrix<double, 7, 1>;
using Mat = Eigen::Matrix<double, 7, 7>;
using Rows = Eigen::Matrix<double, 3, 7>;

constexpr double L1 = 0.15, L2 = 0.3, J1 = 0.002727, J2 = 0.0045339259, M2 = 0.151104, M3 = 0.075552, Omega = 150;
constexpr double width = 0.008, youngs_modulus = 2e11, density = 7870;
constexpr int n = 7, constraints = 3, at_v = n, at_lambda = 2 * n, size = at_lambda + constraints;

Vector2d turned(const Vector2d& r) {
  return {-r.y(), r.x()};
}

struct Rod {
  Matrix4d M, K, B;
  Eigen::Matrix<double, 2, 4> S, ES;
  Vector4d b, c;

  Rod() {
    const double pi = std::acos(-1.0), p3 = pi * pi * pi, bending = p3 * pi * (width / L2) * (width / L2);
    const double m = density * width * width * L2, k = youngs_modulus * width * width / L2;
    M << 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 8, 1, 0, 0, 1, 2;
    K << bending / 24, 0, 0, 0, 0, bending * 2 / 3, 0, 0, 0, 0, 16. / 3, -8. / 3, 0, 0, -8. / 3, 7. / 3;
    B.setZero();
    B(0, 2) = -16 / p3;
    B(0, 3) = 8 / p3 - 1 / pi;
    B(1, 3) = 1 / (2 * pi);
    B -= B.transpose().eval();
    S << 0, 0, 2. / 3, 1. / 6, 2 / pi, 0, 0, 0;
    c << 0, 0, 1. / 3, 1. / 6;
    b << 1 / pi, -1 / (2 * pi), 0, 0;
    M *= m, K *= k, B *= m, S *= m, c *= m * L2, b *= m * L2;
    ES << -S.row(1), S.row(0);
  }
};

/// What depends on p and v alone.
struct Place {
  Vec p, v;
  Vector4d q, q_dot;
  double omega, cos1, sin1, cos2, sin2, reach;  // reach: from the rod's pin to its tip
  Vector2d along, across;                       // along and across the crank, in the rod's frame
  Vector2d s;
  Vector4d h, turn;  // half the derivative of J by q; what couples phi2 and q in M
  double J;

  Place(const Rod& rod, const double* y, const double* y_v)
      : p(y), v(y_v), q(p.tail<4>()), q_dot(v.tail<4>()), omega(v(1)) {
    cos1 = std::cos(p(0)), sin1 = std::sin(p(0)), cos2 = std::cos(p(1)), sin2 = std::sin(p(1));
    reach = L2 + p(6);
    along << cos1 * cos2 + sin1 * sin2, sin1 * cos2 - cos1 * sin2;
    across = turned(along);
    s = rod.S * q;
    s.x() += M2 * L2 / 2;
    const Vector4d Mq = rod.M * q;
    h = rod.c + Mq;
    turn = rod.b + rod.B.transpose() * q;
    J = J2 + 2 * rod.c.dot(q) + q.dot(Mq);
  }

  Vector3d g() const {
    return {L1 * sin1 + reach * sin2, p(2) - L1 * cos1 - reach * cos2, p(0)};  // at t = 0
  }

  Rows G() const {
    Rows G = Rows::Zero();
    G(0, 0) = L1 * cos1, G(0, 1) = reach * cos2, G(0, 6) = sin2;
    G(1, 0) = L1 * sin1, G(1, 1) = reach * sin2, G(1, 2) = 1, G(1, 6) = -cos2;
    G(2, 0) = 1;
    return G;
  }

  /// d(G v)/dp.
  Rows G_v() const {
    Rows D = Rows::Zero();
    D(0, 0) = -L1 * sin1 * v(0), D(0, 1) = -reach * sin2 * omega + cos2 * v(6), D(0, 6) = cos2 * omega;
    D(1, 0) = L1 * cos1 * v(0), D(1, 1) = reach * cos2 * omega + sin2 * v(6), D(1, 6) = sin2 * omega;
    return D;
  }
};

class SliderCrank : public peers::Dae {
 public:
  void residual(double, const double* y, const double* y_dot, double* r) const override {
    const Place at(rod_, y, y + at_v);
    const Eigen::Map<const Vec> p_dot(y_dot), a(y_dot + at_v);
    const Eigen::Map<const Vector3d> lambda(y + at_lambda);
    const Rows G = at.G();
    Eigen::Map<Eigen::Matrix<double, size, 1>> all(r);
    all << p_dot - at.v, inertia(at, a) + G.transpose() * lambda, G * at.v - Vector3d(0, 0, Omega);
  }

  void jacobian(double, double alpha, const double* y, const double* y_dot, SUNMatrix to) const override {
    const Place at(rod_, y, y + at_v);
    const Eigen::Map<const Vec> a(y_dot + at_v);
    const Rows G = at.G();
    Eigen::Map<Eigen::Matrix<double, size, size>> J(SM_DATA_D(to));
    J.block<n, n>(0, 0).diagonal().setConstant(alpha);
    J.block<n, n>(0, at_v).diagonal().setConstant(-1);
    J.block<n, n>(at_v, 0) = by_place(at, a, y[at_lambda], y[at_lambda + 1]);
    J.block<n, n>(at_v, at_v) = by_velocity(at) + alpha * mass(at);
    J.block<n, constraints>(at_v, at_lambda) = G.transpose();
    J.block<constraints, n>(at_lambda, 0) = at.G_v();
    J.block<constraints, n>(at_lambda, at_v) = G;
  }

  /// The published start, moved onto the joints by the metric of the masses, with its accelerations and multipliers.
  peers::Start start() const {
    Vec p, v;
    p << 0, 0, 0.450016933, 0, 0, 0.103339863e-4, 0.169327969e-4;
    v << Omega, -74.9957670, -0.268938672e-5, 0.444896105, 0.463434311e-2, -0.178591076e-5, -0.268938672e-5;
    for (int i = 0; i < 4; ++i) {
      const Place at(rod_, p.data(), v.data());
      p += solved(at, Vec::Zero(), -at.g()).head<n>();
    }
    const Place before(rod_, p.data(), v.data());
    v += solved(before, Vec::Zero(), Vector3d(0, 0, Omega) - before.G() * v).head<n>();
    const Place at(rod_, p.data(), v.data());
    const Eigen::VectorXd x = solved(at, -inertia(at, Vec::Zero()), -at.G_v() * v);

    peers::Start s{std::vector<double>(size, 0), std::vector<double>(size, 0), std::vector<double>(size, 0)};
    Eigen::Map<Vec>(s.y.data()) = p;
    Eigen::Map<Vec>(s.y.data() + at_v) = Eigen::Map<Vec>(s.y_dot.data()) = v;
    Eigen::Map<Vector3d>(s.y.data() + at_lambda) = x.tail<constraints>();
    Eigen::Map<Vec>(s.y_dot.data() + at_v) = x.head<n>();
    std::fill_n(s.differential.begin(), at_lambda, 1);
    return s;
  }

 private:
  Rod rod_;

  Mat mass(const Place& at) const {
    Mat M = Mat::Zero();
    M(0, 0) = J1 + M2 * L1 * L1;
    M(0, 1) = M(1, 0) = L1 * at.across.dot(turned(at.s));
    M.block<1, 4>(0, 3) = L1 * at.across.transpose() * rod_.S;
    M.block<4, 1>(3, 0) = M.block<1, 4>(0, 3).transpose();
    M(1, 1) = at.J;
    M.block<1, 4>(1, 3) = at.turn.transpose();
    M.block<4, 1>(3, 1) = at.turn;
    M(2, 2) = M3;
    M.block<4, 4>(3, 3) = rod_.M;
    return M;
  }

  /// M a - f, by the acceleration of the pin and of the rod's mass relative to it, both in the rod's frame.
  Vec inertia(const Place& at, const Vec& a) const {
    const auto [pin, relative] = accelerations(at, a);
    const Vector4d a_q = a.tail<4>();
    Vec r;
    r(0) = (J1 + M2 * L1 * L1) * a(0) + L1 * at.across.dot(relative);
    r(1) = turned(at.s).dot(pin) + at.J * a(1) + at.turn.dot(a_q) + 2 * at.omega * at.h.dot(at.q_dot);
    r(2) = M3 * a(2);
    r.tail<4>() = rod_.S.transpose() * pin + at.turn * a(1) + rod_.M * a_q - 2 * at.omega * (rod_.B * at.q_dot) -
                  at.omega * at.omega * at.h + rod_.K * at.q;
    return r;
  }

  std::pair<Vector2d, Vector2d> accelerations(const Place& at, const Vec& a) const {
    const double omega = at.omega;
    return {L1 * (a(0) * at.across - at.v(0) * at.v(0) * at.along),
            turned(at.s) * a(1) + rod_.S * a.tail<4>() - omega * omega * at.s + 2 * omega * (rod_.ES * at.q_dot)};
  }

  /// d(M a - f + G^T lambda)/dp.
  Mat by_place(const Place& at, const Vec& a, double lambda1, double lambda2) const {
    const auto [pin, relative] = accelerations(at, a);
    const double omega = at.omega;
    const Vector2d pin_1 = turned(pin);  // as the crank turns on
    Mat D = Mat::Zero();
    D(0, 0) = -L1 * at.along.dot(relative);
    D.block<1, 4>(0, 3) = L1 * at.across.transpose() * (rod_.ES * a(1) - omega * omega * rod_.S);
    D(1, 0) = turned(at.s).dot(pin_1);
    D.block<1, 4>(1, 3) = pin.transpose() * rod_.ES;
    D.block<1, 4>(1, 3) += (2 * a(1) * at.h + rod_.B * a.tail<4>() + 2 * omega * (rod_.M * at.q_dot)).transpose();
    D.block<4, 1>(3, 0) = rod_.S.transpose() * pin_1;
    D.block<4, 4>(3, 3) = rod_.B.transpose() * a(1) - omega * omega * rod_.M + rod_.K;
    D.col(1) = -D.col(0);

    const double along2 = at.cos2 * lambda1 + at.sin2 * lambda2, across2 = at.cos2 * lambda2 - at.sin2 * lambda1;
    D(0, 0) += L1 * (at.cos1 * lambda2 - at.sin1 * lambda1);
    D(1, 1) += at.reach * across2;
    D(1, 6) += along2;
    D(6, 1) += along2;
    return D;
  }

  /// d(M a - f)/dv.
  Mat by_velocity(const Place& at) const {
    const double omega = at.omega;
    const Vector2d pin = -2 * L1 * at.v(0) * at.along;
    Mat D = Mat::Zero();
    D(0, 1) = 2 * L1 * at.across.dot(rod_.ES * at.q_dot - omega * at.s);
    D.block<1, 4>(0, 3) = 2 * omega * L1 * at.across.transpose() * rod_.ES;
    D(1, 0) = turned(at.s).dot(pin);
    D(1, 1) = 2 * at.h.dot(at.q_dot);
    D.block<1, 4>(1, 3) = 2 * omega * at.h.transpose();
    D.block<4, 1>(3, 0) = rod_.S.transpose() * pin;
    D.block<4, 1>(3, 1) = -2 * (rod_.B * at.q_dot + omega * at.h);
    D.block<4, 4>(3, 3) = -2 * omega * rod_.B;
    return D;
  }

  /// M x + G^T lambda = force, G x = rate.
  Eigen::VectorXd solved(const Place& at, const Vec& force, const Vector3d& rate) const {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + constraints, n + constraints);
    A.topLeftCorner<n, n>() = mass(at);
    A.bottomLeftCorner<constraints, n>() = at.G();
    A.topRightCorner<n, constraints>() = at.G().transpose();
    Eigen::VectorXd b(n + constraints);
    b << force, rate;
    return A.partialPivLu().solve(b);
  }
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const double tolerance = std::atof(arguments[1]);
  const SliderCrank mechanism;
  // Newton's iteration, too, leaves the multipliers aside: by round-off they do not converge in the first, short steps.
  const peers::Tolerances tolerances = {tolerance, tolerance / 100, 1e6};
  peers::Measured m = peers::run(mechanism, mechanism.start(), tolerances, 0.1);
  for (auto& [t, y] : m.series) y.resize(n);
  peers::print(m);
}
