// An order of contacts that depends on what they are, not on how they are named.
//
// Problems with friction may have several solutions, and which one an algorithm ends in depends on the order of its
// rows. So contacts are sorted by numbers that move with them when they are permuted: their own stiffness, coefficient
// and load, how their normal and tangents are coupled, by whose sign the two feet of a symmetric block differ, and
// their entries of A b and A A b, which tell how they are coupled with others. Contacts with the same numbers look
// alike. They keep the order that they come in, and no rule could do better.
// An example: two contacts, without tangents of their own here, whose normal forces obey  a_1 = N_1 + 2 N_2 - 1,  a_2 =
// 2 N_1 + N_2 - 1  by friction that slides. Of its solutions (1, 0), (0, 1) and (1/3, 1/3) only the last is the same
// when the two are exchanged, and it is the one that no stiff law settles in: what yields a little runs away from it.
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
  Vec as_named(const Vec& x) const;  // forces or accelerations in the order that the contacts came in

 private:
  std::vector<ContactPoint> points_;
  std::vector<Eigen::Index> rows_;  // of each row the one that it was
  Mat A_;
  Vec b_;
};

}  // namespace trammel::complementarity
