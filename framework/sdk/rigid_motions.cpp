// A body's momentum is p = R^T M v, where R are its velocities in the rigid motions. Hence R = M^-1 (dp/dv)^T for each
// body, which is exact if the body's coordinates can represent these motions.
#include <trammel/rigid_motions.hpp>

#include <algorithm>

#include <Eigen/Cholesky>

#include "system/assembled_system.hpp"

namespace trammel {
namespace {

// Column j: M times the vector whose j-th velocity of every body is 1.
Mat columns_of_mass(model::AssembledSystem& system) {
  int most = 0;
  for (const model::BodyEntry& body : system.model().bodies) most = std::max(most, body.nv);
  Mat columns(system.sizes().nv, most);
  for (int j = 0; j < most; ++j) {
    Vec one = Vec::Zero(columns.rows()), Mv = one;
    for (const model::BodyEntry& body : system.model().bodies)
      if (j < body.nv) one(body.v0 + j) = 1;
    system.add_mass_times(1, one, Mv);
    columns.col(j) = Mv;
  }
  return columns;
}

}  // namespace

bool rigid_motions(System& s, double t, const Vec& q, Mat& r) {
  auto* const system = dynamic_cast<model::AssembledSystem*>(&s);
  if (!system) return false;
  for (const model::BodyEntry& body : system->model().bodies)
    if (body.nv > 0 && !body.momentum) return false;
  const Space space = system->model().world.space;
  const int linear = dimension(space), all = twist_size(space);
  const Mat mass = columns_of_mass(*system);
  r.setZero(s.sizes().nv, all);
  for (const model::BodyEntry& body : system->model().bodies) {
    Mat p(body.nv, all);
    for (int j = 0; j < body.nv; ++j) {
      const Momentum of_one = body.momentum->momentum(t, q.segment(body.q0, body.nq), Vec::Unit(body.nv, j));
      p.row(j).head(linear) = of_one.linear;
      p.row(j).tail(all - linear) = of_one.angular;
    }
    if (body.nv > 0) r.middleRows(body.v0, body.nv) = mass.block(body.v0, 0, body.nv, body.nv).llt().solve(p);
  }
  return true;
}

}  // namespace trammel
