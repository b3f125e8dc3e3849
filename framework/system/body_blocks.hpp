// The equations of many bodies kept body by body: masses and rows of G as dense blocks, solved by the sparse factorisations
// of linear/sparse_kkt.hpp. In place of the dense matrices where bodies are many.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <trammel/system.hpp>

#include "linear/frontal_iteration_kkt.hpp"
#include "linear/kkt.hpp"
#include "linear/sparse_kkt.hpp"
#include "model/model.hpp"
#include "system/markers/twist_rows.hpp"

namespace trammel::model {

class BodyBlocks {
 public:
  // So many bodies and unknowns that blocks are the faster way (measured on the spatial chain).
  static bool worthwhile(const Model& model);

  explicit BodyBlocks(const Model& model);

  // Rows first .. first + count - 1 of g are between these bodies (-1: the ground). Given in ascending order; the masses stay.
  struct Tie {
    int first, count;
    bool constant;
    std::vector<int> bodies;
  };
  void lay_out(std::span<const Tie> ties);

  std::vector<numerics::BodyBlock>& bodies() { return bodies_; }
  Mat& mass(std::size_t body) { return bodies_[body].M; }
  // Rows of G are set, or cleared and then added to; they stay.
  void clear_rows(int body, int row, Eigen::Index n);
  void add_rows(int body, int row, const Motion& marker, const RowsOf& H);  // G(row + i, :) += (H J)_i
  void set_own_rows(std::size_t body, const Mat& G);                        // of a body alone
  void couple();                                                            // W = G, for more to be added to W:
  void add_reaction(int body, int row, const Motion& marker, const RowsOf& H);

  // One kept factorisation, as AssembledSystem's: of M or the identity with W = G, or of any S and W. Redundant rows with sliding
  // friction beside them are left to the dense one, which finds the least squares that the sparse LU cannot.
  struct Kept {
    enum class By { mass, iteration, dense } by = By::mass;
    std::size_t mass = 0;  // in mass_factors_
    bool passing = false;  // asked for only where they were made
    numerics::FrontalIterationKkt iteration;
    numerics::MassKkt dense;
  };
  std::array<Kept, 3> kept;
  // Of M or the identity and G: `at` counts the changes of configuration, on which they depend alone.
  struct MassSystem {
    long long at = -1;
    int nc = 0;
    bool identity = false;
    double rank_tolerance = 0;
    bool operator==(const MassSystem&) const = default;
  };
  // False: a body's mass is not positive definite. `constant`: the masses are always the same. `sliding`: with W, else G alone.
  bool factorise_mass(Kept& store, const MassSystem& of, bool constant, bool sliding);
  void factorise_identity(Kept& store, const MassSystem& of) { factorise(store, of, false); }
  bool redundant(const Kept& store) const { return mass_factors_[store.mass].kkt.redundant(); }
  // `add_tangent(S)` adds all of S; it may be run twice. `sliding`: with W, else G alone.
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

 private:
  struct MassFactors {
    MassSystem of;
    bool used = false, made = false, masses_made = false;  // masses_made: those of the bodies are kept in it
    numerics::SparseMassKkt kkt;
  };
  bool factorise(Kept& store, const MassSystem& of, bool constant);
  void begin(MassFactors& factors) const;
  std::size_t factors_for(const Kept& store, const MassSystem& of) const;
  void add_rows_to(numerics::SparseSum& sum, bool sliding);
  bool factorise_dense(Kept& store, int nc, double rank_tolerance) const;

  const Model& model_;
  std::vector<numerics::BodyBlock> bodies_;
  std::array<MassFactors, std::tuple_size_v<decltype(kept)>>
      mass_factors_;  // one serves all stores that ask for the same
  Mat G_;             // of one body, to be added
};

}  // namespace trammel::model
