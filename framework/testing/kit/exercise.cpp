#include "testing/kit/exercise.hpp"

#include <fmt/format.h>

#include <cmath>

#include <trammel/correction.hpp>
#include <trammel/friction.hpp>
#include <trammel/outside_domain.hpp>
#include <trammel/testing/markers.hpp>

#include "testing/body_under_test.hpp"

namespace trammel::kit {

namespace {

// Collects what came back and remembers the first number that is not finite.
class Seen {
 public:
  explicit Seen(std::vector<double>* all) : all_(all) {}

  void operator()(const char* what, double x) {
    if (all_) all_->push_back(x);
    if (fault_.empty() && !std::isfinite(x)) fault_ = fmt::format("{} is {}", what, x);
  }
  template <class Derived>
  void operator()(const char* what, const Eigen::DenseBase<Derived>& m) {
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      for (Eigen::Index i = 0; i < m.rows(); ++i) (*this)(what, m.derived()(i, j));
  }
  const std::string& fault() const { return fault_; }

 private:
  std::vector<double>* all_;
  std::string fault_;
};

void use(Integrator& method, unsigned seed, Seen& seen) {
  std::mt19937 random(seed);
  const double theta = between(random, 0.5, 1.2);
  const Problem problem = method.traits().rows ? problems::pendulum_with_rod(theta) : problems::pendulum(theta);
  const auto system = problem.system();
  State now = problem.solution(0), next;
  method.restart(*system, now);
  auto* estimate = dynamic_cast<ErrorEstimate*>(&method);
  for (int i = 0; i < 12; ++i) {
    if (!method.step(*system, now, 5e-3, next)) return;
    seen("q after a step", next.q), seen("v after a step", next.v);
    seen("a after a step", next.a), seen("lambda after a step", next.lambda);
    if (estimate) seen("the error estimate", estimate->error(*system, now, next, {}));
    method.accept(*system, now, next);
    std::swap(now, next);
  }
}

void use(Body& body, unsigned seed, Seen& seen) {
  // The body itself is used, not one that a maker makes.
  struct Lent final : Body {
    explicit Lent(Body& b) : body(b) {}
    Coordinates coordinates() const override { return body.coordinates(); }
    void initial(Out q, Out v) const override { body.initial(q, v); }
    void mass(double t, In q, Matrix& M) const override { body.mass(t, q, M); }
    void force(double t, In q, In v, Out f) const override { body.force(t, q, v, f); }
    Energy energy(double t, In q, In v) const override { return body.energy(t, q, v); }
    Power power(double t, In q, In v) const override { return body.power(t, q, v); }
    std::span<const std::string> markers() const override { return body.markers(); }
    void motion(int marker, double t, In q, In v, Motion& m) const override { body.motion(marker, t, q, v, m); }
    Body& body;
  };
  const TriedBody tried([&]() -> std::unique_ptr<Body> { return std::make_unique<Lent>(body); },
                        {.q = 1e-3, .v = 0.1, .count = 2, .seed = seed});
  for (const BodyAt& at : tried.at()) {
    seen("the mass matrix", tried.mass(at));
    seen("the force", tried.force(at));
    seen("the energy", tried.energy(at).total());
    const Power power = tried.body->power(at.t, at.q, at.v);
    seen("the power", power.supplied), seen("the power", power.dissipated);
    for (std::size_t i = 0; i < tried.body->markers().size(); ++i) {
      const Motion m = tried.motion(i, at);
      seen("a marker's position", m.x), seen("a marker's velocity", m.V), seen("a marker's bias", m.bias);
      seen("a marker's Jacobian", m.J);
    }
  }
}

void use(Constraint& joint, Space space, Seen& seen) {
  const auto moving = moving_markers(space, joint.marker_count());
  for (const double t : {0.1, 0.7, 1.9}) {
    std::vector<Motion> markers;
    std::vector<const Motion*> at;
    for (const MovingMarker& each : moving) markers.push_back(each.at(t));
    for (const Motion& m : markers) at.push_back(&m);
    Rows rows;
    rows.resize(joint.row_count(space), space, joint.marker_count());
    joint.rows_between(t, at, rows);
    seen("g", rows.g), seen("g_t", rows.g_t), seen("gamma", rows.gamma);
    for (int k = 0; k < joint.marker_count(); ++k) seen("H", rows.H(k));
  }
}

void use(Force& force, Space space, Seen& seen) {
  const MovingPair pair = moving_pair(space);
  for (const double t : {0.1, 0.7, 1.9}) {
    const Motion A = pair.a.at(t), B = pair.b.at(t);
    Wrench on_A = Wrench::Zero(A.V.size()), on_B = on_A;
    force.wrench(t, A, B, on_A, on_B);
    const Power power = force.power(t, A, B);
    seen("the wrench on A", on_A), seen("the wrench on B", on_B);
    seen("the potential", force.potential(t, A, B));
    seen("the power", power.supplied), seen("the power", power.dissipated);
  }
}

void use(ContactForce& law, Seen& seen) {
  for (const double gap : {-1e-2, -1e-4, -1e-8, 0.0, 1e-3})
    for (const double rate : {-1.0, 0.0, 0.5})
      for (const double approach : {0.0, 1e-3, 2.0}) {
        const auto slope = law.slope(gap, rate, approach);
        seen("the normal force", law.normal(gap, rate, approach));
        seen("its slope", slope.by_gap), seen("its slope", slope.by_rate);
        seen("the potential", law.potential(gap));
      }
}

void use(Restitution& law, Seen& seen) {
  for (const double speed : {0.0, 1e-9, 1e-3, 1.0, 1e3}) seen("the restitution", law.coefficient(speed));
  seen("the capture speed", law.treatment().capture_speed);
}

void use(SmoothFriction& law, Seen& seen) {
  for (const double slip : {0.0, 1e-9, 1e-3, 1.0, 1e3})
    seen("the ratio", law.ratio(slip)), seen("its slope", law.slope(slip));
}

void use(SetValuedFriction& law, Seen& seen) {
  seen("the static coefficient", law.static_coefficient());
  seen("the stick speed", law.stick_speed());
  for (const double slip : {0.0, 1e-9, 1e-3, 1.0, 1e3}) seen("the kinetic coefficient", law.kinetic_coefficient(slip));
}

void use(Correction& correction, Seen& seen) {
  const Problem problem = problems::pendulum_with_rod();
  const auto system = problem.system();
  const State start = problem.solution(0), exact = problem.solution(0.1);
  State off = exact;
  off.q(0) += 1e-5, off.v(1) -= 1e-5;
  correction.restart(*system, start);
  State corrected = off;
  using Level = Correction::Level;
  for (const Level level : {Level::position, Level::velocity, Level::energy})
    if (correction.corrects(level) &&
        !correction.apply(level, *system, {start, off, problem.energy.value(start)}, corrected))
      return;
  seen("the corrected q", corrected.q), seen("the corrected v", corrected.v);
}

void use_as_its_kind(const Subject& s, Component& c, Seen& seen) {
  const Space space = s.form.world.space;
  if (auto* method = dynamic_cast<Integrator*>(&c)) return use(*method, s.seed, seen);
  if (auto* body = dynamic_cast<Body*>(&c)) return use(*body, s.seed, seen);
  if (auto* joint = dynamic_cast<Constraint*>(&c)) return use(*joint, space, seen);
  if (auto* force = dynamic_cast<Force*>(&c)) return use(*force, space, seen);
  if (auto* law = dynamic_cast<ContactForce*>(&c)) return use(*law, seen);
  if (auto* law = dynamic_cast<Restitution*>(&c)) return use(*law, seen);
  if (auto* law = dynamic_cast<SmoothFriction*>(&c)) return use(*law, seen);
  if (auto* law = dynamic_cast<SetValuedFriction*>(&c)) return use(*law, seen);
  if (auto* correction = dynamic_cast<Correction*>(&c)) return use(*correction, seen);
  throw std::logic_error("it derives from no interface of its kind");
}

}  // namespace

std::string exercise(const Subject& subject, Component& component, std::vector<double>* all) {
  Seen seen(all);
  try {
    use_as_its_kind(subject, component, seen);
  } catch (const OutsideDomain&) {
  }
  return seen.fault();
}

}  // namespace trammel::kit
