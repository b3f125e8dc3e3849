#include "system/equations/body_blocks.hpp"

#include <algorithm>

#include "linear/dense/prefetch.hpp"

namespace trammel::model {

using numerics::BodyBlock;

bool BodyBlocks::worthwhile(const Model& model) {
  constexpr int least_bodies = 6, least_unknowns = 80;
  return int(model.bodies.size()) >= least_bodies && model.sizes.nv + model.sizes.nc >= least_unknowns &&
         model.sizes.nc > 0;
}

BodyBlocks::BodyBlocks(const Model& model) : model_(model) {
  for (const BodyEntry& entry : model.bodies) {
    BodyBlock& block = bodies_.emplace_back();
    block.v0 = entry.v0;
    block.M.setZero(entry.nv, entry.nv);
    block.constant_mass = model.constant_mass;
  }
}

void BodyBlocks::lay_out(std::span<const Tie> ties) {
  for (BodyBlock& block : bodies_) block.rows.clear(), block.constant.clear();
  for (const Tie& tie : ties)
    for (auto body = tie.bodies.begin(); body != tie.bodies.end(); ++body) {
      if (*body < 0 || std::find(tie.bodies.begin(), body, *body) != body) continue;
      BodyBlock& block = bodies_[std::size_t(*body)];
      for (int i = tie.first; i < tie.first + tie.count; ++i)
        block.rows.push_back(i), block.constant.push_back(tie.constant);
    }
  for (BodyBlock& block : bodies_) block.Gt.setZero(block.M.rows(), Eigen::Index(block.rows.size()));
}

void BodyBlocks::prefetch_rows(std::size_t body) const {
  const BodyEntry& entry = model_.bodies[body];
  const std::size_t own = std::size_t(entry.rows) * std::size_t(entry.nv);
  numerics::prefetch(bodies_[body].Gt.data(), own * sizeof(double));
}

namespace {

Eigen::Index column_of(const BodyBlock& block, int row) {
  return std::lower_bound(block.rows.begin(), block.rows.end(), row) - block.rows.begin();
}

void add(const BodyBlock& block, int row, const Motion& marker, const RowsOf& H, Mat& transposed) {
  const Eigen::Index column = column_of(block, row);
  double* const to = transposed.data() + column * transposed.rows();
  const Eigen::Index rows = transposed.rows();
  const int* const dofs = marker.dofs.data();
  for_each_column(H, marker.J, [=](Eigen::Index j, const double* entries, auto n) {
    double* const first = to + dofs[j];
    for (int i = 0; i < n; ++i) first[i * rows] += entries[i];
  });
}

}  // namespace

void BodyBlocks::clear_rows(int body, int row, Eigen::Index n) {
  if (body < 0) return;
  BodyBlock& block = bodies_[std::size_t(body)];
  block.Gt.middleCols(column_of(block, row), n).setZero();
}

void BodyBlocks::add_rows(int body, int row, const Motion& marker, const RowsOf& H) {
  if (body < 0) return;
  BodyBlock& block = bodies_[std::size_t(body)];
  add(block, row, marker, H, block.Gt);
}

// The bodies' own rows precede those of joints and contacts.
void BodyBlocks::set_own_rows(std::size_t body, const Mat& G) {
  Mat& Gt = bodies_[body].Gt;
  for (Eigen::Index i = 0; i < G.rows(); ++i)
    for (Eigen::Index j = 0; j < G.cols(); ++j) Gt(j, i) = G(i, j);
}

void BodyBlocks::couple() {
  for (BodyBlock& block : bodies_) block.Wt = block.Gt;
}

void BodyBlocks::add_reaction(int body, int row, const Motion& marker, const RowsOf& H) {
  if (body < 0) return;
  BodyBlock& block = bodies_[std::size_t(body)];
  add(block, row, marker, H, block.Wt);
}

// A corrected step uses the same factors twice (to project velocities and for the accelerations), so they are shared.
std::size_t BodyBlocks::factors_for(const Kept& store, const MassSystem& of) const {
  for (std::size_t k = 0; k < mass_factors_.size(); ++k)
    if (mass_factors_[k].made && mass_factors_[k].of == of) return k;
  const auto needed = [&](std::size_t k) {
    return std::any_of(kept.begin(), kept.end(), [&](const Kept& other) {
      const bool passed = other.passing && mass_factors_[k].of.at != of.at;
      return &other != &store && other.mass == k && !passed;
    });
  };
  std::size_t k = store.mass;
  while (needed(k)) k = (k + 1) % mass_factors_.size();
  return k;
}

// Copies the symbolic analysis of another instance, because computing it is a hundred times as expensive.
void BodyBlocks::begin(MassFactors& factors) const {
  const auto other =
      std::find_if(mass_factors_.begin(), mass_factors_.end(), [](const auto& some) { return some.used; });
  if (other != mass_factors_.end()) factors = *other;
  factors.used = true;
}

bool BodyBlocks::factorise(Kept& store, const MassSystem& of, bool constant) {
  using Metric = numerics::SparseMassKkt::Metric;
  store.by = Kept::By::mass;
  store.mass = factors_for(store, of);
  MassFactors& factors = mass_factors_[store.mass];
  if (factors.made && factors.of == of) return true;
  if (!factors.used) begin(factors);
  const Metric metric = of.identity                       ? Metric::identity
                        : constant && factors.masses_made ? Metric::mass_of_before
                                                          : Metric::mass;
  factors.made = factors.kkt.factorise(bodies_, of.nc, metric, of.rank_tolerance);
  factors.masses_made = factors.made && !of.identity;
  factors.of = of;
  return factors.made;
}

// With sliding friction the matrix is not symmetric; the symmetric factors still determine which rows are redundant.
bool BodyBlocks::factorise_mass(Kept& store, const MassSystem& of, bool constant, bool sliding) {
  if (!factorise(store, of, constant)) return false;
  if (!sliding) return true;
  if (redundant(store)) return factorise_dense(store, of.nc, of.rank_tolerance);
  factorise_tangent(store, of.nc, true, [this](Matrix& S) {
    for (const BodyBlock& block : bodies_) S.add(block.v0, block.v0, block.M);
  });
  return true;
}

bool BodyBlocks::factorise_dense(Kept& store, int nc, double rank_tolerance) const {
  store.by = Kept::By::dense;
  const int nv = model_.sizes.nv;
  Mat M = Mat::Zero(nv, nv), G = Mat::Zero(nc, nv), W = G;
  for (const BodyBlock& block : bodies_) {
    const Eigen::Index n = block.M.rows();
    M.block(block.v0, block.v0, n, n) = block.M;
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      G.row(block.rows[i]).segment(block.v0, n) = block.Gt.col(Eigen::Index(i)).transpose();
      W.row(block.rows[i]).segment(block.v0, n) = block.Wt.col(Eigen::Index(i)).transpose();
    }
  }
  return store.dense.factorise(M, G, W, rank_tolerance);
}

// Adds W^T and G to the matrix of S.
void BodyBlocks::add_rows_to(numerics::SparseSum& sum, bool sliding) {
  for (const BodyBlock& block : bodies_) {
    const numerics::SparseSum::Places velocities{nullptr, block.v0, int(block.M.rows())};
    const numerics::SparseSum::Places rows{block.rows.data(), model_.sizes.nv, int(block.rows.size())};
    G_ = block.Gt.transpose();
    sum.add(velocities, rows, sliding ? block.Wt : block.Gt, 1);
    sum.add(rows, velocities, G_, 1);
  }
}

bool BodyBlocks::solve(Kept& store, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (store.by == Kept::By::iteration) return store.iteration.solve(b, c, x, y);
  if (store.by == Kept::By::mass)
    mass_factors_[store.mass].kkt.solve(bodies_, b, c, x, y);
  else
    store.dense.solve(b, c, x, y);
  return x.allFinite() && y.allFinite();
}

void BodyBlocks::minimise_norm(Kept& store, Vec& y) {
  if (store.by == Kept::By::mass) mass_factors_[store.mass].kkt.minimise_norm(bodies_, y);
}

}  // namespace trammel::model
