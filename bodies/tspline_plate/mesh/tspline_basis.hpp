// The rational bicubic T-spline basis of a T-mesh.
//
//     B_i(u, v) = N[u_i](u) N[v_i](v),    R_i = w_i B_i / W,    W = sum w_j B_j,    r(u, v) = sum R_i P_i
//
// One function per anchor: a vertex of the T-mesh with line numbers 2 to m - 2 in both directions (m: the last line).
// Its knots u_i, v_i are its own lines and the next two that touch a ray to either side. On a Bezier cell, a face of
// the mesh with all face extensions drawn, each function is one polynomial; it is kept by its Bernstein coefficients
// there.
#pragma once

#include <Eigen/Core>

#include "tspline_plate/mesh/blending.hpp"
#include "tspline_plate/mesh/t_mesh.hpp"

namespace trammel::plate {

struct Anchor {
  Index2 at;  // lines of the T-mesh
  std::array<LocalKnots, 2> knots;
  std::array<Index2, 2> support;  // first and last line, per direction
};

// By rows from below: ascending v, then u.
std::vector<Anchor> anchors(const TMesh& mesh);

struct BezierCell {
  Box<double> parameters;
  std::vector<int> functions;  // those whose support overlaps the cell; 16 if the mesh is analysis-suitable
};

// The functions of one cell at one point: R and its derivatives, in the order of the cell's functions.
struct ShapeValues {
  Eigen::VectorXd R, R_u, R_v, R_uu, R_vv, R_uv;
};

class TsplineBasis {
 public:
  TsplineBasis(TMesh mesh, Eigen::VectorXd weights);  // one weight per anchor, positive
  explicit TsplineBasis(TMesh mesh);                  // all weights 1

  const TMesh& mesh() const { return mesh_; }
  int size() const { return int(anchors_.size()); }
  const std::vector<Anchor>& anchors() const { return anchors_; }
  const Eigen::VectorXd& weights() const { return weights_; }
  const std::vector<BezierCell>& cells() const { return cells_; }

  // The cell that contains a point of the patch; for a point on a line, the cell at higher parameters.
  int cell_at(double u, double v) const;
  // B_i, without weights, by the functions of the cell.
  void blending(int cell, double u, double v, Eigen::VectorXd& B) const;
  void evaluate(int cell, double u, double v, ShapeValues& out) const;

 private:
  using Coefficients = std::array<std::array<double, 4>, 2>;
  TMesh mesh_;
  std::vector<Anchor> anchors_;
  Eigen::VectorXd weights_;
  std::vector<BezierCell> cells_;
  std::vector<std::vector<Coefficients>> coefficients_;  // per cell and function
  std::vector<int> cell_of_unit_;                        // of unit squares of index space, by rows
};

}  // namespace trammel::plate
