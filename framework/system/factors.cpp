// The system's matrices at the point, times vectors and factorised: dense, sparse, or by BodyBlocks where bodies are
// many.
#include "linear/dense/products_of_few_rows.hpp"
#include "linear/dense/simd_columns.hpp"
#include "system/assembly.hpp"

namespace trammel::model {

namespace {

Eigen::SparseMatrix<double> sparse_identity(int n) {
  Eigen::SparseMatrix<double> identity(n, n);
  identity.setIdentity();
  return identity;
}

}  // namespace

void AssembledSystem::Work::add_mass_times(double c, const Vec& a, Vec& r) {
  evaluate_mass();
  if (blocks)
    numerics::add_mass_times(blocks->bodies(), c, a, r);
  else if (sparse)
    r.noalias() += c * (sparse_mass.matrix() * a);
  else
    numerics::add_product(c, M, a, r);
}

Vec AssembledSystem::Work::mass_diagonal() {
  evaluate_mass();
  if (sparse) return sparse_mass.matrix().diagonal();
  if (!blocks) return M.diagonal();
  Vec diagonal(sizes.nv);
  for (const numerics::BodyBlock& body : blocks->bodies()) diagonal.segment(body.v0, body.M.rows()) = body.M.diagonal();
  return diagonal;
}

void AssembledSystem::Work::add_rows_times(double c, const Vec& x, Vec& rc) {
  if (blocks)
    numerics::add_rows_times(blocks->bodies(), c, x, rc);
  else
    numerics::add_rows_product(c, G, x, rc);
}

void AssembledSystem::Work::add_rows_force(double c, const Vec& y, Vec& r) {
  if (blocks)
    numerics::add_rows_force(blocks->bodies(), c, y, r);
  else
    numerics::add_transposed_product(c, G, y, r);
}

void AssembledSystem::Work::add_reaction(double c, const Vec& y, Vec& r) {
  bear(y);
  if (!coupled)
    add_rows_force(c, y, r);
  else if (blocks)
    numerics::add_reaction(blocks->bodies(), c, y, r);
  else
    numerics::add_transposed_product(c, W, y, r);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> AssembledSystem::Work::sparse_rows() {
  std::vector<Eigen::Triplet<double, int>> entries;
  const auto add = [&entries](int row, int column, double value) {
    if (value != 0) entries.emplace_back(row, column, value);
  };
  if (blocks) {
    for (const numerics::BodyBlock& body : blocks->bodies())
      for (std::size_t i = 0; i < body.rows.size(); ++i)
        for (int k = 0; k < int(body.Gt.rows()); ++k) add(body.rows[i], body.v0 + k, body.Gt(k, Eigen::Index(i)));
  } else {
    for (int i = 0; i < sizes.nc; ++i)
      for (int j = 0; j < sizes.nv; ++j) add(i, j, G(i, j));
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> all(sizes.nc, sizes.nv);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

bool AssembledSystem::Work::factorise_mass(Store store, bool with_friction, double rank_tolerance) {
  evaluate_rows();
  const bool reuse = kept[store].mass_factorised && model->constant_mass;
  Kept& dense = kept[store];
  dense.symmetric = true;
  if (!reuse) evaluate_mass(), ++counts.factorizations;
  const bool sliding = with_friction && coupled;
  if (blocks) {
    dense.mass_factorised = blocks->factorise_mass(
        blocks->kept[store], {configuration, sizes.nc, false, rank_tolerance}, model->constant_mass, sliding);
  } else if (reuse) {
    dense.mass.change_rows(G, sliding ? W : G, rank_tolerance);
  } else if (sparse) {
    dense.mass_factorised = dense.mass.factorise(sparse_mass.matrix(), G, sliding ? W : G, rank_tolerance);
  } else {
    dense.mass_factorised = dense.mass.factorise(M, G, sliding ? W : G, rank_tolerance);
  }
  return dense.mass_factorised;
}

void AssembledSystem::Work::factorise_identity(Store store) {
  evaluate_rows();
  kept[store].symmetric = true;
  kept[store].mass_factorised = false;
  if (blocks)
    blocks->factorise_identity(blocks->kept[store], {configuration, sizes.nc, true, rank_tolerance()});
  else if (sparse)
    kept[store].mass.factorise(sparse_identity(sizes.nv), G, G, rank_tolerance());
  else
    kept[store].mass.factorise(Mat::Identity(sizes.nv, sizes.nv), G, G, rank_tolerance());
}

void AssembledSystem::Work::factorise_tangent(Store store, Blend c, const Vec& a, const Vec& lambda, bool with_friction,
                                              const CarriedFrom* carried) {
  evaluate_rows();
  ++counts.jacobian_evaluations;  // once, although a sparse sum is filled twice the first time
  ++counts.factorizations;
  kept[store].symmetric = false;
  const bool sliding = with_friction && coupled;
  if (sparse) return factorise_sparse(kept[store], c, a, lambda, sliding, carried);
  if (blocks)
    return blocks->factorise_tangent(blocks->kept[store], sizes.nc, sliding,
                                     [&](Matrix& S) { add_tangent(c, a, lambda, S, carried); });
  Matrix target = Matrix::onto(kept[store].iteration.begin(sizes.nv, sizes.nc));
  add_tangent(c, a, lambda, target, carried);
  kept[store].iteration.factorise(sliding ? W : G, G, rank_tolerance());
}

void AssembledSystem::Work::factorise_sparse(Kept& store, Blend c, const Vec& a, const Vec& lambda, bool sliding,
                                             const CarriedFrom* carried) {
  numerics::SparseSum& sum = store.sparse.sum();
  Matrix target = Matrix::onto(sum);
  store.sparse.factorise(sizes.nv, G, rank_tolerance(), [&] {
    add_tangent(c, a, lambda, target, carried);
    add_rows_to(sum, sliding);
  });
}

bool AssembledSystem::Work::solve(Store store, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (blocks) return blocks->solve(blocks->kept[store], b, c, x, y);
  if (!kept[store].symmetric && sparse) return kept[store].sparse.solve(b, c, x, y);
  if (!kept[store].symmetric) return kept[store].iteration.solve(b, c, x, y);
  kept[store].mass.solve(b, c, x, y);
  return x.allFinite() && y.allFinite();
}

bool AssembledSystem::Work::redundant(Store store) const {
  return blocks ? blocks->redundant(blocks->kept[store]) : kept[store].mass.redundant();
}

std::function<void(const Vec& impulse, Vec& dv)> AssembledSystem::Work::with_joints_held() {
  evaluate_rows();
  evaluate_mass();
  const int joint_rows = held_rows;
  const auto solver = [joint_rows](auto&& solve) {
    return [joint_rows, solve](const Vec& impulse, Vec& dv) {
      Vec on_joints;
      solve(impulse, Vec(Vec::Zero(joint_rows)), dv, on_joints);
    };
  };
  if (blocks) {
    const auto held = std::make_shared<numerics::SparseMassKkt>();
    if (!held->factorise(blocks->bodies(), joint_rows, numerics::SparseMassKkt::Metric::mass))
      throw NotSolvable("the mass matrix is not positive definite");
    return solver(
        [held, this](const Vec& b, const Vec& c, Vec& x, Vec& y) { held->solve(blocks->bodies(), b, c, x, y); });
  }
  const auto held = std::make_shared<numerics::MassKkt>();
  const Mat held_G = G.topRows(joint_rows);
  if (!(sparse ? held->factorise(sparse_mass.matrix(), held_G, held_G) : held->factorise(M, held_G)))
    throw NotSolvable("the mass matrix is not positive definite");
  return solver([held](const Vec& b, const Vec& c, Vec& x, Vec& y) { held->solve(b, c, x, y); });
}

}  // namespace trammel::model
