#include "model/surface_contact.hpp"

namespace trammel::model {

namespace {

using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix3d;

M3 cross(const V3& a) {  // cross(a) b = a x b
  return M3{{0, -a.z(), a.y()}, {a.z(), 0, -a.x()}, {-a.y(), a.x(), 0}};
}

}  // namespace

SurfaceContact::SurfaceContact(const Model& model, const ContactEntry& entry)
    : entry_(entry),
      body_(model.bodies[std::size_t(entry.surface->body)]),
      reach_(entry.geometry.radius + body_.surface->half_thickness()),
      patches_(std::size_t(body_.samples->patches())) {}

const SurfacePatch& SurfaceContact::patch(std::size_t i) {
  if (!patches_[i])
    body_.samples->sample(int(i), entry_.surface->by_points->spacing(entry_.geometry.radius), patches_[i].emplace());
  return *patches_[i];
}

Mat SurfaceContact::of_nodes(const SurfacePatch& p, const Vec& of_body) const {
  Vec local(Eigen::Index(p.dofs.size()));
  for (std::size_t k = 0; k < p.dofs.size(); ++k) local(Eigen::Index(k)) = of_body(p.dofs[k]);
  if (p.B.size() > 0) local = p.B * local;
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(local.data(), p.R.cols(), 3);
}

void SurfaceContact::evaluate(const Motion& sphere, const Vec& q, const Vec& v, double approach_speed) {
  touches_.clear();
  approach_ = approach_speed;
  normal_ = damping_ = friction_ = 0;
  on_sphere_.setZero(6);
  omega_ = sphere.V.tail<3>();
  const Vec q_body = q.segment(body_.q0, body_.nq), v_body = v.segment(body_.v0, body_.nv);
  const V3 centre = sphere.x, velocity = sphere.V.head<3>();
  Vec3 low, high;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    body_.samples->bounds(int(i), q_body, low, high);
    const V3 outside = (V3(low) - centre).cwiseMax(centre - V3(high)).cwiseMax(0.0);
    if (outside.squaredNorm() >= reach_ * reach_) continue;
    const SurfacePatch& p = patch(i);
    const Mat x = p.X + p.R * of_nodes(p, q_body);
    Mat v_nodes;
    for (Eigen::Index k = 0; k < x.rows(); ++k) {
      const V3 d = centre - x.row(k).transpose();
      if (d.squaredNorm() >= reach_ * reach_) continue;
      if (v_nodes.size() == 0) v_nodes = of_nodes(p, v_body);
      touch(i, k, d, velocity - (p.R.row(k) * v_nodes).transpose());
    }
  }
}

void SurfaceContact::touch(std::size_t i, Eigen::Index point, const V3& d, const V3& u) {
  Touch at;
  at.patch = i, at.point = point;
  at.length = d.norm();
  at.n = d / at.length, at.u = u;
  at.gap = at.length - reach_, at.rate = at.n.dot(u);
  at.weight = entry_.surface->by_points->weight(patches_[i]->area(point));
  at.N = entry_.force->normal(at.gap, at.rate, approach_);
  const double R = entry_.geometry.radius;
  at.slip = u - at.rate * at.n - R * omega_.cross(at.n);
  at.F = at.N * at.n;
  if (const SmoothFriction* friction = entry_.surface->friction) {
    const double slip = at.slip.norm();
    if (slip > 0) at.F -= friction->ratio(slip) * at.N / slip * at.slip;
    friction_ += at.weight * friction->ratio(slip) * at.N * slip;
  }
  at.F *= at.weight;
  normal_ += at.weight * at.N;
  damping_ -= at.weight * (at.N - entry_.force->normal(at.gap, 0, approach_)) * at.rate;
  on_sphere_.head<3>() += at.F;
  on_sphere_.tail<3>() -= R * at.n.cross(at.F);
  touches_.push_back(at);
}

void SurfaceContact::add_force(Vec& f) const {
  for (std::size_t k = 0; k < touches_.size();) {
    const std::size_t i = touches_[k].patch;
    const SurfacePatch& p = *patches_[i];
    Eigen::Matrix<double, 3, Eigen::Dynamic> nodes = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, p.R.cols());
    for (; k < touches_.size() && touches_[k].patch == i; ++k)
      nodes.noalias() -= touches_[k].F * p.R.row(touches_[k].point);
    Vec local = Eigen::Map<const Vec>(nodes.data(), nodes.size());
    if (p.B.size() > 0) local = p.B.transpose() * local;
    for (std::size_t j = 0; j < p.dofs.size(); ++j) f(body_.v0 + p.dofs[j]) += local(Eigen::Index(j));
  }
}

