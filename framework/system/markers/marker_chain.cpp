#include "system/markers/marker_chain.hpp"

#include <Eigen/Geometry>

#include <trammel/linear_rows.hpp>

#include "system/markers/numeric_derivative.hpp"

namespace trammel::model {

MarkerChain::MarkerChain(const Model& model) : model_(model), known_(model.bodies.size() + 1) {}

int MarkerChain::slot(MarkerRef marker) {
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

MarkerChain::Slot& MarkerChain::add_slot(MarkerRef marker) {
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

int MarkerChain::surface_slot(int body) {
  add_slot({.body = body}).surface = true;
  return int(slots_.size()) - 1;
}

Motion& MarkerChain::surface_motion(int index) {
  Slot& slot = slots_[std::size_t(index)];
  slot.point = point_;
  return kept_[std::size_t(index)].motion;
}

const Motion& MarkerChain::nearest(int index, const Vec3& to, double t, const Vec& q, const Vec& v) {
  Slot& slot = slots_[std::size_t(index)];
  Motion& motion = kept_[std::size_t(index)].motion;
  if (slot.point == point_) return motion;
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  const auto q_body = q.segment(entry.q0, entry.nq);
  Eigen::Vector2d parameters;
  Vec3 x, normal;
  entry.surface->nearest(t, q_body, to, parameters, x, normal);
  entry.surface->motion_at(parameters, t, q_body, v.segment(entry.v0, entry.nv), motion);
  if (still_) motion.V.setZero(), motion.bias.setZero();
  slot.point = point_;
  return motion;
}

void MarkerChain::evaluate(const Slot& slot, double t, const Vec& q, const Vec& v, Motion& motion) const {
  slot.body->motion(slot.marker.marker, t, q.segment(slot.q0, slot.nq), v.segment(slot.v0, slot.nv), motion);
  if (still_) motion.V.setZero(), motion.bias.setZero();
}

// x = x_0 + J q,  V = J v
void MarkerChain::evaluate_linear(int index, const Vec& q, const Vec& v) {
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

void MarkerChain::keep_linear(int index) {
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

const Motion& MarkerChain::motion(int index, double t, const Vec& q, const Vec& v) {
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

// Motions that several users share are stored.
const Motion& MarkerChain::motion_in_passing(int index, std::size_t k, double t, const Vec& q, const Vec& v) {
  const Slot& slot = slots_[std::size_t(index)];
  if (slot.shared < 0 || slot.uses > 1) return motion(index, t, q, v);
  Motion& motion = shared_[std::size_t(slot.shared)][k];
  evaluate(slot, t, q, v, motion);
  return motion;
}

Motion MarkerChain::motion_at_zero(int index) const {
  const Slot& slot = slots_[std::size_t(index)];
  if (!slot.body) return kept_[std::size_t(index)].motion;
  Motion motion;
  slot.body->motion(slot.marker.marker, 0, Vec::Zero(slot.nq), Vec::Zero(slot.nv), motion);
  return motion;
}

void MarkerChain::add_wrench(int index, const Wrench& wrench, double c, Vec& f) const {
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

void MarkerChain::add_rows(int index, const Motion& motion, int row, const RowsOf& H, Mat& G) const {
  const Slot& slot = slots_[std::size_t(index)];
  if (slot.marker.body < 0) return;
  const int v0 = slot.v0;
  for_each_column(H, motion.J, [&](Eigen::Index j, const double* entries, auto n) {
    double* const column = G.data() + (v0 + motion.dofs[std::size_t(j)]) * G.rows() + row;
    for (int i = 0; i < n; ++i) column[i] += entries[i];
  });
}

void MarkerChain::add_pair(int index, int other, const Mat6& D, double c, Matrix& S) const {
  const Slot& a = slots_[std::size_t(index)];
  const Slot& b = slots_[std::size_t(other)];
  if (a.marker.body < 0 || b.marker.body < 0) return;
  const Motion &of_a = kept_[std::size_t(index)].motion, &of_b = kept_[std::size_t(other)].motion;
  Matrix block = S.from(a.v0, b.v0);
  for (std::size_t j = 0; j < of_b.dofs.size(); ++j) {
    const Vec6 column = D * of_b.J.col(Eigen::Index(j));
    for (std::size_t i = 0; i < of_a.dofs.size(); ++i)
      block.add(of_a.dofs[i], of_b.dofs[j], c * of_a.J.col(Eigen::Index(i)).dot(column));
  }
}

void MarkerChain::add_reaction_derivative(int index, double t, const Vec& q, const Wrench& F, double c, Matrix& S) {
  const Slot& slot = slots_[std::size_t(index)];
  if (!slot.body) return;
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  if (!entry.reaction_derivative) return add_numeric_reaction_derivative(index, t, q, F, c, S);
  Matrix target = S.from(entry.v0, entry.v0);
  entry.reaction_derivative->add_reaction_derivative(slot.marker.marker, t, q.segment(entry.q0, entry.nq), F, c,
                                                     target);
}

void MarkerChain::add_numeric_reaction_derivative(int index, double t, const Vec& q, const Wrench& F, double c,
                                                  Matrix& S) {
  const Slot& slot = slots_[std::size_t(index)];
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  v_zero_.setZero(entry.nv);
  const auto generalised_force = [&](const Vec& q_body, Vec& out) {
    probe_.dofs = kept_[std::size_t(index)].motion.dofs;
    entry.body->motion(slot.marker.marker, t, q_body, v_zero_, probe_);
    out.setZero(entry.nv);
    for (std::size_t j = 0; j < probe_.dofs.size(); ++j) out(probe_.dofs[j]) = probe_.J.col(Eigen::Index(j)).dot(F);
  };
  tangent_differences(entry, q.segment(entry.q0, entry.nq), generalised_force, block_);
  S.add(entry.v0, entry.v0, block_, c);
}

}  // namespace trammel::model
