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
  for (std::size_t i = 0; i < modes.contacts.size(); ++i)
    w.contact_row[i] = modes.contacts[i].closed && w.model->contacts[i].restitution ? row++ : -1;
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

void AssembledSystem::initial(Vec& q, Vec& v) const {
  const Sizes n = work_->model->sizes;
  q.setZero(n.nq);
  v.setZero(n.nv);
  for (const BodyEntry& entry : work_->model->bodies)
    entry.body->initial(q.segment(entry.q0, entry.nq), v.segment(entry.v0, entry.nv));
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
  r.noalias() += c * (work_->G.transpose() * lambda);
}

void AssembledSystem::add_rows_times(double c, const Vec& x, Vec& rc) {
  if (work_->sizes.nc == 0) return;
  work_->evaluate_rows();
  rc.noalias() += c * (work_->G * x);
}

// No contact's friction couples rows here: W = G.
void AssembledSystem::add_rows_force(double c, const Vec& mu, Vec& r) {
  add_reaction(c, mu, r);
}

void AssembledSystem::accelerate(Stabilisation s, Vec& a, Vec& lambda) {
  Work& w = *work_;
  if (!w.factorise_mass(w.at_point)) throw NotSolvable("the mass matrix is not positive definite");
  w.right = w.force();
  w.right_rows = w.gamma - 2 * s.alpha * w.g_dot - s.beta * s.beta * w.g;
  w.at_point.mass.solve(w.right, w.right_rows, a, lambda);
}

void AssembledSystem::factorise(Blend blend, const Vec& a, const Vec& lambda, Factors which) {
  Work& w = *work_;
  Work::Kept& kept = w.kept[std::size_t(which)];
  const bool no_tangent = blend.c_d == 0 && blend.c_k == 0;
  const bool mass_only = no_tangent && blend.c_m == 1 && blend.c_1 == 0;
  const bool identity_only = no_tangent && blend.c_m == 0 && blend.c_1 == 1;
  kept.symmetric = mass_only || identity_only;
  if (mass_only && !w.factorise_mass(kept)) throw NotSolvable("the mass matrix is not positive definite");
  if (mass_only) return;
  w.evaluate_rows();
  if (identity_only) {
    kept.mass_factorised = false;
    kept.mass.factorise(Mat::Identity(w.sizes.nv, w.sizes.nv), w.G);
    return;
  }
  ++w.counts.factorizations;
  w.add_tangent(blend, a, lambda, kept.iteration.begin(w.sizes.nv, w.sizes.nc));
  kept.iteration.factorise(w.G, w.G);
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

double AssembledSystem::gap(int contact) {
  return work_->contact(contact).g(0);
}

double AssembledSystem::gap_rate(int contact) {
  Work& w = *work_;
  const Rows& r = w.contact(contact);
  const auto [A, B] = w.contact_slots[std::size_t(contact)];
  return r.H_A.row(0).dot(w.motion(A).V) + r.H_B.row(0).dot(w.motion(B).V);
}

double AssembledSystem::gap_acceleration(int contact, const Vec& a) {
  Work& w = *work_;
  const Rows& r = w.contact(contact);
  double sum = -r.gamma(0);
  const auto add = [&](int slot, const auto& H) {
    const Motion& m = w.motion(slot);
    sum += H.dot(m.bias);
    if (w.chain.body(slot) < 0) return;
    const int v0 = w.model->bodies[std::size_t(w.chain.body(slot))].v0;
    for (std::size_t j = 0; j < m.dofs.size(); ++j) sum += H.dot(m.J.col(Eigen::Index(j))) * a(v0 + m.dofs[j]);
  };
  const auto [A, B] = w.contact_slots[std::size_t(contact)];
  add(A, r.H_A.row(0));
  add(B, r.H_B.row(0));
  return sum;
}

double AssembledSystem::normal_force(int contact, const Vec& lambda) {
  Work& w = *work_;
  const auto i = std::size_t(contact);
  if (w.contact_row[i] >= 0) return -lambda(w.contact_row[i]);
  const ContactForce* law = w.model->contacts[i].force;
  if (!law || !w.modes.contacts[i].closed) return 0;
  return law->normal(gap(contact), gap_rate(contact), w.modes.contacts[i].approach_speed);
}

void AssembledSystem::impulse_response(const std::vector<int>& contacts, Mat& jump, Mat& delassus) {
  Work& w = *work_;
  w.evaluate_rows();
  const auto n = Eigen::Index(contacts.size());
  numerics::MassKkt held;
  if (!held.factorise(w.mass(), w.G.topRows(w.model->sizes.nc)))
    throw NotSolvable("the mass matrix is not positive definite");
  const Vec no_rows = Vec::Zero(w.model->sizes.nc);
  Mat N = Mat::Zero(w.sizes.nv, n);
  jump.resize(w.sizes.nv, n);
  Vec dv, impulses;
  for (Eigen::Index i = 0; i < n; ++i) {
    const int contact = contacts[std::size_t(i)];
    const Rows& r = w.contact(contact);
    const auto [A, B] = w.contact_slots[std::size_t(contact)];
    w.motion(A), w.motion(B);
    Vec column = Vec::Zero(w.sizes.nv);
    w.chain.add_wrench(A, r.H_A.row(0).transpose(), 1, column);
    w.chain.add_wrench(B, r.H_B.row(0).transpose(), 1, column);
    N.col(i) = column;
    held.solve(column, no_rows, dv, impulses);
    jump.col(i) = dv;
  }
  delassus = N.transpose() * jump;
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

}  // namespace trammel::model
