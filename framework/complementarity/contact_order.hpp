// Orders contacts by their properties, not by their names.
//
// Problems with friction may have several solutions, and the one that an algorithm finds depends on the order of its
// rows. Therefore contacts are sorted by numbers that do not depend on their order: their own stiffness, coefficient
// and load; the coupling of their normal and tangents, whose sign distinguishes the two feet of a symmetric block; and
// their entries of A b and A A b, which contain the coupling with others. Contacts with the same numbers look alike;
// they keep their order, and no rule could do better.
// An example: two contacts whose normal forces obey a_1 = N_1 + 2 N_2 - 1, a_2 = 2 N_1 + N_2 - 1 because of sliding
// friction. Of the solutions (1, 0), (0, 1) and (1/3, 1/3) only the last is unchanged when the contacts are exchanged,
// and it is the one at which no stiff law settles: compliant contacts depart from it.
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"

namespace trammel::complementarity {

// A problem with its contacts in that order.
class OrderedContacts {
 public:
  OrderedContacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b);

  const std::vector<ContactPoint>& points() const { return points_; }
  const Mat& A() const { return A_; }
  const Vec& b() const { return b_; }
  const std::vector<std::size_t>& order() const { return order_; }  // by contact here: its index before
  Vec ordered(const Vec& x) const { return x(rows_); }              // forces or accelerations in that order
  Vec as_named(const Vec& x) const;                                 // in the original order

 private:
  std::vector<ContactPoint> points_;
  std::vector<std::size_t> order_;
  std::vector<Eigen::Index> rows_;  // original row of each row
  Mat A_;
  Vec b_;
};

}  // namespace trammel::complementarity
