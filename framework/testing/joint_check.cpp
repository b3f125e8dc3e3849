// The contract of a joint, checked along known motions of its two to four markers, in general away from g = 0:
//
//     dg/dt = H_A V_A + H_B V_B + ... + g_t,    d(that)/dt = H_A A_A + H_B A_B + ... - gamma
//     H_A, H_B, ...: gradients of g by the markers' twists at fixed time, g_t: derivative by time at fixed markers
//     reactions -H_A^T lambda and -H_B^T lambda balance: in force everywhere, in moment where g = 0
//
// and axes of markers count only where NeedsOrientation says so. Rows that repeat each other are no fault.
#include <fmt/format.h>

#include <stdexcept>

#include <trammel/decompositions.hpp>
#include <trammel/linear_rows.hpp>
#include <trammel/needs_orientation.hpp>
#include <trammel/testing/components.hpp>
#include <trammel/testing/markers.hpp>

#include "testing/difference.hpp"

namespace trammel {
namespace {

constexpr double times[] = {0.1, 0.7, 1.9};  // [s]
constexpr double step = 0.05;                // [s, m, rad] largest of the differences: motions change over 0.5

using Markers = std::vector<Motion>;

struct TriedJoint {
  std::unique_ptr<Constraint> joint;
  Space space;
  std::vector<MovingMarker> moving;

  TriedJoint(const MakerOf<Constraint>& make, Space s) : joint(make()), space(s) {
    const int n = joint->marker_count();
    if (n < 2 || n > Rows::most_markers) throw std::length_error(fmt::format("{} markers, expected 2 to 4", n));
    moving = moving_markers(s, n);
  }

