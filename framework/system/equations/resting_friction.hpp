// Friction of contacts at rest whose law is decided in every evaluation (lcp_every_step) and that have no rows.
#pragma once

#include <vector>

#include "system/equations/factors.hpp"

namespace trammel::model {

class RestingFriction {
 public:
  RestingFriction(Point& at, ContactsAtPoint& contacts, RowsAtPoint& rows, FactorsAtPoint& factors)
      : at_(at), contacts_(contacts), rows_(rows), factors_(factors) {}

  void lay_out(std::vector<int> contacts);
  bool none() const { return resting_.empty(); }
  bool decides(int contact) const;
  // [N] at the last `add_to`; 0 for other contacts
  Tangential force(int contact) const { return forces_.col(contact); }
  // Adds the effect of this friction to the accelerations and to the multipliers. Throws NotSolvable.
  void add_to(Vec& a, Vec& lambda);

 private:
  Point& at_;
  ContactsAtPoint& contacts_;
  RowsAtPoint& rows_;
  FactorsAtPoint& factors_;
  std::vector<int> resting_;
  Eigen::Matrix2Xd forces_;  // [N] by contact
};

}  // namespace trammel::model
