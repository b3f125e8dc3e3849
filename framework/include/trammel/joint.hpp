// A joint: constraint rows between two markers, or more (Constraint). It sees no bodies and no coordinates; assembly
// forms
//     G = H_A J_A + H_B J_B + ...      and moves the markers' bias into gamma.
// Planar and spatial scenes use the same joint; the size of the twists distinguishes them (3 or 6).
#pragma once

#include <span>

#include <trammel/component.hpp>
#include <trammel/marker.hpp>

namespace trammel {

using Motions = std::span<const Motion* const>;  // A, B, C, D in the scene's order

// Rows between marker_count() markers, 2 to Rows::most_markers.
class Constraint : public Component {
 public:
  virtual int marker_count() const = 0;
  virtual int row_count(Space) const = 0;
  // On entry `rows` has row_count rows, all zero.
  virtual void rows_between(double t, Motions markers, Rows& rows) const = 0;
};

// Rows between two markers: nearly all joints.
class Joint : public Constraint {
 public:
  virtual void rows(double t, const Motion& A, const Motion& B, Rows& rows) const = 0;

  int marker_count() const final { return 2; }
  void rows_between(double t, Motions markers, Rows& r) const final { rows(t, *markers[0], *markers[1], r); }
};

// Ability of joints between two markers: the derivatives of the wrenches H^T lambda, exact. Without it the framework
// takes differences of the rows.
class ReactionTangent {
 public:
  virtual ~ReactionTangent();
  // Adds to K, whose blocks have the twists' size on entry.
  virtual void add_reaction_tangent(double t, const Motion& A, const Motion& B, const Vec6& lambda,
                                    PairTangent& K) const = 0;
};

}  // namespace trammel
