// Bodies, joints, forces, laws and corrections with one fault each: `trammel check` must find every one of them.
#include <cmath>
#include <limits>

#include <trammel/body.hpp>
#include <trammel/contact.hpp>
#include <trammel/correction.hpp>
#include <trammel/force.hpp>
#include <trammel/friction.hpp>
#include <trammel/joint.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

// Two masses on a spring in the plane's x: q = (x_1, x_2).
enum class BodyFault {
  none,
  mass_is_not_symmetric,
  mass_is_negative,
  energy_is_not_conserved,
  damper_supplies,
  tangent_lies,
  velocity_lies,
  jacobian_lies,
  motion_is_not_filled,
  refinement_gains_energy,
  refinement_moves_the_marker,
  refinement_forgets,
};

struct Doubling final : Transfer {
  explicit Doubling(double by) : factor(by) {}
  void q(In old, Out fresh) const override { v(old, fresh); }
  void v(In old, Out fresh) const override { fresh << factor * old, 0, 0; }
  double factor;
};

template <BodyFault fault>
struct Masses final : Body, ExactTangent, Refinable {
  double stiffness = 20, coupling = 0.2;

  // Refined, it has two more coordinates: displacements of its spring's middle, which weigh and hold by themselves.
  Coordinates coordinates() const override { return Coordinates::flat(n()); }
  void initial(Out q, Out v) const override { q.setZero(), v.setZero(), q(1) = 0.2; }
  void mass(double, In, Matrix& M) const override {
    const double first = fault == BodyFault::mass_is_negative ? -1 : 1;
    const double above = fault == BodyFault::mass_is_not_symmetric ? 0.3 : coupling;
    M.add(0, 0, first), M.add(0, 1, above), M.add(1, 0, coupling), M.add(1, 1, 2);
    for (int i = 2; i < n(); ++i) M.add(i, i, 0.5);
  }
  bool mass_is_constant() const override { return true; }
  void force(double, In q, In v, Out f) const override {
    const double pull = stiffness * (q(1) - q(0)) + damping() * (v(1) - v(0));
    f(0) += pull;
    f(1) -= pull + (fault == BodyFault::energy_is_not_conserved ? 0.1 * v(1) : 0);
    for (int i = 2; i < n(); ++i) f(i) -= stiffness * q(i);
  }
  Energy energy(double, In q, In v) const override {
    Energy e{.kinetic = (v(0) * v(0) + 2 * coupling * v(0) * v(1) + 2 * v(1) * v(1)) / 2,
             .elastic = stiffness * std::pow(q(1) - q(0), 2) / 2};
    for (int i = 2; i < n(); ++i) e.kinetic += v(i) * v(i) / 4, e.elastic += stiffness * q(i) * q(i) / 2;
    return e;
  }
  Power power(double, In, In v) const override { return {.dissipated = damping() * std::pow(v(1) - v(0), 2)}; }
  std::span<const std::string> markers() const override { return {&name_, 1}; }
  void motion(int, double, In q, In v, Motion& m) const override {
    if (fault == BodyFault::motion_is_not_filled && m.x.size()) return;
    m.x = Eigen::Vector2d(q(1), 0), m.R = Mat3::Identity(2, 2), m.angle = 0;
    m.V = m.bias = Vec6::Zero(3);
    m.V(0) = fault == BodyFault::velocity_lies ? -v(1) : v(1);
    m.dofs = {0, 1};
    m.J = Jac::Zero(3, 2);
    m.J(0, fault == BodyFault::jacobian_lies ? 0 : 1) = m.V(0) == v(1) ? 1 : -1;
  }
  void add_tangent(double, In, In, In, Blend c, Matrix& S) const override {
    const double k = c.c_k * (fault == BodyFault::tangent_lies ? 1.001 : 1) * stiffness, d = c.c_d * damping();
    S.add(0, 0, c.c_m + k + d), S.add(0, 1, c.c_m * coupling - k - d);
    S.add(1, 0, c.c_m * coupling - k - d), S.add(1, 1, 2 * c.c_m + k + d);
    for (int i = 2; i < n(); ++i) S.add(i, i, 0.5 * c.c_m + c.c_k * stiffness);
  }

