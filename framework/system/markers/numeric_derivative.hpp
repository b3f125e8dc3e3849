// Central differences in the tangent space of one body, for components without an exact derivative.
#pragma once

#include <algorithm>
#include <cmath>

#include "model/coordinates.hpp"
#include "model/model.hpp"

namespace trammel::model {

// q (+) dq for one body's own segments.
inline void retract_body(const BodyEntry& entry, const Vec& q, const Vec& dq, Vec& q_new) {
  q_new.resize(q.size());
  int iq = 0, iv = 0;
  for (const Coordinates::Part& part : entry.parts) {
    retract(part, q.data() + iq, dq.data() + iv, q_new.data() + iq);
    iq += part.nq, iv += part.nv;
  }
}

// eps^(1/3): balances round-off and truncation error of a central difference for arguments of order 1.
inline double difference_step(double size) {
  return 6e-6 * std::max(1.0, std::abs(size));
}

// block(:, j) = d function(q (+) e_j s)/ds, function(q_body, out) with out (nv).
template <class Function>
void tangent_differences(const BodyEntry& entry, const Vec& q, Function&& function, Mat& block) {
  Vec dq = Vec::Zero(entry.nv), q_new, plus, minus;
  block.resize(entry.nv, entry.nv);
  int iq = 0, iv = 0;
  for (const Coordinates::Part& part : entry.parts) {
    for (int j = 0; j < part.nv; ++j) {
      const double s = difference_step(part.kind == Coordinates::Kind::flat ? q(iq + j) : 1.0);
      dq(iv + j) = s;
      retract_body(entry, q, dq, q_new);
      function(q_new, plus);
      dq(iv + j) = -s;
      retract_body(entry, q, dq, q_new);
      function(q_new, minus);
      dq(iv + j) = 0;
      block.col(iv + j) = (plus - minus) / (2 * s);
    }
    iq += part.nq, iv += part.nv;
  }
}

// block(:, j) = d function(v)/dv_j.
template <class Function>
void velocity_differences(const Vec& v, Function&& function, Mat& block) {
  Vec moved = v, plus, minus;
  block.resize(v.size(), v.size());
  for (Eigen::Index j = 0; j < v.size(); ++j) {
    const double s = difference_step(v(j));
    moved(j) = v(j) + s;
    function(moved, plus);
    moved(j) = v(j) - s;
    function(moved, minus);
    moved(j) = v(j);
    block.col(j) = (plus - minus) / (2 * s);
  }
}

}  // namespace trammel::model
