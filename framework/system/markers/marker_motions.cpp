#include "system/markers/marker_motions.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include <trammel/linear_rows.hpp>

#include "system/markers/numeric_derivative.hpp"

namespace trammel::model {

namespace {

constexpr double round_off_of_one_point = 64;  // eps times the largest place: two markers no farther apart coincide
constexpr double error_of_unit_turn = 1e-9;    // the turn of a marker by a unit of an angle is 1 up to this round-off

}  // namespace

MarkerMotions::MarkerMotions(const Model& model, CallSite& site)
    : model_(model), site_(site), known_(model.bodies.size() + 1) {}

int MarkerMotions::slot(MarkerRef marker) {
  std::vector<int>& of_body = known_[std::size_t(marker.body + 1)];
  if (of_body.size() <= std::size_t(marker.marker)) of_body.resize(std::size_t(marker.marker) + 1, -1);
  int& known = of_body[std::size_t(marker.marker)];
  if (known >= 0) return ++slots_[std::size_t(known)].uses, known;
  known = int(slots_.size());
  ++add_slot(marker).uses;
  if (marker.body < 0) {
    Motion& motion = kept_.back().motion;
    const int n = twist_size(model_.world.space), dim = dimension(model_.world.space);
    const GroundFrame& frame = model_.ground_frames[std::size_t(marker.marker)];
    motion.x = frame.x.size() == dim ? frame.x : Vec3(Vec3::Zero(dim));
    motion.R = Eigen::AngleAxisd(frame.angle, frame.axis).toRotationMatrix().topLeftCorner(dim, dim);
    motion.angle = frame.angle;
    motion.V.setZero(n);
    motion.bias.setZero(n);
    motion.J.resize(n, 0);
  }
  return known;
}

MarkerMotions::Slot& MarkerMotions::add_slot(MarkerRef marker) {
  Slot& slot = slots_.emplace_back();
  kept_.emplace_back();
  slot.marker = marker;
  if (marker.body < 0) return slot;
  const BodyEntry& entry = model_.bodies[std::size_t(marker.body)];
  const Body& body = *entry.body;
  slot.body = &body;
  slot.q0 = entry.q0, slot.v0 = entry.v0, slot.nq = entry.nq, slot.nv = entry.nv;
  slot.linear = dynamic_cast<const LinearMarkers*>(&body) != nullptr;
  if (dynamic_cast<const SharedMotion*>(&body)) {
    const auto [known, fresh] = class_.try_emplace(typeid(body), short(shared_.size()));
    if (fresh) shared_.emplace_back();
    slot.shared = known->second;
  }
  return slot;
}

int MarkerMotions::surface_slot(int body) {
  add_slot({.body = body}).surface = true;
  return int(slots_.size()) - 1;
}

Motion& MarkerMotions::surface_motion(int index) {
  Slot& slot = slots_[std::size_t(index)];
  slot.point = point_;
  return kept_[std::size_t(index)].motion;
}

const Motion& MarkerMotions::nearest(int index, const Vec3& to, double t, const Vec& q, const Vec& v) {
  Slot& slot = slots_[std::size_t(index)];
  Motion& motion = kept_[std::size_t(index)].motion;
  if (slot.point == point_) return motion;
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  const auto q_body = q.segment(entry.q0, entry.nq);
  Eigen::Vector2d parameters;
  Vec3 x, normal;
  ask(slot.marker.body, "nearest", [&] { entry.surface->nearest(t, q_body, to, parameters, x, normal); });
  ask(slot.marker.body, "motion_at",
      [&] { entry.surface->motion_at(parameters, t, q_body, v.segment(entry.v0, entry.nv), motion); });
  if (still_) motion.V.setZero(), motion.bias.setZero();
  slot.point = point_;
  return motion;
}

void MarkerMotions::evaluate(const Slot& slot, double t, const Vec& q, const Vec& v, Motion& motion) const {
  ask(slot.marker.body, "motion", [&] {
    slot.body->motion(slot.marker.marker, t, q.segment(slot.q0, slot.nq), v.segment(slot.v0, slot.nv), motion);
  });
  if (still_) motion.V.setZero(), motion.bias.setZero();
}

// x = x_0 + J q,  V = J v
void MarkerMotions::evaluate_linear(int index, const Vec& q, const Vec& v) {
  const Slot& slot = slots_[std::size_t(index)];
  if (slot.begin < 0) keep_linear(index);
  Kept& kept = kept_[std::size_t(index)];
  double *const x = kept.motion.x.data(), *const V = kept.motion.V.data();
  for (Eigen::Index i = 0; i < kept.x_0.size(); ++i) x[i] = kept.x_0.data()[i], V[i] = 0;
  for (int k = slot.begin; k < slot.end; ++k) {
    const Entry& J = entries_[std::size_t(k)];
    x[J.row] += J.value * q.data()[slot.q0 + J.dof];
    V[J.row] += J.value * v.data()[slot.v0 + J.dof];
  }
  if (still_) kept.motion.V.setZero();
}

void MarkerMotions::keep_linear(int index) {
  Slot& slot = slots_[std::size_t(index)];
  Motion& m = kept_[std::size_t(index)].motion;
  m = motion_at_zero(index);
  kept_[std::size_t(index)].x_0 = m.x;
  slot.begin = int(entries_.size());
  for (Eigen::Index i = 0; i < m.x.size(); ++i)  // the axes do not turn
    for (Eigen::Index j = 0; j < m.J.cols(); ++j)
      if (m.J(i, j) != 0) entries_.push_back({int(i), m.dofs[std::size_t(j)], m.J(i, j)});
  slot.end = int(entries_.size());
}

const Motion& MarkerMotions::motion(int index, double t, const Vec& q, const Vec& v) {
  Slot& slot = slots_[std::size_t(index)];
  Motion& motion = kept_[std::size_t(index)].motion;
  if (slot.point == point_) return motion;
  if (slot.linear)
    evaluate_linear(index, q, v);
  else if (slot.body)
    evaluate(slot, t, q, v, motion);
  slot.point = point_;
  return motion;
}

// A motion that others use as well is stored for them.
const Motion& MarkerMotions::motion_in_passing(int index, std::size_t k, double t, const Vec& q, const Vec& v) {
  const Slot& slot = slots_[std::size_t(index)];
  if (slot.shared < 0 || slot.uses > 1) return motion(index, t, q, v);
  Motion& motion = shared_[std::size_t(slot.shared)][k];
  evaluate(slot, t, q, v, motion);
  return motion;
}

// Position of the marker at the start of the scene.
Vec3 MarkerMotions::start_of(MarkerRef ref, Motion& m) const {
  const auto body = std::size_t(ref.body);
  if (ref.body < 0) {
    const GroundFrame& frame = model_.ground_frames[std::size_t(ref.marker)];
    const int dim = dimension(model_.world.space);
    return frame.x.size() == dim ? frame.x : Vec3(Vec3::Zero(dim));
  }
  ask(ref.body, "motion", [&] { model_.bodies[body].body->motion(ref.marker, 0, q_start_[body], v_start_[body], m); });
  return m.x;
}

void MarkerMotions::measure() {
  const std::size_t bodies = model_.bodies.size();
  q_start_.resize(bodies), v_start_.resize(bodies);
  std::vector<double> extents(bodies, 0), lengths;
  double place = 0;
  Motion m;

  // The extents of the bodies.
  for (std::size_t b = 0; b < bodies; ++b) {
    const BodyEntry& entry = model_.bodies[b];
    q_start_[b] = Vec::Zero(entry.nq), v_start_[b] = Vec::Zero(entry.nv);
    ask(int(b), "initial", [&] { entry.body->initial(q_start_[b], v_start_[b]); });
    v_start_[b].setZero();
    Vec3 first;
    for (int k = 0; k < int(entry.body->markers().size()); ++k) {
      const Vec3 x = start_of({int(b), k}, m);
      if (k == 0) first = x;
      place = std::max(place, x.lpNorm<Eigen::Infinity>());
      extents[b] = std::max(extents[b], (x - first).norm());
    }
  }

  // The lengths L: joints and forces extend them.
  lengths = extents;
  const double one_point = round_off_of_one_point * std::numeric_limits<double>::epsilon() * place;
  const auto tie = [&](MarkerRef a, MarkerRef b) {
    const double apart = (start_of(b, m) - start_of(a, m)).norm();
    for (const MarkerRef end : {a, b})
      if (end.body >= 0 && apart > one_point)
        lengths[std::size_t(end.body)] = std::max(lengths[std::size_t(end.body)], apart);
  };
  for (const JointEntry& joint : model_.joints)
    for (std::size_t k = 1; k < joint.markers.size(); ++k) tie(joint.markers[0], joint.markers[k]);
  for (const ForceEntry& force : model_.forces)
    if (!force.from_outside) tie(force.A, force.B);
  double longest = 0;
  for (const double length : lengths) longest = std::max(longest, length);

  sizes_.emplace();
  sizes_->length = longest > 0 ? longest : place > 0 ? place : 1;
  sizes_->of = sizes_->levers = Vec::Ones(model_.sizes.nv);
  for (std::size_t b = 0; b < bodies; ++b) measure(int(b), lengths[b] > 0 ? lengths[b] : sizes_->length, extents[b]);
}

void MarkerMotions::measure(int body, double L, double extent) {
  const BodyEntry& entry = model_.bodies[std::size_t(body)];
  const int markers = int(entry.body->markers().size());
  Vec moves = Vec::Zero(entry.nv);  // relative to L and to 1 rad
  Vec turning = Vec::Zero(entry.nv);
  Motion m;
  for (int k = 0; k < markers; ++k) {
    start_of({body, k}, m);
    const auto dim = m.x.size();
    for (std::size_t j = 0; j < m.dofs.size(); ++j) {
      const Vec6 column = m.J.col(Eigen::Index(j));
      const double turn = column.tail(column.size() - dim).norm();
      double& most = moves(m.dofs[j]);
      most = std::max({most, column.head(dim).norm() / L, turn});
      if (std::abs(turn - 1) < error_of_unit_turn) ++turning(m.dofs[j]);
    }
  }
  int iv = 0;
  for (const Coordinates::Part& part : entry.parts) {
    for (int j = iv; j < iv + part.nv; ++j) {
      const bool flat = part.kind == Coordinates::Kind::flat;
      // A coordinate that moves no marker counts as a place, or as a rotation.
      if (!(moves(j) > 0)) moves(j) = flat ? 1 / L : 1;
      if (extent > 0 && (!flat || turning(j) == markers)) sizes_->levers(entry.v0 + j) = extent;
    }
    iv += part.nv;
  }
  sizes_->of.segment(entry.v0, entry.nv) = moves.cwiseInverse();
}

const CoordinateSizes& MarkerMotions::sizes() {
  if (!sizes_) measure();
  return *sizes_;
}

Motion MarkerMotions::motion_at_zero(int index) const {
  const Slot& slot = slots_[std::size_t(index)];
  if (!slot.body) return kept_[std::size_t(index)].motion;
  Motion motion;
  ask(slot.marker.body, "motion",
      [&] { slot.body->motion(slot.marker.marker, 0, Vec::Zero(slot.nq), Vec::Zero(slot.nv), motion); });
  return motion;
}

void MarkerMotions::add_wrench(int index, const Wrench& wrench, double c, Vec& f) const {
  const Slot& slot = slots_[std::size_t(index)];
  if (slot.marker.body < 0) return;
  const int v0 = slot.v0;
  for (int k = slot.begin; k < slot.end; ++k) {
    const Entry& J = entries_[std::size_t(k)];
    f.data()[v0 + J.dof] += J.value * (c * wrench.data()[J.row]);
  }
  if (slot.begin >= 0) return;
  const Motion& motion = kept_[std::size_t(index)].motion;
  const Jac& J = motion.J;
  const Eigen::Index columns = J.cols();
  with_twist(J.rows(), [&](auto twist) {
    double w[twist];
    for (int k = 0; k < twist; ++k) w[k] = c * wrench.data()[k];
    for (Eigen::Index j = 0; j < columns; ++j) {
      double sum = 0;
      for (int k = 0; k < twist; ++k) sum += J.data()[k * columns + j] * w[k];
      f(v0 + motion.dofs[std::size_t(j)]) += sum;
    }
  });
}

void MarkerMotions::add_rows(int index, const Motion& motion, int row, const RowsOf& H, Mat& G) const {
  const Slot& slot = slots_[std::size_t(index)];
  if (slot.marker.body < 0) return;
  const int v0 = slot.v0;
  for_each_column(H, motion.J, [&](Eigen::Index j, const double* entries, auto n) {
    double* const column = G.data() + (v0 + motion.dofs[std::size_t(j)]) * G.rows() + row;
    for (int i = 0; i < n; ++i) column[i] += entries[i];
  });
}

void MarkerMotions::add_pair(int index, int other, const Mat6& D, double c, Matrix& S) {
  const Slot& a = slots_[std::size_t(index)];
  const Slot& b = slots_[std::size_t(other)];
  if (a.marker.body < 0 || b.marker.body < 0) return;
  const Motion &of_a = kept_[std::size_t(index)].motion, &of_b = kept_[std::size_t(other)].motion;
  pair_.resize(of_a.J.cols(), of_b.J.cols());
  for (Eigen::Index j = 0; j < pair_.cols(); ++j) {
    const Vec6 column = D * of_b.J.col(j);
    for (Eigen::Index i = 0; i < pair_.rows(); ++i) pair_(i, j) = of_a.J.col(i).dot(column);
  }
  S.from(a.v0, b.v0).add(of_a.dofs, of_b.dofs, pair_, c);
}

// V = J v: with the unit wrenches e_i, dV_i/dq = v^T d(J^T e_i)/dq.
void MarkerMotions::add_rate_pair(int index, int other, const Mat6& D, double t, const Vec& q, const Vec& v, double c,
                                  Matrix& S) {
  const Slot& a = slots_[std::size_t(index)];
  const Slot& b = slots_[std::size_t(other)];
  if (a.marker.body < 0 || b.marker.body < 0 || b.linear) return;
  const auto v_body = v.segment(b.v0, b.nv);
  const Motion& of_a = kept_[std::size_t(index)].motion;
  pair_.setZero(of_a.J.cols(), b.nv);
  for (Eigen::Index i = 0; i < D.cols(); ++i) {
    if (D.col(i).isZero(0)) continue;
    turning_.setZero(b.nv, b.nv);
    Matrix onto = Matrix::onto(turning_);
    add_to_body(other, t, q, Wrench::Unit(D.cols(), i), 1, onto);
    const Vec6 along_a = of_a.J.transpose() * D.col(i);
    pair_.noalias() += along_a * (v_body.transpose() * turning_);
  }
  std::vector<int> all(std::size_t(b.nv));
  std::iota(all.begin(), all.end(), 0);
  S.from(a.v0, b.v0).add(of_a.dofs, all, pair_, c);
}

void MarkerMotions::add_reaction_derivative(int index, double t, const Vec& q, const Wrench& F, double c, Matrix& S) {
  const Slot& slot = slots_[std::size_t(index)];
  if (!slot.body) return;
  Matrix of_body = S.from(slot.v0, slot.v0);
  add_to_body(index, t, q, F, c, of_body);
}

void MarkerMotions::add_to_body(int index, double t, const Vec& q, const Wrench& F, double c, Matrix& of_body) {
  const Slot& slot = slots_[std::size_t(index)];
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  const auto q_of_body = q.segment(entry.q0, entry.nq);
  if (entry.reaction_derivative) {
    ask(slot.marker.body, "add_reaction_derivative",
        [&] { entry.reaction_derivative->add_reaction_derivative(slot.marker.marker, t, q_of_body, F, c, of_body); });
    return;
  }
  v_zero_.setZero(entry.nv);
  const auto generalised_force = [&](const Vec& q_body, Vec& out) {
    probe_.dofs = kept_[std::size_t(index)].motion.dofs;
    ask(slot.marker.body, "motion", [&] { entry.body->motion(slot.marker.marker, t, q_body, v_zero_, probe_); });
    out.setZero(entry.nv);
    for (std::size_t j = 0; j < probe_.dofs.size(); ++j) out(probe_.dofs[j]) = probe_.J.col(Eigen::Index(j)).dot(F);
  };
  tangent_differences(entry, q_of_body, sizes().of.segment(entry.v0, entry.nv), generalised_force, block_);
  of_body.add(0, 0, block_, c);
}

}  // namespace trammel::model
