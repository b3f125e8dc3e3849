#include "diagnose/row_offsets.hpp"

#include <array>
#include <cmath>

#include <trammel/decompositions.hpp>

namespace trammel::simulate {
namespace {

// Newton's method that moves a body alone onto its own rows: in the rows' unit, round-off of lengths of the order of 1.
constexpr int most_own_steps = 20;
constexpr double on_own_rows = 1e-12;

RowOffset length(double g, double g_dot, double s) {
  constexpr double least = 1e-3;  // a rod of length 0 has no direction for its rate
  return {2 * g / (1 + s), s > least ? g_dot / s : g_dot, false};
}

RowOffset angle(double g, double g_dot, double s) {
  constexpr double round_off = 1e-9;
  const bool sine = std::abs(g * g + s * s - 1) < round_off && s > round_off;
  return sine ? RowOffset{std::atan2(g, s), g_dot / s, true} : RowOffset{g, g_dot, true};
}

using JointMotions = std::array<const Motion*, Rows::most_markers>;

Rows rows_of(model::AssembledSystem& system, const Constraint& constraint, const std::vector<model::MarkerRef>& markers,
             double t, JointMotions& at) {
  const Space space = system.model().world.space;
  for (std::size_t k = 0; k < markers.size(); ++k) at[k] = &system.motion(markers[k]);
  Rows rows;
  rows.resize(constraint.row_count(space), space, int(markers.size()));
  constraint.rows_between(t, Motions(at.data(), markers.size()), rows);
  return rows;
}

std::vector<RowOffset> row_offsets(model::AssembledSystem& system, const Constraint& constraint,
                                   const std::vector<model::MarkerRef>& markers, double t) {
  const Eigen::Index dim = dimension(system.model().world.space);
  JointMotions at = {};
  const Rows rows = rows_of(system, constraint, markers, t, at);
  Vec g_dot = rows.g_t;
  for (std::size_t k = 0; k < markers.size(); ++k) g_dot += rows.H(int(k)) * at[k]->V;
  std::vector<RowOffset> all;
  for (Eigen::Index i = 0; i < rows.g.size(); ++i) {
    const double s = rows.H_B.row(i).head(dim).norm();
    if (markers.size() > 2)
      all.push_back({rows.g(i), g_dot(i), s == 0});
    else
      all.push_back(s > 0 ? length(rows.g(i), g_dot(i), s) : angle(rows.g(i), g_dot(i), rows.H_B.row(i).norm()));
  }
  return all;
}

BodyRows own_rows(const model::BodyEntry& body, double t, const Vec& q, const Vec& v) {
  BodyRows rows;
  rows.resize(body.rows, body.nv);
  body.constrained->own_rows(t, q, v, rows);
  return rows;
}

// Rows of natural coordinates are scaled to lengths; the rows of other bodies are given as they are.
std::vector<RowOffset> own_row_offsets(const model::BodyEntry& body, const State& state) {
  const Vec v = state.v.segment(body.v0, body.nv);
  Vec q = state.q.segment(body.q0, body.nq);
  const BodyRows here = own_rows(body, state.t, q, v);
  BodyRows held = here;
  for (int i = 0; body.nq == body.nv && i < most_own_steps && held.g.norm() > on_own_rows; ++i) {
    const Mat GGt = held.G * held.G.transpose();
    q -= held.G.transpose() * Eigen::LDLT<Mat>(GGt).solve(held.g);
    held = own_rows(body, state.t, q, v);
  }
  const Vec g_dot = here.G * v + here.g_t;
  std::vector<RowOffset> all;
  for (int i = 0; i < body.rows; ++i)
    all.push_back(length(here.g(i), g_dot(i), here.G.row(i).norm() / held.G.row(i).norm()));
  return all;
}

}  // namespace

std::vector<RowOffset> row_offsets(model::AssembledSystem& system, const model::RowGroup& rows, const State& state) {
  for (const model::JointEntry& joint : system.model().joints)
    if (joint.row == rows.first && joint.rows > 0) return row_offsets(system, *joint.joint, joint.markers, state.t);
  for (const model::BodyEntry& body : system.model().bodies)
    if (body.row == rows.first && body.rows > 0) return own_row_offsets(body, state);
  return {};
}

RowOffset row_offset(model::AssembledSystem& system, const model::RowLimit& limit, double t) {
  return row_offsets(system, *limit.joint, limit.markers, t).front();
}

std::vector<int> rows_without_direction(model::AssembledSystem& system, const model::JointEntry& joint, double t) {
  JointMotions at = {};
  const Rows rows = rows_of(system, *joint.joint, joint.markers, t, at);
  std::vector<int> all;
  for (int i = 0; i < joint.rows; ++i) {
    bool has_direction = false;
    for (int k = 0; k < int(joint.markers.size()); ++k) has_direction = has_direction || !rows.H(k).row(i).isZero(0);
    if (!has_direction) all.push_back(i);
  }
  return all;
}

Offset norm(const std::vector<RowOffset>& rows) {
  Offset all;
  for (const RowOffset& row : rows) {
    all.position = std::hypot(all.position, row.position);
    all.velocity = std::hypot(all.velocity, row.velocity);
  }
  return all;
}

}  // namespace trammel::simulate
