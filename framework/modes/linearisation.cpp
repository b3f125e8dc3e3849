#include "modes/linearisation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "system/on_rows/tangent_space.hpp"

namespace trammel::simulate {
namespace {

constexpr double noise_of_sums = 1e-12;  // of a stiffness without differences: round-off of the sums it is made of

class AtState {
 public:
  AtState(model::AssembledSystem& system, const State& s) : system_(system), s_(s), n_(system.sizes()) {
    system_.move_to(s.t, s.q, s.v);
  }

  Linearisation operator()() {
    Linearisation l;
    l.noise = noise_of_stiffness(system_.model());
    const TangentSpace space = tangent_space(system_);
    sizes_ = space.sizes;
    l.Z = space.Z;
    l.redundant = space.redundant;
    left_ = space.left;

    const Mat M = tangent(system_, {1, 0, 0}, s_), D = tangent(system_, {0, 1, 0}, s_),
              K = tangent(system_, {0, 0, 1}, s_);
    l.M = left_.transpose() * M * l.Z;
    l.D = left_.transpose() * D * l.Z;
    l.K = left_.transpose() * K * l.Z;
    if (!s_.v.isZero(0)) add_motion(l, M, D, space.sliding);
    system_.move_to(s_.t, s_.q, s_.v);
    return l;
  }

 private:
  void add_motion(Linearisation& l, const Mat& M, const Mat& D, bool sliding) {
    const model::Model& model = system_.model();
    Mat turned = Mat::Zero(n_.nv, l.Z.cols());
    const bool turning = add_turning(model, s_.v, l.Z, turned);
    const Mat Z_dot = carried(l.Z, turned);
    const bool carried_along = largest_in_sizes(Z_dot) > noise_of_differences * sizes_.largest(s_.v);
    if (!carried_along && !turning) return;
    if (carried_along && sliding)
      throw model::NotSolvable("a contact slides while joints move: the modes of such a state are not defined here");

    const Mat Y = Z_dot + turned;
    Mat MY_dot = Mat::Zero(n_.nv, l.Z.cols());
    add_turning(model, s_.a, l.Z, MY_dot);
    add_turning(model, s_.v, Z_dot, MY_dot);
    MY_dot = M * MY_dot;
    l.D += left_.transpose() * (M * (Z_dot + Y));
    l.K += left_.transpose() * (MY_dot + D * Y);
    if (carried_along) l.K -= Z_dot.transpose() * M * Z_dot + l.Z.transpose() * mass_rate_times(Z_dot);
  }

  double largest_in_sizes(const Mat& columns) const {
    double largest = 0;
    for (Eigen::Index j = 0; j < columns.cols(); ++j) largest = std::max(largest, sizes_.largest(columns.col(j)));
    return largest;
  }

  // Z' from the rows' rates at neighbouring states.
  Mat carried(const Mat& Z, const Mat& turned) {
    Mat Z_dot = Mat::Zero(n_.nv, Z.cols());
    if (n_.nc == 0) return Z_dot;
    Vec q, da, mu;
    const Vec zero = Vec::Zero(n_.nv), no_force = Vec::Zero(n_.nc);
    Mat rates(n_.nc, Z.cols());
    for (Eigen::Index j = 0; j < Z.cols(); ++j) {
      Vec ahead;
      const double step = sizes_.difference_step(Z.col(j));
      for (const double side : {1.0, -1.0}) {
        system_.retract(s_.q, side * step * Z.col(j), q);
        system_.move_to(s_.t, q, s_.v);
        if (side > 0)
          ahead = system_.g_dot();
        else
          rates.col(j) = (ahead - system_.g_dot()) / (2 * step);
      }
    }
    system_.move_to(s_.t, s_.q, s_.v);
    system_.factorise({1, 0, 0}, zero, no_force, Factors::projection);
    for (Eigen::Index j = 0; j < Z.cols(); ++j) {
      Vec missing = rates.col(j);
      system_.add_rows_times(1, turned.col(j), missing);
      if (!system_.correct(zero, missing, da, mu, Factors::projection))
        throw model::NotSolvable("the constraints have no independent rows here");
      Z_dot.col(j) = da;
    }
    return Z_dot;
  }

  // dM/dt along the motion, times the columns.
  Mat mass_rate_times(const Mat& columns) {
    Mat product = Mat::Zero(n_.nv, columns.cols());
    const double tau = sizes_.difference_step(s_.v);
    Vec q, r;
    for (const double side : {1.0, -1.0}) {
      system_.retract(s_.q, side * tau * s_.v, q);
      system_.move_to(s_.t + side * tau, q, s_.v);
      for (Eigen::Index j = 0; j < columns.cols(); ++j) {
        r.setZero(n_.nv);
        system_.add_mass_times(side / (2 * tau), columns.col(j), r);
        product.col(j) += r;
      }
    }
    return product;
  }

  model::AssembledSystem& system_;
  const State& s_;
  Sizes n_;
  model::CoordinateSizes sizes_;
  Mat left_;
};

}  // namespace

Linearisation linearise(model::AssembledSystem& system, const State& state) {
  return AtState(system, state)();
}

double noise_of_stiffness(const model::Model& model) {
  const auto exact = [](const auto& entry) { return entry.tangent != nullptr; };
  const bool all = model.forces.empty() && std::all_of(model.bodies.begin(), model.bodies.end(), exact) &&
                   std::all_of(model.joints.begin(), model.joints.end(), exact);
  return all ? noise_of_sums : noise_of_differences;
}

Mat tangent(model::AssembledSystem& system, Blend blend, const State& state) {
  const int nv = system.sizes().nv;
  Mat S = Mat::Zero(nv, nv);
  system.add_tangent(blend, state.a, state.lambda, S);
  return S;
}

bool add_turning(const model::Model& model, const Vec& rates, const Mat& x, Mat& turned) {
  bool any = false;
  for (const model::BodyEntry& body : model.bodies) {
    int at = body.v0;
    for (const Coordinates::Part& part : body.parts) {
      if (part.kind == Coordinates::Kind::rotation && !rates.segment(at, 3).isZero(0)) {
        const Eigen::Vector3d omega = rates.segment<3>(at);
        for (Eigen::Index j = 0; j < x.cols(); ++j)
          turned.block<3, 1>(at, j) += omega.cross(Eigen::Vector3d(x.block<3, 1>(at, j)));
        any = true;
      }
      at += part.nv;
    }
  }
  return any;
}

}  // namespace trammel::simulate
