#include "system/assembled_system.hpp"

#include <limits>

#include "model/coordinates.hpp"
#include "system/parts.hpp"

namespace trammel::model {

AssembledSystem::Parts::Parts(std::shared_ptr<const Model> model, Storage how)
    : asked_for(how),
      storage(how == Storage::automatic ? storage_for(*model) : how),
      sparse(storage == Storage::sparse),
      at(std::move(model)),
      blocks(storage == Storage::blocks ? std::make_unique<BodyBlocks>(*at.model) : nullptr) {
  resting.lay_out({});
}

void AssembledSystem::Parts::move_to(double t, const Vec& q, const Vec& v) {
  if (!at.move_to(t, q, v)) return;
  masses.moved();
  rows.forget();
}

AssembledSystem::AssembledSystem(std::shared_ptr<const Model> model, Storage storage)
    : parts_(std::make_unique<Parts>(std::move(model), storage)) {}
AssembledSystem::~AssembledSystem() = default;

const Model& AssembledSystem::model() const {
  return parts_->model();
}
Sizes AssembledSystem::sizes() const {
  Sizes sizes = parts_->model().sizes;
  sizes.nc = parts_->rows.count();
  return sizes;
}
const Modes& AssembledSystem::modes() const {
  return parts_->contacts.modes;
}
const Counts& AssembledSystem::counts() const {
  return parts_->counts;
}
Counts& AssembledSystem::counts() {
  return parts_->counts;
}
const CallSite& AssembledSystem::last_call() const {
  return parts_->at.site;
}

void AssembledSystem::set_modes(const Modes& modes) {
  Parts& p = *parts_;
  ContactsAtPoint& contacts = p.contacts;
  contacts.set_modes(modes);
  int row = model().sizes.nc;
  for (int i = 0; i < contacts.count(); ++i)
    if (contacts.locks(i)) contacts.loads.set_row({i, 0}, row++);
  const int held = row;
  std::vector<int> resting;
  for (int i = 0; i < contacts.count(); ++i) {
    const ContactMode& mode = contacts.mode(i);
    const ContactEntry& entry = contacts.entry(i);
    const auto add_row = [&](int direction) {
      const ContactDirection d{i, direction};
      if (!contacts.loads.is_implied(d)) contacts.loads.set_row(d, row++);
    };
    if (!contacts.locks(i) && mode.closed && entry.restitution) add_row(0);
    const bool sticks = mode.closed && mode.friction == ContactMode::Friction::stick;
    const bool by_rows = sticks && (p.at.markers.held_still() || !entry.coulomb ||
                                    entry.coulomb->decide() == SetValuedFriction::Decide::at_events);
    if (sticks && !by_rows) resting.push_back(i);
    for (int k = 1; k <= contacts.tangents(i) && by_rows; ++k) add_row(k);
  }
  p.shares.lay_out();
  p.resting.lay_out(std::move(resting));
  p.rows.lay_out(row, held);
  p.masses.forget_forces();
  ++p.at.configuration;
}

void AssembledSystem::lay_out() {
  auto fresh = std::make_unique<Parts>(parts_->at.model, parts_->asked_for);
  fresh->counts = parts_->counts;
  const Modes modes = parts_->contacts.modes;
  parts_ = std::move(fresh);
  set_modes(modes);
}

int AssembledSystem::row(ContactDirection direction) const {
  return parts_->contacts.loads.place(direction).row;
}

int AssembledSystem::held_rows() const {
  return parts_->rows.held();
}

void AssembledSystem::initial(Vec& q, Vec& v) const {
  const Sizes n = model().sizes;
  q.setZero(n.nq);
  v.setZero(n.nv);
  for (const BodyEntry& entry : model().bodies)
    entry.body->initial(q.segment(entry.q0, entry.nq), v.segment(entry.v0, entry.nv));
}

void AssembledSystem::hold_still(bool still) {
  parts_->at.hold_still(still);
  parts_->masses.forget_forces();
  parts_->rows.forget();
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
  if (model().flat) {
    q_dot = v;
    return;
  }
  q_dot.resize(q.size());
  for_each_part(model(), [&](const auto& part, int iq, int iv) {
    model::rate(part, q.data() + iq, v.data() + iv, q_dot.data() + iq);
  });
}

void AssembledSystem::normalise(Vec& q) const {
  if (model().flat) return;
  for_each_part(model(), [&](const auto& part, int iq, int) { model::normalise(part, q.data() + iq); });
}

void AssembledSystem::retract(const Vec& q, const Vec& dq, Vec& q_new) const {
  if (model().flat) {
    q_new = q + dq;
    return;
  }
  q_new.resize(q.size());
  for_each_part(model(), [&](const auto& part, int iq, int iv) {
    model::retract(part, q.data() + iq, dq.data() + iv, q_new.data() + iq);
  });
}

void AssembledSystem::difference(const Vec& q1, const Vec& q0, Vec& dq) const {
  if (model().flat) {
    dq = q1 - q0;
    return;
  }
  dq.resize(model().sizes.nv);
  for_each_part(model(), [&](const auto& part, int iq, int iv) {
    model::difference(part, q1.data() + iq, q0.data() + iq, dq.data() + iv);
  });
}

void AssembledSystem::move_to(double t, const Vec& q, const Vec& v) {
  parts_->move_to(t, q, v);
}
const Vec& AssembledSystem::f() {
  return parts_->masses.force();
}

const Vec& AssembledSystem::g() {
  parts_->evaluate_rows();
  return parts_->rows.g();
}

const Vec& AssembledSystem::g_dot() {
  parts_->evaluate_rows();
  return parts_->rows.g_dot();
}

void AssembledSystem::add_mass_times(double c, const Vec& a, Vec& r) {
  parts_->masses.add_times(c, a, r);
}

void AssembledSystem::add_reaction(double c, const Vec& lambda, Vec& r) {
  if (parts_->rows.count() == 0) return;
  parts_->evaluate_rows();
  parts_->rows.add_reaction(c, lambda, r);
}

void AssembledSystem::add_rows_times(double c, const Vec& x, Vec& rc) {
  if (parts_->rows.count() == 0) return;
  parts_->evaluate_rows();
  parts_->rows.add_times(c, x, rc);
}

void AssembledSystem::add_rows_force(double c, const Vec& mu, Vec& r) {
  if (parts_->rows.count() == 0) return;
  parts_->evaluate_rows();
  parts_->rows.add_force(c, mu, r);
}

namespace {
constexpr int most_loads = 50;  // iterations of Newton's method for the bearings' loads; 1 to 4 are usual
}

void AssembledSystem::accelerate(Stabilisation s, Vec& a, Vec& lambda) {
  Parts& p = *parts_;
  constexpr auto store = FactorsAtPoint::at_point;
  p.evaluate_rows();
  const bool stabilised = s.alpha != 0 || s.beta != 0;
  p.stabilised_by = std::max(p.stabilised_by, s.beta);
  if (stabilised) p.right_rows = p.rows.gamma() - 2 * s.alpha * p.rows.g_dot() - s.beta * s.beta * p.rows.g();
  // Always start from bearings without load, so that the result at a point does not depend on earlier calls.
  p.rows.unload_bearings();
  for (int tries = 0;; ++tries) {
    if (!p.factors.factorise_mass(store, true)) throw NotSolvable("the mass matrix is not positive definite");
    if (!p.factors.solve(store, p.masses.force(), stabilised ? p.right_rows : p.rows.gamma(), a, lambda)) {
      a.setConstant(model().sizes.nv, std::numeric_limits<double>::quiet_NaN());
      break;  // the caller finds the component whose result is not finite
    }
    if (!p.friction.none()) p.factors.minimise_norm(store, lambda);
    if (!p.rows.load_bearings(lambda)) break;
    if (tries == most_loads) p.friction.fail_without_loads();
  }
  if (!p.resting.none()) p.resting.add_to(a, lambda);
}

double AssembledSystem::stabilised_by() const {
  return parts_->stabilised_by;
}

void AssembledSystem::factorise(Blend blend, const Vec& a, const Vec& lambda, Factors which) {
  Parts& p = *parts_;
  const auto store = FactorsAtPoint::Store(which);
  const bool no_tangent = blend.c_d == 0 && blend.c_k == 0, with_friction = which == Factors::iteration;
  const bool mass_only = no_tangent && blend.c_m == 1 && blend.c_1 == 0;
  const bool identity_only = no_tangent && blend.c_m == 0 && blend.c_1 == 1;
  p.evaluate_rows();
  if (with_friction) p.rows.load_bearings(lambda);
  if (identity_only) return p.factors.factorise_identity(store);
  if (!mass_only) return p.factors.factorise_tangent(store, blend, a, lambda, with_friction);
  if (!p.factors.factorise_mass(store, with_friction)) throw NotSolvable("the mass matrix is not positive definite");
}

void AssembledSystem::factorise_with_stress(const CarriedFrom& carried, const Vec& lambda) {
  Parts& p = *parts_;
  p.evaluate_rows();
  p.rows.load_bearings(lambda);
  p.factors.factorise_tangent(FactorsAtPoint::iteration, {0, 0, 1}, Vec::Zero(model().sizes.nv), lambda, true,
                              &carried);
}

bool AssembledSystem::correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda, Factors which) {
  Parts& p = *parts_;
  if (which == Factors::iteration && p.iterated_at != p.at.number && !r.isZero(0)) {
    ++p.counts.newton_iterations;
    p.iterated_at = p.at.number;
  }
  p.right = -r;
  p.right_rows = -rc;
  return p.factors.solve(FactorsAtPoint::Store(which), p.right, p.right_rows, da, dlambda);
}

