// Single points of the plate: markers, nearest point for contact.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ranges>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <trammel/quadrature.hpp>

#include "tspline_plate/plate.hpp"
#include "tspline_plate/shell/pole_point.hpp"

namespace trammel::plate {

void TsplinePlate::motion(int marker, double, In q, In v, Motion& motion) const {
  plate::motion(*mesh_, marker_points_[std::size_t(marker)].point, q, v, motion);
}

void TsplinePlate::add_reaction_derivative(int marker, double, In q, const Wrench& F, double c, Matrix& S) const {
  plate::add_reaction_derivative(*mesh_, marker_points_[std::size_t(marker)].point, q, F, c, S);
}

void TsplinePlate::motion_at(const Eigen::Vector2d& parameters, double, In q, In v, Motion& motion) const {
  plate::motion(*mesh_, surface_point(*mesh_, parameters.x(), parameters.y()), q, v, motion);
}

namespace {

constexpr int most_iterations = 30;  // of Newton's method
// The full matrix is used while its determinant is at least this part of that without curvature.
constexpr double definite = 0.1;
constexpr double shortest_part = 1e-3;  // of a step
// Relative to the distance and the place: at the minimum the distance is flat, and a change as small is round-off.
constexpr double round_off_of_distance = 1e-14;
// In parameters, relative to the patch: steps that end the search, and points that are the same.
constexpr double no_step = 1e-14, same_place = 1e-7;
// A point must be nearer by this part of the distance to be preferred, so that round-off does not decide.
constexpr double nearer_by = 1e-9;
// Of a cell: rounding does not move a point so far within it to the next cell.
constexpr double within = 1 - 1e-9;
constexpr double fits = 1e-6;  // a spacing may be too large by this part of a side

struct Candidate {
  double distance;
  Eigen::Vector2d at;
  bool operator<(const Candidate& other) const { return distance < other.distance; }
};

// A point of the surface that the search has evaluated.
struct Evaluated {
  Candidate found;
  SurfacePoint point;
  Place place;
};

// Newton's method for (r - x) . r_u = (r - x) . r_v = 0 within the patch; where the full matrix is not positive
// definite, the part without curvature, which always descends. On an edge the parameter across it is fixed while it
// would leave the patch. Ends early at a point that is `known`.
Candidate descend(const Discretisation& mesh, In q, const Vector3& x, const Eigen::Vector2d& start,
                  const Candidate& known) {
  const Box<double> range = mesh.basis.range(mesh.basis.patch_at(start.x()));
  const Eigen::Vector2d low(range.low[0], range.low[1]), high(range.high[0], range.high[1]);
  const auto evaluate = [&](const Eigen::Vector2d& at) {
    SurfacePoint point = surface_point(mesh, at.x(), at.y());
    const Place p = place(mesh, point, q);
    return Evaluated{{(p.r - x).norm(), at}, std::move(point), p};
  };
  Evaluated here = evaluate(start);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Candidate from = here.found;
    const Place p = here.place;
    ShapeValues& shape = here.point.shape;
    shape.R.swap(shape.R_uv), shape.R_u.swap(shape.R_uu), shape.R_v.swap(shape.R_vv);
    const Place c = place(mesh, here.point, q);  // r_uv, r_uu, r_vv
    const Vector3 gap = p.r - x;
    const Eigen::Vector2d gradient(gap.dot(p.a1), gap.dot(p.a2));
    Eigen::Matrix2d flat, full;
    flat << p.a1.dot(p.a1), p.a1.dot(p.a2), p.a1.dot(p.a2), p.a2.dot(p.a2);
    full << flat(0, 0) + gap.dot(c.a1), flat(0, 1) + gap.dot(c.r), flat(0, 1) + gap.dot(c.r),
        flat(1, 1) + gap.dot(c.a2);
    Eigen::Matrix2d matrix = full.determinant() > definite * flat.determinant() && full(0, 0) > 0 ? full : flat;
    Eigen::Vector2d rhs = -gradient;
    for (int i = 0; i < 2; ++i)
      if ((from.at(i) <= low(i) && gradient(i) > 0) || (from.at(i) >= high(i) && gradient(i) < 0)) {
        matrix(0, 1) = matrix(1, 0) = 0;
        rhs(i) = 0;
      }
    const Eigen::Vector2d step = matrix.inverse() * rhs;
    // Round-off must not reject the last, best steps.
    const double allowed = from.distance + round_off_of_distance * (from.distance + x.norm());
    for (double scale = 1; scale > shortest_part; scale /= 2) {
      here = evaluate((from.at + scale * step).cwiseMax(low).cwiseMin(high));
      if (here.found.distance <= allowed) break;
    }
    if (here.found.distance > allowed) return from;
    const auto away = [&](const Eigen::Vector2d& at) {
      return ((here.found.at - at).array() / (high - low).array()).abs().maxCoeff();
    };
    if (away(from.at) < no_step) break;
    if (away(known.at) < same_place) return known;
  }
  return here.found;
}

constexpr double infinity = std::numeric_limits<double>::infinity();
const Candidate nowhere{infinity, {-infinity, -infinity}};

// The parameters of a pole in each of the patches that meet there.
std::vector<Eigen::Vector2d> same_pole(const Discretisation& mesh, const std::vector<Seam>& seams,
                                       const Eigen::Vector2d& at, int turning) {
  std::vector<Eigen::Vector2d> result = {at};
  std::vector<int> patches = {mesh.basis.patch_at(at.x())};
  for (std::size_t k = 0; k < result.size(); ++k) {
    const auto [low, high] = mesh.basis.range(patches[k]);
    for (const double end : {low[std::size_t(turning)], high[std::size_t(turning)]})
      for (const Seam& seam : seams) {
        Eigen::Vector2d corner = result[k];
        corner(turning) = end;
        for (const Eigen::Vector2d& there : other_sides(mesh.basis, seam, corner)) {
          const int patch = mesh.basis.patch_at(there.x());
          if (turning_at_pole(mesh, there) != turning || std::ranges::find(patches, patch) != patches.end()) continue;
          result.push_back(there), patches.push_back(patch);
        }
      }
  }
  return result;
}

// Points from which the search continues: across the seams that a point lies on, and around a pole in several
// directions.
std::vector<Eigen::Vector2d> ways_on(const Discretisation& mesh, const std::vector<Seam>& seams,
                                     const Eigen::Vector2d& at) {
  constexpr int directions = 8;    // in each patch
  constexpr double beside = 1e-3;  // the pole, as a fraction of the patch
  std::vector<Eigen::Vector2d> result;
  for (const Seam& seam : seams) std::ranges::copy(other_sides(mesh.basis, seam, at), std::back_inserter(result));
  const auto turning = turning_at_pole(mesh, at);
  if (!turning) return result;
  for (const Eigen::Vector2d& pole : same_pole(mesh, seams, at, *turning)) {
    const Box<double> range = mesh.basis.range(mesh.basis.patch_at(pole.x()));
    const Eigen::Vector2d low(range.low[0], range.low[1]), high(range.high[0], range.high[1]);
    for (int k = 0; k < directions; ++k) {
      Eigen::Vector2d start = pole + beside * ((low + high) / 2 - pole);
      start(*turning) = low(*turning) + (k + 0.5) / directions * (high - low)(*turning);
      result.push_back(start);
    }
  }
  return result;
}

// If the search for the nearest point ends at a seam or a pole, it continues from there as long as the distance
// decreases.
Candidate onwards(const Discretisation& mesh, const std::vector<Seam>& seams, In q, const Vector3& x, Candidate best) {
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (const Eigen::Vector2d& start : ways_on(mesh, seams, best.at)) {
      const Candidate other = descend(mesh, q, x, start, nowhere);
      if (!(other.distance < best.distance * (1 - nearer_by))) continue;
      best = other, nearer = true;
      break;
    }
  }
  return best;
}

