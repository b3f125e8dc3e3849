// The three inner loops of the beam, over stations. n is a multiple of 8 and the rows do not overlap.
#pragma once

namespace trammel::beam {

// y += c x
inline void add_scaled(int n, double c, const double* x, double* y) {
#pragma omp simd
  for (int g = 0; g < n; ++g) y[g] += c * x[g];
}

// y = c x
inline void set_scaled(int n, double c, const double* x, double* y) {
#pragma omp simd
  for (int g = 0; g < n; ++g) y[g] = c * x[g];
}

// sum x y
inline double dot(int n, const double* x, const double* y) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int g = 0; g < n; ++g) sum += x[g] * y[g];
  return sum;
}

inline double total(int n, const double* x) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int g = 0; g < n; ++g) sum += x[g];
  return sum;
}

}  // namespace trammel::beam
