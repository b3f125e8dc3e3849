// The contributions of bodies, forces, joints and contacts to S = c_m M + c_d D + c_k K + c_1 1; D, K: derivatives of
// M a - f + W^T lambda.
#include "system/assembly.hpp"
#include "system/markers/numeric_derivative.hpp"

namespace trammel::model {

namespace {

class ForceWrench final : public MarkerWrenches {
 public:
  ForceWrench(const Force& force, double t) : force_(force), t_(t) {}
  void operator()(Motions markers, std::span<Wrench> on) const override {
    force_.wrench(t_, *markers[0], *markers[1], on[0], on[1]);
  }
  bool depends_on_velocity() const override { return true; }

 private:
  const Force& force_;
  double t_;
};

}  // namespace

void AssembledSystem::Work::add_tangent(Blend c, const Vec& a, const Vec& lambda, Matrix& S,
                                        const CarriedFrom* carried) {
  if (c.c_1 != 0)
    for (int i = 0; i < sizes.nv; ++i) S.add(i, i, c.c_1);
  for (const BodyEntry& entry : model->bodies) {
    Matrix target = S.from(entry.v0, entry.v0);
    const auto q_body = q.segment(entry.q0, entry.nq);
    const auto v_body = v.segment(entry.v0, entry.nv);
    const auto a_body = a.segment(entry.v0, entry.nv);
    called(entry.origin, "add_own_rows_derivative");
    if (entry.rows > 0 && c.c_k != 0)
      entry.constrained->add_own_rows_derivative(t, q_body, lambda.segment(entry.row, entry.rows), c.c_k, target);
    if (carried && entry.carried_stress) {
      called(entry.origin, "add_tangent_with_stress_from");
      entry.carried_stress->add_tangent_with_stress_from(t, q_body, carried->from.segment(entry.q0, entry.nq),
                                                         carried->dq.segment(entry.v0, entry.nv), c.c_k, target);
      continue;
    }
    if (entry.tangent) {
      called(entry.origin, "add_tangent");
      entry.tangent->add_tangent(t, q_body, v_body, a_body, c, target);
      continue;
    }
    called(entry.origin, "mass");
    entry.body->mass(t, q_body, target);
    if (c.c_m != 1) {
      Mat M_body = Mat::Zero(entry.nv, entry.nv);
      Matrix alone = Matrix::onto(M_body);
      entry.body->mass(t, q_body, alone);
      target.add(0, 0, M_body, c.c_m - 1);
    }
    Mat block;
    called(entry.origin, "force");
    if (c.c_d != 0) {
      velocity_differences(
          v_body,
          [&](const Vec& moved, Vec& out) {
            out.setZero(entry.nv);
            entry.body->force(t, q_body, moved, out);
          },
          block);
      target.add(0, 0, block, -c.c_d);
    }
    if (c.c_k != 0) {
      Mat M_body;
      tangent_differences(
          entry, q_body,
          [&](const Vec& moved, Vec& out) {
            out.setZero(entry.nv);
            entry.body->force(t, moved, v_body, out);
            M_body.setZero(entry.nv, entry.nv);
            Matrix alone = Matrix::onto(M_body);
            entry.body->mass(t, moved, alone);
            out = M_body * a_body - out;
          },
          block);
      target.add(0, 0, block, c.c_k);
    }
  }
  for (std::size_t i = 0; i < force_slots.size(); ++i) {
    called(model->forces[i].origin, "wrench");
    const std::array<int, 2> both = {force_slots[i].A, force_slots[i].B};
    add_wrench_tangent(chain, both, t, q, v, ForceWrench(*model->forces[i].force, t), -c.c_k, -c.c_d, S);
  }
  for (std::size_t i = 0; i < joint_slots.size() && c.c_k != 0; ++i) {
    const JointEntry& entry = model->joints[i];
    called(entry.origin, "rows");
    const auto slots = joint_slots[i].all();
    const Vec6 own = lambda.segment(entry.row, entry.rows);
    const auto used = std::span(slots).first(std::size_t(joint_slots[i].count));
    add_reaction_tangent({*entry.joint, entry.tangent, used, own}, chain, t, q, v, c.c_k, S);
  }
  for (std::size_t i = 0; i < contact_slots.size(); ++i) {
    if (!modes.contacts[i].closed) continue;
    if (on_surface(i)) {
      surface(i).add_tangent(here(), c.c_k, c.c_d, S);
      continue;
    }
    if (in_joint(int(i))) {
      add_slip_tangent(int(i), c, lambda, S);
      continue;
    }
    const Slots& at = contact_slots[i];
    const Rows& r = contact(int(i));
    const Tangential ratio = friction_ratio(int(i));
    const auto add = [&](int row, double weight, auto&& along) {
      for (int k = 0; k < at.count; ++k)
        for (int l = 0; l < at.count; ++l) chain.add_pair(at[k], at[l], along(k) * r.H(l).row(row), weight, S);
    };
    // W^T lambda: the force of the row, or -f of the law, plus sliding friction
    double pull = 0, pull_beside = 0;
    if (model->contacts[i].restitution) {
      const int row = loads.place({int(i), 0}).row;
      pull = row >= 0 ? lambda(row) : 0;
      pull_beside = -loads.spring({int(i), 0}, lambda);
    } else {
      const double rate = contact_rate(int(i), 0), approach = modes.contacts[i].approach_speed;
      const ContactForce* law = model->contacts[i].force;
      called(model->contacts[i].origin, "slope");
      pull = pull_beside = -law->normal(r.g(0), rate, approach);
      const auto [by_gap, by_rate] = law->slope(r.g(0), rate, approach);
      add(0, -(c.c_k * by_gap + c.c_d * by_rate), [&](int k) { return pressed_by(r.H(k), 1, ratio); });
    }
    const Eigen::Matrix2d damping = c.c_d * -pull_beside * friction_damping(int(i));
    for (int m = 0; m < tangents(int(i)); ++m)
      for (int n = 0; n < tangents(int(i)); ++n)
        if (damping(m, n) != 0) add(1 + n, damping(m, n), [&](int k) -> Wrench { return r.H(k).row(1 + m); });
    if (c.c_k == 0) continue;
    Eigen::Vector3d F;  // one of friction's two parts is 0: what slides has no rows
    F << pull, pull_beside * ratio;
    for (int m = 1; m <= tangents(int(i)); ++m)
      if (const int row = loads.place({int(i), m}).row; row >= 0) F[m] += lambda(row);
    geometries[i]->add_reaction_tangent(here(), r, F, c.c_k, S);
  }
  returned();
}

}  // namespace trammel::model
