// A body's momentum is p = R^T M v, where R are its velocities in rigid motions of the system, so R = M^-1 (dp/dv)^T:
// computed body by body, and exact for bodies whose coordinates contain those motions.
#include <algorithm>

#include <trammel/decompositions.hpp>

#include "system/assembled_system.hpp"

namespace trammel::model {
namespace {

// Column j: M times the j-th velocity of all bodies at once.
Mat columns_of_mass(AssembledSystem& system) {
  int most = 0;
  for (const BodyEntry& body : system.model().bodies) most = std::max(most, body.nv);
  Mat columns(system.sizes().nv, most);
  for (int j = 0; j < most; ++j) {
    Vec one = Vec::Zero(columns.rows()), Mv = one;
    for (const BodyEntry& body : system.model().bodies)
      if (j < body.nv) one(body.v0 + j) = 1;
    system.add_mass_times(1, one, Mv);
    columns.col(j) = Mv;
  }
  return columns;
}

}  // namespace

bool AssembledSystem::rigid_motions(double t, const Vec& q, Mat& r) {
  for (const BodyEntry& body : model().bodies)
    if (body.nv > 0 && !body.momentum) return false;
  const Space space = model().world.space;
  const int linear = dimension(space), all = twist_size(space);
  const Mat mass = columns_of_mass(*this);
  r.setZero(sizes().nv, all);
  for (const BodyEntry& body : model().bodies) {
    Mat p(body.nv, all);
    for (int j = 0; j < body.nv; ++j) {
      const Momentum of_one = body.momentum->momentum(t, q.segment(body.q0, body.nq), Vec::Unit(body.nv, j));
      p.row(j).head(linear) = of_one.linear;
      p.row(j).tail(all - linear) = of_one.angular;
    }
    const Mat M = mass.block(body.v0, 0, body.nv, body.nv);
    if (body.nv > 0) r.middleRows(body.v0, body.nv) = Eigen::LLT<Mat>(M).solve(p);
  }
  return true;
}

}  // namespace trammel::model
