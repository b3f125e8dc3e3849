// Linear problems of one coordinate: x'' = -omega^2 x - 2 zeta omega x' + F cos(drive t), and v' = lambda v.
// Closed forms: any text on vibrations, e.g. Meirovitch, Fundamentals of Vibrations, chapters 2 and 3.
#include <cmath>

#include <trammel/testing/problems.hpp>

namespace trammel::problems {

Problem oscillator(double omega, double zeta) {
  Problem p{"oscillator", "x'' = -omega^2 x - 2 zeta omega x'", "Meirovitch, chapter 2"};
  p.until = 2;
  p.M = Mat::Ones(1, 1);
  const double mu = zeta * omega, w = std::sqrt(omega * omega - mu * mu);
  p.force = [=](double, const Vec& q, const Vec& v) -> Vec { return -omega * omega * q - 2 * mu * v; };
  p.exact = [=](double t, Vec& q, Vec& v) {
    const double e = std::exp(-mu * t);
    q = Vec::Constant(1, e * (std::cos(w * t) + mu / w * std::sin(w * t)));
    v = Vec::Constant(1, -e * omega * omega / w * std::sin(w * t));
  };
  if (zeta == 0)
    p.energy = {omega * omega / 2,
                [=](const State& s) { return (s.v.squaredNorm() + omega * omega * s.q.squaredNorm()) / 2; }};
  return p;
}

Problem first_order(double lambda) {
  Problem p{"first_order", "v' = lambda v, x' = v", "Dahlquist's equation"};
  p.M = Mat::Ones(1, 1);
  p.force = [=](double, const Vec&, const Vec& v) -> Vec { return lambda * v; };
  p.exact = [=](double t, Vec& q, Vec& v) {
    v = Vec::Constant(1, std::exp(lambda * t));
    q = Vec::Constant(1, std::expm1(lambda * t) / lambda);
  };
  return p;
}

Problem forced_oscillator(double omega, double zeta, double F, double drive) {
  Problem p{"forced_oscillator", "x'' = -omega^2 x - 2 zeta omega x' + F cos(drive t)", "Meirovitch, chapter 3"};
  p.until = 3;
  p.M = Mat::Ones(1, 1);
  const double c = 2 * zeta * omega, k = omega * omega;
  p.force = [=](double t, const Vec& q, const Vec& v) -> Vec {
    return -k * q - c * v + Vec::Constant(1, F * std::cos(drive * t));
  };
  // x = a cos + b sin of the drive
  const double p_ = k - drive * drive, q_ = c * drive, n = p_ * p_ + q_ * q_, a = F * p_ / n, b = F * q_ / n;
  p.exact = [=](double t, Vec& q, Vec& v) {
    q = Vec::Constant(1, a * std::cos(drive * t) + b * std::sin(drive * t));
    v = Vec::Constant(1, drive * (b * std::cos(drive * t) - a * std::sin(drive * t)));
  };
  return p;
}

}  // namespace trammel::problems
