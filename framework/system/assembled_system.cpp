#include "system/assembled_system.hpp"

#include <limits>
#include <stdexcept>

#include "model/coordinates.hpp"
#include "system/assembly.hpp"

namespace trammel::model {

AssembledSystem::AssembledSystem(std::shared_ptr<const Model> model, Storage storage)
    : work_(std::make_unique<Work>(std::move(model), storage)) {}
AssembledSystem::~AssembledSystem() = default;

const Model& AssembledSystem::model() const {
  return *work_->model;
}
Sizes AssembledSystem::sizes() const {
  return work_->sizes;
}
const Modes& AssembledSystem::modes() const {
  return work_->modes;
}
const Counts& AssembledSystem::counts() const {
  return work_->counts;
}
Counts& AssembledSystem::counts() {
  return work_->counts;
}
const CallSite& AssembledSystem::last_call() const {
  return work_->site;
}

void AssembledSystem::set_modes(const Modes& modes) {
  Work& w = *work_;
  w.modes = modes;
  const auto locks = [&](std::size_t i) {
    const Restitution* law = w.model->contacts[i].restitution;
    return modes.contacts[i].closed && law && law->treatment().release == Restitution::Release::never;
  };
  w.loads.lay_out(w.modes);
  w.shared_at.assign(modes.shared.size(), {});
  int row = w.model->sizes.nc;
  for (std::size_t i = 0; i < modes.contacts.size(); ++i)
    if (locks(i)) w.loads.set_row({int(i), 0}, row++);
  w.held_rows = row;
  w.judged.clear();
  w.judged_friction.setZero(2, Eigen::Index(modes.contacts.size()));
  for (std::size_t i = 0; i < modes.contacts.size(); ++i) {
    const ContactMode& mode = modes.contacts[i];
    const ContactEntry& entry = w.model->contacts[i];
    const auto add_row = [&](int direction) {
      const ContactDirection d{int(i), direction};
      if (!w.loads.is_implied(d)) w.loads.set_row(d, row++);
    };
    if (!locks(i) && mode.closed && entry.restitution) add_row(0);
    const bool sticks = mode.closed && mode.friction == ContactMode::Friction::stick;
    const bool held =
        sticks && (w.chain.held_still() || entry.coulomb->decide() == SetValuedFriction::Decide::at_events);
    if (sticks && !held) w.judged.push_back(int(i));
    for (int k = 1; k <= w.tangents(int(i)) && held; ++k) add_row(k);
  }
  w.sizes.nc = row;
  w.lay_out_blocks();
  w.rows_fresh = w.bodies_fresh = w.force_fresh = false;
  ++w.configuration;
  for (auto& surface : w.surfaces) surface.point = -1;
}

void AssembledSystem::lay_out() {
  auto fresh = std::make_unique<Work>(work_->model, work_->storage);
  fresh->counts = work_->counts;
  const Modes modes = work_->modes;
  work_ = std::move(fresh);
  set_modes(modes);
}

int AssembledSystem::row(ContactDirection direction) const {
  return work_->loads.place(direction).row;
}

int AssembledSystem::held_rows() const {
  return work_->held_rows;
}

void AssembledSystem::initial(Vec& q, Vec& v) const {
  const Sizes n = work_->model->sizes;
  q.setZero(n.nq);
  v.setZero(n.nv);
  for (const BodyEntry& entry : work_->model->bodies)
    entry.body->initial(q.segment(entry.q0, entry.nq), v.segment(entry.v0, entry.nv));
}

void AssembledSystem::hold_still(bool still) {
  Work& w = *work_;
  w.chain.hold_still(still);
  if (w.point > 0) ++w.point;  // otherwise there is no point yet
  w.bodies_fresh = w.force_fresh = w.rows_fresh = false;
  ++w.configuration;
}

namespace {

// Runs f(part, index in q, index in v) over all parts of all bodies.
template <class F>
void for_each_part(const Model& model, F&& f) {
  int iq = 0, iv = 0;
  for (const BodyEntry& entry : model.bodies)
    for (const Coordinates::Part& part : entry.parts) {
      f(part, iq, iv);
      iq += part.nq, iv += part.nv;
    }
}

}  // namespace

void AssembledSystem::rate(const Vec& q, const Vec& v, Vec& q_dot) const {
  if (work_->model->flat) {
    q_dot = v;
    return;
  }
  q_dot.resize(q.size());
  for_each_part(*work_->model, [&](const auto& part, int iq, int iv) {
    model::rate(part, q.data() + iq, v.data() + iv, q_dot.data() + iq);
  });
}

void AssembledSystem::normalise(Vec& q) const {
  if (work_->model->flat) return;
  for_each_part(*work_->model, [&](const auto& part, int iq, int) { model::normalise(part, q.data() + iq); });
}

void AssembledSystem::retract(const Vec& q, const Vec& dq, Vec& q_new) const {
  if (work_->model->flat) {
    q_new = q + dq;
    return;
  }
  q_new.resize(q.size());
  for_each_part(*work_->model, [&](const auto& part, int iq, int iv) {
    model::retract(part, q.data() + iq, dq.data() + iv, q_new.data() + iq);
  });
}

void AssembledSystem::difference(const Vec& q1, const Vec& q0, Vec& dq) const {
  if (work_->model->flat) {
    dq = q1 - q0;
    return;
  }
  dq.resize(work_->sizes.nv);
  for_each_part(*work_->model, [&](const auto& part, int iq, int iv) {
    model::difference(part, q1.data() + iq, q0.data() + iq, dq.data() + iv);
  });
}

void AssembledSystem::move_to(double t, const Vec& q, const Vec& v) {
  work_->move_to(t, q, v);
}
const Vec& AssembledSystem::f() {
  return work_->force();
}

const Vec& AssembledSystem::g() {
  work_->evaluate_rows();
  return work_->g;
}

const Vec& AssembledSystem::g_dot() {
  work_->evaluate_rows();
  return work_->g_dot;
}

void AssembledSystem::add_mass_times(double c, const Vec& a, Vec& r) {
  work_->add_mass_times(c, a, r);
}

void AssembledSystem::add_reaction(double c, const Vec& lambda, Vec& r) {
  if (work_->sizes.nc == 0) return;
  work_->evaluate_rows();
  work_->add_reaction(c, lambda, r);
}

void AssembledSystem::add_rows_times(double c, const Vec& x, Vec& rc) {
  if (work_->sizes.nc == 0) return;
  work_->evaluate_rows();
  work_->add_rows_times(c, x, rc);
}

void AssembledSystem::add_rows_force(double c, const Vec& mu, Vec& r) {
  if (work_->sizes.nc == 0) return;
  work_->evaluate_rows();
  work_->add_rows_force(c, mu, r);
}

namespace {
constexpr int most_loads = 50;  // iterations of Newton's method for the bearings' loads; it takes 1 to 4
}

void AssembledSystem::accelerate(Stabilisation s, Vec& a, Vec& lambda) {
  Work& w = *work_;
  w.evaluate_rows();
  const bool stabilised = s.alpha != 0 || s.beta != 0;
  if (stabilised) w.right_rows = w.gamma - 2 * s.alpha * w.g_dot - s.beta * s.beta * w.g;
  // Always start from bearings without load, so that the result at a point does not depend on earlier calls.
  w.bear_nothing();
  for (int tries = 0;; ++tries) {
    if (!w.factorise_mass(Work::at_point, true, w.rank_tolerance()))
      throw NotSolvable("the mass matrix is not positive definite");
    if (!w.solve(Work::at_point, w.force(), stabilised ? w.right_rows : w.gamma, a, lambda)) {
      a.setConstant(w.sizes.nv, std::numeric_limits<double>::quiet_NaN());
      break;  // the caller finds the component whose result is not finite
    }
    if (w.blocks && !w.bearings.empty()) w.blocks->minimise_norm(w.blocks->kept[Work::at_point], lambda);
    if (!w.bear(lambda)) break;
    if (tries == most_loads) w.fail_without_loads();
  }
  if (!w.judged.empty()) w.judge_friction(a, lambda);
}

void AssembledSystem::factorise(Blend blend, const Vec& a, const Vec& lambda, Factors which) {
  Work& w = *work_;
  const auto store = Work::Store(which);
  const bool no_tangent = blend.c_d == 0 && blend.c_k == 0, with_friction = which == Factors::iteration;
  const bool mass_only = no_tangent && blend.c_m == 1 && blend.c_1 == 0;
  const bool identity_only = no_tangent && blend.c_m == 0 && blend.c_1 == 1;
  w.evaluate_rows();
  if (with_friction) w.bear(lambda);
  if (identity_only) return w.factorise_identity(store);
  if (!mass_only) return w.factorise_tangent(store, blend, a, lambda, with_friction);
  if (!w.factorise_mass(store, with_friction, w.rank_tolerance()))
    throw NotSolvable("the mass matrix is not positive definite");
}

void AssembledSystem::factorise_with_stress(const CarriedFrom& carried, const Vec& lambda) {
  Work& w = *work_;
  w.evaluate_rows();
  w.bear(lambda);
  w.factorise_tangent(Work::Store(Factors::iteration), {0, 0, 1}, Vec::Zero(w.sizes.nv), lambda, true, &carried);
}

bool AssembledSystem::correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors which) {
  Work& w = *work_;
  if (which == Factors::iteration && w.iterated_at != w.point && !r.isZero(0)) {
    ++w.counts.newton_iterations;
    w.iterated_at = w.point;
  }
  w.right = -r;
  w.right_rows = -rc;
  return w.solve(Work::Store(which), w.right, w.right_rows, da, dlambda);
}

void AssembledSystem::constraint_acceleration(const Vec& a, Vec& r) {
  work_->evaluate_rows();
  r = -work_->gamma;
  if (work_->sizes.nc > 0) work_->add_rows_times(1, a, r);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> AssembledSystem::sparse_rows() {
  work_->evaluate_rows();
  return work_->sparse_rows();
}

void AssembledSystem::add_tangent(Blend c, const Vec& a, const Vec& lambda, Mat& S) {
  work_->evaluate_rows();
  Matrix target = Matrix::onto(S);
  work_->add_tangent(c, a, lambda, target);
}

Eigen::SparseMatrix<double> AssembledSystem::sparse_tangent(Blend c, const Vec& a, const Vec& lambda) {
  work_->evaluate_rows();
  numerics::SparseSum sum;
  Matrix target = Matrix::onto(sum);
  sum.fill(work_->sizes.nv, [&] { work_->add_tangent(c, a, lambda, target); });
  return sum.matrix();
}

const Motion& AssembledSystem::motion(MarkerRef marker) {
  Work& w = *work_;
  return w.motion(w.chain.slot(marker));
}

bool AssembledSystem::redundant() const {
  return work_->redundant(Work::at_point);
}

}  // namespace trammel::model
