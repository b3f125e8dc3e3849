// A massless rod between two markers, planar or spatial; its length may be a law of time (an ideal actuator).
//
//     g = (d . d / L - L) / 2 = 0   (1 row),   d = x_B - x_A        ~ |d| - L near the constraint, and smooth at d = 0
//
//     g'  = d . d' / L + g_t,       g_t = -(|d|^2 / L^2 + 1) L' / 2
//     g'' = d . d'' / L - gamma,    gamma = -|d'|^2 / L + 2 d . d' L' / L^2 + (|d|^2 / L^2 + 1) L'' / 2
//                                 - |d|^2 L'^2 / L^3
//
// lambda [N] > 0: the rod is in tension. Source: Garcia de Jalon, Bayo 1994, rigid-body conditions in natural
// coordinates, here divided by 2 L so that g is a length and lambda a force.
#include <string>

#include <trammel/joint.hpp>
#include <trammel/outside_domain.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Distance : Joint, ReactionTangent {
  TimeFunction length;

  void prepare(const World&) override {
    if (length.is_constant() && !(length(0) > 0))
      throw ParameterError("length", "found " + std::to_string(length(0)) + " m; expected a length greater than 0");
  }
  int row_count(Space) const override { return 1; }

  void rows(double t, const Motion& A, const Motion& B, Rows& rows) const override {
    const auto [L, L_dot, L_ddot] = length.jet(t);
    if (L <= 0) throw OutsideDomain("its length is " + std::to_string(L) + " m; it must stay greater than 0");

    const auto dim = A.x.size();
    const Vec3 d = B.x - A.x;
    const Vec3 d_dot = B.V.head(dim) - A.V.head(dim);
    const double stretch = d.squaredNorm() / (L * L);  // 1 on the constraint

    rows.g(0) = L * (stretch - 1) / 2;
    rows.H_A.row(0).head(dim) = -d.transpose() / L;
    rows.H_B.row(0).head(dim) = d.transpose() / L;
    rows.g_t(0) = -(stretch + 1) * L_dot / 2;
    rows.gamma(0) = -d_dot.squaredNorm() / L + 2 * d.dot(d_dot) * L_dot / (L * L) + (stretch + 1) * L_ddot / 2 -
                    stretch * L_dot * L_dot / L;
  }

  // The wrenches are -+ lambda d / L.
  void add_reaction_tangent(double t, const Motion& A, const Motion&, const Vec6& lambda,
                            PairTangent& K) const override {
    const double k = lambda(0) / length(t);
    for (Eigen::Index i = 0; i < A.x.size(); ++i) {
      K.AA(i, i) += k, K.BB(i, i) += k;
      K.AB(i, i) -= k, K.BA(i, i) -= k;
    }
  }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::joint<Distance>("distance", "massless rod: two markers keep their distance")
        .source("J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994")
        .parameter("length", &Distance::length,
                   {.unit = "m", .required = true, .doc = "distance > 0; a number or a law of t", .derivatives = 2}))