void AssembledSystem::constraint_acceleration(const Vec& a, Vec& r) {
  parts_->evaluate_rows();
  r = -parts_->rows.gamma();
  if (parts_->rows.count() > 0) parts_->rows.add_times(1, a, r);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> AssembledSystem::sparse_rows() {
  parts_->evaluate_rows();
  return parts_->rows.sparse();
}

void AssembledSystem::add_tangent(Blend c, const Vec& a, const Vec& lambda, Mat& S) {
  parts_->evaluate_rows();
  Matrix target = Matrix::onto(S);
  parts_->tangent.add(c, a, lambda, target);
}

Eigen::SparseMatrix<double> AssembledSystem::sparse_tangent(Blend c, const Vec& a, const Vec& lambda) {
  parts_->evaluate_rows();
  numerics::SparseSum sum;
  Matrix target = Matrix::onto(sum);
  sum.fill(model().sizes.nv, [&] { parts_->tangent.add(c, a, lambda, target); });
  return sum.matrix();
}

CoordinateSizes AssembledSystem::coordinate_sizes() {
  CoordinateSizes sizes = parts_->at.markers.sizes();
  for (const BodyEntry& body : model().bodies) {
    int iq = body.q0, iv = body.v0;
    for (const Coordinates::Part& part : body.parts) {
      for (int j = 0; j < part.nv && part.kind == Coordinates::Kind::flat; ++j)
        sizes.place = std::max(sizes.place, std::abs(parts_->at.q(iq + j)) / sizes.of(iv + j));
      iq += part.nq, iv += part.nv;
    }
  }
  return sizes;
}

const Motion& AssembledSystem::motion(MarkerRef marker) {
  return parts_->at.motion(parts_->at.markers.slot(marker));
}

void AssembledSystem::find_signs(numerics::BlockSigns& signs) const {
  parts_->factors.find_signs(FactorsAtPoint::at_point, signs);
  if (signs.any()) parts_->shares.change_signs(signs);
}

bool AssembledSystem::redundant() const {
  return parts_->factors.redundant(FactorsAtPoint::at_point);
}

}  // namespace trammel::model
