// A body: a block of coordinates with its mass, forces, energy and markers. It sees no joint, contact or integrator.
//
//     M(q) a = f(t, q, v)       for the body alone, gravity included
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <trammel/archive.hpp>
#include <trammel/component.hpp>
#include <trammel/marker.hpp>
#include <trammel/matrix.hpp>
#include <trammel/system.hpp>
#include <trammel/transfer.hpp>

namespace trammel {

// The structure of a body's configuration. It defines N(q), retraction, difference and normalisation.
class Coordinates {
 public:
  enum class Kind {
    flat,      // n numbers and their n rates
    rotation,  // a unit quaternion (w, x, y, z) and the angular velocity in body axes: 4 numbers, 3 rates
  };
  struct Part {
    Kind kind;
    int nq, nv;
  };

  static Coordinates flat(int n);
  Coordinates& then_flat(int n);
  Coordinates& then_rotation();

  std::span<const Part> parts() const { return parts_; }
  int nq() const;
  int nv() const;

 private:
  std::vector<Part> parts_;
};

class Body : public Component {
 public:
  virtual Coordinates coordinates() const = 0;
  virtual void initial(Out q, Out v) const = 0;  // configuration and velocity at the start, from the body's parameters

  virtual void mass(double t, In q, Matrix& M) const = 0;  // adds M (nv x nv), symmetric
  virtual bool mass_is_constant() const { return false; }
  virtual void force(double t, In q, In v, Out f) const = 0;  // adds f (nv): elastic, gyroscopic, gravity, drives
  virtual Energy energy(double t, In q, In v) const = 0;
  virtual Power power(double /*t*/, In /*q*/, In /*v*/) const { return {}; }  // of the body's own drives and dampers

  virtual std::span<const std::string> markers() const = 0;
  // Fills every member of `motion`. It is called many times with the same object, so constant members may be kept.
  virtual void motion(int marker, double t, In q, In v, Motion& motion) const = 0;
};

// Abilities. Where a derivative is missing, the framework takes differences within this body only.

// Declares that one Motion object may serve the markers of all bodies of the class in turn, whatever their parameters:
// the members that motion() keeps, sizes and dofs included, are the same for all of them.
class SharedMotion {
 public:
  virtual ~SharedMotion();
};

// Mass and force at one point in one call, for a body whose mass and force share intermediate results.
class MassAndForce {
 public:
  virtual ~MassAndForce();
  virtual void mass_and_force(double t, In q, In v, Matrix& M, Out f) const = 0;
};

// Exact derivatives: S += c_m M + c_d D + c_k K with D = -df/dv, K = d(M a - f)/dq (increments in the tangent space).
class ExactTangent {
 public:
  virtual ~ExactTangent();
  virtual void add_tangent(double t, In q, In v, In a, Blend c, Matrix& S) const = 0;
};

// For statics of thin bodies. An increment that bends a sheet also stretches it by the square of the rotation. Newton's
// iteration removes this stretch later, but its stresses spoil the next tangent. Adds S += c K at rest, where the part
// of K that is due to stress uses stresses linear in the increment, stress(from) + d(stress)/dq dq (mixed integration
// points; Magisano, Leonardi, Garcea, Int. J. Numer. Meth. Engng. 109, 2017). With from = q and dq = 0 it is the exact
// tangent.
class CarriedStress {
 public:
  virtual ~CarriedStress();
  virtual void add_tangent_with_stress_from(double t, In q, In from, In dq, double c, Matrix& S) const = 0;
};

// S += c d(J^T F)/dq for a constant wrench F at a marker: the geometric stiffness of joints and contacts.
class ReactionDerivative {
 public:
  virtual ~ReactionDerivative();
  virtual void add_reaction_derivative(int marker, double t, In q, const Wrench& F, double c, Matrix& S) const = 0;
};

// Constraint rows between a body's own coordinates, enforced like those of joints: for example, the constant length of
// a rod in natural coordinates.
//     g(t, q) = 0,      g_dot = G v + g_t,      G v' = gamma
struct BodyRows {
  Vec g, g_t, gamma;  // (n); g_t: partial derivative by time
  Mat G;              // n x nv

