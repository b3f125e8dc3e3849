// Products with matrices X of few rows and any number of columns, such as the rows of constraints: loops over the
// columns, with the values of one column in registers. For more rows Eigen's products are as fast, unless each row
// touches few of the columns.
#pragma once

#include <trammel/types.hpp>

namespace trammel::numerics {

// y += c X x
void add_rows_product(double c, const Mat& X, const Vec& x, Vec& y);
// x += c X^T y
void add_transposed_product(double c, const Mat& X, const Vec& y, Vec& x);
// S = X Y^T
void multiply_rows(const Mat& X, const Mat& Y, Mat& S);

}  // namespace trammel::numerics
