// Finds the first component whose result at the point is not finite, by asking one after the other.
#include "system/parts.hpp"

namespace trammel::model {
namespace {

CallSite find_in_body(const BodyEntry& entry, const Point& at) {
  const auto q = at.q_of(entry);
  const auto v = at.v_of(entry);
  Vec f = Vec::Zero(entry.nv);
  entry.body->force(at.t, q, v, f);
  if (!f.allFinite()) return {&entry.origin, "force"};
  numerics::SparseSum M;
  Matrix target = Matrix::onto(M);
  M.fill(entry.nv, [&] { entry.body->mass(at.t, q, target); });
  if (!M.matrix().coeffs().allFinite()) return {&entry.origin, "mass"};
  if (entry.rows == 0) return {};
  BodyRows rows;
  rows.resize(entry.rows, entry.nv);
  entry.constrained->own_rows(at.t, q, v, rows);
  if (!rows.g.allFinite() || !rows.G.allFinite() || !rows.gamma.allFinite()) return {&entry.origin, "own_rows"};
  return {};
}

CallSite find_in_markers(Point& at) {
  for (int slot = 0; slot < at.markers.slots(); ++slot) {
    if (at.markers.body(slot) < 0 || at.markers.on_surface(slot)) continue;
    const Motion& m = at.motion(slot);
    if (!m.x.allFinite() || !m.V.allFinite() || !m.bias.allFinite() || !m.J.allFinite())
      return {&at.model->bodies[std::size_t(at.markers.body(slot))].origin, "motion"};
  }
  return {};
}

CallSite find_in_forces(Point& at) {
  for (std::size_t i = 0; i < at.forces.size(); ++i) {
    const ForceEntry& entry = at.model->forces[i];
    Wrench on_A = Wrench::Zero(twist_size(at.model->world.space)), on_B = on_A;
    entry.force->wrench(at.t, at.motion(at.forces[i].A), at.motion(at.forces[i].B), on_A, on_B);
    if (!on_A.allFinite() || !on_B.allFinite()) return {&entry.origin, "wrench"};
  }
  return {};
}

}  // namespace

CallSite AssembledSystem::find_not_finite() {
  Parts& p = *parts_;
  for (const BodyEntry& body : model().bodies)
    if (const CallSite found = find_in_body(body, p.at); found.origin) return found;
  if (const CallSite found = find_in_markers(p.at); found.origin) return found;
  if (const CallSite found = find_in_forces(p.at); found.origin) return found;
  if (const CallSite found = p.rows.find_not_finite(); found.origin) return found;
  return p.friction.find_not_finite();
}

}  // namespace trammel::model
