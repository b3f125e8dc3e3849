#include "system/equations/storage.hpp"

#include "linear/sparse/sparse_sum.hpp"
#include "system/equations/body_blocks.hpp"

namespace trammel::model {

namespace {

Eigen::SparseMatrix<double> first_mass(const Model& model) {
  Vec q(model.sizes.nq), v(model.sizes.nv);
  for (const BodyEntry& entry : model.bodies)
    entry.body->initial(q.segment(entry.q0, entry.nq), v.segment(entry.v0, entry.nv));
  numerics::SparseSum M;
  M.fill(model.sizes.nv, [&] {
    for (const BodyEntry& entry : model.bodies) {
      Matrix target = Matrix::onto(M).from(entry.v0, entry.v0);
      entry.body->mass(0, q.segment(entry.q0, entry.nq), target);
    }
  });
  return M.matrix();
}

}  // namespace

// The pattern of the mass shows which coordinates of a body are coupled.
Storage storage_for(const Model& model) {
  constexpr int least_unknowns = 150;  // below this number dense storage is faster, measured on plates
  constexpr double filled = 0.2;
  if (BodyBlocks::worthwhile(model)) return Storage::blocks;
  const double n = model.sizes.nv;
  if (n < least_unknowns) return Storage::dense;
  return double(first_mass(model).nonZeros()) < filled * n * n ? Storage::sparse : Storage::dense;
}

}  // namespace trammel::model
