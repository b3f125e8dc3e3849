// A slender beam by assumed modes: a floating frame at the root that turns by theta, axial and transverse cantilever
// modes, and the foreshortening caused by bending.
//
//     r = o + R(theta) (r_h + x + u_x, u_y),    u_x = Phi_x A - 1/2 B^T H(x) B,    u_y = Phi_y B
//     q = ([o_x, o_y,] [theta,] A_1..A_n, B_1..B_N)        o only for mount "free", theta not for mount "clamped"
//
// Guo, Zhang, Chen, Acta Physica Sinica 66, 164501 (2017), eqs (1) to (4), here by the acceleration of the material:
//
//     M = int rho S J^T J dx,    f = -int rho S J^T (alpha - gravity) dx - (0, 0, K1 A, K2 B),
//
// J = (d r / d q) and alpha the acceleration at v' = 0, both in the beam's axes. Euler-Bernoulli; no rotary inertia of
// the cross section; axial strain is that of Phi_x A alone.
//
// `coupling` selects how deformation and overall motion are coupled:
//     full     the above
//     linear   without foreshortening (H = 0): wrong beyond slow rotation, where it misses the geometric stiffening
//     none     the inertia of the undeformed beam: a constant mass matrix, no gyroscopic or centrifugal terms
// Each is the Lagrangian system of its own kinetic energy, so each conserves energy. `none` needs a root that is held:
// with a free one, its kinetic energy would depend on a uniform motion of the whole.
#pragma once

#include <optional>

#include <trammel/body.hpp>
#include <trammel/fidelity.hpp>
#include <trammel/natural_boundary.hpp>
#include <trammel/observed_units.hpp>
#include <trammel/parameters.hpp>
#include <trammel/theory_limit.hpp>
#include <trammel/time_function.hpp>

#include "inertia_basis.hpp"
#include "sizes.hpp"

