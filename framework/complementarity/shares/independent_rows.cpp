#include "complementarity/shares/independent_rows.hpp"

#include <Eigen/QR>

namespace trammel::complementarity {
namespace {

constexpr double dependent = 1e-9;  // of the longest column

}  // namespace

Mat independent_rows(const Mat& E) {
  Eigen::ColPivHouseholderQR<Mat> qr;
  qr.setThreshold(dependent);
  qr.compute(E);
  const Mat range = qr.householderQ() * Mat::Identity(E.rows(), qr.rank());
  return range.transpose() * E;
}

}  // namespace trammel::complementarity
