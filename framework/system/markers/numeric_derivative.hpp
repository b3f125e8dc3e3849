// Central differences in the tangent space of one body, for components without an exact derivative.
#pragma once

#include "model/coordinates.hpp"
#include "model/model.hpp"
#include "system/markers/coordinate_sizes.hpp"

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

// block(:, j) = d function(q (+) e_j s)/ds, function(q_body, out) with out (nv); `sizes` of the body's coordinates.
template <class Function>
void tangent_differences(const BodyEntry& entry, const Vec& q, const Vec& sizes, Function&& function, Mat& block) {
  Vec dq = Vec::Zero(entry.nv), ahead, behind, plus, minus;
  block.resize(entry.nv, entry.nv);
  int iq = 0, iv = 0;
  for (const Coordinates::Part& part : entry.parts) {
    const bool flat = part.kind == Coordinates::Kind::flat;
    for (int j = 0; j < part.nv; ++j) {
      const double s = difference_step(sizes(iv + j), flat ? q(iq + j) : 0);
      dq(iv + j) = s;
      retract_body(entry, q, dq, ahead);
      function(ahead, plus);
      dq(iv + j) = -s;
      retract_body(entry, q, dq, behind);
      function(behind, minus);
      dq(iv + j) = 0;
      block.col(iv + j) = (plus - minus) / (flat ? ahead(iq + j) - behind(iq + j) : 2 * s);
    }
    iq += part.nq, iv += part.nv;
  }
}

// block(:, j) = d function(v)/dv_j; steps are parts of the velocity and of the size per second.
template <class Function>
void velocity_differences(const Vec& v, const Vec& sizes, Function&& function, Mat& block) {
  Vec moved = v, plus, minus;
  block.resize(v.size(), v.size());
  for (Eigen::Index j = 0; j < v.size(); ++j) {
    const double s = difference_step(std::max(sizes(j), std::abs(v(j)))), ahead = v(j) + s, behind = v(j) - s;
    moved(j) = ahead;
    function(moved, plus);
    moved(j) = behind;
    function(moved, minus);
    moved(j) = v(j);
    block.col(j) = (plus - minus) / (ahead - behind);
  }
}

}  // namespace trammel::model
