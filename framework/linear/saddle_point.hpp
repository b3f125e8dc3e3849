// The interface of all solvers of the saddle-point systems of constrained dynamics,
//
//     [S W^T] [x]   [b]        S: nv x nv, the mass or an iteration matrix;  G, W: nc x nv
//     [G  0 ] [y] = [c]        W = G unless friction couples rows
//
//     solver                S                  rows         method
//     MassKkt               mass, any storage  dense        Schur complement G M^-1 G^T (kkt.hpp)
//     IterationKkt          any, dense         dense        LU of the whole (kkt.hpp)
//     SparseMassKkt         mass, by bodies    by bodies    Schur complement, or fronts (sparse_mass_kkt.hpp)
//     FrontalKkt            mass, by bodies    by bodies    elimination of the rows (fronts/frontal_kkt.hpp)
//     SparseIterationKkt    any, sparse        sparse       LU of the whole (sparse_iteration_kkt.hpp)
//     FrontalIterationKkt   any, sparse        sparse       LU of the whole in fronts (frontal_iteration_kkt.hpp)
//
// A solver analyses the pattern within `factorise` if it differs from the one before: contacts change it, and no caller
// has to know when. tests/linear/saddle_point.cpp tests these promises on every solver:
//  - x and y solve both equations to round-off, whatever the units of masses and rows (SparseIterationKkt: rows of
//    similar length).
//  - Rows may be redundant: x and W^T y are unique. Which rows are redundant, and so the rank, is a property of G
//    alone: every solver finds as many as `dependent_rows` does (sparse/dependent_rows.hpp).
//  - Multipliers of redundant rows are those of minimum norm, sum_i y_i^2, with rows in the units in which they are
//    given: y in the range of G, also where W^T y distinguishes y that G^T y does not (friction by the load of a
//    joint). SparseMassKkt makes them so in `minimise_norm`, FrontalKkt by LeastMultipliers.
//  - Solving twice, or factorising again after another system, also with another pattern, gives the same bits: a
//    resumed run continues like an uninterrupted one.
//  - Failure is reported: `factorise` or `solve` returns false, never true with a NaN in x or y.
#pragma once

#include <concepts>

#include <trammel/types.hpp>

namespace trammel::numerics {

// Bounds of the sine of a row's angle to others below which it counts as dependent (rank_tolerance_at in kkt.hpp).
inline constexpr double least_rank_tolerance = 1e-7, largest_rank_tolerance = 1e-2;
// A singular system is solved if its residual is at most this share of the right side, or the round-off of positions of
// the order of 1 that the matrix multiplies.
inline constexpr double solved_share = 1e-6, round_off_of_positions = 1e-13;

// `Matrices`: the types of S, G and W. False: singular, or not finite.
template <class Solver, class... Matrices>
concept FactorisesSaddlePoints = requires(Solver solver, const Matrices&... matrices) {
  { solver.factorise(matrices...) } -> std::same_as<bool>;
};

// `Matrices`: those that a solver reads again to refine its solution; often none.
template <class Solver, class... Matrices>
concept SolvesSaddlePoints = requires(Solver solver, const Matrices&... matrices, const Vec& right, Vec& solution) {
  { solver.solve(matrices..., right, right, solution, solution) } -> std::same_as<bool>;
};

template <class Solver>
concept KnowsRedundantRows = requires(const Solver& factors) {
  { factors.redundant() } -> std::same_as<bool>;
};

}  // namespace trammel::numerics
