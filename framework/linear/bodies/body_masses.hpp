// M = C C^T of many bodies.
//
// Diagonal masses, as of rigid bodies in the coordinates of their centres, are one vector over all velocities, which is
// read from end to end: factors of their own, each with its ways to memory, take 10,000 links 1.5 ms of 17 more.
#pragma once

#include <vector>

#include <trammel/types.hpp>

#include "linear/bodies/body_block.hpp"
#include "linear/dense/cholesky.hpp"

namespace trammel::numerics {

class BodyMasses {
 public:
  // False: the mass of one is not positive definite.
  [[nodiscard]] bool factorise(const std::vector<BodyBlock>& bodies);
  void take_identity(const std::vector<BodyBlock>& bodies);
  bool are_of(const std::vector<BodyBlock>& bodies) const;  // not the identity; of as many, and as many velocities

  void solve(Vec& x);  // x := M^-1 x
  // C^-1 is diagonal with these entries, but for bodies with dense factors, where they are 1.
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
  std::vector<int> place_;  // of each body in dense_, where it stays once its mass was not diagonal; -1: it always was
  std::vector<Dense> dense_;
  bool identity_ = false;
};

}  // namespace trammel::numerics
