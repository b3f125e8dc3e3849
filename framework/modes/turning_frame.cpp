#include "modes/turning_frame.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <trammel/decompositions.hpp>

namespace trammel::simulate {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int most_coordinates = 200;  // of a body: the cost grows with their cube
constexpr double same_rate = 1e-9;     // of a rate: the bodies turn together but for round-off

Quaterniond orientation(const double* q) {
  return Quaterniond(q[0], q[1], q[2], q[3]);
}

Matrix3d turn_by(const Vector3d& angle) {
  const double size = angle.norm();
  if (size == 0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(size, angle / size).toRotationMatrix();
}

// use(body's index, kind, index in q, index in v, nv), part by part.
template <class Use>
void for_each_part(const model::Model& model, Use&& use) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    int q0 = model.bodies[b].q0, v0 = model.bodies[b].v0;
    for (const Coordinates::Part& part : model.bodies[b].parts) {
      use(b, part.kind == Coordinates::Kind::rotation, q0, v0, part.nv);
      q0 += part.nq, v0 += part.nv;
    }
  }
}

// Angular momentum about the origin of unit velocities, a row each.
Mat angular_momenta(const model::BodyEntry& body, int rotations, double t, const Vec& q) {
  Mat p(body.nv, rotations);
  for (int j = 0; j < body.nv; ++j) p.row(j) = body.momentum->momentum(t, q, Vec::Unit(body.nv, j)).angular;
  return p;
}

// The velocities of a body that rotates with the world, M^-1 p, as linear functions of the places.
std::array<Mat, 3> turning_of(const model::BodyEntry& body, Space space, double t, const Vec& q) {
  Mat M = Mat::Zero(body.nv, body.nv);
  Matrix into = Matrix::onto(M);
  body.body->mass(t, q, into);
  const Eigen::LLT<Mat> mass(M);
  const int axes = rotations(space), flat = body.parts.front().nv;
  const Mat here = angular_momenta(body, axes, t, q);
  std::array<Mat, 3> turning;
  for (int k = 3 - axes; k < 3; ++k) turning[std::size_t(k)].setZero(flat, flat);
  for (int j = 0; j < flat; ++j) {
    const Mat there = angular_momenta(body, axes, t, q + Vec::Unit(q.size(), j)) - here, change = mass.solve(there);
    for (int k = 0; k < axes; ++k) turning[std::size_t(k + 3 - axes)].col(j) = change.col(k).head(flat);
  }
  return turning;
}

// exp(tau L) x with L^3 = -w^2 L.
Mat turned_by(const Mat& L, double w, double tau, const Mat& x) {
  if (L.size() == 0 || w == 0) return x;
  const Mat Lx = L * x;
  return x + std::sin(w * tau) / w * Lx + (1 - std::cos(w * tau)) / (w * w) * (L * Lx);
}

// Its integral from 0 to tau, times v.
Vec gone_by(const Mat& L, double w, double tau, const Vec& v) {
  if (L.size() == 0 || w == 0) return tau * v;
  const Vec Lv = L * v;
  return tau * v + (1 - std::cos(w * tau)) / (w * w) * Lv + (w * tau - std::sin(w * tau)) / (w * w * w) * (L * Lv);
}

Mat crossed(const Vector3d& a, const Mat& x) {
  Mat out(3, x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j) out.col(j) = a.cross(Vector3d(x.col(j)));
  return out;
}

}  // namespace

FlatTurning flat_turning(model::AssembledSystem& system, double t, const Vec& q) {
  const model::Model& model = system.model();
  FlatTurning all(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const model::BodyEntry& body = model.bodies[b];
    if (!body.momentum || body.nv == 0 || body.nv > most_coordinates) continue;
    if (body.parts.front().kind != Coordinates::Kind::flat) continue;
    all[b] = turning_of(body, model.world.space, t, q.segment(body.q0, body.nq));
  }
  return all;
}

