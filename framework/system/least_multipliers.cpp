#include "system/least_multipliers.hpp"

#include <algorithm>
#include <vector>

#include "linear/fronts/least_multipliers.hpp"
#include "linear/kkt.hpp"

namespace trammel::model {

namespace {

std::vector<numerics::BodyBlock> rows_by_body(AssembledSystem& system) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> G = system.sparse_rows();
  std::vector<numerics::BodyBlock> bodies;
  std::vector<std::size_t> body_of(std::size_t(G.cols()));
  for (const BodyEntry& entry : system.model().bodies) {
    std::fill_n(body_of.begin() + entry.v0, entry.nv, bodies.size());
    numerics::BodyBlock& body = bodies.emplace_back();
    body.v0 = entry.v0;
    body.M.setZero(entry.nv, entry.nv);
    body.Gt.resize(entry.nv, 0);
  }
  for (int row = 0; row < G.rows(); ++row)
    for (decltype(system.sparse_rows())::InnerIterator entry(G, row); entry; ++entry) {
      numerics::BodyBlock& body = bodies[body_of[std::size_t(entry.col())]];
      if (body.rows.empty() || body.rows.back() != row) {
        body.rows.push_back(row);
        body.Gt.conservativeResize(Eigen::NoChange, body.Gt.cols() + 1);
        body.Gt.rightCols(1).setZero();
      }
      body.Gt(entry.col() - body.v0, body.Gt.cols() - 1) = entry.value();
    }
  return bodies;
}

}  // namespace

void minimise_norm(AssembledSystem& system, Vec& lambda) {
  if (!system.redundant() || system.rubs_by_reactions()) return;
  const double violation = system.g().lpNorm<Eigen::Infinity>();
  numerics::LeastMultipliers least;
  least.factorise(rows_by_body(system), system.sizes().nc, numerics::rank_tolerance_at(violation));
  least.minimise(lambda);
}

}  // namespace trammel::model
