// The equations of many bodies in dense blocks: one mass per body and blocks of G, solved by sparse factorisations.
// They replace dense matrices for systems of many bodies.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <trammel/system.hpp>

#include "linear/frontal_iteration_kkt.hpp"
#include "linear/kkt.hpp"
#include "linear/sparse_mass_kkt.hpp"
#include "model/model.hpp"
#include "system/markers/twist_rows.hpp"

namespace trammel::model {

class BodyBlocks {
 public:
  // True if blocks are faster for these numbers of bodies and unknowns (measured on the spatial chain).
  static bool worthwhile(const Model& model);

  explicit BodyBlocks(const Model& model);

  // Rows [first, first + count) of g are between these bodies (-1: the ground). To be called in ascending order; masses
  // are kept.
  struct Tie {
    int first, count;
    bool constant;
    std::vector<int> bodies;
  };
  void lay_out(std::span<const Tie> ties);

  std::vector<numerics::BodyBlock>& bodies() { return bodies_; }
  Mat& mass(std::size_t body) { return bodies_[body].M; }
  void prefetch_rows(std::size_t body) const;  // prefetches the memory of its own rows
  // Rows of G are set, or cleared and then added to; they stay until the next change.
  void clear_rows(int body, int row, Eigen::Index n);
  void add_rows(int body, int row, const Motion& marker, const RowsOf& H);  // G(row + i, :) += (H J)_i
  void set_own_rows(std::size_t body, const Mat& G);                        // of one body
  void couple();                                                            // sets W = G, to which terms can be added:
  void add_reaction(int body, int row, const Motion& marker, const RowsOf& H);

  // One stored factorisation: of M or the identity with W = G, or of any S and W. Redundant rows with sliding friction
  // use a dense factorisation, because the sparse LU cannot solve least-squares problems.
  struct Kept {
    enum class By { mass, iteration, dense } by = By::mass;
    std::size_t mass = 0;  // in mass_factors_
    bool passing = false;  // needed only at the point at which they were made
    numerics::FrontalIterationKkt iteration;
    numerics::MassKkt dense;
  };
  std::array<Kept, 3> kept;
  // Determines factors of M or the identity and G; `at` counts changes of the configuration.
  struct MassSystem {
    long long at = -1;
    int nc = 0;
    bool identity = false;
    double rank_tolerance = 0;
    bool operator==(const MassSystem&) const = default;
  };
  // False: a body's mass is not positive definite. `constant`: the masses never change. `sliding`: with W, otherwise
  // with G only.
  bool factorise_mass(Kept& store, const MassSystem& of, bool constant, bool sliding);
  void factorise_identity(Kept& store, const MassSystem& of) { factorise(store, of, false); }
  bool redundant(const Kept& store) const { return mass_factors_[store.mass].kkt.redundant(); }
  // `add_tangent(S)` adds the whole of S; it may be run twice. `sliding`: with W, otherwise with G only.
  template <class AddTangent>
  void factorise_tangent(Kept& store, int nc, bool sliding, AddTangent&& add_tangent) {
    store.by = Kept::By::iteration;
    numerics::SparseSum& sum = store.iteration.sum();
    Matrix S = Matrix::onto(sum);
    store.iteration.factorise(
        model_.sizes.nv, nc, [] { return false; },
        [&] {
          add_tangent(S);
          add_rows_to(sum, sliding);
        });
  }
  [[nodiscard]] bool solve(Kept& store, const Vec& b, const Vec& c, Vec& x, Vec& y);  // false: not solvable
  // Makes multipliers of redundant rows those of minimum norm, if `solve` has not done so.
  void minimise_norm(Kept& store, Vec& y);

 private:
  struct MassFactors {
    MassSystem of;
    bool used = false, made = false, masses_made = false;  // masses_made: contains factors of the bodies' masses
    numerics::SparseMassKkt kkt;
  };
  bool factorise(Kept& store, const MassSystem& of, bool constant);
  void begin(MassFactors& factors) const;
  std::size_t factors_for(const Kept& store, const MassSystem& of) const;
  void add_rows_to(numerics::SparseSum& sum, bool sliding);
  bool factorise_dense(Kept& store, int nc, double rank_tolerance) const;

  const Model& model_;
  std::vector<numerics::BodyBlock> bodies_;
  // Shared by all stores with the same MassSystem.
  std::array<MassFactors, std::tuple_size_v<decltype(kept)>> mass_factors_;
  Mat G_;  // of one body, before it is added
};

}  // namespace trammel::model
