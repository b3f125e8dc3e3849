#include "system/on_rows/tangent_space.hpp"

#include <trammel/decompositions.hpp>

#include "linear/kkt.hpp"

namespace trammel::simulate {
namespace {

// A matrix from products with unit vectors, column by column.
template <class Add>
Mat transposed(const Sizes& n, Add&& add) {
  Mat all(n.nv, n.nc);
  Vec column;
  for (int i = 0; i < n.nc; ++i) {
    column.setZero(n.nv);
    add(Vec(Vec::Unit(n.nc, i)), column);
    all.col(i) = column;
  }
  return all;
}

// A basis of the orthogonal complement of the columns, orthonormal in units of the sizes of its rows.
Mat complement(Mat columns, const Vec& sizes, double rank_tolerance) {
  columns = sizes.asDiagonal() * columns;
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    if (const double length = columns.col(i).norm(); length > 0) columns.col(i) /= length;
  const Eigen::Index n = columns.rows();
  if (columns.cols() == 0) return Mat(sizes.asDiagonal());
  Eigen::ColPivHouseholderQR<Mat> qr;
  qr.setThreshold(rank_tolerance);
  qr.compute(columns);
  return sizes.asDiagonal() * last_columns_of_q(qr, n - qr.rank());
}

}  // namespace

Mat rows_transposed(model::AssembledSystem& system) {
  return transposed(system.sizes(), [&](const Vec& e, Vec& r) { system.add_rows_force(1, e, r); });
}

Mat reactions_transposed(model::AssembledSystem& system) {
  return transposed(system.sizes(), [&](const Vec& e, Vec& r) { system.add_reaction(1, e, r); });
}

TangentSpace tangent_space(model::AssembledSystem& system) {
  const Sizes n = system.sizes();
  const Mat Gt = rows_transposed(system), Wt = reactions_transposed(system);
  const double violation = n.nc > 0 ? system.g().lpNorm<Eigen::Infinity>() : 0;
  TangentSpace space;
  space.sizes = system.coordinate_sizes();
  const double tolerance = numerics::rank_tolerance_at(violation / space.sizes.length);
  space.Z = complement(Gt, space.sizes.of, tolerance);
  space.redundant = n.nc - int(n.nv - space.Z.cols());
  space.sliding = Gt != Wt;
  space.left = space.sliding ? complement(Wt, space.sizes.of, tolerance) : space.Z;
  if (space.left.cols() != space.Z.cols())
    throw model::NotSolvable("friction jams: a sliding contact's force does not move what its row holds");
  return space;
}

}  // namespace trammel::simulate