// From the middles of the three nearest of these cells: a folded sheet has several nearby points.
Candidate nearest_among(const Discretisation& mesh, const std::vector<Seam>& seams,
                        const std::ranges::range auto& cells, In q, const Vector3& x) {
  Candidate starts[3];
  int found = 0;
  CellVectors u;
  for (const int c : cells) {
    const Cell& cell = mesh.cells[std::size_t(c)];
    const auto& [low, high] = mesh.basis.cells()[std::size_t(c)].parameters;
    gather(cell, q, u);
    const double* R = &cell.value[cell.points.size() / 2 * std::size_t(cell.padded)];  // a point in the middle
    Vector3 r = Vector3::Zero();
    for (int f = 0; f < cell.functions; ++f)
      r += R[f] * (mesh.points.row(cell.nodes[std::size_t(f)]).transpose() +
                   Vector3(u[f], u[cell.padded + f], u[2 * cell.padded + f]));
    const Candidate middle{(r - x).norm(), {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2}};
    if (found < 3)
      starts[found++] = middle;
    else if (middle < starts[2])
      starts[2] = middle;
    std::sort(starts, starts + found);
  }
  Candidate best = nowhere;
  for (int k = 0; k < found; ++k) {
    const Candidate other = descend(mesh, q, x, starts[k].at, best);
    if (other.distance < best.distance * (1 - nearer_by)) best = other;
  }
  return onwards(mesh, seams, q, x, best);
}

}  // namespace

void TsplinePlate::nearest(double, In q, const Vec3& x, Eigen::Vector2d& parameters, Vec3& point, Vec3& normal) const {
  parameters = nearest_among(*mesh_, seams_, std::views::iota(0, patches()), q, x).at;
  const Place at = place(*mesh_, surface_point(*mesh_, parameters.x(), parameters.y()), q);
  point = at.r;
  normal = at.a1.cross(at.a2).normalized();
}

void TsplinePlate::nearest_on(std::span<const int> patches, In q, const Vec3& x, Eigen::Vector2d& parameters,
                              Vec3& point) const {
  parameters = nearest_among(*mesh_, seams_, patches, q, x).at;
  point = place(*mesh_, surface_point(*mesh_, parameters.x(), parameters.y()), q).r;
}

