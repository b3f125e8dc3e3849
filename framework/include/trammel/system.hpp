// The whole mechanical system at one point (t, q, v), as an integrator sees it.
//
//     q' = N(q) v                                  q configuration (nq), on a manifold; v velocity (nv)
//     M(q) v' = f(t, q, v) - W(t, q, v)^T lambda   M mass matrix; f applied, elastic and gyroscopic forces
//     g(t, q) = 0,   G = (dg/dq) N                 nc rows, may be redundant; W = G without sliding friction
//
// and the derivatives of the rows, G v + g_t = 0 and G v' = gamma(t, q, v). The System hides contacts, events, storage
// (dense or sparse), redundancy and the meaning of the coordinates.
#pragma once

#include <trammel/types.hpp>

namespace trammel {

// Baumgarte's stabilisation of the acceleration rows: G a = gamma - 2 alpha (G v + g_t) - beta^2 g.   [1/s] both
struct Stabilisation {
  double alpha = 0;
  double beta = 0;
};

// Weights of the iteration matrix S = c_m M + c_d D + c_k K + c_1 1 (nv x nv) with D = d(M a - f + W^T lambda)/dv and K
// the derivative by q, by increments in the tangent space.
struct Blend {
  double c_m = 1;
  double c_d = 0;
  double c_k = 0;
  double c_1 = 0;  // of the identity; if it is the only weight, [1 G^T; G 0] gives solutions of minimum norm
};

// Selects one of two stored factorisations. The stabilisation of Gear, Gupta and Leimkuhler (GGL) needs both the
// iteration matrix and the projection onto the position rows.
enum class Factors { iteration, projection };

class System {
 public:
  virtual ~System();

  virtual Sizes sizes() const = 0;  // constant between two calls of Integrator::restart

  // For methods that treat q as numbers (Runge-Kutta, Adams): q_dot = N(q) v, and q back onto its manifold.
  virtual void rate(const Vec& q, const Vec& v, Vec& q_dot) const = 0;
  virtual void normalise(Vec& q) const = 0;
  // For methods that work with increments dq in R^nv (Newmark, HHT, Newton): q (+) dq, and q1 (-) q0.
  virtual void retract(const Vec& q, const Vec& dq, Vec& q_new) const = 0;
  virtual void difference(const Vec& q1, const Vec& q0, Vec& dq) const = 0;

  // All functions below refer to this point. Each part is evaluated at its first use; references are valid until the
  // next move_to. `t` may repeat, decrease or lie between steps.
  virtual void move_to(double t, const Vec& q, const Vec& v) = 0;

  virtual const Vec& f() = 0;      // (nv)
  virtual const Vec& g() = 0;      // (nc)
  virtual const Vec& g_dot() = 0;  // (nc)  G v + g_t

  virtual void add_mass_times(double c, const Vec& a, Vec& r) = 0;     // r += c M a           (nv)
  virtual void add_reaction(double c, const Vec& lambda, Vec& r) = 0;  // r += c W^T lambda    (nv)
  // G alone, without the contribution of friction to the reactions.
  virtual void add_rows_times(double c, const Vec& x, Vec& rc) = 0;  // rc += c G x      (nc)
  virtual void add_rows_force(double c, const Vec& mu, Vec& r) = 0;  // r += c G^T mu    (nv)

  virtual Energy energy() = 0;  // of all bodies, forces and contacts that store energy [J]

  // Solves M a + W^T lambda = f, G a = gamma - stabilisation. Throws if M is singular on the null space of G. If rows
  // are redundant, lambda is one of many solutions. With W = G all of them give the same a and W^T lambda; with W != G
  // a may depend on the choice. The multipliers that are recorded, and those that load joints with friction, have the
  // least norm at any number of rows, sum_i lambda_i^2 with rows in the units in which joints write them.
  virtual void accelerate(Stabilisation, Vec& a, Vec& lambda) = 0;

  // Factorises [S W^T; G 0] at this point, or [S G^T; G 0] for Factors::projection. The projection never uses W: a
  // correction of the rows would move a sliding body along its plane, and would be singular where G W^T is.
  // a and lambda enter D and K through d(M a)/dq and d(W^T lambda)/dq.
  // The factors remain valid after later move_to calls (modified Newton iteration) until the next `factorise` of the
  // same kind or a change of sizes.
  virtual void factorise(Blend, const Vec& a, const Vec& lambda, Factors = Factors::iteration) = 0;
  // Solves for (da, dlambda) with the right-hand side -(r, rc) and these factors; redundant rows as in `accelerate`.
  // Returns false if the matrix is singular: reject the step.
  [[nodiscard]] virtual bool correct(const Vec& r, const Vec& rc, Vec& da, Vec& dlambda,
                                     Factors = Factors::iteration) = 0;

 protected:
  System() = default;
  System(const System&) = default;
  System& operator=(const System&) = default;
};

}  // namespace trammel
