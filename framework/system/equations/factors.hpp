// Factorisations of the equations at the point: [S W^T; G 0] in the storage of the system.
#pragma once

#include <array>
#include <vector>

#include "linear/frontal_iteration_kkt.hpp"
#include "linear/kkt.hpp"
#include "system/equations/mass_and_force.hpp"
#include "system/equations/rows.hpp"
#include "system/equations/tangent.hpp"

namespace trammel::model {

class FactorsAtPoint {
 public:
  // The stores of System::Factors, and one for accelerations at the point.
  enum Store : std::size_t { iteration, projection, at_point };

  FactorsAtPoint(Point& at, ContactsAtPoint& contacts, RowsAtPoint& rows, MassAndForceAtPoint& masses,
                 TangentAtPoint& tangent, BodyBlocks* blocks, bool sparse, Counts& counts);

  // The rows must be evaluated. With friction: W, otherwise G only.
  [[nodiscard]] bool factorise_mass(Store store, bool with_friction);  // false: M is not positive definite
  void factorise_identity(Store store);
  void factorise_tangent(Store store, Blend c, const Vec& a, const Vec& lambda, bool with_friction,
                         const CarriedFrom* carried = nullptr);
  [[nodiscard]] bool solve(Store store, const Vec& b, const Vec& c, Vec& x, Vec& y);  // false: not solvable
  bool redundant(Store store) const;  // true if rows were redundant at the last factorise_mass
  void find_signs(Store store, numerics::BlockSigns& signs) const;  // MassKkt's; none in blocks
  void minimise_norm(Store store, Vec& lambda);                     // of redundant rows, if bodies are in blocks

 private:
  // If S is M or the identity only, a cheaper, symmetric factorisation is used.
  struct Kept {
    bool symmetric = false;  // of M or the identity only
    numerics::MassKkt mass;
    bool mass_factorised = false;  // constant mass matrices are factorised once
    numerics::IterationKkt iteration;
    numerics::FrontalIterationKkt sparse;  // used instead of the dense factors in sparse storage
  };
  void factorise_sparse(Kept& store, Blend c, const Vec& a, const Vec& lambda, bool sliding,
                        const CarriedFrom* carried);
  void reserve_contacts();
  void add_rows_to(numerics::SparseSum& sum, bool sliding);  // adds W^T and G to the matrix of S
  void add_places(const Slots& slots);
  void add_rows_at_places(numerics::SparseSum& sum, const Mat& reaction, int row, int count);

  Point& at_;
  ContactsAtPoint& contacts_;
  RowsAtPoint& rows_;
  MassAndForceAtPoint& masses_;
  TangentAtPoint& tangent_;
  BodyBlocks* blocks_;
  bool sparse_;
  Counts& counts_;
  std::array<Kept, 3> kept_;
  std::vector<int> row_places_;  // column indices and values of the present rows
  std::vector<double> row_numbers_;
};

}  // namespace trammel::model