// A cell lies in the convex hull of its control points, as its functions are not negative and sum to 1.
void TsplinePlate::bounds(int patch, In q, Vec3& low, Vec3& high) const {
  const Cell& cell = mesh_->cells[std::size_t(patch)];
  CellVectors u;
  gather(cell, q, u);
  Vector3 least = Vector3::Constant(std::numeric_limits<double>::infinity()), most = -least;
  for (int f = 0; f < cell.functions; ++f) {
    const Vector3 at = mesh_->points.row(cell.nodes[std::size_t(f)]).transpose() +
                       Vector3(u[f], u[cell.padded + f], u[2 * cell.padded + f]);
    least = least.cwiseMin(at), most = most.cwiseMax(at);
  }
  low = least, high = most;
}

namespace {

// The points along one side of a cell, from 0 to 1. With a limited spacing they are the midpoints of equal parts, which
// integrate functions that are no polynomials (the rim of the area that a sphere touches) as well as any rule.
// Otherwise they are four Gauss points, which are exact for products of two cubics, so that a uniform pressure gives a
// uniform displacement.
Quadrature along_side(double length, double spacing) {
  if (!std::isfinite(spacing)) return gauss_legendre(4, 0, 1);
  const int n = std::max(1, int(std::ceil(length / spacing - fits)));
  return {(Vec::LinSpaced(n, 0, n - 1).array() + 0.5) / n, Vec::Constant(n, 1.0 / n)};
}

}  // namespace

void TsplinePlate::sample(int patch, double spacing, SurfacePatch& out) const {
  const Cell& cell = mesh_->cells[std::size_t(patch)];
  const auto& [low, high] = mesh_->basis.cells()[std::size_t(patch)].parameters;
  const double du = high[0] - low[0], dv = high[1] - low[1];
  const Vec still = Vec::Zero(mesh_->coordinates.coordinates());
  double along_u_longest = 0, along_v_longest = 0;
  for (const double a : {0.0, 0.5, 1.0})
    for (const double b : {0.0, 0.5, 1.0}) {
      const Place at = place(*mesh_, surface_point(*mesh_, low[0] + within * a * du, low[1] + within * b * dv), still);
      along_u_longest = std::max(along_u_longest, at.a1.norm() * du);
      along_v_longest = std::max(along_v_longest, at.a2.norm() * dv);
    }
  const Quadrature u = along_side(along_u_longest, spacing), v = along_side(along_v_longest, spacing);
  const Eigen::Index n = u.x.size(), m = v.x.size();
  out.dofs = cell.dofs;
  out.R.resize(n * m, cell.functions);
  out.X.resize(n * m, 3);
  out.area.resize(n * m);
  Eigen::Index k = 0;
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = 0; i < n; ++i, ++k) {
      const SurfacePoint at = surface_point(*mesh_, low[0] + u.x(i) * du, low[1] + v.x(j) * dv);
      const Place reference = place(*mesh_, at, still);
      out.R.row(k) = at.shape.R.head(cell.functions).transpose();
      out.X.row(k) = reference.r.transpose();
      out.area(k) = reference.a1.cross(reference.a2).norm() * du * u.weight(i) * dv * v.weight(j);
    }
  out.B.resize(0, 0);
  if (cell.plain) return;
  out.B.setZero(3 * cell.functions, Eigen::Index(cell.dofs.size()));
  for (const Cell::Local& t : cell.terms) out.B(t.component, t.dof) += t.factor;
}

void TsplinePlate::jet(const Eigen::Vector2d& parameters, In q, SurfaceJet& out) const {
  const double u = parameters.x(), v = parameters.y();
  const SurfacePoint at = surface_point(*mesh_, u, v);
  SurfacePoint second = at;
  second.shape.R = at.shape.R_uv, second.shape.R_u = at.shape.R_uu, second.shape.R_v = at.shape.R_vv;
  const Place first_order = place(*mesh_, at, q), second_order = place(*mesh_, second, q);
  out.r = first_order.r, out.r_u = first_order.a1, out.r_v = first_order.a2;
  out.r_uv = second_order.r, out.r_uu = second_order.a1, out.r_vv = second_order.a2;
  const Box<double> range = mesh_->basis.range(mesh_->basis.patch_at(u));
  const auto end = [](double x, double low, double high) { return int(x >= high) - int(x <= low); };
  out.end = {end(u, range.low[0], range.high[0]), end(v, range.low[1], range.high[1])};
  out.patch = at.cell;
  const Cell& cell = mesh_->cells[std::size_t(at.cell)];
  out.dofs = cell.dofs;
  for (Mat* J : {&out.J, &out.J_u, &out.J_v}) J->setZero(3, Eigen::Index(cell.dofs.size()));
  for (const Cell::Local& t : cell.terms) {
    const int k = t.component % 3;
    const Eigen::Index f = t.component / 3;
    out.J(k, t.dof) += t.factor * at.shape.R(f);
    out.J_u(k, t.dof) += t.factor * at.shape.R_u(f);
    out.J_v(k, t.dof) += t.factor * at.shape.R_v(f);
  }
}

}  // namespace trammel::plate
