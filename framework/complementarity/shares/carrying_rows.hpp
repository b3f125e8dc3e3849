// How closed contacts carry their resultants. Their rows R: normals that are closed and tangents that stick.
//
// If rows depend on each other, only the resultants of their forces are determined (row_basis.hpp). They are shared as
// by equal springs, F_R of least norm; if such a force would pull or leave a cone, by the admissible forces of least
// norm (admissible_forces.hpp). The shares of a sliding contact affect the motion, since its friction follows from
// them: sliding contacts that would pull are idle, closed without a force, until their spring would press.
#pragma once

#include <optional>
#include <vector>

#include "complementarity/programs/contact_point.hpp"
#include "complementarity/shares/row_basis.hpp"

namespace trammel::complementarity {

// The role of one contact.
struct ContactRole {
  enum class Tangent { none, sticks, slides };
  bool closed = false;
  bool idle = false;  // closed without a force; its row follows from others
  Tangent tangent = Tangent::none;
  Eigen::Vector2d ratio = Eigen::Vector2d::Zero();  // slides: T / N
  bool operator==(const ContactRole&) const = default;
};

struct CarryingRows {
  RowBasis rows;  // idle normals are among the implied ones
  Mat share;      // (basis, then implied) x basis: F = share lambda of least norm, that of idle ones 0
  std::vector<bool> indeterminate;  // by contact: part of a self-stress
  bool sliding_shares = false;      // a sliding contact is among those
};
CarryingRows carrying_rows(const std::vector<ContactPoint>& points, const Mat& A,
                           const std::vector<ContactRole>& roles);

// Forces of least norm for their resultants, F = share lambda, (basis, then implied) x basis. `shares` is K with zero
// rows for idle contacts.
Mat least_norm_shares(const Mat& shares);
// The same for any basis: `resultants` is E; `idle`: which of its columns have no force. The shares stay below 1e8
// where the other columns come to depend on each other.
Mat least_norm_shares(const Mat& resultants, const std::vector<bool>& idle);
// The force that an idle contact would have as one more equal spring, for forces F: that of the last column of `among`,
// whose others are the columns of E of the contacts that carry. It is continuous, and 0, where these come to depend on
// each other.
double force_as_spring(const Mat& among, const Vec& resultants);

// Contacts that share resultants, by their rows: indices into A, with those of each contact together.
struct SharingGroup {
  std::vector<Eigen::Index> basis, implied;
  Mat K, share;
  std::vector<std::size_t> sliding;  // contacts among them that slide
};
std::vector<SharingGroup> sharing_groups(const std::vector<ContactPoint>& points, const std::vector<ContactRole>& roles,
                                         const CarryingRows& carrying);
// One group of all these rows, on their best conditioned basis. Rows of idle contacts have no share, but they hold the
// motion as the others do, also where the rows that carry come to depend on each other. None if the others do not carry
// all resultants.
std::optional<SharingGroup> group_with_idle(const Mat& A, const std::vector<Eigen::Index>& rows,
                                            const std::vector<Eigen::Index>& idle);

}  // namespace trammel::complementarity
