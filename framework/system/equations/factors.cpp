#include "system/equations/factors.hpp"

#include <algorithm>

namespace trammel::model {

namespace {

// In bodies with fewer coordinates a marker is assumed to depend on all of them.
constexpr int few_coordinates = 30;

Eigen::SparseMatrix<double> sparse_identity(int n) {
  Eigen::SparseMatrix<double> identity(n, n);
  identity.setIdentity();
  return identity;
}

}  // namespace

FactorsAtPoint::FactorsAtPoint(Point& at, ContactsAtPoint& contacts, RowsAtPoint& rows, MassAndForceAtPoint& masses,
                               TangentAtPoint& tangent, BodyBlocks* blocks, bool sparse, Counts& counts)
    : at_(at),
      contacts_(contacts),
      rows_(rows),
      masses_(masses),
      tangent_(tangent),
      blocks_(blocks),
      sparse_(sparse),
      counts_(counts) {
  const numerics::Levers levers = [&markers = at_.markers]() -> const Vec& { return markers.sizes().levers; };
  for (Kept& each : kept_)
    each.mass.measure_by(levers), each.iteration.measure_by(levers), each.sparse.measure_by(levers);
  if (blocks_) {
    blocks_->kept[at_point].passing = true;
    for (auto& each : blocks_->kept) each.dense.measure_by(levers);
  }
  if (sparse_) reserve_contacts();
}

bool FactorsAtPoint::factorise_mass(Store store, bool with_friction) {
  Kept& kept = kept_[store];
  const bool constant = at_.model->constant_mass, reuse = kept.mass_factorised && constant;
  const bool sliding = with_friction && rows_.coupled();
  const double tolerance = rows_.rank_tolerance();
  const Mat& W = sliding ? rows_.W() : rows_.G();
  kept.symmetric = true;
  if (!reuse) masses_.evaluate_mass(), ++counts_.factorizations;
  if (blocks_) {
    kept.mass_factorised = blocks_->factorise_mass(
        blocks_->kept[store], {at_.configuration, rows_.count(), false, tolerance}, constant, sliding);
  } else if (reuse) {
    kept.mass.change_rows(rows_.G(), W, tolerance);
  } else if (sparse_) {
    kept.mass_factorised = kept.mass.factorise(masses_.sparse(), rows_.G(), W, tolerance);
  } else {
    kept.mass_factorised = kept.mass.factorise(masses_.dense(), rows_.G(), W, tolerance);
  }
  return kept.mass_factorised;
}

void FactorsAtPoint::factorise_identity(Store store) {
  const int nv = at_.model->sizes.nv;
  const Mat& G = rows_.G();
  const double tolerance = rows_.rank_tolerance();
  kept_[store].symmetric = true;
  kept_[store].mass_factorised = false;
  if (blocks_)
    blocks_->factorise_identity(blocks_->kept[store], {at_.configuration, rows_.count(), true, tolerance});
  else if (sparse_)
    kept_[store].mass.factorise(sparse_identity(nv), G, G, tolerance);
  else
    kept_[store].mass.factorise(Mat::Identity(nv, nv), G, G, tolerance);
}

void FactorsAtPoint::factorise_tangent(Store store, Blend c, const Vec& a, const Vec& lambda, bool with_friction,
                                       const CarriedFrom* carried) {
  ++counts_.jacobian_evaluations;  // counts once, although a sparse sum is filled twice the first time
  ++counts_.factorizations;
  Kept& kept = kept_[store];
  kept.symmetric = false;
  const bool sliding = with_friction && rows_.coupled();
  if (sparse_) return factorise_sparse(kept, c, a, lambda, sliding, carried);
  if (blocks_)
    return blocks_->factorise_tangent(blocks_->kept[store], rows_.count(), sliding,
                                      [&](Matrix& S) { tangent_.add(c, a, lambda, S, carried); });
  Matrix target = Matrix::onto(kept.iteration.begin(at_.model->sizes.nv, rows_.count()));
  tangent_.add(c, a, lambda, target, carried);
  kept.iteration.factorise(sliding ? rows_.W() : rows_.G(), rows_.G(), rows_.rank_tolerance());
}

void FactorsAtPoint::factorise_sparse(Kept& store, Blend c, const Vec& a, const Vec& lambda, bool sliding,
                                      const CarriedFrom* carried) {
  numerics::SparseSum& sum = store.sparse.sum();
  Matrix target = Matrix::onto(sum);
  store.sparse.factorise(at_.model->sizes.nv, rows_.G(), rows_.rank_tolerance(), [&] {
    tangent_.add(c, a, lambda, target, carried);
    add_rows_to(sum, sliding);
  });
}

bool FactorsAtPoint::solve(Store store, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  Kept& kept = kept_[store];
  if (blocks_) return blocks_->solve(blocks_->kept[store], b, c, x, y);
  if (!kept.symmetric && sparse_) return kept.sparse.solve(b, c, x, y);
  if (!kept.symmetric) return kept.iteration.solve(b, c, x, y);
  kept.mass.solve(b, c, x, y);
  return x.allFinite() && y.allFinite();
}

bool FactorsAtPoint::redundant(Store store) const {
  return blocks_ ? blocks_->redundant(blocks_->kept[store]) : kept_[store].mass.redundant();
}

void FactorsAtPoint::find_signs(Store store, numerics::BlockSigns& signs) const {
  if (!blocks_ && kept_[store].symmetric)
    kept_[store].mass.find_signs(signs);
  else
    signs.clear();
}

void FactorsAtPoint::minimise_norm(Store store, Vec& lambda) {
  if (blocks_) blocks_->minimise_norm(blocks_->kept[store], lambda);
}

// A sphere moves over a surface: reserves all patches from the start, so that the pattern does not change.
void FactorsAtPoint::reserve_contacts() {
  for (std::size_t i = 0; i < std::size_t(contacts_.count()); ++i) {
    const auto& side = at_.model->contacts[i].surface;
    if (!side || side->against == SurfaceSide::Against::surface) continue;
    const int A = at_.markers.body(contacts_.slots(int(i)).A), B = at_.markers.body(contacts_.slots(int(i)).B);
    if (A < 0 || B < 0 || A == B) continue;
    const auto range = [this](int body) {
      const BodyEntry& entry = at_.model->bodies[std::size_t(body)];
      return numerics::SparseSum::Places{nullptr, entry.v0, entry.nv};
    };
    if (std::min(range(A).count, range(B).count) > few_coordinates) continue;
    for (Kept& store : kept_) store.sparse.sum().reserve(range(A), range(B));
  }
}

// Rows with the coordinates that move their markers, including entries that are 0 at present.
void FactorsAtPoint::add_rows_to(numerics::SparseSum& sum, bool sliding) {
  const Mat &G = rows_.G(), &reaction = sliding ? rows_.W() : G;
  for (const BodyEntry& entry : at_.model->bodies) {
    if (entry.rows == 0) continue;
    row_places_.clear();
    for (int j = entry.v0; j < entry.v0 + entry.nv; ++j)
      if (entry.nv <= few_coordinates || !G.col(j).segment(entry.row, entry.rows).isZero(0)) row_places_.push_back(j);
    add_rows_at_places(sum, reaction, entry.row, entry.rows);
  }
  for (std::size_t i = 0; i < at_.joints.size(); ++i) {
    row_places_.clear();
    add_places(at_.joints[i]);
    add_rows_at_places(sum, reaction, at_.model->joints[i].row, at_.model->joints[i].rows);
  }
  contacts_.for_each_row([&](ContactDirection d, int row) {
    row_places_.clear();
    for (const int i : contacts_.acting_with(d)) add_places(contacts_.slots(i));
    add_rows_at_places(sum, reaction, row, 1);
  });
}

void FactorsAtPoint::add_places(const Slots& slots) {
  for (int k = 0; k < slots.count; ++k) {
    if (at_.markers.body(slots[k]) < 0) continue;
    const int v0 = at_.markers.first_velocity(slots[k]);
    for (const int dof : at_.motion(slots[k]).dofs) row_places_.push_back(v0 + dof);
  }
}

// Rows of G and columns of the reactions, at the coordinates row_places_.
void FactorsAtPoint::add_rows_at_places(numerics::SparseSum& sum, const Mat& reaction, int row, int count) {
  const Mat& G = rows_.G();
  std::sort(row_places_.begin(), row_places_.end());
  row_places_.erase(std::unique(row_places_.begin(), row_places_.end()), row_places_.end());
  const int n = int(row_places_.size());
  const numerics::SparseSum::Places rows{nullptr, at_.model->sizes.nv + row, count}, columns{row_places_.data(), 0, n};
  row_numbers_.resize(std::size_t(count) * std::size_t(n));
  Eigen::Map<Mat> block(row_numbers_.data(), count, n), transposed(row_numbers_.data(), n, count);
  for (int j = 0; j < n; ++j) block.col(j) = G.col(row_places_[std::size_t(j)]).segment(row, count);
  sum.add(rows, columns, block, 1);
  for (int j = 0; j < n; ++j)
    transposed.row(j) = reaction.col(row_places_[std::size_t(j)]).segment(row, count).transpose();
  sum.add(columns, rows, transposed, 1);
}

}  // namespace trammel::model
