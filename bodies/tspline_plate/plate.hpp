// A thin plate or shell without rotational coordinates: Kirchhoff-Love on rational bicubic T-splines, St
// Venant-Kirchhoff material, any displacements. It may replace its mesh by a finer one during the run.
//
//     r(u, v, t) = sum R_i (P_i + u_i),   M q'' = -dU/dq - damping + loads,   u = B q
//     U = 1/2 int (h eps^T C^ eps + h^3/12 kappa^T C^ kappa) dA,    M = rho h int R_i R_j dA (constant)
//
// q are displacements of control points, 0 in the reference, without those that the edges hold (elimination.hpp).
// Kiendl, Bletzinger, Linhard, Wuechner, CMAME 198, 2009; Wang, Cui, Yu, Lan, Lu, Chinese Journal of Theoretical and
// Applied Mechanics 53(8), 2021. The latter's formulas are missing in the available print; these are Kiendl's.
#pragma once

#include <optional>

#include <trammel/awaits_contact.hpp>
#include <trammel/body.hpp>
#include <trammel/faces.hpp>
#include <trammel/fidelity.hpp>
#include <trammel/fields.hpp>
#include <trammel/observed_units.hpp>
#include <trammel/parameters.hpp>

#include "tspline_plate/conditions/edge.hpp"
#include "tspline_plate/conditions/loads.hpp"
#include "tspline_plate/conditions/seam.hpp"
#include "tspline_plate/mesh/patch.hpp"
#include "tspline_plate/shell/discretisation.hpp"
#include "tspline_plate/shell/refinement_trigger.hpp"
#include "tspline_plate/shell/stress.hpp"
#include "tspline_plate/shell/surface_point.hpp"

