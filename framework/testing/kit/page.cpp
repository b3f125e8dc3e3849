#include "testing/kit/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <trammel/linear_theory.hpp>

#include "testing/kit/integrators/integrators.hpp"
#include "testing/kit/integrators/order.hpp"

namespace trammel::kit {

namespace {

using report::Curve;
using report::Figure;
using report::least_drawn;
using report::Mark;
using report::Page;
using report::Scale;

const report::Axis step_axis{"step h [s]", Scale::logarithmic};

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

// The line of slope p through the fitted runs.
Curve slope_line(const Convergence& c, double p, const std::string& name) {
  Curve line{name, Mark::dashed, {}, {}};
  double log_c = 0;
  for (std::size_t i = c.first; i < c.last; ++i)
    log_c += (std::log(c.runs[i].error) - p * std::log(c.until / c.runs[i].steps)) / double(c.last - c.first);
  for (std::size_t i : {c.first, c.last - 1}) {
    const double h = c.until / c.runs[i].steps;
    line.points.push_back({h, std::exp(log_c) * std::pow(h, p), ""});
  }
  return line;
}

Figure order_figure(const Convergence& c, int claimed) {
  Figure figure{"Order on " + c.problem,
                fmt::format("The root mean square of q and v at four times against the step. Claimed slope {}, fitted "
                            "slope {:.3f} over {} runs; extrapolated to h = 0 {:.3f}.",
                            claimed, c.order, c.last - c.first, c.limit),
                step_axis,
                {"error of q and v", Scale::logarithmic},
                {}};
  Curve measured{"measured", Mark::line_and_points, {}, {}};
  for (const Convergence::Run& run : c.runs) {
    const double h = c.until / run.steps;
    if (std::isfinite(run.error))
      measured.points.push_back({h, std::max(run.error, 1e-16), ""});
    else
      measured.failures.push_back({h, 0, "a step was rejected"});
  }
  figure.curves.push_back(std::move(measured));
  if (c.last - c.first >= 2) {
    figure.curves.push_back(slope_line(c, c.order, fmt::format("fitted slope {:.2f}", c.order)));
    figure.curves.push_back(slope_line(c, claimed, fmt::format("claimed slope {}", claimed)));
  }
  return figure;
}

}  // namespace

Page verdict_page(const Verdicts& v) {
  Page page;
  page.title = fmt::format("{} {}", v.component.kind, v.component.name);
  page.sentences.push_back(v.failed() ? fmt::format("{} of {} checks failed.", v.failed(), v.asked())
                                      : fmt::format("All {} checks that ran hold.", v.asked()));
  page.sentences.push_back(fmt::format("{} of {} checks ran; {} were skipped, with the reason in the table.", v.asked(),
                                       v.results.size(), v.count(Verdict::skipped)));
  report::Table table{"Verdicts", {{"check", ""}, {"verdict", ""}, {"claim", ""}, {"found", ""}, {"time", "s"}}, {}};
  for (const Result& r : v.results)
    table.rows.push_back({r.words.name, to_string(r.finding.verdict), r.words.claim, first_line(r.finding.text),
                          fmt::format("{:.2f}", r.seconds)});
  page.tables.push_back(std::move(table));
  return page;
}

void add_orders(Page& page, const Subject& s) {
  const Traits traits = s.traits();
  std::vector<Problem> problems = {some_oscillator(s), some_pendulum(s), some_pendulum_of_varying_mass(s), some_top(s)};
  if (traits.rows)
    for (Problem& more : std::vector{some_rod(s), some_wind(s)}) problems.push_back(std::move(more));
  for (const Problem& problem : problems)
    page.figures.push_back(order_figure(converge(s.maker<Integrator>(), problem, 4096), traits.order));
}

// By theory, where the method states it.
std::optional<double> radius_in_theory(const Integrator& method, double Omega) {
  const auto* theory = dynamic_cast<const LinearTheory*>(&method);
  if (!theory) return {};
  double radius = 0;
  for (const std::complex<double> root : theory->roots(Omega, 0)) radius = std::max(radius, std::abs(root));
  return radius;
}

void add_spectral_radius(Page& page, const Subject& s) {
  Figure figure{"Spectral radius",
                "The largest root of the amplification matrix on x'' = -omega^2 x, measured on trajectories. Above 1 a "
                "mode grows; below 1 it is damped.",
                {"omega h", Scale::logarithmic},
                {"spectral radius", Scale::linear},
                {}};
  Curve measured{"measured", Mark::points, {}, {}}, theory{"theory", Mark::line, {}, {}};
  const auto method = s.maker<Integrator>()();
  for (double Omega = 0.02; Omega < 200; Omega *= 1.25) {
    if (const auto radius = radius_in_theory(*method, Omega); radius && *radius < 2)
      theory.points.push_back({Omega, *radius, ""});
    try {
      const double radius = amplification(s.maker<Integrator>(), Omega).radius;
      if (radius < 2)
        measured.points.push_back({Omega, radius, ""});
      else
        measured.failures.push_back({Omega, 0, fmt::format("radius {:.3g}", radius)});
    } catch (const std::exception& e) {
      measured.failures.push_back({Omega, 0, e.what()});
    }
  }
  figure.curves.push_back(std::move(measured));
  if (!theory.points.empty()) figure.curves.push_back(std::move(theory));
  page.figures.push_back(std::move(figure));
}

void add_drifts(Page& page, const Subject& s) {
  const Problem problem = any_pendulum(s);
  const auto system = problem.system(), probe = problem.system();
  const auto method = s.maker<Integrator>()();
  Curve energy{"energy |E - E_0|/E", Mark::line, {}, {}}, position{"|g| [m]", Mark::line, {}, {}},
      velocity{"|G v + g_t| [m/s]", Mark::line, {}, {}};
  const double start = problem.energy.value(problem.solution(0));
  int step = 0;
  try {
    integrate(*method, *system, problem.solution(0), 20, 2000, [&](const State& x) {
      if (++step % 10) return;
      probe->move_to(x.t, x.q, x.v);
      energy.points.push_back(
          {x.t, std::max(least_drawn, std::abs(problem.energy.value(x) - start) / problem.energy.scale), ""});
      position.points.push_back({x.t, std::max(least_drawn, probe->g().norm()), ""});
      velocity.points.push_back({x.t, std::max(least_drawn, probe->g_dot().norm()), ""});
    });
  } catch (const std::exception& e) {
    energy.failures.push_back({10e-3 * step, 0, e.what()});
  }
  Figure figure{"Energy and rows of the pendulum",
                "20 s in steps of 10 ms. The energy is divided by m g L.",
                {"time [s]", Scale::linear},
                {"violation", Scale::logarithmic},
                {}};
  figure.curves.push_back(std::move(energy));
  if (s.traits().rows) figure.curves.push_back(std::move(position)), figure.curves.push_back(std::move(velocity));
  page.figures.push_back(std::move(figure));
}

namespace {

Curve work_curve(const std::string& name, const std::vector<Work>& runs, const char* setting) {
  Curve curve{name, Mark::line_and_points, {}, {}};
  for (const Work& run : runs) {
    const std::string note = fmt::format("{} = {:.3g}", setting, run.setting);
    if (std::isfinite(run.error))
      curve.points.push_back({run.evaluations, std::max(run.error, 1e-16), note});
    else
      curve.failures.push_back({run.evaluations, 0, note + ": " + run.failure});
  }
  return curve;
}

Figure work_figure(const Problem& problem, const std::vector<Contender>& all, bool controlled) {
  Figure figure{
      fmt::format("Work and precision on {}, {}", problem.name,
                  controlled ? "steps controlled by the estimate" : "equal steps"),
      "Evaluations of the system at a point and factorisations, against the error of q and v. Left and low is "
      "better.",
      {"evaluations and factorisations", Scale::logarithmic},
      {"error of q and v", Scale::logarithmic},
      {}};
  for (const Contender& one : all) {
    const auto runs = controlled ? with_controlled_steps(one.make, problem) : with_fixed_steps(one.make, problem, 2048);
    if (!runs.empty()) figure.curves.push_back(work_curve(one.name, runs, controlled ? "tolerance" : "h"));
  }
  return figure;
}

}  // namespace

void add_work_precision(Page& page, const Subject& s, const std::vector<Contender>& others) {
  std::vector<Contender> all = {{s.declaration().name + " (this)", s.maker<Integrator>()}};
  all.insert(all.end(), others.begin(), others.end());
  std::vector<Problem> problems = {some_pendulum(s)};
  if (s.traits().rows) problems.push_back(some_rod(s)), problems.push_back(some_turning_wire(s));
  for (const Problem& problem : problems)
    for (const bool controlled : {false, true}) {
      std::vector<Contender> able;
      for (const Contender& one : all)
        if (one.make()->traits().rows || problem.solution(0).lambda.size() == 0) able.push_back(one);
      Figure figure = work_figure(problem, able, controlled);
      if (!figure.curves.empty()) page.figures.push_back(std::move(figure));
    }
}

void add_honesty(Page& page, const Subject& s) {
  if (!s.offers<ErrorEstimate>()) {
    page.sentences.push_back("It offers no error estimate: its honesty cannot be measured.");
    return;
  }
  Figure figure{
      "True error over tolerance",
      "Runs whose steps the estimate controls. The tolerance is that of each step, whose errors add up over the "
      "run: at 1 the error of the run is what was asked for, above 10 the run ended well and deceived.",
      {"tolerance", Scale::logarithmic},
      {"error of q and v over tolerance", Scale::logarithmic},
      {}};
  report::Table table{
      "Honesty of the error estimate",
      {{"problem", ""}, {"runs that ended", ""}, {"error over tolerance, mean", ""}, {"largest", ""}, {"deceived", ""}},
      {}};
  Honesty total;
  for (unsigned seed = 0; seed < 5; ++seed) {
    Subject other = s;
    other.seed = s.seed + seed;
    std::vector<Problem> problems = {some_oscillator(other), some_pendulum(other)};
    if (s.traits().rows) problems.push_back(some_rod(other)), problems.push_back(some_turning_wire(other));
    for (const Problem& problem : problems) {
      const auto runs = with_controlled_steps(s.maker<Integrator>(), problem);
      const Honesty h = honesty(runs);
      total.runs += h.runs, total.deceived += h.deceived;
      table.rows.push_back({fmt::format("{}, seed {}", problem.name, other.seed), std::to_string(h.runs),
                            fmt::format("{:.3g}", h.mean_ratio), fmt::format("{:.3g}", h.largest_ratio),
                            std::to_string(h.deceived)});
      if (seed > 0) continue;
      Curve curve{problem.name, Mark::line_and_points, {}, {}};
      for (const Work& run : runs) {
        if (std::isfinite(run.error))
          curve.points.push_back({run.setting, std::max(run.error, 1e-16) / run.setting, ""});
        else
          curve.failures.push_back({run.setting, 0, run.failure});
      }
      figure.curves.push_back(std::move(curve));
    }
  }
  page.figures.push_back(std::move(figure));
  page.tables.push_back(std::move(table));
  page.sentences.push_back(
      fmt::format("Deception rate: {} of {} runs that ended well have an error of more than ten times "
                  "their tolerance ({:.1f} %).",
                  total.deceived, total.runs, total.runs ? 100.0 * total.deceived / total.runs : 0));
}

Page measured_page(const Request& request, const Surveyed& component, Page page) {
  if (component.interface != "integrator") return page;
  plugin::Registry registry;
  registry.load(component.file);
  const plugin::Entry& entry = registry.find(Kind::integrator, component.name);
  const std::string parameters =
      request.with.empty() ? fmt::format("{{\"type\": \"{}\"}}", component.name) : request.with.front();
  const Subject s{entry, {"", parameters, world_of(Space::planar)}, request.level, request.seed};
  std::vector<Contender> others;
  for (const plugin::Entry* other : registry.all())
    if (other->declaration.kind == Kind::integrator && other != &entry) {
      const Subject one{*other,
                        {"", fmt::format("{{\"type\": \"{}\"}}", other->declaration.name), world_of(Space::planar)}};
      others.push_back({other->declaration.name, one.maker<Integrator>()});
    }
  add_orders(page, s);
  add_spectral_radius(page, s);
  add_drifts(page, s);
  add_work_precision(page, s, others);
  add_honesty(page, s);
  return page;
}

}  // namespace trammel::kit
