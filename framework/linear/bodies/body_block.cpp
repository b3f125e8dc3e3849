#include "linear/bodies/body_block.hpp"

#include <algorithm>

#include "linear/dense/fixed_sizes.hpp"
#include "linear/dense/prefetch.hpp"

namespace trammel::numerics {

namespace {

// Calls f(n) with n as a compile-time constant for bodies of few velocities.
template <class F>
void with_size(Eigen::Index n, F&& f) {
  if (!with_fixed_size(n, f)) f(n);
}

// Calls f for each body; the rows of later bodies are prefetched.
template <class F>
void for_each(const std::vector<BodyBlock>& bodies, F&& f) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    look_ahead(k, bodies.size(), [&](std::size_t next) { prefetch_rows(bodies[next]); });
    f(bodies[k]);
  }
}

}  // namespace

void prefetch_rows(const BodyBlock& body) {
  prefetch(body.rows.data(), body.rows.size() * sizeof(int));
  prefetch(body.Gt.data(), std::size_t(body.Gt.size()) * sizeof(double));
}

void add_rows_times(const std::vector<BodyBlock>& bodies, double c, const Vec& x, Vec& rc) {
  for_each(bodies, [&](const BodyBlock& body) {
    with_size(body.Gt.rows(), [&](auto n) {
      const double *column = body.Gt.data(), *const of_body = x.data() + body.v0;
      for (const int row : body.rows) {
        if (row >= rc.size()) break;
        double sum = 0;
        for (int j = 0; j < n; ++j) sum += column[j] * of_body[j];
        rc[row] += c * sum;
        column += n;
      }
    });
  });
}

namespace {

// Sums in registers if n is a compile-time constant.
void add_columns(const BodyBlock& body, const Mat& columns, double c, const Vec& y, Vec& r) {
  double* const of_body = r.data() + body.v0;
  const auto add = [&](auto n, double* sum) {
    const double* column = columns.data();
    for (const int row : body.rows) {
      if (row >= y.size()) break;
      const double by = c * y[row];
      for (int j = 0; j < n; ++j) sum[j] += by * column[j];
      column += n;
    }
  };
  const bool fixed = with_fixed_size(columns.rows(), [&](auto n) {
    double sum[n];
    std::copy_n(of_body, int(n), sum);
    add(n, sum);
    std::copy_n(sum, int(n), of_body);
  });
  if (!fixed) add(columns.rows(), of_body);
}

}  // namespace

void add_rows_force(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r) {
  for_each(bodies, [&](const BodyBlock& body) { add_columns(body, body.Gt, c, y, r); });
}

void add_reaction(const std::vector<BodyBlock>& bodies, double c, const Vec& y, Vec& r) {
  for (const BodyBlock& body : bodies) add_columns(body, body.Wt, c, y, r);
}

void add_mass_times(const std::vector<BodyBlock>& bodies, double c, const Vec& a, Vec& r) {
  for (const BodyBlock& body : bodies)
    with_size(body.M.rows(), [&](auto n) {
      const double *column = body.M.data(), *const of_body = a.data() + body.v0;
      double* const to = r.data() + body.v0;
      for (int j = 0; j < n; ++j, column += n) {
        const double by = c * of_body[j];
        for (int i = 0; i < n; ++i) to[i] += by * column[i];
      }
    });
}

}  // namespace trammel::numerics
