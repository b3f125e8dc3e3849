// All data of a plate that depend on its mesh alone: shape functions at the quadrature points, mass, the free
// coordinates.
//
// Total Lagrangian: shape data are evaluated once per mesh and kept. u are the displacements of all control points, q
// the coordinates that the edge conditions leave (elimination.hpp). Integration is over Bezier cells, with `quadrature`
// points a direction for the elastic part and 4, which is exact on a flat plate, for the mass.
#pragma once

#include "tspline_plate/mesh/control_net.hpp"
#include "tspline_plate/mesh/elimination.hpp"
#include "tspline_plate/mesh/multipatch.hpp"
#include "tspline_plate/shell/material_point.hpp"

namespace trammel::plate {

inline constexpr int most_functions = 32;  // of one cell; 16 if the mesh is analysis-suitable, 17 or 18 in the paper's

// One Bezier cell. Arrays of functions are padded with zeros to a multiple of four.
struct Cell {
  int functions = 0, padded = 0;
  std::vector<int> nodes;  // control points by number
  std::vector<int> dofs;   // coordinates that move the cell
  struct Local {
    int component, dof;  // 3 * function + axis, position in `dofs`
    double factor;
  };
  std::vector<Local> terms;  // u_component = sum factor q_dof
  bool plain = false;        // terms are the identity
  std::vector<ReferencePoint> points;
  std::vector<double> weight;  // reference area of each point [m^2]
  std::vector<double> shape;   // rows R_u, R_v, R_uu, R_vv, R_uv of each point, (5 points) x padded
  std::vector<double> value;   // R at each point, points x padded
  std::vector<double> mass;    // rho h int R_I R_J dA [kg], padded x padded
};

struct PlateData {
  Section section;
  double density = 0;  // [kg/m^3]
  int quadrature = 3;
};

class Discretisation {
 public:
  // `hold` adds the conditions of edges and seams. Throws std::invalid_argument: a surface that is degenerate at a
  // quadrature point.
  template <class Hold>
  Discretisation(const std::vector<ControlNet>& patches, const PlateData& data, Hold hold)
      : basis(functions_of(patches)), points(points_of(patches)), coordinates(3 * basis.size()) {
    hold(*this, coordinates);
    coordinates.finish();
    integrate(data);
  }

  Multipatch basis;
  Points points;            // of the reference
  Elimination coordinates;  // u = B q
  std::vector<Cell> cells;
  Vec lumped;  // rho h int R_i dA of each control point [kg]: total mass, static moments, gravity
  Vec area;    // int R_i dA [m^2]

 private:
  static std::vector<TsplineBasis> functions_of(const std::vector<ControlNet>& patches);
  static Points points_of(const std::vector<ControlNet>& patches);
  void integrate(const PlateData& data);
  void connect(int c, Cell& cell) const;
  void number_coordinates(Cell& cell) const;
  void sample_shapes(int c, const PlateData& data, Cell& cell) const;
  void integrate_mass(int c, double surface_density, Cell& cell);
};

}  // namespace trammel::plate
