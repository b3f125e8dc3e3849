#include "system/equations/tangent.hpp"

#include "system/markers/numeric_derivative.hpp"
#include "system/markers/pair_tangent.hpp"
#include "system/markers/reaction_tangent.hpp"

namespace trammel::model {

namespace {

class ForceWrench final : public MarkerWrenches {
 public:
  ForceWrench(const Force& force, const WrenchTangent* exact, double t) : force_(force), exact_(exact), t_(t) {}
  void operator()(Motions markers, std::span<Wrench> on) const override {
    force_.wrench(t_, *markers[0], *markers[1], on[0], on[1]);
  }
  bool depends_on_velocity() const override { return true; }
  bool exact_tangent(Motions markers, PairTangent& K, PairTangent& D) const override {
    if (exact_) exact_->add_wrench_tangent(t_, *markers[0], *markers[1], K, D);
    return exact_ != nullptr;
  }

 private:
  const Force& force_;
  const WrenchTangent* exact_;
  double t_;
};

}  // namespace

void TangentAtPoint::add(Blend c, const Vec& a, const Vec& lambda, Matrix& S, const CarriedFrom* carried) {
  const Model& model = *at_.model;
  if (c.c_1 != 0)
    for (int i = 0; i < model.sizes.nv; ++i) S.add(i, i, c.c_1);
  for (const BodyEntry& body : model.bodies) add_body(body, c, a, lambda, S, carried);
  for (std::size_t i = 0; i < at_.forces.size(); ++i) {
    const ForceEntry& force = model.forces[i];
    at_.called(force.origin, force.tangent ? "add_wrench_tangent" : "wrench");
    const std::array<int, 2> both = {at_.forces[i].A, at_.forces[i].B};
    add_wrench_tangent(at_.markers, both, at_.t, at_.q, at_.v, ForceWrench(*force.force, force.tangent, at_.t), -c.c_k,
                       -c.c_d, S);
  }
  for (std::size_t i = 0; i < at_.joints.size() && c.c_k != 0; ++i) add_joint(i, c.c_k, lambda, S);
  for (int i = 0; i < contacts_.count(); ++i)
    if (contacts_.mode(i).closed) add_contact(i, c, lambda, S);
  at_.returned();
}

void TangentAtPoint::add_body(const BodyEntry& body, Blend c, const Vec& a, const Vec& lambda, Matrix& S,
                              const CarriedFrom* carried) {
  Matrix target = S.from(body.v0, body.v0);
  const auto q = at_.q_of(body);
  at_.called(body.origin, "add_own_rows_derivative");
  if (body.rows > 0 && c.c_k != 0)
    body.constrained->add_own_rows_derivative(at_.t, q, lambda.segment(body.row, body.rows), c.c_k, target);
  if (carried && body.carried_stress) {
    at_.called(body.origin, "add_tangent_with_stress_from");
    body.carried_stress->add_tangent_with_stress_from(at_.t, q, carried->from.segment(body.q0, body.nq),
                                                      carried->dq.segment(body.v0, body.nv), c.c_k, target);
  } else if (body.tangent) {
    at_.called(body.origin, "add_tangent");
    body.tangent->add_tangent(at_.t, q, at_.v_of(body), a.segment(body.v0, body.nv), c, target);
  } else {
    add_body_by_differences(body, c, a, target);
  }
}

void TangentAtPoint::add_body_by_differences(const BodyEntry& body, Blend c, const Vec& a, Matrix& S) {
  const auto q = at_.q_of(body);
  const auto v = at_.v_of(body);
  const auto mass_at = [&](const Vec& place, Mat& M) {
    M.setZero(body.nv, body.nv);
    Matrix alone = Matrix::onto(M);
    body.body->mass(at_.t, place, alone);
  };
  const Vec sizes = at_.markers.sizes().of.segment(body.v0, body.nv);
  Mat M, block;
  at_.called(body.origin, "mass");
  body.body->mass(at_.t, q, S);
  if (c.c_m != 1) {
    mass_at(q, M);
    S.add(0, 0, M, c.c_m - 1);
  }
  at_.called(body.origin, "force");
  if (c.c_d != 0) {
    velocity_differences(
        v, sizes,
        [&](const Vec& moved, Vec& out) {
          out.setZero(body.nv);
          body.body->force(at_.t, q, moved, out);
        },
        block);
    S.add(0, 0, block, -c.c_d);
  }
  if (c.c_k != 0) {
    tangent_differences(
        body, q, sizes,
        [&](const Vec& moved, Vec& out) {
          out.setZero(body.nv);
          body.body->force(at_.t, moved, v, out);
          mass_at(moved, M);
          out = M * a.segment(body.v0, body.nv) - out;
        },
        block);
    S.add(0, 0, block, c.c_k);
  }
}

void TangentAtPoint::add_joint(std::size_t i, double c_k, const Vec& lambda, Matrix& S) {
  const JointEntry& joint = at_.model->joints[i];
  at_.called(joint.origin, "rows");
  const auto slots = at_.joints[i].all();
  const Vec6 own = lambda.segment(joint.row, joint.rows);
  const auto used = std::span(slots).first(std::size_t(at_.joints[i].count));
  add_reaction_tangent({*joint.joint, joint.tangent, used, own}, at_.markers, at_.t, at_.q, at_.v, c_k, S);
}

void TangentAtPoint::add_contact(int i, Blend c, const Vec& lambda, Matrix& S) {
  if (contacts_.on_surface(i)) return contacts_.surface(i).add_tangent(at_.here(), c.c_k, c.c_d, S);
  if (contacts_.in_joint(i)) return friction_.add_tangent(i, c, lambda, S);
  const Slots& slots = contacts_.slots(i);
  const Rows& r = contacts_.rows(i);
  const Tangential ratio = contacts_.friction_ratio(i);
  const auto add = [&](int row, double weight, auto&& along) {
    for (int k = 0; k < slots.count; ++k)
      for (int l = 0; l < slots.count; ++l)
        at_.markers.add_pair(slots[k], slots[l], along(k) * r.H(l).row(row), weight, S);
  };
  // W^T lambda: the force of the row, or -f of the law, plus sliding friction
  double pull = 0, pull_beside = 0;
  if (contacts_.entry(i).restitution) {
    const int row = contacts_.loads.place({i, 0}).row;
    pull = row >= 0 ? lambda(row) : 0;
    pull_beside = -contacts_.loads.spring({i, 0}, lambda);
  } else {
    const double rate = contacts_.rate(i, 0), approach = contacts_.mode(i).approach_speed;
    const ContactForce* law = contacts_.entry(i).force;
    at_.called(contacts_.entry(i).origin, "slope");
    pull = pull_beside = -law->normal(r.g(0), rate, approach);
    const auto [by_gap, by_rate] = law->slope(r.g(0), rate, approach);
    add(0, -(c.c_k * by_gap + c.c_d * by_rate), [&](int k) { return pressed_by(r.H(k), 1, ratio); });
  }
  const Eigen::Matrix2d damping = c.c_d * -pull_beside * contacts_.friction_damping(i);
  for (int m = 0; m < contacts_.tangents(i); ++m)
    for (int n = 0; n < contacts_.tangents(i); ++n)
      if (damping(m, n) != 0) add(1 + n, damping(m, n), [&](int k) -> Wrench { return r.H(k).row(1 + m); });
  if (c.c_k == 0) return;
  Eigen::Vector3d F;  // one of the two parts of friction is 0: a sliding contact has no rows in its tangents
  F << pull, pull_beside * ratio;
  for (int m = 1; m <= contacts_.tangents(i); ++m)
    if (const int row = contacts_.loads.place({i, m}).row; row >= 0) F[m] += lambda(row);
  contacts_.geometry(i).add_reaction_tangent(at_.here(), r, F, c.c_k, S);
}

}  // namespace trammel::model
