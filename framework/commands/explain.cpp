// `trammel explain`: what was built, what each part costs, what was left out.
#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands/simulation.hpp"
#include "diagnose/redundancy.hpp"
#include "plugin/breadcrumb.hpp"
#include "run/run_failed.hpp"
#include "simulate/event/trial_step.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/blame.hpp"
#include "simulate/start/crash_witness.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::simulate {
namespace {

using Clock = std::chrono::steady_clock;

// A sample repeats a call for `long_enough`, so that reading the clock costs nothing beside it, but at most
// `most_calls` times.
constexpr int samples = 5, most_calls = 100000;
constexpr double long_enough = 2e-3;       // [s]
constexpr double to_second_point = 1e-12;  // [s], and added to each velocity: evaluation costs the same there
constexpr double usual_step = 1e-4;        // [s] where the scene leaves the first step to the method

// [s] The least of several samples.
template <class Call>
double least_time(Call call) {
  double least = std::numeric_limits<double>::infinity();
  for (int sample = 0; sample < samples; ++sample) {
    int n = 0;
    const Clock::time_point begin = Clock::now();
    double passed = 0;
    do {
      call(), ++n;
      passed = std::chrono::duration<double>(Clock::now() - begin).count();
    } while (passed < long_enough && n < most_calls);
    least = std::min(least, passed / n);
  }
  return least;
}

std::string step_text(const StepChoice& choice) {
  if (choice.fixed) return fmt::format("{:.6g} s", *choice.fixed);
  const double absolute = choice.tolerance.absolute;
  return fmt::format("error-controlled, relative {:.3g}, absolute {}", choice.tolerance.relative,
                     absolute > 0 ? fmt::format("{:.3g}", absolute) : "in the scene's size");
}

class Text {
 public:
  void section(const std::string& title) { sections_.push_back({title, {}}); }
  template <class... Args>
  void line(const char* format, const Args&... args) {
    sections_.back().lines.push_back(fmt::format(fmt::runtime(format), args...));
  }
  std::vector<ExplainedPart> sections() && { return std::move(sections_); }