TurningFrame::TurningFrame(const model::Model& model, const FlatTurning& flat, const State& at, const Vector3d& rate)
    : at_(at), speed_(rate.norm()), rate_(rate) {
  for_each_part(model, [&](std::size_t b, bool rotation, int q0, int v0, int nv) {
    Part part{rotation, q0, v0, nv, {}, {}, {}};
    if (rotation) {
      part.rate = orientation(at.q.data() + q0).inverse() * rate;
      part.relative = Vector3d(at.v.segment<3>(v0)) - part.rate;
    } else if (flat[b][2].rows() == nv && v0 == model.bodies[b].v0) {
      part.by_rate = Mat::Zero(nv, nv);
      for (std::size_t k = 0; k < 3; ++k)
        if (flat[b][k].size() > 0) part.by_rate += rate(Eigen::Index(k)) * flat[b][k];
    }
    parts_.push_back(std::move(part));
  });
}

Mat TurningFrame::carried(const Mat& x) const {
  Mat out = Mat::Zero(x.rows(), x.cols());
  for (const Part& part : parts_) {
    if (part.rotation)
      out.middleRows(part.v0, 3) = crossed(-part.relative, x.middleRows(part.v0, 3));
    else if (part.by_rate.size() > 0)
      out.middleRows(part.v0, part.nv) = part.by_rate * x.middleRows(part.v0, part.nv);
  }
  return out;
}

Mat TurningFrame::turned(const Mat& x) const {
  Mat out = Mat::Zero(x.rows(), x.cols());
  for (const Part& part : parts_) {
    if (part.rotation)
      out.middleRows(part.v0, 3) = crossed(part.rate, x.middleRows(part.v0, 3));
    else if (part.by_rate.size() > 0)
      out.middleRows(part.v0, part.nv) = part.by_rate * x.middleRows(part.v0, part.nv);
  }
  return out;
}

Mat TurningFrame::after(double tau, const Mat& x) const {
  Mat out = x;
  for (const Part& part : parts_) {
    if (part.rotation)
      out.middleRows(part.v0, 3) = turn_by(-tau * part.relative) * x.middleRows(part.v0, 3);
    else
      out.middleRows(part.v0, part.nv) = turned_by(part.by_rate, speed_, tau, x.middleRows(part.v0, part.nv));
  }
  return out;
}

State TurningFrame::after(double tau) const {
  State later = at_;
  later.t += tau;
  for (const Part& part : parts_) {
    const Vec v = at_.v.segment(part.v0, part.nv);
    if (!part.rotation) {
      later.q.segment(part.q0, part.nv) += gone_by(part.by_rate, speed_, tau, v);
      later.v.segment(part.v0, part.nv) = turned_by(part.by_rate, speed_, tau, v);
      continue;
    }
    const Quaterniond turned = Quaterniond(turn_by(tau * rate_)) * orientation(at_.q.data() + part.q0) *
                               Quaterniond(turn_by(tau * part.relative));
    later.q.segment<4>(part.q0) << turned.w(), turned.vec();
    later.v.segment<3>(part.v0) = turn_by(-tau * part.relative) * part.rate + part.relative;
  }
  return later;
}

std::vector<Vector3d> body_rates(const model::Model& model, const State& at) {
  std::vector<Vector3d> all;
  const auto add = [&](const Vector3d& rate) {
    const auto same = [&](const Vector3d& other) { return (other - rate).norm() <= same_rate * rate.norm(); };
    if (!rate.isZero(0) && std::none_of(all.begin(), all.end(), same)) all.push_back(rate);
  };
  const bool planar = model.world.space == Space::planar;
  for_each_part(model, [&](std::size_t b, bool rotation, int q0, int v0, int nv) {
    if (rotation) add(orientation(at.q.data() + q0) * Vector3d(at.v.segment<3>(v0)));
    // In the plane a rotation is a flat coordinate: the one with angular momentum about the body's own centre, the
    // third coordinate of a rigid body.
    if (planar && model.bodies[b].momentum && nv == 3) add({0, 0, at.v(v0 + 2)});
  });
  return all;
}

}  // namespace trammel::simulate
