// Masses m1 = 1 and m2 = 1/ratio at the ends of a massless rod of 1 m, in free flight: the centre moves straight on,
// the rod turns at a constant rate. Elementary; the masses make the saddle-point matrix as badly scaled as one likes.
#include <cmath>

#include <trammel/testing/problems.hpp>

namespace trammel::problems {

Problem dumbbell(double ratio) {
  Problem p{"dumbbell", "m_i r_i'' = -G_i^T lambda, (|r_2 - r_1|^2 - 1)/2 = 0", "elementary"};
  const double m1 = 1, m2 = 1 / ratio, rate = 3;
  p.M = Eigen::Vector4d(m1, m1, m2, m2).asDiagonal();
  p.force = [](double, const Vec&, const Vec&) -> Vec { return Vec::Zero(4); };
  p.rows = [](double, const Vec& q, const Vec& v) -> Problem::Rows {
    const Eigen::Vector2d d = q.tail<2>() - q.head<2>(), u = v.tail<2>() - v.head<2>();
    Mat G(1, 4);
    G << -d.transpose(), d.transpose();
    return {Vec::Constant(1, (d.squaredNorm() - 1) / 2), Vec::Zero(1), Vec::Constant(1, -u.squaredNorm()), G};
  };
  p.exact = [=](double t, Vec& q, Vec& v) {
    const Eigen::Vector2d e(std::cos(rate * t), std::sin(rate * t)), n(-e[1], e[0]), w(0.3, 0.2);
    const double first = -m2 / (m1 + m2), second = m1 / (m1 + m2);
    q.resize(4), v.resize(4);
    q << w * t + first * e, w * t + second * e;
    v << w + first * rate * n, w + second * rate * n;
  };
  p.energy = {
      1, [=](const State& s) { return (m1 * s.v.head<2>().squaredNorm() + m2 * s.v.tail<2>().squaredNorm()) / 2; }};
  return p;
}

}  // namespace trammel::problems
