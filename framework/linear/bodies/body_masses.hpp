// Factors M = C C^T of the masses of many bodies.
//
// All diagonal masses, such as of rigid bodies in the coordinates of their centres, form one vector over all
// velocities, which is read contiguously; separate factors would be scattered in memory.
#pragma once

#include <vector>

#include <trammel/types.hpp>

#include "linear/bodies/body_block.hpp"
#include "linear/dense/cholesky.hpp"

namespace trammel::numerics {

class BodyMasses {
 public:
  // False: a mass is not positive definite.
  [[nodiscard]] bool factorise(const std::vector<BodyBlock>& bodies);
  void take_identity(const std::vector<BodyBlock>& bodies);
  // True if these are factors of M, not the identity, for as many bodies and velocities.
  bool are_of(const std::vector<BodyBlock>& bodies) const;

  void solve(Vec& x);  // x := M^-1 x
  // C^-1 is diagonal with these entries, except for bodies with dense factors, whose entries are 1.
  const double* inverse_roots(const BodyBlock& body) const { return inverse_root_.data() + body.v0; }
  const Cholesky* dense(std::size_t body) const {
    return identity_ || place_[body] < 0 ? nullptr : &dense_[std::size_t(place_[body])].factors;
  }

 private:
  struct Dense {
    int v0 = 0, n = 0;
    Cholesky factors;
  };
  bool fits(const std::vector<BodyBlock>& bodies) const;
  void begin(const std::vector<BodyBlock>& bodies);
  bool factorise(const BodyBlock& body, int& place);
  bool invert_diagonal(const BodyBlock& body);

  Vec inverse_, inverse_root_;  // 1/M_ii and its root
  std::vector<int> place_;      // by body: index into dense_, kept after its mass was once not diagonal; -1: never
  std::vector<Dense> dense_;
  bool identity_ = false;
};

}  // namespace trammel::numerics
