// S = c_m M + c_d D + c_k K + c_1 1 at the point; D, K: derivatives of M a - f + W^T lambda by v and q.
#pragma once

#include <trammel/system.hpp>

#include "system/point/contacts.hpp"
#include "system/point/joint_friction.hpp"

namespace trammel::model {

// The stresses of a CarriedStress tangent: those at `from` plus their linear change by the increment dq.
struct CarriedFrom {
  const Vec& from;
  const Vec& dq;
};

class TangentAtPoint {
 public:
  TangentAtPoint(Point& at, ContactsAtPoint& contacts, JointFriction& friction)
      : at_(at), contacts_(contacts), friction_(friction) {}

  // Adds S, exactly if components give derivatives, otherwise by differences. `carried`: K with these stresses; null:
  // exact.
  void add(Blend c, const Vec& a, const Vec& lambda, Matrix& S, const CarriedFrom* carried = nullptr);

 private:
  void add_body(const BodyEntry& body, Blend c, const Vec& a, const Vec& lambda, Matrix& S, const CarriedFrom* carried);
  void add_body_by_differences(const BodyEntry& body, Blend c, const Vec& a, Matrix& S);
  void add_joint(std::size_t joint, double c_k, const Vec& lambda, Matrix& S);
  void add_contact(int contact, Blend c, const Vec& lambda, Matrix& S);

  Point& at_;
  ContactsAtPoint& contacts_;
  JointFriction& friction_;
};

}  // namespace trammel::model