  // Sets n rows, all zero.
  void resize(int n, int nv);
};
class Constrained {
 public:
  virtual ~Constrained();
  virtual int row_count() const = 0;  // constant except at a refinement
  // On entry `rows` has row_count rows, all zero.
  virtual void own_rows(double t, In q, In v, BodyRows& rows) const = 0;
  // S += c d(G^T lambda)/dq
  virtual void add_own_rows_derivative(double t, In q, In lambda, double c, Matrix& S) const = 0;
};

// Named scalars of a body beyond its markers' motion, for recording: "angle", "transverse_1".
class Observed {
 public:
  virtual ~Observed();
  virtual std::span<const std::string> observables() const = 0;
  virtual double observe(int observable, double t, In q, In v) const = 0;
};

// The body's shape for plots and animation: a polyline in world axes, one column per point (2 or 3 rows).
class Drawn {
 public:
  virtual ~Drawn();
  virtual void shape(double t, In q, Mat& points) const = 0;
};

// Why and where a body is asked to refine.
struct RefineCause {
  // Name in the scene of the contact that has just closed. Empty: a step has ended, and the body may apply its own
  // criteria (a time, an error indicator).
  std::string_view contact;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // surface parameters (u, v) of the place; 0 for a body without Surface
  // When a step has ended: the largest contact pressure on each patch of the body's SampledSurface [Pa]; empty: none.
  std::span<const double> pressure = {};
};

// A body that may replace its coordinates during the run (mesh refinement).
class Refinable {
 public:
  virtual ~Refinable();
  // Called after every step and every closing of a contact of the body; must be cheap while there is nothing to do.
  virtual bool due(double t, In q, In v, const RefineCause& cause) const = 0;
  // Called when due; null: nothing could be refined. Afterwards coordinates(), mass, force and motion() refer to the
  // refined body. Markers keep their names and indices; Motion objects are created anew. The framework maps q and v by
  // the transfer and solves for a and lambda again.
  virtual std::unique_ptr<Transfer> refine(double t, In q, In v, const RefineCause& cause) = 0;
  // The data that rebuild the refined coordinates when a run resumes; coordinates() is called after reading.
  virtual void archive(Archive&) = 0;
};

// Mass and momentum, for the balance before and after a refinement.
struct Momentum {
  double mass = 0;  // [kg]
  Vec3 linear;      // [kg m/s], world axes
  Vec3 angular;     // about the origin of the world [kg m^2/s]: 1 entry planar, 3 spatial
};
class HasMomentum {
 public:
  virtual ~HasMomentum();
  virtual Momentum momentum(double t, In q, In v) const = 0;
};

// Nearest point on a body's surface, for contact. The point is given by surface parameters (u, v).
class Surface {
 public:
  virtual ~Surface();
  virtual void nearest(double t, In q, const Vec3& x, Eigen::Vector2d& parameters, Vec3& point, Vec3& normal) const = 0;
  virtual void motion_at(const Eigen::Vector2d& parameters, double t, In q, In v, Motion& motion) const = 0;
  // Distance from this surface to the body's faces on both sides [m].
  virtual double half_thickness() const { return 0; }
};

// Material points of one part of a surface (a cell of a mesh), interpolated from its nodes: x_p = X_p + sum_I R_pI u_I
// with the nodal displacements u_I = B q[dofs].
struct SurfacePatch {
  std::vector<int> dofs;  // coordinates of the body that move it
  Mat R;                  // points x nodes
  Mat X;                  // points x 3, positions at q = 0 [m]
  Mat B;                  // (3 nodes) x dofs, node by node; empty: the identity
  Vec area;               // of the surface that each point represents [m^2]
};
// Ability of spatial bodies that also have Surface and flat coordinates: the points that a contact pressure acts on.
// They are constant except at a refinement.
class SampledSurface {
 public:
  virtual ~SampledSurface();
  virtual int patches() const = 0;
  // A box in world axes that contains the patch.
  virtual void bounds(int patch, In q, Vec3& low, Vec3& high) const = 0;
  // Points at most `spacing` [m] apart. Infinite: the fewest that integrate products of two shape functions exactly.
  virtual void sample(int patch, double spacing, SurfacePatch& out) const = 0;
};

// A surface near one of its points: derivatives of the point by the coordinates and by the parameters (u, v).
struct SurfaceJet {
  int patch = 0;                                  // the patch that contains the point
  std::array<int, 2> end = {0, 0};                // per parameter: -1 at its minimum, 1 at its maximum, else 0
  std::vector<int> dofs;                          // coordinates of the body that move it
  Eigen::Vector3d r, r_u, r_v, r_uu, r_uv, r_vv;  // world axes [m]; by parameters
  Mat J, J_u, J_v;                                // 3 x dofs: derivatives of r, r_u, r_v by the coordinates
};
// Ability of bodies that also have Surface and SampledSurface: points of other surfaces may slide on this one. The
// tangent of such a contact needs the motion of the nearest point.
class SlidingSurface {
 public:
  virtual ~SlidingSurface();
  virtual void jet(const Eigen::Vector2d& parameters, In q, SurfaceJet& out) const = 0;
  // Like Surface::nearest, but searches these patches only, for points known to be nearest to one of them.
  virtual void nearest_on(std::span<const int> patches, In q, const Vec3& x, Eigen::Vector2d& parameters,
                          Vec3& point) const = 0;
};

}  // namespace trammel
