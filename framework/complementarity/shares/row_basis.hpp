// Which rows of closed contacts are independent, and how the others follow from them.
//
//     g_implied = K g_basis + a combination of the joints' rows
//
// from the Delassus matrix A = G P G^T, where P holds the joints: a row follows from others if its pivot in a Cholesky
// factorisation, the square of the sine of its angle to them, is round-off. Forces along rows have the same effect if
// their resultants on the basis are the same,
//
//     lambda = E F,   E = [1 K^T]
//
// A contact is statically indeterminate if one of its rows takes part in a self-stress, E F = 0.
#pragma once

#include <vector>

#include <trammel/types.hpp>

namespace trammel::complementarity {

// Squares of sines of angles: below this a row follows from others. If A is built from rows that are exact to 1e-16,
// the pivot of a dependent row is about 1e-14; contacts 1e-6 of a body's size apart leave 1e-12.
inline constexpr double round_off_of_shares = 1e-13;

struct RowBasis {
  std::vector<Eigen::Index> basis, implied;  // indices into A
  Mat K;                                     // implied x basis; entries that are round-off are 0

  Mat resultants() const;  // E: basis x (basis, then implied)
};

// `rows`: indices into A. Those in `first` enter the basis before all others.
RowBasis find_basis(const Mat& A, const std::vector<Eigen::Index>& first, const std::vector<Eigen::Index>& others = {});

// A largest subset of these rows in which each row leaves more than `least_share`, the square of the sine of its angle
// to the rows before it.
std::vector<Eigen::Index> well_conditioned_rows(const Mat& A, const std::vector<Eigen::Index>& rows,
                                                double least_share);

// K of the implied rows, with its round-off; basis and implied are indices into A.
Mat implied_by(const Mat& A, const std::vector<Eigen::Index>& basis, const std::vector<Eigen::Index>& implied);

// Rates of the `others` minus K times the rates along the basis, for rates along all rows; infinite for a row that does
// not depend on the basis.
Vec beside_basis(const Mat& A, const std::vector<Eigen::Index>& basis, const std::vector<Eigen::Index>& others,
                 const Vec& rates);

// True if a row depends on these.
bool follows(const Mat& A, const std::vector<Eigen::Index>& rows, Eigen::Index row);

}  // namespace trammel::complementarity
