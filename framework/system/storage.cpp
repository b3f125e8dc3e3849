// The storage of a system's matrices, and the parts of a sparse pattern of S that are known in advance: rows and
// contacts.
#include <algorithm>

#include "system/assembly.hpp"
#include "linear/sparse/sparse_sum.hpp"

namespace trammel::model {

namespace {

// Bodies with fewer coordinates are coupled by all of them.
constexpr int few_coordinates = 30;

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
  constexpr int least_unknowns = 150;  // for sparse storage to be faster, measured on plates
  constexpr double filled = 0.2;
  if (BodyBlocks::worthwhile(model)) return Storage::blocks;
  const double n = model.sizes.nv;
  if (n < least_unknowns) return Storage::dense;
  return double(first_mass(model).nonZeros()) < filled * n * n ? Storage::sparse : Storage::dense;
}

// A sphere moves over a surface: the pattern includes all patches from the start, so that it does not change.
void AssembledSystem::Work::reserve_contacts() {
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    const auto& side = model->contacts[i].surface;
    if (!side || side->against == SurfaceSide::Against::surface) continue;
    const int A = chain.body(contact_slots[i].A), B = chain.body(contact_slots[i].B);
    if (A < 0 || B < 0 || A == B) continue;
    const auto range = [this](int body) {
      const BodyEntry& entry = model->bodies[std::size_t(body)];
      return numerics::SparseSum::Places{nullptr, entry.v0, entry.nv};
    };
    if (std::min(range(A).count, range(B).count) > few_coordinates) continue;
    for (Kept& store : kept) store.sparse.sum().reserve(range(A), range(B));
  }
}

// The coordinates that move the rows' markers, including entries that are 0 at present.
void AssembledSystem::Work::add_rows_to(numerics::SparseSum& sum, bool sliding) {
  const auto add = [&](int row, int count) {
    std::sort(row_places.begin(), row_places.end());
    row_places.erase(std::unique(row_places.begin(), row_places.end()), row_places.end());
    const int n = int(row_places.size());
    const numerics::SparseSum::Places these{nullptr, sizes.nv + row, count}, columns{row_places.data(), 0, n};
    row_numbers.resize(std::size_t(count) * std::size_t(n));
    Eigen::Map<Mat> block(row_numbers.data(), count, n), transposed(row_numbers.data(), n, count);
    for (int j = 0; j < n; ++j) block.col(j) = G.col(row_places[std::size_t(j)]).segment(row, count);
    sum.add(these, columns, block, 1);
    const Mat& reaction = sliding ? W : G;
    for (int j = 0; j < n; ++j)
      transposed.row(j) = reaction.col(row_places[std::size_t(j)]).segment(row, count).transpose();
    sum.add(columns, these, transposed, 1);
  };
  const auto add_places = [&](const Slots& at) {
    for (int k = 0; k < at.count; ++k) {
      if (chain.body(at[k]) < 0) continue;
      const int v0 = chain.first_velocity(at[k]);
      for (const int dof : motion(at[k]).dofs) row_places.push_back(v0 + dof);
    }
  };
  for (const BodyEntry& entry : model->bodies) {
    if (entry.rows == 0) continue;
    row_places.clear();
    for (int j = entry.v0; j < entry.v0 + entry.nv; ++j)
      if (entry.nv <= few_coordinates || !G.col(j).segment(entry.row, entry.rows).isZero(0)) row_places.push_back(j);
    add(entry.row, entry.rows);
  }
  for (std::size_t i = 0; i < joint_slots.size(); ++i) {
    row_places.clear();
    add_places(joint_slots[i]);
    add(model->joints[i].row, model->joints[i].rows);
  }
  for_each_contact_row([&](ContactDirection d, int row) {
    row_places.clear();
    for (const int i : contacts_of_row(d)) add_places(contact_slots[std::size_t(i)]);
    add(row, 1);
  });
}

}  // namespace trammel::model
