#include "model/marker_chain.hpp"

#include <Eigen/Geometry>

#include <trammel/linear_rows.hpp>

#include "model/numeric_derivative.hpp"

namespace trammel::model {

MarkerChain::MarkerChain(const Model& model) : model_(model), known_(model.bodies.size() + 1) {}

int MarkerChain::slot(MarkerRef marker) {
  std::vector<int>& of_body = known_[std::size_t(marker.body + 1)];
  if (of_body.size() <= std::size_t(marker.marker)) of_body.resize(std::size_t(marker.marker) + 1, -1);
  int& known = of_body[std::size_t(marker.marker)];
  if (known >= 0) return known;
  known = int(slots_.size());
  Slot& slot = add_slot(marker);
  if (marker.body < 0) {
    const int n = twist_size(model_.world.space), dim = dimension(model_.world.space);
    const GroundFrame& frame = model_.ground_frames[std::size_t(marker.marker)];
    slot.motion.x = frame.x.size() == dim ? frame.x : Vec3(Vec3::Zero(dim));
    slot.motion.R = Eigen::AngleAxisd(frame.angle, frame.axis).toRotationMatrix().topLeftCorner(dim, dim);
    slot.motion.angle = frame.angle;
    slot.motion.V.setZero(n);
    slot.motion.bias.setZero(n);
    slot.motion.J.resize(n, 0);
  }
  return known;
}

MarkerChain::Slot& MarkerChain::add_slot(MarkerRef marker) {
  Slot& slot = slots_.emplace_back();
  slot.marker = marker;
  if (marker.body < 0) return slot;
  const BodyEntry& entry = model_.bodies[std::size_t(marker.body)];
  slot.q0 = entry.q0, slot.v0 = entry.v0;
  slot.linear = dynamic_cast<const LinearMarkers*>(entry.body.get()) != nullptr;
  return slot;
}

int MarkerChain::surface_slot(int body) {
  add_slot({.body = body}).surface = true;
  return int(slots_.size()) - 1;
}

Motion& MarkerChain::surface_motion(int index) {
  Slot& slot = slots_[std::size_t(index)];
  slot.point = point_;
  return slot.motion;
}

const Motion& MarkerChain::nearest(int index, const Vec3& to, double t, const Vec& q, const Vec& v) {
  Slot& slot = slots_[std::size_t(index)];
  if (slot.point == point_) return slot.motion;
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  const auto q_body = q.segment(entry.q0, entry.nq);
  Eigen::Vector2d parameters;
  Vec3 x, normal;
  entry.surface->nearest(t, q_body, to, parameters, x, normal);
  entry.surface->motion_at(parameters, t, q_body, v.segment(entry.v0, entry.nv), slot.motion);
  if (still_) slot.motion.V.setZero(), slot.motion.bias.setZero();
  slot.point = point_;
  return slot.motion;
}

void MarkerChain::evaluate(Slot& slot, double t, const Vec& q, const Vec& v) {
  if (slot.linear) return evaluate_linear(slot, q, v);
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  entry.body->motion(slot.marker.marker, t, q.segment(entry.q0, entry.nq), v.segment(entry.v0, entry.nv), slot.motion);
}

// x = x_0 + J q,  V = J v
void MarkerChain::evaluate_linear(Slot& slot, const Vec& q, const Vec& v) {
  if (slot.begin < 0) keep_linear(slot);
  double *const x = slot.motion.x.data(), *const V = slot.motion.V.data();
  for (Eigen::Index i = 0; i < slot.x_0.size(); ++i) x[i] = slot.x_0.data()[i], V[i] = 0;
  for (int k = slot.begin; k < slot.end; ++k) {
    const Entry& J = entries_[std::size_t(k)];
    x[J.row] += J.value * q.data()[slot.q0 + J.dof];
    V[J.row] += J.value * v.data()[slot.v0 + J.dof];
  }
}

void MarkerChain::keep_linear(Slot& slot) {
  Motion& m = slot.motion;
  m = motion_at_zero(slot);
  slot.x_0 = m.x;
  slot.begin = int(entries_.size());
  for (Eigen::Index i = 0; i < m.x.size(); ++i)  // axes do not turn
    for (Eigen::Index j = 0; j < m.J.cols(); ++j)
      if (m.J(i, j) != 0) entries_.push_back({int(i), m.dofs[std::size_t(j)], m.J(i, j)});
  slot.end = int(entries_.size());
}

const Motion& MarkerChain::motion(int index, double t, const Vec& q, const Vec& v) {
  Slot& slot = slots_[std::size_t(index)];
  if (slot.point != point_) {
    // Which rows are added to after this: waiting for them there took 10,000 links 1.5 ms of 12.
    numerics::fetch(slot.motion.dofs.data(), slot.motion.dofs.size() * sizeof(int));
    if (slot.marker.body >= 0) evaluate(slot, t, q, v);
    if (still_) slot.motion.V.setZero(), slot.motion.bias.setZero();
    slot.point = point_;
  }
  return slot.motion;
}

Motion MarkerChain::motion_at_zero(const Slot& slot) const {
  if (slot.marker.body < 0) return slot.motion;
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  Motion motion;
  entry.body->motion(slot.marker.marker, 0, Vec::Zero(entry.nq), Vec::Zero(entry.nv), motion);
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
  const Jac& J = slot.motion.J;
  const Eigen::Index columns = J.cols();
  with_twist(J.rows(), [&](auto twist) {
    double w[twist];
    for (int k = 0; k < twist; ++k) w[k] = c * wrench.data()[k];
    for (Eigen::Index j = 0; j < columns; ++j) {
      double sum = 0;
      for (int k = 0; k < twist; ++k) sum += J.data()[k * columns + j] * w[k];
      f(v0 + slot.motion.dofs[std::size_t(j)]) += sum;
    }
  });
}

void MarkerChain::add_rows(int index, int row, const RowsOf& H, Mat& G) const {
  const Slot& slot = slots_[std::size_t(index)];
  if (slot.marker.body < 0) return;
  const int v0 = slot.v0;
  for_each_column(H, slot.motion.J, [&](Eigen::Index j, const double* entries, auto n) {
    double* const column = G.data() + (v0 + slot.motion.dofs[std::size_t(j)]) * G.rows() + row;
    for (int i = 0; i < n; ++i) column[i] += entries[i];
  });
}

void MarkerChain::add_pair(int index, int other, const Mat6& D, double c, Matrix& S) const {
  const Slot& a = slots_[std::size_t(index)];
  const Slot& b = slots_[std::size_t(other)];
  if (a.marker.body < 0 || b.marker.body < 0) return;
  Matrix block = S.from(a.v0, b.v0);
  for (std::size_t j = 0; j < b.motion.dofs.size(); ++j) {
    const Vec6 column = D * b.motion.J.col(Eigen::Index(j));
    for (std::size_t i = 0; i < a.motion.dofs.size(); ++i)
      block.add(a.motion.dofs[i], b.motion.dofs[j], c * a.motion.J.col(Eigen::Index(i)).dot(column));
  }
}

void MarkerChain::add_reaction_derivative(int index, double t, const Vec& q, const Wrench& F, double c, Matrix& S) {
  Slot& slot = slots_[std::size_t(index)];
  if (slot.marker.body < 0) return;
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  if (!entry.reaction_derivative) return add_numeric_reaction_derivative(slot, t, q, F, c, S);
  Matrix target = S.from(entry.v0, entry.v0);
  entry.reaction_derivative->add_reaction_derivative(slot.marker.marker, t, q.segment(entry.q0, entry.nq), F, c,
                                                     target);
}

void MarkerChain::add_numeric_reaction_derivative(Slot& slot, double t, const Vec& q, const Wrench& F, double c,
                                                  Matrix& S) {
  const BodyEntry& entry = model_.bodies[std::size_t(slot.marker.body)];
  v_zero_.setZero(entry.nv);
  const auto generalised_force = [&](const Vec& q_body, Vec& out) {
    probe_.dofs = slot.motion.dofs;
    entry.body->motion(slot.marker.marker, t, q_body, v_zero_, probe_);
    out.setZero(entry.nv);
    for (std::size_t j = 0; j < probe_.dofs.size(); ++j) out(probe_.dofs[j]) = probe_.J.col(Eigen::Index(j)).dot(F);
  };
  tangent_differences(entry, q.segment(entry.q0, entry.nq), generalised_force, block_);
  S.add(entry.v0, entry.v0, block_, c);
}

}  // namespace trammel::model
