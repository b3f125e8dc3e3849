#include "tspline_plate/mesh/refinement_operator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/SparseCholesky>
#include <trammel/quadrature.hpp>

namespace trammel::plate {

namespace {

constexpr double nested = 1e-11;    // round-off of sums of about ten terms of order one, with a margin
constexpr double no_entry = 1e-13;  // entries are of order one, smaller ones are round-off
using Triplets = std::vector<Eigen::Triplet<double>>;

Sparse by_dual_functionals(const TsplineBasis& coarse, const TsplineBasis& fine) {
  Triplets entries;
  entries.reserve(std::size_t(fine.size()) * 4);
  for (int j = 0; j < fine.size(); ++j) {
    const auto& dual = fine.anchors()[std::size_t(j)].knots;
    // A function whose support contains that of j is positive at every inner point of it.
    std::array<double, 2> inside{};
    for (std::size_t d : {0, 1}) inside[d] = dual[d][0] + (dual[d][4] - dual[d][0]) / 2;
    const int cell = coarse.cell_at(inside[0], inside[1]);
    for (int i : coarse.cells()[std::size_t(cell)].functions) {
      const auto& own = coarse.anchors()[std::size_t(i)].knots;
      const bool covers =
          own[0][0] <= dual[0][0] && dual[0][4] <= own[0][4] && own[1][0] <= dual[1][0] && dual[1][4] <= own[1][4];
      if (!covers) continue;
      const double value = dual_functional(dual[0], own[0]) * dual_functional(dual[1], own[1]);
      if (value != 0) entries.emplace_back(j, i, value);
    }
  }
  Sparse M(fine.size(), coarse.size());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

// Sums int f_a g_b over the cells of `fine`, f of `fine`, g of `other`; exact where both are polynomials on the cells.
Eigen::SparseMatrix<double> gram(const TsplineBasis& fine, const TsplineBasis& other) {
  const Quadrature rule = gauss_legendre(degree + 1, 0, 1);
  Triplets entries;
  Eigen::VectorXd f, g;
  Eigen::MatrixXd sum;  // of the points that share both cells
  for (int c = 0; c < int(fine.cells().size()); ++c) {
    const auto& rows = fine.cells()[std::size_t(c)].functions;
    int shared = -1;
    const auto hand_over = [&] {
      if (shared < 0) return;
      const auto& columns = other.cells()[std::size_t(shared)].functions;
      for (std::size_t j = 0; j < columns.size(); ++j)
        for (std::size_t i = 0; i < rows.size(); ++i)
          entries.emplace_back(rows[i], columns[j], sum(Eigen::Index(i), Eigen::Index(j)));
    };
    const auto& [low, high] = fine.cells()[std::size_t(c)].parameters;
    for (Eigen::Index a = 0; a < rule.x.size(); ++a)
      for (Eigen::Index b = 0; b < rule.x.size(); ++b) {
        const double u = low[0] + rule.x(a) * (high[0] - low[0]), v = low[1] + rule.x(b) * (high[1] - low[1]);
        const double weight = rule.weight(a) * rule.weight(b) * (high[0] - low[0]) * (high[1] - low[1]);
        const int there = other.cell_at(u, v);
        fine.blending(c, u, v, f);
        other.blending(there, u, v, g);
        if (there != shared) {
          hand_over();
          shared = there;
          sum.setZero(f.size(), g.size());
        }
        sum.noalias() += (weight * f) * g.transpose();
      }
    hand_over();
  }
  Eigen::SparseMatrix<double> G(fine.size(), other.size());
  G.setFromTriplets(entries.begin(), entries.end());
  return G;
}

// G scaled to a unit diagonal, so that pivots do not depend on the sizes of the supports.
Eigen::SparseMatrix<double> scaled(const Eigen::SparseMatrix<double>& G, const Eigen::VectorXd& scale) {
  return scale.asDiagonal() * G * scale.asDiagonal();
}

Sparse by_projection(const TsplineBasis& coarse, const TsplineBasis& fine) {
  const Eigen::SparseMatrix<double> G = gram(fine, fine);
  const Eigen::VectorXd scale = G.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(scaled(G, scale));
  const Eigen::MatrixXd right = scale.asDiagonal() * Eigen::MatrixXd(gram(fine, coarse));
  const Eigen::MatrixXd M = scale.asDiagonal() * Eigen::MatrixXd(solver.solve(right));
  return M.sparseView(1, no_entry);
}

double nesting_error(const TsplineBasis& coarse, const TsplineBasis& fine, const Sparse& M) {
  const Quadrature rule = gauss_legendre(degree + 1, 0, 1);
  Eigen::VectorXd old, fresh, difference = Eigen::VectorXd::Zero(coarse.size());
  double error = 0;
  for (int c = 0; c < int(fine.cells().size()); ++c) {
    const auto& [low, high] = fine.cells()[std::size_t(c)].parameters;
    for (Eigen::Index a = 0; a < rule.x.size(); ++a)
      for (Eigen::Index b = 0; b < rule.x.size(); ++b) {
        const double u = low[0] + rule.x(a) * (high[0] - low[0]), v = low[1] + rule.x(b) * (high[1] - low[1]);
        const int there = coarse.cell_at(u, v);
        coarse.blending(there, u, v, old);
        fine.blending(c, u, v, fresh);
        const auto &rows = fine.cells()[std::size_t(c)].functions,
                   &columns = coarse.cells()[std::size_t(there)].functions;
        for (std::size_t i = 0; i < columns.size(); ++i) difference(columns[i]) = old(Eigen::Index(i));
        for (std::size_t j = 0; j < rows.size(); ++j)
          for (Sparse::InnerIterator entry(M, rows[j]); entry; ++entry)
            difference(entry.col()) -= entry.value() * fresh(Eigen::Index(j));
        const auto collect = [&](Eigen::Index i) {
          error = std::max(error, std::abs(difference(i)));
          difference(i) = 0;
        };
        for (int i : columns) collect(i);
        for (int j : rows)
          for (Sparse::InnerIterator entry(M, j); entry; ++entry) collect(entry.col());
      }
  }
  return error;
}

}  // namespace

RefinementOperator refinement_operator(const TsplineBasis& coarse, const TsplineBasis& fine) {
  RefinementOperator result;
  result.blending = by_dual_functionals(coarse, fine);
  result.nesting_error = nesting_error(coarse, fine, result.blending);
  if (!(result.nesting_error < nested)) {
    result.blending = by_projection(coarse, fine);
    result.nesting_error = nesting_error(coarse, fine, result.blending);
  }
  if (!(result.nesting_error < nested))
    throw std::domain_error(
        fmt::format("the refined mesh cannot keep the shape: functions are off by {:.2g}; choose the "
                    "closure both or greedy",
                    result.nesting_error));
  result.weights = result.blending * coarse.weights();
  if (!(result.weights.minCoeff() > 0))
    throw std::domain_error(fmt::format("a weight became {:.3g} in the refinement; choose the closure both or greedy",
                                        result.weights.minCoeff()));
  result.points = result.weights.cwiseInverse().asDiagonal() * result.blending * coarse.weights().asDiagonal();
  return result;
}

double independence(const TsplineBasis& basis) {
  const Eigen::SparseMatrix<double> G = gram(basis, basis);
  const Eigen::VectorXd scale = G.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(scaled(G, scale));
  if (solver.info() != Eigen::Success) return 0;
  return solver.vectorD().cwiseAbs().minCoeff() / solver.vectorD().cwiseAbs().maxCoeff();
}

}  // namespace trammel::plate
