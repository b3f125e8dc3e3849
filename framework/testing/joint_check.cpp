// What a joint owes the assembly, along known motions of its two markers, in general away from g = 0:
//
//     dg/dt = H_A V_A + H_B V_B + g_t,    d(that)/dt = H_A A_A + H_B A_B - gamma
//     H_A, H_B: gradients of g by the twists of the markers at fixed time, g_t: derivative by time at fixed markers
//     reactions -H_A^T lambda and -H_B^T lambda balance: in force everywhere, in moment where g = 0
//
// Rows that repeat each other are no fault.
#include <fmt/format.h>

#include <Eigen/QR>

#include <stdexcept>

#include <trammel/testing_components.hpp>
#include <trammel/testing_markers.hpp>

#include "testing/difference.hpp"

namespace trammel {
namespace {

constexpr double times[] = {0.1, 0.7, 1.9};  // [s]
constexpr double step = 0.05;                // [s, m, rad] largest of the differences: motions change over 0.5

struct Tried {
  std::unique_ptr<Joint> joint;
  Space space;
  MovingPair pair;

  Tried(const MakerOf<Joint>& make, Space s) : joint(make()), space(s), pair(moving_pair(s)) {}

  Rows rows(double t, const Motion& A, const Motion& B) const {
    const int n = joint->row_count(space), twist = twist_size(space);
    if (n < 1 || n > 6) throw std::length_error(fmt::format("{} rows, expected 1 to 6", n));
    Rows r;
    r.resize(n, space);
    joint->rows(t, A, B, r);
    const bool kept = r.g.size() == n && r.g_t.size() == n && r.gamma.size() == n && r.H_A.rows() == n &&
                      r.H_A.cols() == twist && r.H_B.rows() == n && r.H_B.cols() == twist;
    if (!kept) throw std::length_error("an array of the rows was resized");
    return r;
  }
  Rows along(double t) const { return rows(t, pair.a.at(t), pair.b.at(t)); }
  Vec g_dot(double t) const {
    const Rows r = along(t);
    return r.H_A * pair.a.at(t).V + r.H_B * pair.b.at(t).V + r.g_t;
  }
};

Report rows_have_their_sizes(const Tried& j) {
  return compare("rows keep the sizes they come in with",
                 [&](Comparison& c) { c.holds(j.along(times[0]).g.allFinite(), "a number that is not finite"); });
}

Report jacobian_is_the_gradient(const Tried& j) {
  return compare("H_A and H_B are the gradients of g", [&](Comparison& c) {
    for (const double t : times) {
      const Motion A = j.pair.a.at(t), B = j.pair.b.at(t);
      const Rows r = j.rows(t, A, B);
      for (int i = 0; i < twist_size(j.space); ++i) {
        const Vec6 e = Vec6::Unit(twist_size(j.space), i);
        const auto by_A = [&](double s) { return Vec(j.rows(t, displaced(A, s * e), B).g); };
        const auto by_B = [&](double s) { return Vec(j.rows(t, A, displaced(B, s * e)).g); };
        c.derivative(r.H_A.col(i), difference(by_A, step), fmt::format("column {} of H_A at t = {}", i, t));
        c.derivative(r.H_B.col(i), difference(by_B, step), fmt::format("column {} of H_B at t = {}", i, t));
      }
    }
  });
}

Report g_t_is_the_time_derivative(const Tried& j) {
  return compare("g_t is the derivative of g by time alone", [&](Comparison& c) {
    for (const double t : times) {
      const Motion A = j.pair.a.at(t), B = j.pair.b.at(t);
      c.derivative(j.rows(t, A, B).g_t, difference([&](double s) { return Vec(j.rows(t + s, A, B).g); }, step),
                   fmt::format("g_t at t = {}", t));
    }
  });
}

// By the joint's own H and g_t, so that gamma alone is judged.
Report gamma_is_the_rest_of_the_acceleration(const Tried& j) {
  return compare("d(g_dot)/dt = H_A A_A + H_B A_B - gamma", [&](Comparison& c) {
    for (const double t : times) {
      const Rows r = j.along(t);
      const Vec claimed = r.H_A * j.pair.a.acceleration(t) + r.H_B * j.pair.b.acceleration(t) - r.gamma;
      c.derivative(claimed, difference([&](double s) { return j.g_dot(t + s); }, step), fmt::format("at t = {}", t));
    }
  });
}

Report reactions_balance(const Tried& j) {
  return compare("reactions on A and B are equal and opposite", [&](Comparison& c) {
    for (const double t : times) {
      const Motion A = j.pair.a.at(t);
      Motion B = j.pair.b.at(t);
      const auto n = A.x.size();
      Rows r = j.rows(t, A, B);
      c.within((r.H_A + r.H_B).leftCols(n), Mat::Zero(r.g.size(), n), 1e-13 * r.H_B.norm(), "force of each row");
      // B is moved to where g = 0, by Newton's method.
      for (int i = 0; i < 50 && r.g.norm() > 1e-14; ++i) {
        B = displaced(B, -Eigen::CompleteOrthogonalDecomposition<Mat>(r.H_B).solve(Vec(r.g)));
        r = j.rows(t, A, B);
      }
      if (!(r.g.norm() <= 1e-11)) return;  // no pose of B satisfies these rows: nothing to ask
      for (Eigen::Index i = 0; i < r.g.size(); ++i) {
        const Vec sum = about_origin(r.H_A.row(i).transpose(), A.x) + about_origin(r.H_B.row(i).transpose(), B.x);
        // What is left of g has an arm of its size; the rest is round-off.
        c.within(sum, Vec::Zero(sum.size()), 1e-10 * (1 + r.H_B.norm()), fmt::format("row {} at t = {}", i, t));
      }
    }
  });
}

// Of joints that offer it.
Report reaction_tangent_is_that_of_the_wrenches(const Tried& j) {
  return compare("the reaction's derivative is that of H^T lambda", [&](Comparison& c) {
    const Vec6 lambda = Vec::LinSpaced(j.joint->row_count(j.space), 1.5, -0.7);
    const auto* exact = dynamic_cast<const ReactionTangent*>(j.joint.get());
    if (!exact) return;
    const int n = twist_size(j.space);
    for (const double t : times) {
      const Motion A = j.pair.a.at(t), B = j.pair.b.at(t);
      PairTangent K;
      for (Mat6* block : {&K.AA, &K.AB, &K.BA, &K.BB}) block->setZero(n, n);
      exact->add_reaction_tangent(t, A, B, lambda, K);
      const auto wrenches = [&](const Motion& a, const Motion& b) {
        const Rows r = j.rows(t, a, b);
        Vec both(2 * n);
        both << r.H_A.transpose() * lambda, r.H_B.transpose() * lambda;
        return both;
      };
      for (int i = 0; i < n; ++i) {
        const Vec6 e = Vec6::Unit(n, i);
        Vec by_A(2 * n), by_B(2 * n);
        by_A << K.AA.col(i), K.BA.col(i);
        by_B << K.AB.col(i), K.BB.col(i);
        c.derivative(by_A, difference([&](double s) { return wrenches(displaced(A, s * e), B); }, step),
                     fmt::format("by twist {} of A at t = {}", i, t));
        c.derivative(by_B, difference([&](double s) { return wrenches(A, displaced(B, s * e)); }, step),
                     fmt::format("by twist {} of B at t = {}", i, t));
      }
    }
  });
}

}  // namespace

std::vector<Check> joint_checks(const MakerOf<Joint>& make, Space space, Reaction reaction) {
  using Look = Report (*)(const Tried&);
  const std::pair<const char*, Look> all[] = {
      {"RowsHaveTheirSizes", rows_have_their_sizes},
      {"JacobianIsTheGradient", jacobian_is_the_gradient},
      {"TimeDerivativeIsThatOfFrozenMarkers", g_t_is_the_time_derivative},
      {"GammaIsTheRestOfTheAcceleration", gamma_is_the_rest_of_the_acceleration},
      {"ReactionTangentIsThatOfTheWrenches", reaction_tangent_is_that_of_the_wrenches},
      {"ReactionsBalance", reactions_balance},
  };
  std::vector<Check> checks;
  for (const auto& [name, look] : all)
    if (look != reactions_balance || reaction == Reaction::on_A)
      checks.push_back({name, [=] { return look(Tried(make, space)); }});
  return checks;
}

}  // namespace trammel
