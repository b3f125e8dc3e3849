// The contract of a force, checked along known motions of its two markers, with V the stored energy:
//
//     dV/dt + F_A . V_A + F_B . V_B = supplied - dissipated,  dissipated >= 0
//     F_A + F_B = 0, moments about the origin too (except external loads)
//     Q F(A, B) = F(Q A, Q B) for a turn Q of the scene (likewise)
//     F has a derivative by pose and velocity, which the framework takes by differences, or from WrenchTangent
//     axes of a marker count, and moments act on it, only where NeedsOrientation says so
#include <fmt/format.h>

#include <trammel/needs_orientation.hpp>
#include <trammel/testing/components.hpp>
#include <trammel/testing/markers.hpp>

#include "testing/difference.hpp"

namespace trammel {
namespace {

constexpr double force_times[] = {0.1, 0.7, 1.3, 1.9};  // [s]
constexpr double force_step = 0.05;  // [s, m, rad] largest of the differences: motions change over 0.5

struct Wrenches {
  Wrench on_A, on_B;
};

struct TriedForce {
  std::unique_ptr<Force> force;
  Space space;
  Reaction reaction;
  MovingPair pair;

  TriedForce(const MakerOf<Force>& make, Space s, Reaction r)
      : force(make()), space(s), reaction(r), pair(moving_pair(s)) {}

