// A body at random states near its start: its functions as values, paths through them and derivatives.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <trammel/testing/components.hpp>

#include "model/coordinates.hpp"
#include "testing/difference.hpp"

namespace trammel {

struct BodyAt {
  double t = 0;
  Vec q, v;
};

// A body's functions as values.
struct TriedBody {
  std::unique_ptr<Body> body;
  BodyStates states;
  Coordinates coordinates;
  Eigen::Index nq, nv;

  TriedBody(const MakerOf<Body>& make, const BodyStates& s)
      : body(make()), states(s), coordinates(body->coordinates()), nq(coordinates.nq()), nv(coordinates.nv()) {}

  BodyAt start() const {
    BodyAt at{0, Vec::Zero(nq), Vec::Zero(nv)};
    body->initial(at.q, at.v);
    return at;
  }
  std::vector<BodyAt> at() const {
    std::mt19937 random(states.seed);
    std::uniform_real_distribution<double> u(-1, 1);
    const auto vec = [&](double size) { return Vec(Vec::NullaryExpr(nv, [&] { return size * u(random); })); };
    const Vec q_0 = start().q;
    std::vector<BodyAt> all;
    for (int i = 0; i < states.count; ++i) {
      const Vec displacement = vec(states.q);
      all.push_back({0.5 + u(random) / 2, retract(q_0, displacement), vec(states.v)});
    }
    return all;
  }

  Vec retract(const Vec& q, const Vec& dq) const {
    Vec moved(nq);
    int iq = 0, iv = 0;
    for (const Coordinates::Part& part : coordinates.parts()) {
      model::retract(part, q.data() + iq, dq.data() + iv, moved.data() + iq);
      iq += part.nq, iv += part.nv;
    }
    return moved;
  }
  BodyAt along(const BodyAt& at, const Vec& a, double s) const {
    return {at.t + s, retract(at.q, s * at.v + s * s / 2 * a), at.v + s * a};
  }
  // The largest step along a path that leaves neither range of displacements and rates by more than a quarter.
  double path_step(const BodyAt& at, const Vec& a) const {
    const double v = at.v.lpNorm<Eigen::Infinity>() + 1e-300, acc = a.lpNorm<Eigen::Infinity>() + 1e-300;
    return 0.25 * std::min({1.0, states.q / v, std::sqrt(states.q / acc), states.v / acc});
  }

  Mat mass(const BodyAt& at) const {
    Mat M = Mat::Zero(nv, nv);
    Matrix into = Matrix::onto(M);
    body->mass(at.t, at.q, into);
    return M;
  }
  Vec force(const BodyAt& at) const {
    Vec f = Vec::Zero(nv);
    body->force(at.t, at.q, at.v, f);
    return f;
  }
  Energy energy(const BodyAt& at) const { return body->energy(at.t, at.q, at.v); }
  Motion motion(std::size_t marker, const BodyAt& at) const {
    Motion m;
    body->motion(int(marker), at.t, at.q, at.v, m);
    return m;
  }
  Mat tangent(const BodyAt& at, const Vec& a, Blend c, Mat S) const {
    Matrix into = Matrix::onto(S);
    dynamic_cast<const ExactTangent&>(*body).add_tangent(at.t, at.q, at.v, a, c, into);
    return S;
  }
  Vec of_dofs(const Motion& m, const Vec& v) const {
    Vec own(Eigen::Index(m.dofs.size()));
    for (std::size_t k = 0; k < m.dofs.size(); ++k) own(Eigen::Index(k)) = v(m.dofs[k]);
    return own;
  }

  void for_each_marker(const std::function<void(std::size_t, const BodyAt&, const std::string& where)>& look) const {
    for (const BodyAt& state : at())
      for (std::size_t i = 0; i < body->markers().size(); ++i)
        look(i, state, fmt::format("marker {} at t = {:.3g}", body->markers()[i], state.t));
  }
  // Columns of d f/dq in the tangent space, or of d f/dv.
  void for_each_direction(const BodyAt& at, const std::function<Vec(const BodyAt&)>& f, bool of_q,
                          const std::function<void(Eigen::Index, const Difference&)>& look) const {
    for (Eigen::Index j = 0; j < nv; ++j) {
      const Vec e = Vec::Unit(nv, j);
      look(j, difference(
                  [&](double s) {
                    return of_q ? f({at.t, retract(at.q, s * e), at.v}) : f({at.t, at.q, at.v + s * e});
                  },
                  0.25 * (of_q ? states.q : states.v)));
    }
  }
};

// The contract of markers (marker_check.cpp); part of body_checks.
std::vector<std::pair<const char*, Report (*)(const TriedBody&)>> marker_looks();

}  // namespace trammel