  int count() const { return int(moving.size()); }
  Rows rows(double t, const Markers& markers) const {
    const int n = joint->row_count(space), twist = twist_size(space);
    if (n < 1 || n > 6) throw std::length_error(fmt::format("{} rows, expected 1 to 6", n));
    Rows r;
    r.resize(n, space, count());
    std::vector<const Motion*> at;
    for (const Motion& marker : markers) at.push_back(&marker);
    joint->rows_between(t, at, r);
    bool kept = r.g.size() == n && r.g_t.size() == n && r.gamma.size() == n;
    for (int k = 0; k < count(); ++k) kept = kept && r.H(k).rows() == n && r.H(k).cols() == twist;
    if (!kept) throw std::length_error("an array of the rows was resized");
    return r;
  }
  Markers at(double t) const {
    Markers markers;
    for (const MovingMarker& each : moving) markers.push_back(each.at(t));
    return markers;
  }
  Rows along(double t) const { return rows(t, at(t)); }
  Vec g_dot(double t) const {
    const Rows r = along(t);
    Vec rate = r.g_t;
    for (int k = 0; k < count(); ++k) rate += r.H(k) * moving[std::size_t(k)].at(t).V;
    return rate;
  }
};

// The markers with one of them moved.
Markers with_moved(Markers markers, int marker, const Vec6& by) {
  markers[std::size_t(marker)] = displaced(markers[std::size_t(marker)], by);
  return markers;
}

Report rows_have_their_sizes(const TriedJoint& j) {
  return compare("rows keep the sizes they come in with",
                 [&](Comparison& c) { c.holds(j.along(times[0]).g.allFinite(), "a number that is not finite"); });
}

Report jacobian_is_the_gradient(const TriedJoint& j) {
  return compare("H_A, H_B, ... are the gradients of g", [&](Comparison& c) {
    for (const double t : times) {
      const Markers markers = j.at(t);
      const Rows r = j.rows(t, markers);
      for (int k = 0; k < j.count(); ++k)
        for (int i = 0; i < twist_size(j.space); ++i) {
          const Vec6 e = Vec6::Unit(twist_size(j.space), i);
          const auto g = [&](double s) { return Vec(j.rows(t, with_moved(markers, k, s * e)).g); };
          c.derivative(r.H(k).col(i), difference(g, step),
                       fmt::format("column {} of H_{} at t = {}", i, char('A' + k), t));
        }
    }
  });
}

Report g_t_is_the_time_derivative(const TriedJoint& j) {
  return compare("g_t is the derivative of g by time alone", [&](Comparison& c) {
    for (const double t : times) {
      const Markers markers = j.at(t);
      c.derivative(j.rows(t, markers).g_t, difference([&](double s) { return Vec(j.rows(t + s, markers).g); }, step),
                   fmt::format("g_t at t = {}", t));
    }
  });
}

// With the joint's own H and g_t, so that only gamma is checked.
Report gamma_is_the_rest_of_the_acceleration(const TriedJoint& j) {
  return compare("d(g_dot)/dt = H_A A_A + H_B A_B + ... - gamma", [&](Comparison& c) {
    for (const double t : times) {
      const Rows r = j.along(t);
      Vec claimed = -r.gamma;
      for (int k = 0; k < j.count(); ++k) claimed += r.H(k) * j.moving[std::size_t(k)].acceleration(t);
      c.derivative(claimed, difference([&](double s) { return j.g_dot(t + s); }, step), fmt::format("at t = {}", t));
    }
  });
}

Report reactions_balance(const TriedJoint& j) {
  return compare("reactions on all markers balance", [&](Comparison& c) {
    for (const double t : times) {
      Markers markers = j.at(t);
      const auto n = markers[0].x.size();
      Rows r = j.rows(t, markers);
      Mat force = Mat::Zero(r.g.size(), n);
      for (int k = 0; k < j.count(); ++k) force += r.H(k).leftCols(n);
      c.within(force, Mat::Zero(r.g.size(), n), 1e-13 * r.H_B.norm(), "force of each row");
      // B is moved to where g = 0, by Newton's method.
      for (int i = 0; i < 50 && r.g.norm() > 1e-14; ++i) {
        markers = with_moved(markers, 1, -Eigen::CompleteOrthogonalDecomposition<Mat>(r.H_B).solve(Vec(r.g)));
        r = j.rows(t, markers);
      }
      if (!(r.g.norm() <= 1e-11)) return;  // no pose of B satisfies these rows: nothing to ask
      for (Eigen::Index i = 0; i < r.g.size(); ++i) {
        Vec sum = Vec::Zero(markers[0].V.size());
        for (int k = 0; k < j.count(); ++k) sum += about_origin(r.H(k).row(i).transpose(), markers[std::size_t(k)].x);
        // The remaining g is a lever arm of its size; the rest is round-off.
        c.within(sum, Vec::Zero(sum.size()), 1e-10 * (1 + r.H_B.norm()), fmt::format("row {} at t = {}", i, t));
      }
    }
  });
}

// For joints with exact derivatives.
Report reaction_tangent_is_that_of_the_wrenches(const TriedJoint& j) {
  return compare("the reaction's derivative is that of H^T lambda", [&](Comparison& c) {
    const Vec6 lambda = Vec::LinSpaced(j.joint->row_count(j.space), 1.5, -0.7);
    const auto* exact = dynamic_cast<const ReactionTangent*>(j.joint.get());
    if (!exact || j.count() != 2) return;
    const int n = twist_size(j.space);
    for (const double t : times) {
      const Motion A = j.moving[0].at(t), B = j.moving[1].at(t);
      PairTangent K;
      for (Mat6* block : {&K.AA, &K.AB, &K.BA, &K.BB}) block->setZero(n, n);
      exact->add_reaction_tangent(t, A, B, lambda, K);
      const auto wrenches = [&](const Motion& a, const Motion& b) {
        const Rows r = j.rows(t, {a, b});
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

// For markers whose axes do not turn.
Report rows_are_linear_if_claimed(const TriedJoint& j) {
  return compare("between points the rows are g_0 + H x with constant H, where LinearRows says so", [&](Comparison& c) {
    const auto* claims = dynamic_cast<const LinearRows*>(j.joint.get());
    if (!claims || !claims->linear()) return;
    const int dim = dimension(j.space);
    const Markers start = j.at(times[0]);
    const auto places = [&](double t, bool at_zero) {
      Markers points = start;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const Motion moved = j.moving[k].at(t);
        points[k].x = at_zero ? Vec3(Vec3::Zero(dim)) : moved.x;
        points[k].V.setZero(), points[k].bias.setZero();
        if (!at_zero) points[k].V.head(dim) = moved.V.head(dim);
      }
      return points;
    };
    const Rows zero = j.rows(0, places(0, true));
    for (const double t : times) {
      const Markers points = places(t, false);
      const Rows r = j.rows(t, points);
      Vec g = zero.g;
      double size = zero.g.norm();
      for (int k = 0; k < j.count(); ++k) {
        const Mat H = r.H(k).leftCols(dim);
        c.within(H, Mat(zero.H(k).leftCols(dim)), 1e-15, fmt::format("H of marker {} at t = {}", k, t));
        g += H * points[std::size_t(k)].x;
        size += points[std::size_t(k)].x.norm();
      }
      c.within(r.g, g, 1e-14 * size, fmt::format("g at t = {}", t));
      c.within(r.gamma, Vec::Zero(r.gamma.size()), 0, fmt::format("gamma at t = {}", t));
      c.within(r.g_t, Vec::Zero(r.g_t.size()), 0, fmt::format("g_t at t = {}", t));
    }
  });
}

// For a marker that may be a point, which has no axes.
Report joint_axes_count_only_where_said(const TriedJoint& j) {
  return compare("a marker's orientation counts only where NeedsOrientation says so", [&](Comparison& c) {
    const auto* needs = dynamic_cast<const NeedsOrientation*>(j.joint.get());
    for (int k = 0; k < j.count(); ++k) {
      if (needs && needs->needs_orientation(k)) continue;
      Vec6 turn = Vec6::Zero(twist_size(j.space));
      turn.tail(rotations(j.space)).setConstant(0.6);
      for (const double t : times) {
        const Markers markers = j.at(t);
        const Rows r = j.rows(t, markers), turned = j.rows(t, with_moved(markers, k, turn));
        const Mat by_turn = r.H(k).rightCols(rotations(j.space));
        c.within(by_turn, Mat::Zero(by_turn.rows(), by_turn.cols()), 0, fmt::format("turns in H_{}", char('A' + k)));
        c.within(turned.g, r.g, 0, fmt::format("g with marker {} turned", char('A' + k)));
      }
    }
  });
}

}  // namespace

std::vector<Check> joint_checks(const MakerOf<Constraint>& make, Space space, Reaction reaction) {
  using Look = Report (*)(const TriedJoint&);
  const std::pair<const char*, Look> all[] = {
      {"RowsHaveTheirSizes", rows_have_their_sizes},
      {"JacobianIsTheGradient", jacobian_is_the_gradient},
      {"TimeDerivativeIsThatOfFrozenMarkers", g_t_is_the_time_derivative},
      {"GammaIsTheRestOfTheAcceleration", gamma_is_the_rest_of_the_acceleration},
      {"ReactionTangentIsThatOfTheWrenches", reaction_tangent_is_that_of_the_wrenches},
      {"ReactionsBalance", reactions_balance},
      {"RowsAreLinearIfClaimed", rows_are_linear_if_claimed},
      {"AxesCountOnlyWhereSaid", joint_axes_count_only_where_said},
  };
  std::vector<Check> checks;
  for (const auto& [name, look] : all)
    if (look != reactions_balance || reaction == Reaction::on_A)
      checks.push_back({name, [=] { return look(TriedJoint(make, space)); }});
  return checks;
}

}  // namespace trammel
