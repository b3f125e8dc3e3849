#include "system/equations/mass_and_force.hpp"

#include "linear/dense/prefetch.hpp"
#include "linear/dense/row_products.hpp"
#include "linear/dense/simd_columns.hpp"

namespace trammel::model {

MassAndForceAtPoint::MassAndForceAtPoint(Point& at, ContactsAtPoint& contacts, BodyBlocks* blocks, bool sparse,
                                         Counts& counts)
    : at_(at), contacts_(contacts), blocks_(blocks), sparse_(sparse), counts_(counts) {}

void MassAndForceAtPoint::moved() {
  mass_fresh_ = mass_fresh_ && at_.model->constant_mass;
  forget_forces();
}

void MassAndForceAtPoint::forget_forces() {
  bodies_fresh_ = force_fresh_ = false;
}

// Evaluates M, unless it is constant and available, and the bodies' part of f together: callers usually need both.
void MassAndForceAtPoint::evaluate_bodies() {
  const std::vector<BodyEntry>& bodies = at_.model->bodies;
  const int nv = at_.model->sizes.nv;
  ++counts_.residual_evaluations;
  if (!mass_fresh_ && sparse_) sum_mass(), mass_fresh_ = true;
  if (!mass_fresh_ && !blocks_) M_.setZero(nv, nv);
  f_.setZero(nv);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    numerics::look_ahead(k, bodies.size(), [&](std::size_t next) {
      at_.prefetch(bodies[next]);
      if (blocks_) blocks_->prefetch_rows(next);
    });
    evaluate_body(k);
  }
  at_.returned();
  mass_fresh_ = bodies_fresh_ = true;
}

void MassAndForceAtPoint::evaluate_body(std::size_t k) {
  const BodyEntry& entry = at_.model->bodies[k];
  const auto q = at_.q_of(entry);
  const auto v = at_.v_of(entry);
  if (!mass_fresh_) {
    Matrix M = blocks_ ? Matrix::onto(blocks_->mass(k)) : Matrix::onto(M_).from(entry.v0, entry.v0);
    if (blocks_) blocks_->mass(k).setZero();
    if (entry.mass_and_force) {
      at_.called(entry.origin, "mass_and_force");
      entry.mass_and_force->mass_and_force(at_.t, q, v, M, f_.segment(entry.v0, entry.nv));
      return;
    }
    at_.called(entry.origin, "mass");
    entry.body->mass(at_.t, q, M);
  }
  at_.called(entry.origin, "force");
  entry.body->force(at_.t, q, v, f_.segment(entry.v0, entry.nv));
}

void MassAndForceAtPoint::sum_mass() {
  sum_.fill(at_.model->sizes.nv, [this] {
    for (const BodyEntry& entry : at_.model->bodies) {
      at_.called(entry.origin, "mass");
      Matrix M = Matrix::onto(sum_).from(entry.v0, entry.v0);
      entry.body->mass(at_.t, at_.q_of(entry), M);
    }
  });
}

void MassAndForceAtPoint::evaluate_mass() {
  if (!mass_fresh_) evaluate_bodies();
}

const Vec& MassAndForceAtPoint::force() {
  if (force_fresh_) return f_;
  if (!bodies_fresh_) evaluate_bodies();
  const int twist = twist_size(at_.model->world.space);
  for (std::size_t i = 0; i < at_.forces.size(); ++i) {
    numerics::look_ahead(i, at_.forces.size(), [&](std::size_t next) {
      at_.markers.prefetch(at_.forces[next].A), at_.markers.prefetch(at_.forces[next].B);
    });
    const int A = at_.forces[i].A, B = at_.forces[i].B;
    at_.called(at_.model->forces[i].origin, "wrench");
    on_A_.setZero(twist);
    on_B_.setZero(twist);
    at_.model->forces[i].force->wrench(at_.t, at_.motion(A), at_.motion(B), on_A_, on_B_);
    at_.markers.add_wrench(A, on_A_, 1, f_);
    at_.markers.add_wrench(B, on_B_, 1, f_);
  }
  for (int i = 0; i < contacts_.count(); ++i)
    if (contacts_.entry(i).force && contacts_.mode(i).closed) add_contact(i);
  at_.returned();
  force_fresh_ = true;
  return f_;
}

void MassAndForceAtPoint::add_contact(int i) {
  if (contacts_.on_surface(i)) return contacts_.surface(i).add_force(f_);
  const Rows& r = contacts_.rows(i);
  at_.called(contacts_.entry(i).origin, "normal");
  const double N = contacts_.law_normal(i);
  const Tangential ratio = contacts_.friction_ratio(i);
  const Slots& slots = contacts_.slots(i);
  for (int k = 0; k < slots.count; ++k) at_.markers.add_wrench(slots[k], pressed_by(r.H(k), 1, ratio), N, f_);
}

void MassAndForceAtPoint::add_times(double c, const Vec& a, Vec& r) {
  evaluate_mass();
  if (blocks_)
    numerics::add_mass_times(blocks_->bodies(), c, a, r);
  else if (sparse_)
    r.noalias() += c * (sum_.matrix() * a);
  else
    numerics::add_product(c, M_, a, r);
}

Vec MassAndForceAtPoint::diagonal() {
  evaluate_mass();
  if (sparse_) return sum_.matrix().diagonal();
  if (!blocks_) return M_.diagonal();
  Vec diagonal(at_.model->sizes.nv);
  for (const numerics::BodyBlock& body : blocks_->bodies())
    diagonal.segment(body.v0, body.M.rows()) = body.M.diagonal();
  return diagonal;
}

}  // namespace trammel::model
