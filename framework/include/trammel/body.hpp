// A body: a block of coordinates with its mass, forces, energy and markers. It knows no joint, contact or integrator.
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

// The make-up of a body's configuration; it gives N(q), retraction, difference and normalisation.
class Coordinates {
 public:
  enum class Kind {
    flat,      // n numbers with n rates
    rotation,  // a unit quaternion (w, x, y, z) with the angular velocity in body axes: 4 numbers, 3 rates
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
  virtual Power power(double /*t*/, In /*q*/, In /*v*/) const { return {}; }  // of drives and dampers inside the body

  virtual std::span<const std::string> markers() const = 0;
  // Fills everything of `motion`; called with the same object again and again, so it may keep what does not change.
  virtual void motion(int marker, double t, In q, In v, Motion& motion) const = 0;
};

// Abilities. A missing one is replaced by differences within this one body, so the cost stays local.

// One Motion may serve markers of all bodies of the class in turn, whatever their parameters: what motion() keeps in it, sizes and
// dofs included, is the same for each of them.
class SharedMotion {
 public:
  virtual ~SharedMotion();
};

// mass and force of one point together, for a body where both begin with the same work.
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

// For statics of thin bodies. A sheet that an increment has bent is stretched by the square of its turn, and the stresses of
// that stretch, which is to vanish, spoil the next tangent. S += c K at rest, but in the part of K that is due to stress with
// stresses that follow the increment linearly, stress(from) + d(stress)/dq dq (mixed integration points; Magisano, Leonardi,
// Garcea, Int. J. Numer. Meth. Engng. 109, 2017). With from = q and dq = 0 it is the exact tangent.
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

// Rows between a body's own coordinates, held like those of joints: a rod in natural coordinates keeps its length.
//     g(t, q) = 0,      g_dot = G v + g_t,      G v' = gamma
struct BodyRows {
  Vec g, g_t, gamma;  // (n); g_t partial derivative by time
  Mat G;              // n x nv

  // All zero, n rows.
  void resize(int n, int nv);
};
class Constrained {
 public:
  virtual ~Constrained();
  virtual int row_count() const = 0;  // constant but for a refinement
  // `rows` comes in with row_count rows, all zero.
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

// The body's shape for plots and animation: a polyline in world axes, one column a point (2 or 3 rows).
class Drawn {
 public:
  virtual ~Drawn();
  virtual void shape(double t, In q, Mat& points) const = 0;
};

// Why and where a body is asked to refine.
struct RefineCause {
  // Name in the scene of the contact that has just closed; empty: a step has ended, which is the time for triggers of the
  // body's own (a moment, an indicator).
  std::string_view contact;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // surface parameters (u, v) of the place; 0 for a body without Surface
  // When a step has ended: the largest pressure of contacts on each patch of the body's SampledSurface [Pa]; empty: none presses.
  std::span<const double> pressure = {};
};

// A body that may replace its coordinates during the run (mesh refinement).
class Refinable {
 public:
  virtual ~Refinable();
  // Asked after every step and every closing of a contact of the body: cheap while there is nothing to do.
  virtual bool due(double t, In q, In v, const RefineCause& cause) const = 0;
  // Called when due; null: nothing could be refined. Afterwards coordinates(), mass, force and motion() are the new ones.
  // Markers keep their names and indices; Motion objects are fresh, nothing kept in them is from before. The framework
  // moves q and v by the transfer and solves a and lambda anew.
  virtual std::unique_ptr<Transfer> refine(double t, In q, In v, const RefineCause& cause) = 0;
  // What it takes to build the refined coordinates again when a run resumes; coordinates() is asked after reading.
  virtual void archive(Archive&) = 0;
};

// Mass and momentum, for the balance at a refinement.
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

// Nearest point of a body's surface, for contact. The point is given by surface parameters (u, v).
class Surface {
 public:
  virtual ~Surface();
  virtual void nearest(double t, In q, const Vec3& x, Eigen::Vector2d& parameters, Vec3& point, Vec3& normal) const = 0;
  virtual void motion_at(const Eigen::Vector2d& parameters, double t, In q, In v, Motion& motion) const = 0;
  // The body's faces lie so far to both sides of that surface [m].
  virtual double half_thickness() const { return 0; }
};

// Material points of one part of a surface (a cell of a mesh), which follow its nodes: x_p = X_p + sum_I R_pI u_I with the
// nodes' displacements u_I = B q[dofs].
struct SurfacePatch {
  std::vector<int> dofs;  // coordinates of the body that move it
  Mat R;                  // points x nodes
  Mat X;                  // points x 3, positions at q = 0 [m]
  Mat B;                  // (3 nodes) x dofs, node by node; empty: the identity
  Vec area;               // that each point stands for [m^2]
};
// Ability beside Surface of bodies in space with flat coordinates: what a pressure of contact acts on. Constant but for a
// refinement.
class SampledSurface {
 public:
  virtual ~SampledSurface();
  virtual int patches() const = 0;
  // A box in world axes that contains the patch.
  virtual void bounds(int patch, In q, Vec3& low, Vec3& high) const = 0;
  // Points no further apart than `spacing` [m]; infinite: as few as integrate products of two of the patch's functions.
  virtual void sample(int patch, double spacing, SurfacePatch& out) const = 0;
};

// A surface around one of its points: how that point moves with the coordinates, and along the parameters (u, v).
struct SurfaceJet {
  int patch = 0;                                  // that holds the point
  std::array<int, 2> end = {0, 0};                // -1, 1: u or v is the least or largest there is
  std::vector<int> dofs;                          // coordinates of the body that move it
  Eigen::Vector3d r, r_u, r_v, r_uu, r_uv, r_vv;  // world axes [m]; by parameters
  Mat J, J_u, J_v;                                // 3 x dofs: of r, r_u, r_v by the coordinates
};
// Ability beside Surface and SampledSurface: points of other surfaces may slide on this one. That they do is how its nearest
// point moves, which the tangent of such a contact needs.
class SlidingSurface {
 public:
  virtual ~SlidingSurface();
  virtual void jet(const Eigen::Vector2d& parameters, In q, SurfaceJet& out) const = 0;
  // As Surface::nearest, of points known to lie nearest to one of these patches: most of a large surface is then left out.
  virtual void nearest_on(std::span<const int> patches, In q, const Vec3& x, Eigen::Vector2d& parameters,
                          Vec3& point) const = 0;
};

}  // namespace trammel
