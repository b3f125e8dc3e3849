// M and f of bodies, forces and compliant contacts at the point.
#pragma once

#include <trammel/types.hpp>

#include "linear/sparse/sparse_sum.hpp"
#include "system/equations/body_blocks.hpp"
#include "system/point/contacts.hpp"
#include "system/point/counts.hpp"

namespace trammel::model {

class MassAndForceAtPoint {
 public:
  // M is in `blocks` if not null, otherwise dense or sparse.
  MassAndForceAtPoint(Point& at, ContactsAtPoint& contacts, BodyBlocks* blocks, bool sparse, Counts& counts);

  void moved();          // the point has changed
  void forget_forces();  // to be called when something other than the point changes f
  const Vec& force();
  void evaluate_mass();
  const Mat& dense() const { return M_; }               // after evaluate_mass, in dense storage
  const auto& sparse() const { return sum_.matrix(); }  // after evaluate_mass, in sparse storage
  void add_times(double c, const Vec& a, Vec& r);       // r += c M a
  Vec diagonal();

 private:
  void evaluate_bodies();
  void evaluate_body(std::size_t body);
  void sum_mass();
  void add_contact(int i);

  Point& at_;
  ContactsAtPoint& contacts_;
  BodyBlocks* blocks_;
  bool sparse_;
  Counts& counts_;
  bool mass_fresh_ = false;
  bool bodies_fresh_ = false, force_fresh_ = false;  // f contains the bodies' part; f is complete
  Mat M_;
  numerics::SparseSum sum_;  // of the bodies' masses, in sparse storage
  Vec f_;
  Wrench on_A_, on_B_;
};

}  // namespace trammel::model
