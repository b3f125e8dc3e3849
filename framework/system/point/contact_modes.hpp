// The discrete state of contacts: which of them are closed, stick or slide, and which of their rows are in g.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "complementarity/shares/spring.hpp"
#include "system/point/slip.hpp"

namespace trammel::model {

struct ContactMode {
  bool closed = false;        // Restitution: its row is active; ContactForce: its force is evaluated
  double approach_speed = 0;  // [m/s] at the last onset
  double offset = 0;          // [m] the row is gap = offset; 0 except after an onset that was not located

  // Set-valued friction while closed. Stick: rows make the slip 0. Slide: F_t = -mu F_n e (slip.hpp).
  enum class Friction { none, stick, slide };
  Friction friction = Friction::none;
  Tangential direction = Tangential::Zero();  // slide: unit vector, the slip's direction at the step's start
  double least_slip = 0;                      // [m/s] slide, in space: slip across `direction` below this counts as 0
  Tangential anchor = Tangential::Zero();     // [m] stick: coordinates along the tangents
  // Stick of a round body in space: A's orientation in B's axes when `anchor` was set, the reference for rolling.
  Eigen::Matrix3d rolled_from = Eigen::Matrix3d::Identity();
  // In a group of contacts that share rows: what it does as a spring.
  complementarity::Spring spring = complementarity::Spring::undecided;
  std::optional<double> push = {};  // [N] where it can be wedged in (complementarity/spring_motion.hpp)

  bool operator==(const ContactMode&) const = default;
};

// A direction of a contact: 0 is its normal, 1 and 2 are its tangents.
struct ContactDirection {
  int contact = 0;
  int row = 0;
  bool operator==(const ContactDirection&) const = default;
};

// Closed contacts whose rows depend on each other (complementarity/shares/row_basis.hpp). The basis has rows in g; its
// multipliers are minus the resultants of all these contacts. Implied directions have no rows. Idle contacts may be in
// the basis.
struct SharedRows {
  std::vector<ContactDirection> basis, implied;
  Eigen::MatrixXd K;         // implied x basis: g_implied = K g_basis + a combination of the joints' rows
  Eigen::MatrixXd share;     // (basis, implied) x basis: forces of least norm per resultant; 0 for idle contacts
  std::vector<int> sliding;  // sliding contacts among them: their friction, and so the motion, depends on their share

  Eigen::MatrixXd resultants() const;  // E = [1 K^T]: basis x (basis, implied)
  bool operator==(const SharedRows&) const = default;
};

inline Eigen::MatrixXd SharedRows::resultants() const {
  Eigen::MatrixXd E(K.cols(), K.cols() + K.rows());
  E << Eigen::MatrixXd::Identity(K.cols(), K.cols()), K.transpose();
  return E;
}

// What a contact does as a spring.
struct ContactSpring {
  int contact;
  complementarity::Spring spring;
  std::optional<double> push;
};

// What a contact carries [N].
struct Carried {
  int contact;
  double N, T;  // normal force, size of the friction
};

struct Modes {
  std::vector<ContactMode> contacts;
  std::vector<SharedRows> shared;  // all other contacts have their own rows, dependent or not
  bool operator==(const Modes&) const = default;
};

}  // namespace trammel::model
