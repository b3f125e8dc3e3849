#include <trammel/decompositions.hpp>
#include <trammel/methods/linear_roots.hpp>

namespace trammel {

std::array<std::complex<double>, 2> oscillator_eigenvalues(double Omega, double zeta) {
  const std::complex<double> root = std::sqrt(std::complex<double>(zeta * zeta - 1));
  return {Omega * (-zeta + root), Omega * (-zeta - root)};
}

// The three equations of AlphaMethod at n + 1 on the left, at n on the right; h^2 A = -Omega^2 q - 2 zeta Omega (h v).
Roots alpha_roots(const AlphaMethod::Weights& w, double Omega, double zeta) {
  const double k = Omega * Omega, c = 2 * zeta * Omega;
  Mat left(3, 3), right(3, 3);
  left << 1, 0, -w.beta,  //
      0, 1, -w.gamma,     //
      (1 - w.alpha_f) * k, (1 - w.alpha_f) * c, 1 - w.alpha_m;
  right << 1, 1, 0.5 - w.beta,  //
      0, 1, 1 - w.gamma,        //
      -w.alpha_f * k, -w.alpha_f * c, -w.alpha_m;
  const Mat A = Eigen::PartialPivLU<Mat>(left).solve(right);
  const Eigen::VectorXcd roots = Eigen::EigenSolver<Mat>(A, false).eigenvalues();
  return {roots.begin(), roots.end()};
}

std::complex<double> stability_function(const Tableau& tableau, std::complex<double> z) {
  std::vector<std::complex<double>> slope(std::size_t(tableau.stages));
  std::complex<double> R = 1;
  const double* a = tableau.a;
  for (int i = 0; i < tableau.stages; ++i) {
    std::complex<double> y = 1;
    for (int j = 0; j < i; ++j) y += *a++ * slope[std::size_t(j)];
    slope[std::size_t(i)] = z * y;
    R += tableau.b[i] * slope[std::size_t(i)];
  }
  return R;
}

Roots runge_kutta_roots(const Tableau& tableau, double Omega, double zeta) {
  Roots roots;
  for (const std::complex<double> z : oscillator_eigenvalues(Omega, zeta))
    roots.push_back(stability_function(tableau, z));
  return roots;
}

Roots polynomial_roots(const Eigen::VectorXcd& coefficients) {
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(coefficients.size(), coefficients.size());
  companion.row(0) = coefficients.transpose();
  companion.diagonal(-1).setOnes();
  const Eigen::VectorXcd roots = Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(companion, false).eigenvalues();
  return {roots.begin(), roots.end()};
}

}  // namespace trammel
