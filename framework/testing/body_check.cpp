// The contract of a body, checked at random states near its start. With E its energy, P = supplied - dissipated, and s
// the parameter of the path t + s, q (+) (s v + s^2/2 a), v + s a:
//
//     M symmetric, v^T M v >= 0, T(q, v) = v^T M v/2 + what time alone drives
//     dE/ds = P + v^T (M a - f)                                 the last term is 0 along M a = f
//     c_m M - c_d df/dv + c_k d(M a - f)/dq = the exact tangent, where it is offered
//     own rows: G = dg/dq, dg/dt = G v + g_t, d(G v + g_t)/dt = G a - gamma along the path, K = d(G^T lambda)/dq
#include <set>

#include <trammel/decompositions.hpp>
#include <trammel/fields.hpp>

#include "testing/body_under_test.hpp"

namespace trammel {
namespace {

Mat symmetric(const Mat& M) {
  return (M + M.transpose()) / 2;
}

Report starts_on_its_manifold(const TriedBody& b) {
  return compare("the initial state is finite, its rotations are unit quaternions", [&](Comparison& c) {
    const BodyAt start = b.start();
    c.holds(start.q.allFinite() && start.v.allFinite(), "a number that is not finite");
    int iq = 0;
    for (const Coordinates::Part& part : b.coordinates.parts()) {
      if (part.kind == Coordinates::Kind::rotation)
        c.within(start.q.segment(iq, 4).norm(), 1, 1e-14, "norm of a quaternion");  // round-off of a normalisation
      iq += part.nq;
    }
  });
}

Report mass_is_symmetric(const TriedBody& b) {
  return compare("M is symmetric", [&](Comparison& c) {
    for (const BodyAt& at : b.at()) {
      const Mat M = b.mass(at);
      for (Eigen::Index i = 0; i < b.nv; ++i)
        for (Eigen::Index j = 0; j < i; ++j)
          c.within(M(i, j), M(j, i), 1e-13 * std::sqrt(std::abs(M(i, i) * M(j, j))),
                   fmt::format("M({0}, {1}) against M({1}, {0})", i, j));
    }
  });
}

// Scaled to a diagonal of 1, so that units and small masses do not matter; a coordinate without mass has a row of
// zeros.
Report mass_is_positive(const TriedBody& b) {
  return compare("M is positive semidefinite", [&](Comparison& c) {
    for (const BodyAt& at : b.at()) {
      const Mat M = symmetric(b.mass(at));
      c.holds(M.allFinite(), "a number that is not finite");
      c.holds(M.size() == 0 || M.diagonal().minCoeff() >= 0, "a negative number on the diagonal");
      const Vec scale = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
      const Mat scaled = scale.asDiagonal() * M * scale.asDiagonal();
      if (!scaled.allFinite() || !scaled.size()) continue;
      const double least = Eigen::SelfAdjointEigenSolver<Mat>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(0);
      c.holds(least >= -1e-13 * double(b.nv), fmt::format("an eigenvalue of {:.6g}, diagonal scaled to 1", least));
    }
  });
}

Report mass_is_constant_if_claimed(const TriedBody& b) {
  return compare("M never changes if mass_is_constant", [&](Comparison& c) {
    if (!b.body->mass_is_constant()) return;
    const Mat M = b.mass(b.start());
    for (const BodyAt& at : b.at()) c.within(b.mass(at), M, 0, fmt::format("at t = {:.3g}", at.t));
  });
}

// The even part of T in v: a body that is moved by time has others.
Report kinetic_energy_is_that_of_its_mass(const TriedBody& b) {
  return compare("kinetic energy is v^T M v/2", [&](Comparison& c) {
    for (const BodyAt& at : b.at()) {
      const double T = (b.energy(at).kinetic + b.energy({at.t, at.q, -at.v}).kinetic) / 2;
      const double rest = b.energy({at.t, at.q, Vec::Zero(b.nv)}).kinetic;
      const double terms = at.v.cwiseAbs().dot(b.mass(at).cwiseAbs() * at.v.cwiseAbs()) + rest;
      // Quadrature in the body or sums in another order: some hundred roundings.
      c.within(T - rest, at.v.dot(b.mass(at) * at.v) / 2, 1e-13 * terms, fmt::format("at t = {:.3g}", at.t));
    }
  });
}

Report energy_balances(const TriedBody& b) {
  return compare("dE/dt = supplied - dissipated along M a = f", [&](Comparison& c) {
    for (const BodyAt& at : b.at()) {
      const Mat M = symmetric(b.mass(at));
      const Vec f = b.force(at), a = b.nv ? Eigen::CompleteOrthogonalDecomposition<Mat>(M).solve(f) : f;
      const Power P = b.body->power(at.t, at.q, at.v);
      const Vec residual = M * a - f;  // not 0 where a coordinate has no mass
      const Difference rate = difference(
          [&](double s) { return Vec::Constant(1, b.energy(b.along(at, a, s)).total()); }, b.path_step(at, a));
      // a is exact to round-off of its terms.
      const double noise = 1e-13 * at.v.cwiseAbs().dot(f.cwiseAbs() + M.cwiseAbs() * a.cwiseAbs());
      c.derivative(Vec::Constant(1, P.supplied - P.dissipated + at.v.dot(residual)), rate,
                   fmt::format("dE/dt at t = {:.3g}", at.t), noise);
    }
  });
}

Report only_dissipates(const TriedBody& b) {
  return compare("dissipated power is not negative", [&](Comparison& c) {
    for (const BodyAt& at : b.at()) {
      const double power = b.body->power(at.t, at.q, at.v).dissipated;
      c.holds(power >= 0, fmt::format("{:.6g} W at t = {:.3g}", power, at.t));
    }
  });
}

Report force_adds(const TriedBody& b) {
  return compare("force() adds to what is there", [&](Comparison& c) {
    for (const BodyAt& at : b.at()) {
      const Vec f = b.force(at), before = f + Vec::Ones(b.nv);
      Vec after = before;
      b.body->force(at.t, at.q, at.v, after);
      c.within(after, before + f, 1e-13 * (f.cwiseAbs().sum() + 1), "f onto other forces");
    }
  });
}

Report tangent_is_exact(const TriedBody& b) {
  return compare("add_tangent adds c_m M + c_d D + c_k K, where it is offered", [&](Comparison& c) {
    if (!dynamic_cast<const ExactTangent*>(b.body.get())) return;
    std::mt19937 random(b.states.seed + 1);
    std::uniform_real_distribution<double> u(-1, 1);
    for (const BodyAt& at : b.at()) {
      // Accelerations that turn a rate round within the displacements' range.
      const double size = b.states.v * b.states.v / b.states.q;
      const Vec a = Vec::NullaryExpr(b.nv, [&] { return size * u(random); });
      const Mat none = Mat::Zero(b.nv, b.nv), M = b.mass(at);
      const Mat by_m = b.tangent(at, a, {1, 0, 0}, none), D = b.tangent(at, a, {0, 1, 0}, none),
                K = b.tangent(at, a, {0, 0, 1}, none);
      c.within(by_m, M, 1e-13 * M.lpNorm<Eigen::Infinity>(), "c_m alone");
      const auto residual = [&](const BodyAt& x) { return Vec(b.mass(x) * a - b.force(x)); };
      b.for_each_direction(at, residual, false, [&](Eigen::Index j, const Difference& d) {
        c.derivative(D.col(j), d, fmt::format("column {} of D", j));
      });
      b.for_each_direction(at, residual, true, [&](Eigen::Index j, const Difference& d) {
        c.derivative(K.col(j), d, fmt::format("column {} of K", j));
      });
      const Mat before = M + K, all = before + 2 * by_m + 0.3 * D + 0.7 * K;
      const double terms = (before.cwiseAbs() + 2 * by_m.cwiseAbs() + D.cwiseAbs() + K.cwiseAbs()).maxCoeff();
      c.within(b.tangent(at, a, {2, 0.3, 0.7}, before), all, 1e-13 * terms, "a blend onto other entries");
    }
  });
}

const Constrained* constrained(const TriedBody& b) {
  return dynamic_cast<const Constrained*>(b.body.get());
}
BodyRows own_rows(const TriedBody& b, const BodyAt& at) {
  BodyRows rows;
  rows.resize(constrained(b)->row_count(), int(b.nv));
  constrained(b)->own_rows(at.t, at.q, at.v, rows);
  return rows;
}

bool keep_their_sizes(const TriedBody& b, const BodyRows& rows) {
  const int n = constrained(b)->row_count();
  return rows.g.size() == n && rows.g_t.size() == n && rows.gamma.size() == n && rows.G.rows() == n &&
         rows.G.cols() == b.nv;
}
// Rows of wrong sizes allow no further check.
bool has_own_rows(const TriedBody& b) {
  return constrained(b) && keep_their_sizes(b, own_rows(b, b.start()));
}

Report own_rows_have_their_sizes(const TriedBody& b) {
  return compare("rows of its own keep the sizes they come in with", [&](Comparison& c) {
    if (constrained(b)) c.holds(has_own_rows(b), "an array of the rows was resized");
  });
}

Report own_jacobian_is_the_gradient(const TriedBody& b) {
  return compare("G is the gradient of g", [&](Comparison& c) {
    if (!has_own_rows(b)) return;
    for (const BodyAt& at : b.at()) {
      const Mat G = own_rows(b, at).G;
      b.for_each_direction(
          at, [&](const BodyAt& x) { return own_rows(b, x).g; }, true,
          [&](Eigen::Index j, const Difference& d) { c.derivative(G.col(j), d, fmt::format("column {} of G", j)); });
    }
  });
}

Report own_rates_are_those_of_the_path(const TriedBody& b) {
  return compare("dg/dt = G v + g_t and d(g_dot)/dt = G a - gamma", [&](Comparison& c) {
    if (!has_own_rows(b)) return;
    const auto g_dot = [&](const BodyAt& x) {
      const BodyRows rows = own_rows(b, x);
      return Vec(rows.G * x.v + rows.g_t);
    };
    std::mt19937 random(b.states.seed + 2);
    std::uniform_real_distribution<double> u(-1, 1);
    for (const BodyAt& at : b.at()) {
      const Vec a = Vec::NullaryExpr(b.nv, [&] { return b.states.v * b.states.v / b.states.q * u(random); });
      const double step = b.path_step(at, a);
      const BodyRows rows = own_rows(b, at);
      c.derivative(g_dot(at), difference([&](double s) { return own_rows(b, b.along(at, a, s)).g; }, step),
                   fmt::format("g_dot at t = {:.3g}", at.t));
      c.derivative(rows.G * a - rows.gamma, difference([&](double s) { return g_dot(b.along(at, a, s)); }, step),
                   fmt::format("g_ddot at t = {:.3g}", at.t));
    }
  });
}

Report own_reaction_derivative_is_exact(const TriedBody& b) {
  return compare("the derivative of the reaction of its own rows is that of G^T lambda", [&](Comparison& c) {
    if (!has_own_rows(b)) return;
    const Vec lambda = Vec::LinSpaced(constrained(b)->row_count(), 1.5, -0.7);
    for (const BodyAt& at : b.at()) {
      Mat K = Mat::Zero(b.nv, b.nv);
      Matrix into = Matrix::onto(K);
      constrained(b)->add_own_rows_derivative(at.t, at.q, lambda, 1, into);
      b.for_each_direction(
          at, [&](const BodyAt& x) { return Vec(own_rows(b, x).G.transpose() * lambda); }, true,
          [&](Eigen::Index j, const Difference& d) { c.derivative(K.col(j), d, fmt::format("column {}", j)); });
    }
  });
}

// p and -p are one rotation.
Report sees_rotations_not_quaternions(const TriedBody& b) {
  return compare("a quaternion and its negative give the same", [&](Comparison& c) {
    for (const BodyAt& at : b.at()) {
      BodyAt other = at;
      int iq = 0;
      for (const Coordinates::Part& part : b.coordinates.parts()) {
        if (part.kind == Coordinates::Kind::rotation) other.q.segment(iq, 4) *= -1;
        iq += part.nq;
      }
      if (other.q == at.q) return;
      const Vec f = b.force(at);
      c.within(b.mass(other), b.mass(at), 0, "M");
      c.within(b.force(other), f, 1e-13 * f.lpNorm<Eigen::Infinity>(), "f");
      for (std::size_t i = 0; i < b.body->markers().size(); ++i) {
        const Motion m = b.motion(i, at), n = b.motion(i, other);
        c.within(n.x, m.x, 1e-13 * (1 + m.x.norm()), "x of " + b.body->markers()[i]);
        c.within(n.R, m.R, 1e-13, "R of " + b.body->markers()[i]);
      }
    }
  });
}

Report shows_itself(const TriedBody& b) {
  return compare("what is drawn and observed is finite, of one size, and named once", [&](Comparison& c) {
    const auto* drawn = dynamic_cast<const Drawn*>(b.body.get());
    const auto* observed = dynamic_cast<const Observed*>(b.body.get());
    Eigen::Index columns = -1;
    for (const BodyAt& at : b.at()) {
      if (drawn) {
        Mat points;
        drawn->shape(at.t, at.q, points);
        const auto n = b.body->markers().empty() ? points.rows() : b.motion(0, at).x.size();
        c.holds(points.rows() == n && points.cols() > 0 && (columns < 0 || points.cols() == columns),
                fmt::format("a shape of {} x {}", points.rows(), points.cols()));
        c.holds(points.allFinite(), "a point of the shape that is not finite");
        columns = points.cols();
      }
      for (int i = 0; observed && i < int(observed->observables().size()); ++i)
        c.holds(std::isfinite(observed->observe(i, at.t, at.q, at.v)),
                observed->observables()[std::size_t(i)] + " is not finite");
    }
    if (!observed) return;
    const auto names = observed->observables();
    c.holds(std::set<std::string>(names.begin(), names.end()).size() == names.size(), "two observables of one name");
  });
}

Report shows_fields(const TriedBody& b) {
  return compare("fields are finite, at as many points as there are values, and named once", [&](Comparison& c) {
    const auto* fields = dynamic_cast<const HasFields*>(b.body.get());
    if (!fields) return;
    const auto names = fields->fields();
    c.holds(std::set<std::string>(names.begin(), names.end()).size() == names.size(), "two fields of one name");
    std::vector<FieldPatch> patches;
    for (const BodyAt& at : b.at()) {
      fields->fields_at(at.t, at.q, at.v, patches);
      for (const FieldPatch& patch : patches) {
        const Eigen::Index n = patch.points.cols();
        c.holds(patch.along > 0 && n > 0 && n % patch.along == 0,
                fmt::format("{} points by rows of {}", n, patch.along));
        c.holds(
            patch.points.rows() == 3 && patch.values.rows() == Eigen::Index(names.size()) && patch.values.cols() == n,
            fmt::format("{} x {} values of {} fields at {} x {} points", patch.values.rows(), patch.values.cols(),
                        names.size(), patch.points.rows(), n));
        c.holds(patch.points.allFinite() && patch.values.allFinite(), "a point or value that is not finite");
      }
    }
  });
}

}  // namespace

std::vector<Check> body_checks(const MakerOf<Body>& make, const BodyStates& states) {
  using Look = Report (*)(const TriedBody&);
  std::vector<std::pair<const char*, Look>> all = {
      {"StartsOnItsManifold", starts_on_its_manifold},
      {"MassIsSymmetric", mass_is_symmetric},
      {"MassIsPositive", mass_is_positive},
      {"MassIsConstantIfClaimed", mass_is_constant_if_claimed},
      {"KineticEnergyIsThatOfItsMass", kinetic_energy_is_that_of_its_mass},
      {"EnergyBalances", energy_balances},
      {"OnlyDissipates", only_dissipates},
      {"ForceAdds", force_adds},
      {"TangentIsExact", tangent_is_exact},
      {"OwnRowsHaveTheirSizes", own_rows_have_their_sizes},
      {"OwnJacobianIsTheGradient", own_jacobian_is_the_gradient},
      {"OwnRatesAreThoseOfThePath", own_rates_are_those_of_the_path},
      {"OwnReactionDerivativeIsExact", own_reaction_derivative_is_exact},
      {"SeesRotationsNotQuaternions", sees_rotations_not_quaternions},
      {"ShowsItself", shows_itself},
      {"ShowsFields", shows_fields},
  };
  for (const auto& look : marker_looks()) all.push_back(look);
  std::vector<Check> checks;
  for (const auto& [name, look] : all) checks.push_back({name, [=] { return look(TriedBody(make, states)); }});
  return checks;
}

}  // namespace trammel