namespace trammel::beam {

enum class Coupling { none, linear, full };

class AssumedModeBeam final : public Body,
                              public MassAndForce,
                              public ExactTangent,
                              public ReactionDerivative,
                              public HasFidelity,
                              public Observed,
                              public ObservedUnits,
                              public Drawn,
                              public TheoryLimit,
                              public NaturalBoundary {
 public:
  // Parameters; see the declaration in plugin.cpp.
  double length = 1, area = 0, second_moment = 0, density = 0, youngs_modulus = 0;
  int axial_modes = 0, transverse_modes = 0;
  bool static_axial = false, static_transverse = false;  // static_functions.hpp
  Coupling coupling = Coupling::full;
  std::optional<Vec3> hinge, clamped, free;
  double angle = 0, angular_velocity = 0;
  Vec3 velocity;
  double hub_inertia = 0, hub_radius = 0;
  TimeFunction torque;
  Named<double> extra_markers;
  std::vector<double> axial, transverse, axial_rate, transverse_rate;

  AssumedModeBeam();
  void prepare(const World& world) override;

  Coordinates coordinates() const override { return Coordinates::flat(n_); }
  void initial(Out q, Out v) const override;
  void mass(double t, In q, Matrix& M) const override;
  bool mass_is_constant() const override { return coupling == Coupling::none; }
  void force(double t, In q, In v, Out f) const override;
  void mass_and_force(double t, In q, In v, Matrix& M, Out f) const override;
  Energy energy(double t, In q, In v) const override;
  Power power(double t, In q, In v) const override;
  std::span<const std::string> markers() const override { return marker_names_; }
  void motion(int marker, double t, In q, In v, Motion& motion) const override;

  void add_tangent(double t, In q, In v, In a, Blend c, Matrix& S) const override;
  void add_reaction_derivative(int marker, double t, In q, const Wrench& F, double c, Matrix& S) const override;

  std::vector<FidelityParameter> fidelity() const override {
    return {{"modes.axial"}, {"modes.transverse"}, {"coupling", {}, {"none", "linear", "full"}}};
  }

  std::span<const std::string> observables() const override { return observable_names_; }
  double observe(int observable, double t, In q, In v) const override;
  std::string_view unit(int observable) const override;
  void shape(double t, In q, Mat& points) const override;

  Bounds bounds() const override;
  double stretched(double t, In q) const override;

  std::optional<Slow> under_moment(int marker) const override;

 private:
  // Coefficients in the inertia basis of L = X0 + Phi_x A, F = 1/2 B^T H B, X = L - F, Y = Phi_y B, and the rows p_i =
  // (H B)_i. Those of F and p are followed by their integrals with Phi_x, like the rows of H. On the stack: no
  // allocation, and several threads may use one beam.
  struct Deformation {
    alignas(64) double L[InertiaBasis::most], X[InertiaBasis::most], Y[InertiaBasis::most];
    alignas(64) double F[InertiaBasis::most_row], p[most_functions * InertiaBasis::most_row];
  };
  AnySizes sizes() const;
  template <class Sizes>
  void deform(const Sizes& s, In q, Deformation& at) const;
  void deform(In q, Deformation& at) const;
  template <class Sizes>
  void foreshorten(const Sizes& s, const double* b, double* rows) const;  // (H b)_i as rows
  template <class Sizes>
  void bending_square(const Sizes& s, const double* b, double* y) const;  // y = b^T H b
  template <class Sizes>
  void shortening_rate(const Sizes& s, const Deformation& at, const double* Bd, double* P) const;
  template <class Sizes>
  double turning_inertia(const Sizes& s, const double* A, const double* B, const Deformation& at) const;
  template <class Sizes>
  Eigen::Vector2d first_moment(const Sizes& s, const double* A, const double* B, const Deformation& at) const;
  Eigen::Vector2d first_moment(In q, const Deformation& at) const;

  double theta(In q) const { return i_theta_ >= 0 ? q(i_theta_) : angle; }
  double omega(In v) const { return i_theta_ >= 0 ? v(i_theta_) : 0; }
  Eigen::Vector2d origin(In q) const;

  // The equations of motion for the couplings full and linear ...
  template <class Sizes>
  void add_mass(const Sizes& s, In q, const Deformation& at, Matrix& M) const;
  void add_origin_mass(In q, const Deformation& at, Matrix& M) const;
  template <class Sizes>
  void add_force(const Sizes& s, In q, In v, const Deformation& at, Out f) const;
  void add_coupled_mass(In q, Matrix& M) const;
  void add_coupled_force(In q, In v, Out f) const;
  void add_coupled_mass_and_force(In q, In v, Matrix& M, Out f) const;
  double coupled_kinetic_energy(In q, In v, const Deformation& at) const;
  // ... their tangent ...
  struct TangentPoint;
  template <class Sizes>
  void prepare_tangent(const Sizes& s, In q, TangentPoint& t) const;
  template <class Sizes>
  void add_modal_tangent(const Sizes& s, const TangentPoint& t, Matrix& S) const;
  template <class Sizes>
  void add_turning_tangent(const Sizes& s, const TangentPoint& t, Matrix& S) const;
  void add_origin_tangent(const TangentPoint& t, Matrix& S) const;
  void add_coupled_tangent(In q, In v, In a, Blend c, Matrix& S) const;
  // ... and for the coupling none.
  void add_uncoupled_mass(double c, Matrix& M) const;
  void add_uncoupled_force(In q, Out f) const;
  void add_uncoupled_tangent(In q, Blend c, Matrix& S) const;
  double uncoupled_kinetic_energy(In v) const;

  void place_coordinates();
  Shape functions() const;
  void integrate_inertia(const Shape& shape);
  void integrate_stiffness(const Shape& shape);
  void place_markers(const Shape& shape);
  void name_observables();
  bool foreshortens() const { return coupling == Coupling::full; }
  void check_parameters(const World& world) const;
  void check_amplitudes(const char* name, const std::vector<double>& given, int functions) const;

  // Position in the beam's axes, slope of u_y and p at one point.
  struct Point {
    double X, Y, slope;
    alignas(64) double p[padded(most_functions)];
  };
  Point point(const PointShape& shape, In q) const;

  // Places in q and v; -1: none.
  int i_o_ = -1, i_theta_ = -1, i_A_ = 0, i_B_ = 0, n_ = 0;
  int n_axial_ = 0, N_ = 0;  // functions of each kind: modes and static ones
  Eigen::Vector2d gravity_ = Eigen::Vector2d::Zero();
  std::optional<InertiaBasis> basis_;
  Vec marker_x_;  // [m] places of the markers along the beam
  std::vector<PointShape> marker_shapes_, outline_shapes_;
  Mat slopes_;              // Phi_y' at places close enough to resolve the shortest wave, one row each
  double mass_ = 0;         // rho S L
  double S0_ = 0, I0_ = 0;  // int X0 dm, int X0^2 dm
  Vec Sx_, Sy_;             // int Phi_x dm, int Phi_y dm
  Vec Dx_, Dy_;             // int X0 Phi_x dm, int X0 Phi_y dm, padded
  Mat Mxy_, Myx_;           // int Phi_x^T Phi_y dm and its transpose, columns padded
  Vec K1_, K2_;
  std::vector<std::string> marker_names_, observable_names_;
};

}  // namespace trammel::beam