  bool due(double, In, In, const RefineCause& cause) const override { return !fine_ && !cause.contact.empty(); }
  std::unique_ptr<Transfer> refine(double, In, In, const RefineCause&) override {
    fine_ = true;
    if (fault == BodyFault::refinement_moves_the_marker) return std::make_unique<Doubling>(1 + 1e-6);
    return std::make_unique<Doubling>(fault == BodyFault::refinement_gains_energy ? 1.01 : 1);
  }
  void archive(Archive& a) override {
    if (fault != BodyFault::refinement_forgets) a("fine", fine_);
  }

 private:
  int n() const { return fine_ ? 4 : 2; }
  double damping() const { return fault == BodyFault::damper_supplies ? -0.5 : 0.5; }
  bool fine_ = false;
  std::string name_ = "end";
};

template <BodyFault fault>
Declaration masses(const char* name) {
  return body<Masses<fault>>(name, "two masses on a spring")
      .source("none")
      .markers("end")
      .parameter("stiffness", &Masses<fault>::stiffness, {.unit = "N/m", .min = 0});
}

enum class JointFault { none, does_work, jacobian_lies, forgets_gamma };

template <JointFault fault>
struct Distance final : Joint {
  int row_count(Space) const override { return 1; }
  void rows(double, const Motion& A, const Motion& B, Rows& r) const override {
    const auto n = A.x.size();
    const Vec3 d = B.x - A.x, u = B.V.head(n) - A.V.head(n);
    r.g(0) = (d.squaredNorm() - 1) / 2;
    r.H_B.row(0).head(n) = d.transpose() * (fault == JointFault::jacobian_lies ? 1 + 1e-5 : 1);
    r.H_A.row(0).head(n) = -(fault == JointFault::does_work ? 0.5 : 1) * r.H_B.row(0).head(n);
    r.gamma(0) = fault == JointFault::forgets_gamma ? 0 : -u.squaredNorm();
  }
};

enum class ForceFault { none, pushes_itself, potential_lies, damper_supplies, knows_north, has_a_kink };

template <ForceFault fault>
struct Spring final : Force {
  void wrench(double, const Motion& A, const Motion& B, Wrench& on_A, Wrench& on_B) const override {
    const auto n = A.x.size();
    const Vec3 d = B.x - A.x;
    Vec3 F = (10 + (fault == ForceFault::damper_supplies ? -1 : 1) * rate(A, B) / d.norm()) * d;
    if (fault == ForceFault::knows_north) F(0) *= 2;
    if (fault == ForceFault::has_a_kink) F(1) += 3 * std::abs(B.x(1) - 0.5);
    on_A.head(n) += F * (fault == ForceFault::pushes_itself ? 0.9 : 1);
    on_B.head(n) -= F;
  }
  double potential(double, const Motion& A, const Motion& B) const override {
    return (fault == ForceFault::potential_lies ? 4.9 : 5) * (B.x - A.x).squaredNorm();
  }
  Power power(double, const Motion& A, const Motion& B) const override {
    const double power = std::pow(rate(A, B), 2);
    return {.dissipated = fault == ForceFault::damper_supplies ? -power : power};
  }

 private:
  static double rate(const Motion& A, const Motion& B) {
    const Vec3 d = B.x - A.x, u = B.V.head(d.size()) - A.V.head(d.size());
    return d.dot(u) / d.norm();
  }
};

enum class ContactFault { none, pulls, acts_apart, slope_lies, feeds, potential_lies };

template <ContactFault fault>
struct Hertz final : ContactForce {
  double normal(double gap, double rate, double) const override {
    if (gap >= 0) return fault == ContactFault::acts_apart && gap < 1e-8 ? 1 : 0;
    const double F = 1e6 * std::pow(-gap, 1.5) * (1 - (fault == ContactFault::feeds ? -0.3 : 0.3) * rate);
    return fault == ContactFault::pulls ? F : std::max(0.0, F);
  }
  double potential(double gap) const override {
    return gap < 0 ? (fault == ContactFault::potential_lies ? 0.41 : 0.4) * 1e6 * std::pow(-gap, 2.5) : 0;
  }
  Slope slope(double gap, double rate, double approach) const override {
    if (gap >= 0 || normal(gap, rate, approach) <= 0) return {};
    const double c = fault == ContactFault::feeds ? -0.3 : 0.3;
    return {-1.5e6 * std::sqrt(-gap) * (1 - c * rate) * (fault == ContactFault::slope_lies ? 1.01 : 1),
            -c * 1e6 * std::pow(-gap, 1.5)};
  }
};

