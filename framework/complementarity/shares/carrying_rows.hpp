// How closed contacts carry: the rows R of what they hold, normals that are closed and tangents that stick.
//
// Where rows depend on each other only the resultants of their forces are determined (row_basis.hpp). They share those
// as equal springs do, F_R of least norm; where that pulls or leaves a cone, by the admissible forces of least norm
// (admissible_forces.hpp). A contact that slides makes a difference by how it shares, since its friction follows: those
// that would pull are idle, closed without a force, until their spring would press.
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"
#include "complementarity/shares/row_basis.hpp"

namespace trammel::complementarity {

// What one contact does.
struct ContactRole {
  enum class Tangent { none, sticks, slides };
  bool closed = false;
  bool idle = false;  // closed, its row follows from others, and it carries nothing
  Tangent tangent = Tangent::none;
  Eigen::Vector2d ratio = Eigen::Vector2d::Zero();  // slides: T / N
  bool operator==(const ContactRole&) const = default;
};

struct CarryingRows {
  RowBasis rows;  // idle normals are among the implied ones
  Mat share;      // (basis, then implied) x basis: F = share lambda of least norm, that of idle ones 0
  std::vector<bool> indeterminate;  // by contact: part of a self-stress
  bool sliding_shares = false;      // a contact that slides is among those
};
CarryingRows carrying_rows(const std::vector<ContactPoint>& points, const Mat& A,
                           const std::vector<ContactRole>& roles);

// Forces of least norm by their resultants, F = share lambda, (basis, then implied) x basis; rows of `shares` are those
// of K, or 0 where an implied one is idle.
Mat least_norm_shares(const Mat& shares);

// Contacts that share with each other, by their rows: indices into A, those of each contact together.
struct SharingGroup {
  std::vector<Eigen::Index> basis, implied;
  Mat K, share;
  std::vector<std::size_t> sliding;  // contacts among them that slide
};
std::vector<SharingGroup> sharing_groups(const std::vector<ContactPoint>& points, const std::vector<ContactRole>& roles,
                                         const CarryingRows& carrying);

}  // namespace trammel::complementarity