double SurfaceContact::potential() const {
  double sum = 0;
  for (const Touch& at : touches_) sum += at.weight * entry_.force->potential(at.gap);
  return sum;
}

SurfaceContact::Derivatives SurfaceContact::derivatives(const Touch& at) const {
  const auto [by_gap, by_rate] = entry_.force->slope(at.gap, at.rate, approach_);
  const V3& n = at.n;
  const double w = at.weight, R = entry_.geometry.radius;
  const M3 P = M3::Identity() - n * n.transpose(), Pd = P / at.length;
  const V3 N_d = by_gap * n + by_rate * (Pd * at.u), N_u = by_rate * n;
  M3 F_d = w * (n * N_d.transpose() + at.N * Pd), F_u = w * n * N_u.transpose(), F_omega = M3::Zero();
  if (const SmoothFriction* friction = entry_.surface->friction) {
    const double slip = at.slip.norm(), ratio = friction->ratio(slip), slope = friction->slope(slip);
    const V3 e = slip > 0 ? V3(at.slip / slip) : V3(V3::Zero());
    const double secant = slip > 0 ? ratio / slip : slope;
    const M3 A = -w * at.N * (secant * (M3::Identity() - e * e.transpose()) + slope * e * e.transpose());
    const M3 s_d = -(at.rate * M3::Identity() + n * at.u.transpose() + R * cross(omega_)) * Pd;
    F_d += A * s_d - w * ratio * e * N_d.transpose();
    F_u += A * P - w * ratio * e * N_u.transpose();
    F_omega = R * A * cross(n);
  }
  Derivatives all;
  const M3 arm = -R * cross(n);
  all.by_d << F_d, arm * F_d + R * cross(at.F) * Pd;
  all.by_u << F_u, arm * F_u;
  all.by_omega << F_omega, arm * F_omega;
  return all;
}

// With z = (position and turn of the sphere's marker): d(d) = dx_A - R_p du, so blocks with one and the same matrix.
void SurfaceContact::add_tangent(MarkerChain& chain, int slot, double c_k, double c_d, Mat& S) const {
  Mat6 on_itself = Mat6::Zero(6, 6);
  const Motion& sphere = chain.last_motion(slot);
  const int sphere_body = chain.body(slot);
  for (std::size_t k = 0; k < touches_.size();) {
    const std::size_t i = touches_[k].patch;
    const SurfacePatch& p = *patches_[i];
    const Eigen::Index nodes = p.R.cols();
    Mat points_K = Mat::Zero(3 * nodes, 3 * nodes), sphere_by_nodes = Mat::Zero(6, 3 * nodes),
        nodes_by_sphere = Mat::Zero(3 * nodes, 6);
    for (; k < touches_.size() && touches_[k].patch == i; ++k) {
      const Derivatives D = derivatives(touches_[k]);
      const M63 K = -c_k * D.by_d - c_d * D.by_u, K_omega = -c_d * D.by_omega;
      const auto R = p.R.row(touches_[k].point);
      on_itself.leftCols(3) += K, on_itself.rightCols(3) += K_omega;
      for (Eigen::Index J = 0; J < nodes; ++J) {
        sphere_by_nodes.middleCols<3>(3 * J) -= R(J) * K;
        nodes_by_sphere.middleRows<3>(3 * J).leftCols<3>() -= R(J) * K.topRows<3>();
        nodes_by_sphere.middleRows<3>(3 * J).rightCols<3>() -= R(J) * K_omega.topRows<3>();
        for (Eigen::Index I = 0; I < nodes; ++I) points_K.block<3, 3>(3 * I, 3 * J) += R(I) * R(J) * K.topRows<3>();
      }
    }
    if (p.B.size() > 0) {
      points_K = p.B.transpose() * points_K * p.B;
      sphere_by_nodes = sphere_by_nodes * p.B;
      nodes_by_sphere = p.B.transpose() * nodes_by_sphere;
    }
    const Matrix whole = Matrix::onto(S);
    whole.from(body_.v0, body_.v0).add(p.dofs, points_K);
    if (sphere_body < 0) continue;
    const int v0 = chain.first_velocity(slot);
    whole.from(v0, body_.v0).add(sphere.dofs, p.dofs, sphere.J.transpose() * sphere_by_nodes);
    whole.from(body_.v0, v0).add(p.dofs, sphere.dofs, nodes_by_sphere * sphere.J);
  }
  chain.add_pair(slot, slot, on_itself, 1, S);
}

}  // namespace trammel::model