 private:
  std::vector<ExplainedPart> sections_;
};

const char* friction_in(const model::Model& model, int joint) {
  for (const model::ContactEntry& contact : model.contacts)
    if (contact.joint && contact.joint->joint == joint)
      return contact.coulomb ? ", friction by the load of its bearings: sticks in a row and slides by a force"
                             : ", friction by the load of its bearings, as a force";
  return "";
}

void matrices(Text& text, const model::Model& model) {
  const model::Storage storage = model::storage_for(model);
  if (storage == model::Storage::blocks)
    text.line("matrices: blocks by body; sparse factorisations, ordered once for a pattern");
  else if (storage == model::Storage::sparse)
    text.line("matrices: sparse; factorised front by front, analysed once for a mesh");
  else if (model.sizes.nc > 0)
    text.line("matrices: dense");
}

void components(Text& text, const scene::Scene& scene, const model::Model& model) {
  const auto type = [&](const char* group, const std::string& name) {
    const scene::Value* value = scene.root().at_path(fmt::format("{}.{}.type", group, name));
    return value && value->type() == scene::Value::Type::text ? value->text() : std::string();
  };
  for (const model::BodyEntry& body : model.bodies)
    text.line("bodies.{} ({}): nq = {}, nv = {}{}, {} markers; derivatives {}", body.name, type("bodies", body.name),
              body.nq, body.nv, body.rows > 0 ? fmt::format(", {} rows of its own", body.rows) : "",
              body.body->markers().size(), body.tangent ? "exact" : "by differences");
  for (int j = 0; j < int(model.joints.size()); ++j) {
    const model::JointEntry& joint = model.joints[std::size_t(j)];
    text.line("joints.{} ({}): {} rows{}", joint.name, type("joints", joint.name), joint.rows, friction_in(model, j));
  }
  for (const model::ForceEntry& force : model.forces)
    text.line("forces.{} ({})", force.name, type("forces", force.name));
  for (const model::ContactEntry& contact : model.contacts)
    if (!contact.joint)
      text.line("contacts.{} ({}): {}, {}", contact.name, type("contacts", contact.name),
                contact.restitution ? "impulse and row" : "compliant force",
                contact.coulomb  ? "sticks in rows and slides by a force"
                : contact.smooth ? "friction as a force"
                                 : "frictionless");
}

void built(Text& text, const scene::Scene& scene, const plugin::Registry& registry, const Setup& setup) {
  const model::Model& model = *setup.model;
  text.section("Built");
  text.line("{} scene: nq = {}, nv = {}, rows of joints and bodies = {}",
            model.world.space == Space::planar ? "planar" : "spatial", model.sizes.nq, model.sizes.nv, model.sizes.nc);
  matrices(text, model);
  components(text, scene, model);
  text.line("integrator {}: step {}{}", setup.integrator_type, step_text(setup.settings.step),
            setup.settings.own_contact_step ? ", in contact " + step_text(setup.settings.contact_step) : "");
  if (!setup.choice.empty()) text.line("chosen: {}", setup.choice);
  text.section("Plugins loaded");
  for (const std::string& file : registry.files()) text.line("{}", file);
}

// nv minus the rank of G at the initial state. Contacts and latches that close later reduce it further.
void freedom(Text& text, Setup& setup, const std::vector<RedundantRows>& redundant) {
  const Sizes& n = setup.model->sizes;
  int rank = n.nc;
  for (const RedundantRows& rows : redundant) rank -= int(rows.rows.size());
  text.section("Degrees of freedom");
  text.line("{} = nv {} - rank {} of the {} rows of joints and bodies", n.nv - rank, n.nv, rank, n.nc);
  if (n.nv == rank)
    setup.warnings.push_back(
        "the joints leave no degree of freedom: everything stands still or follows the joints' laws of time");
}

void redundant(Text& text, const std::vector<RedundantRows>& found) {
  if (found.empty()) return;
  text.section("Redundant rows at the initial state (accelerations are unique, multipliers those of minimum norm)");
  for (const RedundantRows& rows : found) text.line("{}", description(rows));
}

// Contacts that are closed at the start and whose rows depend on each other.
void indeterminate(Text& text, Setup& setup) {
  if (setup.model->contacts.empty()) return;
  Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
  try {
    simulator.start(setup.initial);
  } catch (const RunFailed& failed) {
    text.section("Contacts at the start");
    text.line("{}", failed.what());
    return;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < setup.model->contacts.size(); ++i)
    if (simulator.system().sharing(int(i)).shared) names.push_back(setup.model->contacts[i].name);
  if (names.empty()) return;
  text.section(
      "Statically indeterminate contacts at the start (of the forces that push and stay in their cones those of least "
      "norm; accelerations are unique without friction)");
  text.line("contacts.{}", fmt::join(names, ", contacts."));
}

void cost_of_step(Text& text, Setup& setup, model::AssembledSystem& system, const State& now) {
  const StepChoice& choice = setup.settings.step;
  const double h = choice.fixed ? *choice.fixed : choice.initial > 0 ? choice.initial : usual_step;
  {
    const plugin::Breadcrumb restarts(setup.integrator_origin, "restart");
    setup.integrator->restart(system, now);
  }
  const plugin::Breadcrumb steps(setup.integrator_origin, "step");
  State next;
  if (!trial_step(*setup.integrator, system, now, h, next)) {
    text.line("one step of {:.3g} s: refused at the initial state", h);
    return;
  }
  text.line("one step of {:.3g} s: {:.3g}", h, 1e6 * least_time([&] {
                                                 if (!setup.integrator->step(system, now, h, next)) next = now;
                                               }));
}

void costs(Text& text, Setup& setup, model::AssembledSystem& system) {
  text.section("Cost (microseconds, this machine, at the initial state)");
  model::Modes open;
  open.contacts.resize(setup.model->contacts.size());
  system.set_modes(open);
  State now = setup.initial;
  // Alternates between two points, so that no result of the previous evaluation is reused.
  const Vec beside = now.v + Vec::Constant(now.v.size(), to_second_point);
  bool there = false;
  const auto move = [&] {
    there = !there;
    system.move_to(there ? now.t + to_second_point : now.t, now.q, there ? beside : now.v);
  };
  system.move_to(now.t, now.q, now.v);
  system.accelerate({}, now.a, now.lambda);
  Vec a, lambda;
  text.line("f: {:.3g}", 1e6 * least_time([&] { move(), system.f(); }));
  text.line("accelerations (M, f, rows, solution): {:.3g}",
            1e6 * least_time([&] { move(), system.accelerate({}, a, lambda); }));
  for (int i = 0; i < int(setup.model->contacts.size()); ++i)
    if (!setup.model->contacts[std::size_t(i)].joint)
      text.line("gap and its rate of contacts.{}: {:.3g}", setup.model->contacts[i].name,
                1e6 * least_time([&] { move(), system.gap(i), system.gap_rate(i); }));
  cost_of_step(text, setup, system, now);
}

void left_out(Text& text, const Setup& setup) {
  const model::Model& model = *setup.model;
  text.section("Left out");
  if (model.sizes.nc == 0)
    text.line("{}", model.contacts.empty()
                        ? "no joints, no contacts: the system is an ODE and solved as one"
                        : "no joints: while no contact is closed the system is an ODE and solved as one");
  const auto in_joint = [](const model::ContactEntry& contact) { return contact.joint.has_value(); };
  if (!model.joints.empty() && std::none_of(model.contacts.begin(), model.contacts.end(), in_joint))
    text.line("no friction in joints");
  if (model.contacts.empty())
    text.line("no contacts: no event functions are watched");
  else if (!std::all_of(model.contacts.begin(), model.contacts.end(), in_joint))
    text.line("contact rows and forces exist only while their contact is closed");
  if (model.forces.empty()) text.line("no force elements between markers");
  if (model.flat) text.line("no rotation coordinates: configurations are plain vectors");
  if (model.constant_mass) text.line("the mass matrix is constant");
  if (model.world.space == Space::planar) text.line("nothing spatial: two translations and one rotation");
  if (model.world.gravity.isZero(0)) text.line("no gravity");
  if (setup.corrections.empty()) text.line("no corrections after steps");
}

}  // namespace

std::vector<ExplainedPart> explain(const scene::Scene& scene, plugin::Registry& registry, CrashWitness* witness) {
  Setup setup = set_up(scene, registry, Purpose::motion, witness);
  Text text;
  built(text, scene, registry, setup);
  model::AssembledSystem system(setup.model);
  const WitnessScope scope(witness, setup, system, {&setup.initial.t, nullptr});
  blaming(setup, system, scene.root(), setup.initial.t, [&] {
    std::vector<RedundantRows> rows;
    if (setup.model->sizes.nc > 0) rows = redundant_rows(system, setup.initial);
    freedom(text, setup, rows);
    redundant(text, rows);
    indeterminate(text, setup);
    costs(text, setup, system);
  });
  left_out(text, setup);
  if (!setup.warnings.empty()) text.section("Warnings");
  for (const std::string& warning : setup.warnings) text.line("{}", warning);
  return std::move(text).sections();
}

std::string text_of(const std::vector<ExplainedPart>& parts) {
  std::string text;
  for (const ExplainedPart& part : parts) {
    text += part.title + "\n";
    for (const std::string& line : part.lines) text += "  " + line + "\n";
  }
  return text;
}

}  // namespace trammel::simulate
