#include "complementarity/shares/independent_rows.hpp"

#include <trammel/decompositions.hpp>

namespace trammel::complementarity {
namespace {

constexpr double dependent_column = 1e-9;  // of the longest column

}  // namespace

Mat independent_rows(const Mat& E) {
  Eigen::ColPivHouseholderQR<Mat> qr;
  qr.setThreshold(dependent_column);
  qr.compute(E);
  return first_columns_of_q(qr, qr.rank()).transpose() * E;
}

}  // namespace trammel::complementarity