struct GainsEnergy final : Restitution {
  double coefficient(double speed) const override { return speed > 10 ? 1.05 : 0.5; }
  Treatment treatment() const override { return {}; }
};
struct BouncesForEver final : Restitution {
  double coefficient(double) const override { return 0.5; }
  Treatment treatment() const override { return {.capture_speed = 1e-3}; }
};

enum class FrictionFault { none, drives, jumps, slope_lies, grows };

template <FrictionFault fault>
struct Smooth final : SmoothFriction {
  double ratio(double slip) const override {
    if (fault == FrictionFault::drives && slip > 1) return -0.1;
    if (fault == FrictionFault::grows) return slip / 1e-3;
    return (fault == FrictionFault::jumps ? 0.1 : 0) + 0.3 * std::tanh(slip / 1e-3);
  }
  double slope(double slip) const override {
    if (fault == FrictionFault::grows) return 1e3;
    if (fault == FrictionFault::drives && slip > 1) return 0;
    return (fault == FrictionFault::slope_lies ? 310 : 300) / std::pow(std::cosh(std::min(slip / 1e-3, 300.0)), 2);
  }
};

struct SlidesHarder final : SetValuedFriction {
  double static_coefficient() const override { return 0.3; }
  double kinetic_coefficient(double slip) const override { return slip > 1 ? 0.4 : 0.2; }
  Decide decide() const override { return Decide::at_events; }
  double stick_speed() const override { return 0; }
};
struct DrivesWhenSliding final : SetValuedFriction {
  double static_coefficient() const override { return 0.3; }
  double kinetic_coefficient(double slip) const override { return slip > 1 ? -0.1 : 0.2; }
  Decide decide() const override { return Decide::at_events; }
  double stick_speed() const override { return 0; }
};
struct NeverSticks final : SetValuedFriction {
  double static_coefficient() const override { return 0.3; }
  double kinetic_coefficient(double) const override { return 0.2; }
  Decide decide() const override { return Decide::every_evaluation; }
  double stick_speed() const override { return -1e-6; }
};

enum class CorrectionFault { none, stops_halfway, moves_along, changes_velocities, acts_without_rows, invents };

template <CorrectionFault fault>
struct Projection final : Correction {
  bool corrects(Level level) const override { return level == Level::position; }
  Outcome apply(Level, System& s, const Step&, State& state) override {
    const Vec before = state.q;
    if (fault == CorrectionFault::invents && !state.q.allFinite()) state.q.setZero();
    if (fault == CorrectionFault::acts_without_rows && s.sizes().nc == 0) state.q *= 1 + 1e-9;
    for (int i = 0; i < (fault == CorrectionFault::stops_halfway ? 1 : 20); ++i) {
      s.move_to(state.t, state.q, state.v);
      const Vec& g = s.g();
      if (g.size() == 0 || g.lpNorm<Eigen::Infinity>() <= 1e-13) break;
      if (!g.allFinite()) return Outcome::reject("the rows are not finite");
      const Vec zero = Vec::Zero(s.sizes().nv), rows = Vec::Zero(g.size());
      Vec dq, mu, moved;
      s.factorise({.c_m = 1}, zero, rows, Factors::projection);
      if (!s.correct(zero, g * (fault == CorrectionFault::stops_halfway ? 0.5 : 1), dq, mu, Factors::projection))
        return Outcome::reject("singular");
      if (fault == CorrectionFault::moves_along && i == 0 && dq.size() == 2) {
        const double size = dq.norm();
        dq += size * Eigen::Vector2d(-state.q(1), state.q(0));
      }
      s.retract(state.q, dq, moved);
      state.q = moved;
    }
    if (fault == CorrectionFault::changes_velocities) state.v *= 1 + 1e-9;
    return Outcome::accept();
  }
};

// --- parameters ---

struct DivergesAtItsBound final : SmoothFriction {
  double mu = 0.3, speed = 1;
  double ratio(double slip) const override { return mu * std::tanh(slip / speed); }
  double slope(double slip) const override {
    return mu / speed / std::pow(std::cosh(std::min(slip / speed, 300.0)), 2);
  }
};
struct DefaultOutside final : SmoothFriction {
  double mu = 3;
  double ratio(double slip) const override { return mu * std::tanh(slip); }
  double slope(double slip) const override { return mu / std::pow(std::cosh(std::min(slip, 300.0)), 2); }
};
struct Undocumented final : SmoothFriction {
  double mu = 0.3;
  double ratio(double slip) const override { return mu * std::tanh(slip); }
  double slope(double slip) const override { return mu / std::pow(std::cosh(std::min(slip, 300.0)), 2); }
};

