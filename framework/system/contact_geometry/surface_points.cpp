#include "system/contact_geometry/surface_points.hpp"

namespace trammel::model {

SurfacePoints::SurfacePoints(const BodyEntry& body, const ForceBySurfacePoints& law, double sphere_radius)
    : body_(body), spacing_(law.spacing(sphere_radius)), patches_(std::size_t(body.samples->patches())) {}

const SurfacePatch& SurfacePoints::patch(std::size_t i) {
  if (!patches_[i]) body_.samples->sample(int(i), spacing_, patches_[i].emplace());
  return *patches_[i];
}

void SurfacePoints::bounds(std::size_t i, const Vec& q, V3& low, V3& high) const {
  Vec3 least, most;
  body_.samples->bounds(int(i), q.segment(body_.q0, body_.nq), least, most);
  low = least, high = most;
}

Mat SurfacePoints::of_nodes(const SurfacePatch& p, const Vec& of_body) const {
  Vec local(Eigen::Index(p.dofs.size()));
  for (std::size_t k = 0; k < p.dofs.size(); ++k) local(Eigen::Index(k)) = of_body(p.dofs[k]);
  if (p.B.size() > 0) local = p.B * local;
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(local.data(), p.R.cols(), 3);
}

// Three columns are too few for Eigen's blocked product.
SurfacePoints::Points SurfacePoints::positions(const SurfacePatch& p, const Vec& q) const {
  const Mat u = of_nodes(p, q.segment(body_.q0, body_.nq));
  return p.X + p.R.lazyProduct(u);
}

SurfacePoints::Points SurfacePoints::velocities(const SurfacePatch& p, const Vec& v) const {
  const Mat rate = of_nodes(p, v.segment(body_.v0, body_.nv));
  return p.R.lazyProduct(rate);
}

void SurfacePoints::motion(const SurfacePatch& p, Eigen::Index point, const Vec& q, const Vec& v, Motion& m) const {
  const auto R = p.R.row(point);
  m.x = p.X.row(point).transpose() + (R * of_nodes(p, q.segment(body_.q0, body_.nq))).transpose();
  m.R = Eigen::Matrix3d::Identity();
  m.angle = 0;
  m.V.setZero(6), m.bias.setZero(6);
  m.V.head(3) = (R * of_nodes(p, v.segment(body_.v0, body_.nv))).transpose();
  m.dofs = p.dofs;
  m.J.setZero(6, Eigen::Index(p.dofs.size()));
  for (Eigen::Index I = 0; I < R.size(); ++I)
    for (int axis = 0; axis < 3; ++axis)
      if (p.B.size() > 0)
        m.J.row(axis) += R(I) * p.B.row(3 * I + axis);
      else
        m.J(axis, 3 * I + axis) = R(I);
}

void SurfacePoints::add_force(const SurfacePatch& p, const OnNodes& forces, Vec& f) const {
  Vec local = Eigen::Map<const Vec>(forces.data(), forces.size());
  if (p.B.size() > 0) local = p.B.transpose() * local;
  for (std::size_t j = 0; j < p.dofs.size(); ++j) f(body_.v0 + p.dofs[j]) += local(Eigen::Index(j));
}

void SurfacePoints::add_square(const SurfacePatch& p, const Mat& nodes, Matrix& S) const {
  S.from(body_.v0, body_.v0).add(p.dofs, p.B.size() > 0 ? Mat(p.B.transpose() * nodes * p.B) : nodes);
}

void SurfacePoints::add_rows(const SurfacePatch& p, const Mat& nodes, int first, const std::vector<int>& dofs,
                             Matrix& S) const {
  S.from(body_.v0, first).add(p.dofs, dofs, p.B.size() > 0 ? Mat(p.B.transpose() * nodes) : nodes);
}

void SurfacePoints::add_columns(const SurfacePatch& p, const Mat& nodes, int first, const std::vector<int>& dofs,
                                Matrix& S) const {
  S.from(first, body_.v0).add(dofs, p.dofs, p.B.size() > 0 ? Mat(nodes * p.B) : nodes);
}

}  // namespace trammel::model
