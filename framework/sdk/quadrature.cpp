#include <trammel/quadrature.hpp>

#include <boost/math/special_functions/legendre.hpp>

namespace trammel {

Quadrature gauss_legendre(int n, double a, double b) {
  const std::vector<double> zeros = boost::math::legendre_p_zeros<double>(n);  // those >= 0, ascending
  Quadrature rule{Vec(n), Vec(n)};
  const double middle = (a + b) / 2, half = (b - a) / 2;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const double z = zeros[i], slope = boost::math::legendre_p_prime(n, z);
    const double weight = 2 / ((1 - z * z) * slope * slope) * half;
    const Eigen::Index upper = n - Eigen::Index(zeros.size() - i), lower = n - 1 - upper;
    rule.x(upper) = middle + half * z;
    rule.x(lower) = middle - half * z;
    rule.weight(upper) = rule.weight(lower) = weight;
  }
  return rule;
}

}  // namespace trammel
