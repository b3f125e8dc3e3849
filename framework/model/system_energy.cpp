#include <cmath>

#include "model/assembly.hpp"

namespace trammel::model {

Energy AssembledSystem::energy() {
  Work& w = *work_;
  Energy sum;
  for (const BodyEntry& entry : w.model->bodies) {
    w.called(entry.name, "energy");
    const Energy e = entry.body->energy(w.t, w.q.segment(entry.q0, entry.nq), w.v.segment(entry.v0, entry.nv));
    sum.kinetic += e.kinetic;
    sum.potential += e.potential;
    sum.elastic += e.elastic;
  }
  for (std::size_t i = 0; i < w.force_slots.size(); ++i) {
    const auto [A, B] = w.force_slots[i];
    w.called(w.model->forces[i].name, "potential");
    sum.elastic += w.model->forces[i].force->potential(w.t, w.motion(A), w.motion(B));
  }
  for (std::size_t i = 0; i < w.contact_slots.size(); ++i)
    if (w.model->contacts[i].force && w.modes.contacts[i].closed) {
      w.called(w.model->contacts[i].name, "potential");
      sum.elastic += w.model->contacts[i].force->potential(w.contact(int(i)).g(0));
    }
  w.returned();
  return sum;
}

AssembledSystem::Balance AssembledSystem::balance(const Vec& lambda) {
  Work& w = *work_;
  Balance sum;
  for (const BodyEntry& entry : w.model->bodies) {
    w.called(entry.name, "power");
    const Power p = entry.body->power(w.t, w.q.segment(entry.q0, entry.nq), w.v.segment(entry.v0, entry.nv));
    sum.drives += p.supplied;
    sum.dampers += p.dissipated;
  }
  for (std::size_t i = 0; i < w.force_slots.size(); ++i) {
    const auto [A, B] = w.force_slots[i];
    w.called(w.model->forces[i].name, "power");
    const Power p = w.model->forces[i].force->power(w.t, w.motion(A), w.motion(B));
    sum.drives += p.supplied;
    sum.dampers += p.dissipated;
  }
  for (std::size_t i = 0; i < w.contact_slots.size(); ++i) {
    const ContactForce* law = w.model->contacts[i].force;
    if (!law || !w.modes.contacts[i].closed) continue;
    const double gap = w.contact(int(i)).g(0), rate = gap_rate(int(i)), approach = w.modes.contacts[i].approach_speed;
    w.called(w.model->contacts[i].name, "normal");
    // What the law gives beyond its elastic part, which is its value at rest.
    sum.contacts -= (law->normal(gap, rate, approach) - law->normal(gap, 0, approach)) * rate;
  }
  if (w.sizes.nc > 0) {
    w.evaluate_rows();
    sum.constraints = -lambda.dot(w.G * w.v);
  }
  w.returned();
  return sum;
}

CallSite AssembledSystem::find_not_finite() {
  Work& w = *work_;
  for (const BodyEntry& entry : w.model->bodies) {
    const auto q = w.q.segment(entry.q0, entry.nq);
    const auto v = w.v.segment(entry.v0, entry.nv);
    Vec f = Vec::Zero(entry.nv);
    entry.body->force(w.t, q, v, f);
    if (!f.allFinite()) return {&entry.name, "force"};
    Mat M = Mat::Zero(entry.nv, entry.nv);
    Matrix target = Matrix::onto(M);
    entry.body->mass(w.t, q, target);
    if (!M.allFinite()) return {&entry.name, "mass"};
  }
  for (std::size_t i = 0; i < w.force_slots.size(); ++i) {
    const auto [A, B] = w.force_slots[i];
    const int twist = twist_size(w.model->world.space);
    w.on_A.setZero(twist);
    w.on_B.setZero(twist);
    w.model->forces[i].force->wrench(w.t, w.motion(A), w.motion(B), w.on_A, w.on_B);
    if (!w.on_A.allFinite() || !w.on_B.allFinite()) return {&w.model->forces[i].name, "wrench"};
  }
  for (std::size_t i = 0; i < w.joint_slots.size(); ++i) {
    const JointEntry& entry = w.model->joints[i];
    w.rows.resize(entry.rows, w.model->world.space);
    entry.joint->rows(w.t, w.motion(w.joint_slots[i].A), w.motion(w.joint_slots[i].B), w.rows);
    if (!w.rows.g.allFinite() || !w.rows.H_A.allFinite() || !w.rows.H_B.allFinite() || !w.rows.gamma.allFinite())
      return {&entry.name, "rows"};
  }
  return {};
}

}  // namespace trammel::model