namespace trammel::plate {

// Two edges that the scene joins, by name.
struct Joined final : Component {
  std::string from, to;
  Continuity continuity = Continuity::C1;
};
Declaration joined_declaration();

class TsplinePlate final : public Body,
                           public ExactTangent,
                           public CarriedStress,
                           public ReactionDerivative,
                           public Observed,
                           public Drawn,
                           public HasFields,
                           public HasFaces,
                           public ObservedUnits,
                           public Surface,
                           public SampledSurface,
                           public SlidingSurface,
                           public Refinable,
                           public AwaitsContact,
                           public HasFidelity,
                           public HasMomentum {
 public:
  // Parameters; see the declaration in plugin.cpp.
  Patch sole_patch;            // of a plate of one patch
  Named<Patch> named_patches;  // of others
  Named<Joined> joined;

  double thickness = 0, density = 0, youngs_modulus = 0, poissons_ratio = 0.3;
  int quadrature = 3;
  std::string held_axes;

  double mass_damping = 0, stiffness_damping = 0;
  TimeFunction pressure, load_factor{1.0};
  Vec3 load = Eigen::Vector3d::Zero();
  Vec3 velocity = Eigen::Vector3d::Zero(), angular_velocity = Eigen::Vector3d::Zero();

  std::string refine_on;
  std::optional<double> refine_at;
  std::vector<double> refine_elements;
  std::optional<double> refine_near, refine_threshold;
  Indicator indicator = Indicator::none;
  int refine_levels = 1;

  void prepare(const World& world) override;

  // The mesh of a plate of one patch, unless its elements or lines are named by their numbers.
  std::vector<FidelityParameter> fidelity() const override;

  Coordinates coordinates() const override { return Coordinates::flat(mesh_->coordinates.coordinates()); }
  void initial(Out q, Out v) const override;
  void mass(double t, In q, Matrix& M) const override;
  bool mass_is_constant() const override { return true; }
  void force(double t, In q, In v, Out f) const override;
  Energy energy(double t, In q, In v) const override;
  Power power(double t, In q, In v) const override;
  std::span<const std::string> markers() const override { return marker_names_; }
  void motion(int marker, double t, In q, In v, Motion& motion) const override;

  void add_tangent(double t, In q, In v, In a, Blend c, Matrix& S) const override;
  void add_tangent_with_stress_from(double t, In q, In q_from, In dq, double c, Matrix& S) const override;
  void add_reaction_derivative(int marker, double t, In q, const Wrench& F, double c, Matrix& S) const override;

  std::span<const std::string> observables() const override { return observable_names_; }
  double observe(int observable, double t, In q, In v) const override;
  std::string_view unit(int observable) const override;
  void shape(double t, In q, Mat& points) const override;
  std::span<const std::string> fields() const override { return std::span(observable_names_).first(3); }
  void fields_at(double t, In q, In v, std::vector<FieldPatch>& patches) const override;
  std::string face_values() const override { return "von Mises stress on the top [Pa]"; }
  void faces(double t, In q, FaceMesh& mesh) const override;

  void nearest(double t, In q, const Vec3& x, Eigen::Vector2d& parameters, Vec3& point, Vec3& normal) const override;
  void motion_at(const Eigen::Vector2d& parameters, double t, In q, In v, Motion& motion) const override;

  double half_thickness() const override { return thickness / 2; }
  int patches() const override { return int(mesh_->cells.size()); }
  void bounds(int patch, In q, Vec3& low, Vec3& high) const override;
  void sample(int patch, double spacing, SurfacePatch& out) const override;
  void jet(const Eigen::Vector2d& parameters, In q, SurfaceJet& out) const override;
  void nearest_on(std::span<const int> patches, In q, const Vec3& x, Eigen::Vector2d& parameters,
                  Vec3& point) const override;

  bool due(double t, In q, In v, const RefineCause& cause) const override;
  std::unique_ptr<Transfer> refine(double t, In q, In v, const RefineCause& cause) override;
  std::string awaited_contact() const override { return refine_on; }
  std::string where_awaited() const override { return "refine.on_contact"; }
  void archive(Archive& archive) override;
  Momentum momentum(double t, In q, In v) const override;

  // Crosses these elements, and the elements across seams where both sides must be divided alike, closes the mesh and
  // adopts it; returns the transfer of q and v.
  std::unique_ptr<Transfer> refine_elements_in(const std::vector<Box<double>>& boxes);
  const Discretisation& mesh() const { return *mesh_; }
  CellEnergy strain_energy(In q) const;
  StressState stress_at(double u, double v, In q) const;

 private:
  struct Marker {
    double u, v, height;
    SurfacePoint point;
  };

  struct MomentEdge {
    int patch;
    std::size_t edge;  // of `edges`
    std::vector<EdgePoint> points;
  };

  int patch_count() const { return named_patches.empty() ? 1 : int(named_patches.size()); }
  const Patch& given(int k) const { return named_patches.empty() ? sole_patch : named_patches[std::size_t(k)].second; }
  std::string in_patch(int k) const;  // "roof." before the names of what is in that patch; "" if there is but one
  PatchEdge edge_named(const std::string& name) const;  // "roof.u1", "u1"
  void check_parameters(const World& world) const;
  void check_refinement() const;
  void check_joined() const;
  std::vector<ControlNet> first_nets() const;
  void take(const std::vector<ControlNet>& nets);  // builds everything that depends on the mesh
  void hold(const Discretisation& mesh, Elimination& coordinates);
  void add_markers(int patch, const Box<double>& range, double own_u);
  void place_markers();
  bool chooses_elements() const { return refine_near || indicator != Indicator::none; }
  std::vector<Box<double>> elements_near(const Eigen::Vector2d& at) const;
  double distance(const Eigen::Vector2d& from, const Box<double>& element) const;
  std::vector<Box<double>> indicated(In q, std::span<const double> contact_pressure) const;
  std::vector<Box<double>> chosen(double t, In q, const RefineCause& cause) const;  // none: nothing is due
  void gather_dead_loads();
  void add_loads(double t, In q, Out f) const;
  void add_load_tangent(double t, In q, double c, Matrix& S) const;
  double dead_factor(double t) const { return load_factor(t); }
  bool damped() const { return mass_damping > 0 || stiffness_damping > 0; }

  Eigen::Vector3d gravity_ = Eigen::Vector3d::Zero();
  std::unique_ptr<Discretisation> mesh_;
  Vec weight_force_;  // of gravity, on q [N]
  Vec dead_force_;    // of `load`, edge_force, edge_pressure at load_factor 1
  std::vector<MomentEdge> moment_edges_;
  std::vector<Seam> seams_;
  std::vector<std::string> marker_names_, observable_names_;
  std::vector<Marker> marker_points_;
  std::vector<std::vector<Box<double>>> refinements_;  // crossed so far, to be repeated when a run resumes
  std::vector<Box<double>> first_elements_;            // of the first mesh
  Splittable splittable_;                              // empty unless the plate chooses elements by itself
};

}  // namespace trammel::plate
