#include "model/assembled_system.hpp"

#include <stdexcept>

#include "model/assembly.hpp"
#include "model/coordinates.hpp"

namespace trammel::model {

AssembledSystem::AssembledSystem(std::shared_ptr<const Model> model)
    : work_(std::make_unique<Work>(std::move(model))) {}
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
  int row = w.model->sizes.nc;
  const int tangents = dimension(w.model->world.space) - 1;
  w.judged.clear();
  w.judged_friction.setZero(Eigen::Index(modes.contacts.size()));
  for (std::size_t i = 0; i < modes.contacts.size(); ++i) {
    const ContactMode& mode = modes.contacts[i];
    const ContactEntry& entry = w.model->contacts[i];
    w.contact_row[i] = mode.closed && entry.restitution ? row++ : -1;
    const bool sticks = mode.closed && mode.friction == ContactMode::Friction::stick;
    const bool held = sticks && entry.coulomb->decide() == SetValuedFriction::Decide::at_events;
    if (sticks && !held) w.judged.push_back(int(i));
    w.stick_row[i] = held ? row : -1;
    if (held) row += tangents;
  }
  w.sizes.nc = row;
  w.rows_fresh = w.bodies_fresh = w.force_fresh = false;
}

void AssembledSystem::lay_out() {
  auto fresh = std::make_unique<Work>(work_->model);
  fresh->counts = work_->counts;
  const Modes modes = work_->modes;
  work_ = std::move(fresh);
  set_modes(modes);
}

int AssembledSystem::contact_row(int contact) const {
  return work_->contact_row[std::size_t(contact)];
}

int AssembledSystem::stick_row(int contact) const {
  return work_->stick_row[std::size_t(contact)];
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
  if (w.point > 0) ++w.point;  // else there is no point yet
  w.bodies_fresh = w.force_fresh = w.rows_fresh = false;
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
  r.noalias() += c * (work_->mass() * a);
}

void AssembledSystem::add_reaction(double c, const Vec& lambda, Vec& r) {
  if (work_->sizes.nc == 0) return;
  work_->evaluate_rows();
  r.noalias() += c * (work_->reactions().transpose() * lambda);
}

void AssembledSystem::add_rows_times(double c, const Vec& x, Vec& rc) {
  if (work_->sizes.nc == 0) return;
  work_->evaluate_rows();
  rc.noalias() += c * (work_->G * x);
}

void AssembledSystem::add_rows_force(double c, const Vec& mu, Vec& r) {
  if (work_->sizes.nc == 0) return;
  work_->evaluate_rows();
  r.noalias() += c * (work_->G.transpose() * mu);
}

void AssembledSystem::accelerate(Stabilisation s, Vec& a, Vec& lambda) {
  Work& w = *work_;
  if (!w.factorise_mass(w.at_point, true)) throw NotSolvable("the mass matrix is not positive definite");
  w.right_rows = w.gamma - 2 * s.alpha * w.g_dot - s.beta * s.beta * w.g;
  w.at_point.mass.solve(w.force(), w.right_rows, a, lambda);
  if (!w.judged.empty()) w.judge_friction(a, lambda);
}

void AssembledSystem::factorise(Blend blend, const Vec& a, const Vec& lambda, Factors which) {
  Work& w = *work_;
  Work::Kept& kept = w.kept[std::size_t(which)];
  const bool no_tangent = blend.c_d == 0 && blend.c_k == 0;
  const bool mass_only = no_tangent && blend.c_m == 1 && blend.c_1 == 0;
  const bool identity_only = no_tangent && blend.c_m == 0 && blend.c_1 == 1;
  kept.symmetric = mass_only || identity_only;
  if (mass_only && !w.factorise_mass(kept, which == Factors::iteration))
    throw NotSolvable("the mass matrix is not positive definite");
  if (mass_only) return;
  w.evaluate_rows();
  if (identity_only) {
    kept.mass_factorised = false;
    kept.mass.factorise(Mat::Identity(w.sizes.nv, w.sizes.nv), w.G);
    return;
  }
  ++w.counts.factorizations;
  w.add_tangent(blend, a, lambda, kept.iteration.begin(w.sizes.nv, w.sizes.nc));
  kept.iteration.factorise(which == Factors::iteration ? w.reactions() : w.G, w.G);
}

bool AssembledSystem::correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors which) {
  Work& w = *work_;
  if (which == Factors::iteration) ++w.counts.newton_iterations;
  Work::Kept& kept = w.kept[std::size_t(which)];
  w.right = -r;
  w.right_rows = -rc;
  if (!kept.symmetric) return kept.iteration.solve(w.right, w.right_rows, da, dlambda);
  kept.mass.solve(w.right, w.right_rows, da, dlambda);
  return da.allFinite() && dlambda.allFinite();
}

void AssembledSystem::constraint_acceleration(const Vec& a, Vec& r) {
  work_->evaluate_rows();
  r = -work_->gamma;
  if (work_->sizes.nc > 0) r.noalias() += work_->G * a;
}

const Motion& AssembledSystem::motion(MarkerRef marker) {
  Work& w = *work_;
  return w.motion(w.chain.slot(marker));
}

bool AssembledSystem::redundant() const {
  return work_->at_point.mass.redundant();
}

}  // namespace trammel::model
