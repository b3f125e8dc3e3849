// The equations of closed contacts that carry (carrying_rows.hpp), for the resultants lambda of their forces:
//
//     a_R = A_R F + b_R = 0 along the basis,     F = F_0 + W share lambda
//
// W: rows of the unknowns, and T = p N where a contact slides. F_0: friction of contacts that slide under a given
// normal force.
#pragma once

#include <trammel/decompositions.hpp>

#include "complementarity/shares/carrying_rows.hpp"

namespace trammel::complementarity {

class CarryingEquations {
 public:
  CarryingEquations(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b,
                    const std::vector<ContactRole>& roles, const CarryingRows& carrying);

  // False: they have no solution or many, as at Painleve's critical coefficient.
  bool regular() const { return regular_; }
  double least_pivot() const;  // with rows in their own units
  Vec forces() const;          // F
  // The change of lambda that cancels the remaining accelerations `a` along the basis.
  Vec correction(const Vec& a) const;

 private:
  Mat along_rows(const std::vector<ContactPoint>& points, const std::vector<ContactRole>& roles,
                 const CarryingRows& carrying) const;

  std::vector<Eigen::Index> basis_;
  Vec F_0_, rest_, scale_;  // rest_: accelerations by F_0
  Mat F_lambda_;            // W share
  bool regular_ = true;
  Eigen::FullPivLU<Mat> lu_;
};

}  // namespace trammel::complementarity
