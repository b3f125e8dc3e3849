// The discrete state of contacts: which are closed, stick or slide, and which of their rows carry.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "system/slip.hpp"

namespace trammel::model {

struct ContactMode {
  bool closed = false;        // Restitution: its row is active; ContactForce: its force is evaluated
  double approach_speed = 0;  // [m/s] at the last onset
  double offset = 0;          // [m] the row holds gap = offset; 0 but where an onset was not located

  // Of set-valued friction, while closed. Stick: rows hold the slip at 0. Slide: F_t = -mu F_n e (slip.hpp).
  enum class Friction { none, stick, slide };
  Friction friction = Friction::none;
  Tangential direction = Tangential::Zero();  // slide: of length 1, the slip's where the step began
  double slow = 0;                            // [m/s] slide, in space: less slip across `direction` has no direction
  Tangential anchor = Tangential::Zero();     // [m] stick: coordinates along the tangents that are held
  // Stick of a round body in space: B's view of A where `anchor` was taken. What has rolled since then counts.
  Eigen::Matrix3d rolled_from = Eigen::Matrix3d::Identity();

  bool operator==(const ContactMode&) const = default;
};

// A direction of a contact: row 0 its normal, from 1 on its tangents.
struct ContactDirection {
  int contact = 0;
  int row = 0;
  bool operator==(const ContactDirection&) const = default;
};

// Closed contacts whose rows depend on each other (complementarity/shares/row_basis.hpp). The basis has rows in g; its multipliers are
// the resultants of all these contacts, with the other sign. Those implied have none.
struct SharedRows {
  std::vector<ContactDirection> basis, implied;
  Eigen::MatrixXd K;      // implied x basis: g_implied = K g_basis + a combination of the joints' rows
  Eigen::MatrixXd share;  // (basis, implied) x basis: their forces of least norm by the resultants; 0 of idle contacts
  std::vector<int>
      sliding;  // contacts among them that slide: their friction, and so the motion, follows from their share
  bool operator==(const SharedRows&) const = default;
};

struct Modes {
  std::vector<ContactMode> contacts;
  std::vector<SharedRows> shared;  // those that are left out have rows of their own, dependent or not
  bool operator==(const Modes&) const = default;
};

}  // namespace trammel::model