template <class T>
Declaration a_contact(const char* name) {
  return contact<T>(name, "a contact").source("none");
}
template <class T>
Declaration a_friction(const char* name) {
  return friction<T>(name, "a law of friction").source("none");
}
template <JointFault fault>
Declaration distance(const char* name) {
  return joint<Distance<fault>>(name, "a distance of 1 m").source("none");
}
template <ForceFault fault>
Declaration spring(const char* name) {
  return force<Spring<fault>>(name, "a spring").source("none");
}
template <CorrectionFault fault>
Declaration projection(const char* name) {
  return correction<Projection<fault>>(name, "a projection").source("none");
}

}  // namespace

TRAMMEL_PLUGIN(
    masses<BodyFault::none>("good_masses"), masses<BodyFault::mass_is_not_symmetric>("mass_is_not_symmetric"),
    masses<BodyFault::mass_is_negative>("mass_is_negative"),
    masses<BodyFault::energy_is_not_conserved>("energy_is_not_conserved"),
    masses<BodyFault::damper_supplies>("body_damper_supplies"), masses<BodyFault::tangent_lies>("tangent_lies"),
    masses<BodyFault::velocity_lies>("velocity_lies"), masses<BodyFault::jacobian_lies>("marker_jacobian_lies"),
    masses<BodyFault::motion_is_not_filled>("motion_is_not_filled"),
    masses<BodyFault::refinement_gains_energy>("refinement_gains_energy"),
    masses<BodyFault::refinement_moves_the_marker>("refinement_moves_the_marker"),
    masses<BodyFault::refinement_forgets>("refinement_forgets"), distance<JointFault::none>("good_distance"),
    distance<JointFault::does_work>("joint_does_work"), distance<JointFault::jacobian_lies>("joint_jacobian_lies"),
    distance<JointFault::forgets_gamma>("joint_forgets_gamma"), spring<ForceFault::none>("good_spring"),
    spring<ForceFault::pushes_itself>("pushes_itself"), spring<ForceFault::potential_lies>("force_potential_lies"),
    spring<ForceFault::damper_supplies>("force_damper_supplies"), spring<ForceFault::knows_north>("knows_north"),
    spring<ForceFault::has_a_kink>("has_a_kink"), a_contact<Hertz<ContactFault::none>>("good_hertz"),
    a_contact<Hertz<ContactFault::pulls>>("pulls"), a_contact<Hertz<ContactFault::acts_apart>>("acts_apart"),
    a_contact<Hertz<ContactFault::slope_lies>>("contact_slope_lies"), a_contact<Hertz<ContactFault::feeds>>("feeds"),
    a_contact<Hertz<ContactFault::potential_lies>>("contact_potential_lies"), a_contact<GainsEnergy>("gains_energy"),
    a_contact<BouncesForEver>("bounces_for_ever"), a_friction<Smooth<FrictionFault::none>>("good_smooth"),
    a_friction<Smooth<FrictionFault::drives>>("drives"), a_friction<Smooth<FrictionFault::jumps>>("jumps"),
    a_friction<Smooth<FrictionFault::slope_lies>>("friction_slope_lies"),
    a_friction<Smooth<FrictionFault::grows>>("friction_grows"), a_friction<SlidesHarder>("slides_harder"),
    a_friction<DrivesWhenSliding>("drives_when_sliding"), a_friction<NeverSticks>("never_sticks"),
    projection<CorrectionFault::none>("good_projection"), projection<CorrectionFault::stops_halfway>("stops_halfway"),
    projection<CorrectionFault::moves_along>("moves_along"),
    projection<CorrectionFault::changes_velocities>("changes_velocities"),
    projection<CorrectionFault::acts_without_rows>("acts_without_rows"),
    projection<CorrectionFault::invents>("invents"),
    friction<DivergesAtItsBound>("diverges_at_its_bound", "a law whose slope is infinite at a bound")
        .source("none")
        .parameter("speed", &DivergesAtItsBound::speed, {.unit = "m/s", .min = 0, .max = 2}),
    friction<DefaultOutside>("default_outside", "a default outside its range")
        .source("none")
        .parameter("coefficient", &DefaultOutside::mu, {.min = 0, .max = 1, .doc = "mu"}),
    friction<Undocumented>("undocumented", "neither source nor doc").parameter("coefficient", &Undocumented::mu))
