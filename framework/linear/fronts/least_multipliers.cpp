#include "linear/fronts/least_multipliers.hpp"

#include <cmath>

#include <trammel/decompositions.hpp>

#include "linear/fronts/row_elimination.hpp"

namespace trammel::numerics {

void LeastMultipliers::factorise(const std::vector<BodyBlock>& bodies, int nc, double rank_tolerance) {
  if (!layout_.is_built_for(bodies, nc)) layout_.build(bodies, nc, FrontLayout::Unknowns::apart);
  while (!eliminate(bodies, rank_tolerance)) layout_.extend(bodies);
}

// False: a row no longer fits the pattern.
bool LeastMultipliers::eliminate(const std::vector<BodyBlock>& bodies, double rank_tolerance) {
  const std::vector<FrontLayout::Front>& fronts = layout_.fronts();
  fronts_.assign(fronts.size(), {});
  up_.assign(fronts.size(), {});
  dependent_ = 0;
  Vec C, scratch;
  std::vector<int> columns;
  for (std::size_t k = 0; k < fronts.size(); ++k) {
    const FrontLayout::Front& front = fronts[k];
    const int m = rows_of(front), n = front.unknowns, width = RowElimination::width(m, n);
    C.setZero(m * width), scratch.resize(2 * width), columns.resize(std::size_t(n));
    if (!sum_rows(k, bodies, m, C)) return false;
    const auto rank =
        RowElimination(C.data(), m, n).run(front.eliminated, rank_tolerance, columns.data(), scratch.data());
    using Rows =
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0, Eigen::OuterStride<>>;
    const Rows rows(C.data(), m, n + m, Eigen::OuterStride<>(width));
    const int first = rank.pivots + rank.passed, dependent = m - first;
    const auto passed = rows.middleRows(rank.pivots, rank.passed);
    const Vec inverse = passed.middleCols(front.eliminated, front.boundary()).rowwise().norm().cwiseInverse();
    up_[k] = inverse.asDiagonal() * passed.middleCols(front.eliminated, front.boundary());
    fronts_[k].passed = (inverse.asDiagonal() * passed.rightCols(m)).transpose();
    fronts_[k].null = rows.bottomRightCorner(dependent, m).transpose();
    dependent_ += dependent;
    compose(k);
  }
  return true;
}

int LeastMultipliers::rows_of(const FrontLayout::Front& front) const {
  Eigen::Index m = front.own_rows;
  for (const FrontLayout::Child& child : layout_.children(front)) m += up_[std::size_t(child.front)].rows();
  return int(m);
}

// Forms C: own rows of length one, then those of the children, which are released.
bool LeastMultipliers::sum_rows(std::size_t k, const std::vector<BodyBlock>& bodies, int m, Vec& C) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const int n = front.unknowns, width = RowElimination::width(m, n);
  for (const FrontLayout::Source& source : layout_.rows(front)) {
    const auto entries = bodies[std::size_t(source.body)].Gt.col(source.column);
    const int* const map = layout_.map(source.map);
    for (int j = 0; j < source.size; ++j)
      if (map[j] >= 0)
        C[source.row * width + map[j]] += entries[j];
      else if (entries[j] != 0)
        return false;
  }
  Vec& scale = fronts_[k].scale;
  scale.resize(front.own_rows);
  for (int i = 0; i < front.own_rows; ++i) {
    const double length = C.segment(i * width, n).norm();
    scale[i] = length > 0 ? 1 / length : 1;
    C.segment(i * width, n) *= scale[i];
  }
  int at = front.own_rows;
  for (const FrontLayout::Child& child : layout_.children(front)) {
    Mat& below = up_[std::size_t(child.front)];
    const int* const map = layout_.map(child.map);
    for (Eigen::Index i = 0; i < below.rows(); ++i, ++at)
      for (Eigen::Index j = 0; j < below.cols(); ++j) C[at * width + map[j]] = below(i, j);
    below.resize(0, 0);
  }
  return true;
}

// B [Q_3 Q_2] = Q [R_33 R_32; 0 R]
void LeastMultipliers::compose(std::size_t k) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  Eliminated& here = fronts_[k];
  const Eigen::Index d = here.null.cols(), passed = here.passed.cols(), m = here.null.rows();
  if (d + passed == 0) return;
  Mat all(m, d + passed);
  all << here.null, here.passed;
  all.topRows(front.own_rows) = here.scale.asDiagonal() * all.topRows(front.own_rows).eval();
  Eigen::Index at = front.own_rows;
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Mat& R = fronts_[std::size_t(child.front)].R;
    all.middleRows(at, R.rows()) = (R * all.middleRows(at, R.rows())).eval();
    at += R.rows();
  }
  const Eigen::HouseholderQR<Mat> qr(all);
  here.Q = qr.householderQ() * Mat::Identity(m, d + passed);
  const Mat R = qr.matrixQR().topRows(d + passed).triangularView<Eigen::Upper>();
  here.R_33 = R.topLeftCorner(d, d), here.R_32 = R.topRightCorner(d, passed),
  here.R = R.bottomRightCorner(passed, passed);
}

void LeastMultipliers::minimise(Vec& y) const {
  if (dependent_ == 0) return;
  const std::vector<FrontLayout::Front>& fronts = layout_.fronts();
  std::vector<Vec> beta(fronts.size()), p(fronts.size());
  for (std::size_t k = 0; k < fronts.size(); ++k) {
    Vec b(fronts_[k].null.rows());
    for (int i = 0; i < fronts[k].own_rows; ++i) b[i] = y[layout_.own_row(std::size_t(fronts[k].first_row + i))];
    Eigen::Index at = fronts[k].own_rows;
    for (const FrontLayout::Child& child : layout_.children(fronts[k])) {
      const Eliminated& below = fronts_[std::size_t(child.front)];
      b.segment(at, below.R.rows()) = beta[std::size_t(child.front)].tail(below.R.rows());
      at += below.R.rows();
    }
    beta[k] = fronts_[k].Q.transpose() * b;
  }
  for (std::size_t k = fronts.size(); k-- > 0;) {
    const Eliminated& here = fronts_[k];
    const Eigen::Index d = here.null.cols();
    if (p[k].size() == 0) p[k].setZero(here.passed.cols());
    const Vec z = -here.R_33.triangularView<Eigen::Upper>().solve(beta[k].head(d) + here.R_32 * p[k]);
    const Vec w = here.passed * p[k] + here.null * z;
    for (int i = 0; i < fronts[k].own_rows; ++i)
      y[layout_.own_row(std::size_t(fronts[k].first_row + i))] += here.scale[i] * w[i];
    Eigen::Index at = fronts[k].own_rows;
    for (const FrontLayout::Child& child : layout_.children(fronts[k])) {
      const Eigen::Index passed = fronts_[std::size_t(child.front)].passed.cols();
      p[std::size_t(child.front)] = w.segment(at, passed);
      at += passed;
    }
  }
}

}  // namespace trammel::numerics