  Wrenches wrenches(double t, const Motion& A, const Motion& B) const {
    Wrenches w{Wrench::Zero(A.V.size()), Wrench::Zero(B.V.size())};
    force->wrench(t, A, B, w.on_A, w.on_B);
    return w;
  }
  Wrenches along(double t) const { return wrenches(t, pair.a.at(t), pair.b.at(t)); }
};

Report force_energy_balances(const TriedForce& f) {
  return compare("power of the wrenches is taken from the potential, supplied or dissipated", [&](Comparison& c) {
    for (const double t : force_times) {
      const Motion A = f.pair.a.at(t), B = f.pair.b.at(t);
      const Wrenches w = f.wrenches(t, A, B);
      const Power P = f.force->power(t, A, B);
      const double by_wrench = w.on_A.dot(A.V) + w.on_B.dot(B.V);
      const Difference stored = difference(
          [&](double s) { return Vec::Constant(1, f.force->potential(t + s, f.pair.a.at(t + s), f.pair.b.at(t + s))); },
          force_step);
      const double noise = 1e-13 * (w.on_A.cwiseAbs().dot(A.V.cwiseAbs()) + w.on_B.cwiseAbs().dot(B.V.cwiseAbs()));
      c.derivative(Vec::Constant(1, P.supplied - P.dissipated - by_wrench), stored,
                   fmt::format("d(potential)/dt at t = {}", t), noise);
    }
  });
}

Report force_only_dissipates(const TriedForce& f) {
  return compare("dissipated power is not negative", [&](Comparison& c) {
    for (const double t : force_times) {
      const double power = f.force->power(t, f.pair.a.at(t), f.pair.b.at(t)).dissipated;
      c.holds(power >= 0, fmt::format("{:.6g} W at t = {}", power, t));
    }
  });
}

Report action_is_reaction(const TriedForce& f) {
  return compare("wrenches on A and B are equal and opposite", [&](Comparison& c) {
    if (f.reaction == Reaction::outside) return;
    for (const double t : force_times) {
      const Motion A = f.pair.a.at(t), B = f.pair.b.at(t);
      const Wrenches w = f.wrenches(t, A, B);
      const Vec on_A = about_origin(w.on_A, A.x), on_B = about_origin(w.on_B, B.x);
      c.within(on_A, -on_B, 1e-13 * (on_A.norm() + on_B.norm()), fmt::format("at t = {}", t));
    }
  });
}

Report turns_with_the_scene(const TriedForce& f) {
  return compare("wrenches turn with the scene", [&](Comparison& c) {
    if (f.reaction == Reaction::outside) return;
    for (const double t : force_times) {
      Vec6 turn = Vec6::Zero(twist_size(f.space));
      turn.tail(rotations(f.space)) = Eigen::Vector3d(0.7, -0.4, 0.9).head(rotations(f.space));
      Motion origin = marker_at(Vec::Zero(turn.size()), Vec::Zero(turn.size()));
      const Mat3 Q = displaced(origin, turn).R;
      const auto turned_twist = [&](Vec6 w) {
        w.head(Q.rows()) = (Q * w.head(Q.rows())).eval();
        if (f.space == Space::spatial) w.tail(3) = (Q * w.tail(3)).eval();
        return w;
      };
      const auto turned = [&](const Motion& m) {
        Motion n = displaced(m, turn);
        n.x = Q * m.x;
        n.V = turned_twist(m.V);
        return n;
      };
      const Motion A = f.pair.a.at(t), B = f.pair.b.at(t);
      const Wrenches w = f.wrenches(t, A, B), v = f.wrenches(t, turned(A), turned(B));
      const double round_off = 1e-12 * (w.on_A.norm() + w.on_B.norm());
      c.within(v.on_A, turned_twist(w.on_A), round_off, fmt::format("on A at t = {}", t));
      c.within(v.on_B, turned_twist(w.on_B), round_off, fmt::format("on B at t = {}", t));
    }
  });
}

// Central differences converge at a kink, to the mean of its slopes; therefore both sides are evaluated.
Report has_a_derivative(const TriedForce& f) {
  return compare("wrenches have a derivative by pose and velocity", [&](Comparison& c) {
    const int n = twist_size(f.space);
    for (const double t : force_times) {
      const Motion A = f.pair.a.at(t), B = f.pair.b.at(t);
      for (int i = 0; i < 2 * n; ++i) {
        const auto moved = [&](double s) {
          Motion m = i < n ? displaced(B, s * Vec6::Unit(n, i)) : B;
          if (i >= n) m.V(i - n) += s;
          const Wrenches w = f.wrenches(t, A, m);
          Vec both(2 * n);
          both << w.on_A, w.on_B;
          return both;
        };
        const Difference d = difference(moved, force_step);
        const double h = 1e-6;
        const Vec right = (moved(h) - moved(0)) / h, left = (moved(0) - moved(-h)) / h;
        const double scale = d.value.cwiseAbs().maxCoeff() + d.size / d.h;
        c.derivative(d.value, d, fmt::format("by {} of B at t = {}", i < n ? "pose" : "velocity", t));
        c.within(right, left, 1e-3 * scale, fmt::format("by {} of B at t = {}", i < n ? "pose" : "velocity", t));
      }
    }
  });
}

// For forces with exact derivatives.
Report wrench_tangent_is_exact(const TriedForce& f) {
  return compare("the exact derivatives are those of the wrenches", [&](Comparison& c) {
    const auto* exact = dynamic_cast<const WrenchTangent*>(f.force.get());
    if (!exact) return;
    const int n = twist_size(f.space);
    for (const double t : force_times) {
      const Motion A = f.pair.a.at(t), B = f.pair.b.at(t);
      PairTangent K, D;
      for (PairTangent* of : {&K, &D})
        for (Mat6* block : {&of->AA, &of->AB, &of->BA, &of->BB}) block->setZero(n, n);
      exact->add_wrench_tangent(t, A, B, K, D);
      for (int i = 0; i < 4 * n; ++i) {
        const bool by_pose = i < 2 * n, of_A = i / n % 2 == 0;
        const Vec6 e = Vec6::Unit(n, i % n);
        const auto moved = [&](double s) {
          Motion both[] = {A, B};
          Motion& m = both[of_A ? 0 : 1];
          if (by_pose)
            m = displaced(m, s * e);
          else
            m.V += s * e;
          const Wrenches w = f.wrenches(t, both[0], both[1]);
          Vec all(2 * n);
          all << w.on_A, w.on_B;
          return all;
        };
        const PairTangent& of = by_pose ? K : D;
        Vec claimed(2 * n);
        claimed << (of_A ? of.AA : of.AB).col(i % n), (of_A ? of.BA : of.BB).col(i % n);
        c.derivative(
            claimed, difference(moved, force_step),
            fmt::format("by {} {} of {} at t = {}", by_pose ? "twist" : "velocity", i % n, of_A ? 'A' : 'B', t));
      }
    }
  });
}

// For a marker that may be a point, which has no axes.
Report force_axes_count_only_where_said(const TriedForce& f) {
  return compare("a marker's orientation counts only where NeedsOrientation says so", [&](Comparison& c) {
    const auto* needs = dynamic_cast<const NeedsOrientation*>(f.force.get());
    const int turns = rotations(f.space), dim = dimension(f.space);
    Vec6 turn = Vec6::Zero(twist_size(f.space));
    turn.tail(turns).setConstant(0.6);
    for (const double t : force_times) {
      const Motion A = f.pair.a.at(t), B = f.pair.b.at(t);
      const Wrenches w = f.wrenches(t, A, B);
      for (int k = 0; k < 2; ++k) {
        if (needs && needs->needs_orientation(k)) continue;
        const Wrenches turned = k == 0 ? f.wrenches(t, displaced(A, turn), B) : f.wrenches(t, A, displaced(B, turn));
        const Wrench& on_it = k == 0 ? w.on_A : w.on_B;
        c.within(on_it.tail(turns), Vec::Zero(turns), 0, fmt::format("moment on {}", char('A' + k)));
        c.within(turned.on_A.head(dim), w.on_A.head(dim), 0, fmt::format("force on A with {} turned", char('A' + k)));
        c.within(turned.on_B.head(dim), w.on_B.head(dim), 0, fmt::format("force on B with {} turned", char('A' + k)));
      }
    }
  });
}

}  // namespace

std::vector<Check> force_checks(const MakerOf<Force>& make, Space space, Reaction reaction) {
  using Look = Report (*)(const TriedForce&);
  const std::pair<const char*, Look> all[] = {
      {"EnergyBalances", force_energy_balances},
      {"OnlyDissipates", force_only_dissipates},
      {"ActionIsReaction", action_is_reaction},
      {"TurnsWithTheScene", turns_with_the_scene},
      {"HasADerivative", has_a_derivative},
      {"WrenchTangentIsExact", wrench_tangent_is_exact},
      {"AxesCountOnlyWhereSaid", force_axes_count_only_where_said},
  };
  std::vector<Check> checks;
  for (const auto& [name, look] : all)
    checks.push_back({name, [=] { return look(TriedForce(make, space, reaction)); }});
  return checks;
}

}  // namespace trammel
