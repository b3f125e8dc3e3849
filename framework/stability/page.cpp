#include "stability/page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include <fmt/format.h>

#include "stability/region.hpp"
#include "stability/scene_step.hpp"
#include "stability/small_steps.hpp"
#include "stability/spectral_map.hpp"

namespace trammel::stability {

namespace {

using report::Axis;
using report::Curve;
using report::Figure;
using report::least_drawn;
using report::Mark;
using report::Page;
using report::Point;
using report::Scale;
using report::Table;

constexpr double near = 1e-2, far = 1e3;  // omega h of the slowest and the fastest mode tried
constexpr int points_of_map = 41;
constexpr double longest_step = 1e-2, shortest_step = 1e-9;  // [s] of the pendulum
constexpr int pendulum_steps = 8;                            // a decade each
constexpr double most = 8;  // of a region's boundary: beyond those of all methods known to the authors of this page
constexpr int rays = 13;

std::string number(double x) {
  return fmt::format("{:.5g}", x);
}
std::string number(const std::optional<double>& x) {
  return x ? number(*x) : "-";
}

// --- Over omega h ---

using Of = double (*)(const Oscillation&);

Figure map_figure(std::string title, std::string caption, std::string label, const std::vector<MapPoint>& map, Of value,
                  double largest) {
  Figure figure{.title = std::move(title),
                .caption = std::move(caption),
                .x = {"omega h [1]", Scale::logarithmic},
                .y = {std::move(label), Scale::linear},
                .curves = {{.name = "theory", .mark = Mark::dashed, .points = {}, .failures = {}},
                           {.name = "measured", .mark = Mark::points, .points = {}, .failures = {}}}};
  for (const MapPoint& p : map) {
    const auto add = [&](Curve& curve, const std::optional<Oscillation>& of) {
      if (!of || !std::isfinite(value(*of))) return;
      if (std::abs(value(*of)) <= largest)
        curve.points.push_back({p.Omega, value(*of), ""});
      else
        curve.failures.push_back({p.Omega, 0, fmt::format("{:.3g}", value(*of))});
    };
    add(figure.curves[0], p.theory);
    add(figure.curves[1], p.measured);
    if (!p.measured) figure.curves[1].failures.push_back({p.Omega, 0, "a step was rejected"});
  }
  if (figure.curves[0].points.empty()) figure.curves.erase(figure.curves.begin());
  return figure;
}

// The largest distance of measured radii from theory, up to a radius of 1: beyond it trajectories overflow.
std::optional<double> distance(const std::vector<MapPoint>& map) {
  std::optional<double> largest;
  for (const MapPoint& p : map)
    if (p.measured && p.theory && p.theory->radius <= 1 + growth)
      largest = std::max(largest.value_or(0), std::abs(p.measured->radius - p.theory->radius));
  return largest;
}

void add_maps(Page& page, const IntegratorUnderTest& subject, const LinearTheory* theory) {
  const std::vector<double> Omegas = logarithmic(near, far, points_of_map);
  const std::vector<MapPoint> map = spectral_map(subject.maker(), theory, 0, Omegas);
  page.figures.push_back(map_figure(
      "Spectral radius", "Undamped oscillator; above 1 the motion grows.", "spectral radius [1]", map,
      [](const Oscillation& o) { return o.radius; }, 1.5));
  page.figures.push_back(map_figure(
      "Numerical damping", "Damping ratio that the method adds to an undamped oscillator; below 0 it drives.",
      "damping ratio [1]", map, [](const Oscillation& o) { return o.damping; }, 1));
  page.figures.push_back(map_figure(
      "Period error", "Above 0 the method's period is longer than the exact one.", "relative error of the period [1]",
      map, [](const Oscillation& o) { return o.period_error; }, 1));
  const auto stable = [](const MapPoint& p) { return p.measured && p.measured->radius <= 1 + growth; };
  const auto unstable = std::find_if_not(map.begin(), map.end(), stable);
  if (unstable == map.end())
    page.sentences.push_back(
        fmt::format("Stable without damping at all {} points up to omega h = {:g}; spectral radius {} "
                    "there.",
                    map.size(), far, number(map.back().measured->radius)));
  if (const auto d = distance(map))
    page.sentences.push_back(
        fmt::format("Measured spectral radii differ from theory by at most {:.1e} where it is stable.", *d));
  else if (!theory)
    page.sentences.push_back(
        "The method states no theory (trammel/linear_theory.hpp): figures show what was measured.");
}

// --- Regions ---

Curve boundary_curve(const char* name, Mark mark, const std::vector<BoundaryPoint>& points,
                     const std::function<std::optional<double>(const BoundaryPoint&)>& radius,
                     const std::function<Point(double zeta, double Omega)>& place) {
  Curve curve{.name = name, .mark = mark, .points = {}, .failures = {}};
  for (const BoundaryPoint& p : points)
    if (const auto Omega = radius(p); Omega && *Omega < most) curve.points.push_back(place(p.zeta, *Omega));
  return curve;
}

Figure region_figure(std::string title, std::string caption, Axis x, Axis y, const std::vector<BoundaryPoint>& points,
                     const std::function<Point(double zeta, double Omega)>& place) {
  Figure figure{
      .title = std::move(title), .caption = std::move(caption), .x = std::move(x), .y = std::move(y), .curves = {}};
  figure.curves.push_back(boundary_curve(
      "theory", Mark::dashed, points, [](const auto& p) { return p.theory; }, place));
  figure.curves.push_back(boundary_curve(
      "measured", Mark::points, points, [](const auto& p) { return std::optional<double>(p.measured); }, place));
  std::erase_if(figure.curves, [](const Curve& c) { return c.points.empty(); });
  return figure;
}

Table region_table(std::string title, const std::vector<BoundaryPoint>& points) {
  Table table{
      .title = std::move(title), .columns = {{"zeta", "1"}, {"measured omega h", "1"}, {"theory", "1"}}, .rows = {}};
  for (const BoundaryPoint& p : points)
    table.rows.push_back({fmt::format("{:.4f}", p.zeta), p.open ? fmt::format("> {:g}", most) : number(p.measured),
                          p.theory && *p.theory >= most ? fmt::format("> {:g}", most) : number(p.theory)});
  return table;
}

void add_motion_region(Page& page, const IntegratorUnderTest& subject, const LinearTheory* theory) {
  const auto points = motion_region(subject.maker(), theory, most, rays);
  page.figures.push_back(region_figure(
      "Stability region", "Boundary of the stable z = h lambda in the left half plane, along rays from the origin.",
      {"real part of z [1]", Scale::linear}, {"imaginary part of z [1]", Scale::linear}, points,
      [](double zeta, double Omega) -> Point {
        return {-zeta * Omega, Omega * std::sqrt(1 - zeta * zeta), ""};
      }));
  page.tables.push_back(region_table("Boundary of stability over the damping ratio", points));
  page.sentences.push_back(
      fmt::format("Stable without damping up to omega h = {}, with critical damping up to {}.",
                  points.back().open ? fmt::format("{:g} or more", most) : number(points.back().measured),
                  points.front().open ? fmt::format("{:g} or more", most) : number(points.front().measured)));
}

void add_row_region(Page& page, const IntegratorUnderTest& subject, const LinearTheory* theory) {
  const RowMaker method = [&](double delta, double epsilon) {
    return subject.maker({{"delta", fmt::format("{:.17g}", delta)}, {"epsilon", fmt::format("{:.17g}", epsilon)}});
  };
  const auto points = row_region(method, theory, most, rays);
  page.figures.push_back(region_figure(
      "Baumgarte's stable region",
      "Boundary of the weights with which violations of a row shrink: g'' + 2 delta g' + epsilon^2 g = 0.",
      {"delta h [1]", Scale::linear}, {"epsilon h [1]", Scale::linear}, points, [](double zeta, double Omega) -> Point {
        return {zeta * Omega, Omega, ""};
      }));
  page.tables.push_back(region_table("Boundary of Baumgarte's weights over delta/epsilon", points));
  page.sentences.push_back(fmt::format("Baumgarte's weights with delta = epsilon are stable up to epsilon h = {}.",
                                       number(points.front().measured)));
}

// --- Small steps ---

void add_small_steps(Page& page, const IntegratorUnderTest& subject) {
  const std::vector<double> steps = logarithmic(longest_step, shortest_step, pendulum_steps);
  Figure figure{.title = "Multipliers at small steps",
                .caption =
                    "Largest relative error of lambda in ten steps of a pendulum with a rod; index 3 divides the "
                    "round-off of g by h^2.",
                .x = {"step h [s]", Scale::logarithmic},
                .y = {"relative error of lambda [1]", Scale::logarithmic},
                .curves = {}};
  for (const std::string& formulation : subject.choices("formulation")) {
    Curve curve{.name = formulation, .mark = Mark::line_and_points, .points = {}, .failures = {}};
    for (const SmallStep& s : small_steps(subject.maker({{"formulation", formulation}}), steps)) {
      if (s.rejected.empty())
        curve.points.push_back({s.h, std::max(s.lambda_error, least_drawn), ""});
      else
        curve.failures.push_back({s.h, 0, s.rejected});
    }
    const auto worst = std::max_element(curve.points.begin(), curve.points.end(),
                                        [](const Point& a, const Point& b) { return a.y < b.y; });
    if (worst != curve.points.end())
      page.sentences.push_back(
          fmt::format("Formulation {}: relative error of lambda at most {:.1e}, at h = {:.0e} s{}.", formulation,
                      worst->y, worst->x, curve.failures.empty() ? "" : "; it rejects steps of other sizes"));
    figure.curves.push_back(std::move(curve));
  }
  if (!figure.curves.empty()) page.figures.push_back(std::move(figure));
}

// --- On a scene ---

Table table_of_steps(const std::vector<study::Overrides>& changes, const std::vector<LargestStep>& found) {
  Table table{.title = "The scene as it is", .columns = {}, .rows = {}};
  for (const scene::Override& varied : changes.front()) table.columns.push_back({varied.path, ""});
  if (!table.columns.empty()) table.title = "Changes of the scene";
  table.columns.push_back({"largest bounded step", "s"});
  table.columns.push_back({"linear theory", "s"});
  for (std::size_t i = 0; i < changes.size(); ++i) {
    std::vector<std::string>& row = table.rows.emplace_back();
    for (const scene::Override& varied : changes[i]) row.push_back(varied.value);
    row.push_back(!found[i].failure.empty() ? found[i].failure
                  : found[i].at_limit       ? fmt::format("{:.4g} or more", found[i].h)
                  : found[i].h > 0          ? fmt::format("{:.4g}", found[i].h)
                                            : "none");
    row.push_back(number(found[i].predicted));
  }
  return table;
}

// Over the path that varies fastest, two curves for each combination of the others; nothing if its values are no
// numbers above 0.
std::optional<Figure> steps_over_values(const std::vector<study::Overrides>& changes,
                                        const std::vector<LargestStep>& found) {
  if (changes.size() < 2) return std::nullopt;
  Figure figure{.title = "Largest bounded step",
                .caption = "",
                .x = {changes.front().back().path, Scale::logarithmic},
                .y = {"step [s]", Scale::logarithmic},
                .curves = {}};
  const auto curve = [&figure](const std::string& name, Mark mark) -> Curve& {
    const auto at =
        std::find_if(figure.curves.begin(), figure.curves.end(), [&](const Curve& c) { return c.name == name; });
    if (at != figure.curves.end()) return *at;
    return figure.curves.emplace_back(Curve{.name = name, .mark = mark, .points = {}, .failures = {}});
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const std::string& value = changes[i].back().value;
    char* end = nullptr;
    const double x = std::strtod(value.c_str(), &end);
    if (end != value.c_str() + value.size() || !(x > 0)) return std::nullopt;
    std::string others;
    for (std::size_t k = 0; k + 1 < changes[i].size(); ++k)
      others += fmt::format(", {} = {}", changes[i][k].path, changes[i][k].value);
    if (found[i].predicted)
      curve("linear theory" + others, Mark::dashed).points.push_back({x, *found[i].predicted, ""});
    Curve& measured = curve("measured" + others, Mark::line_and_points);
    if (found[i].h > 0)
      measured.points.push_back({x, found[i].h, found[i].at_limit ? "or more" : ""});
    else
      measured.failures.push_back({x, 0, found[i].failure.empty() ? "no step is bounded" : found[i].failure});
  }
  return figure;
}

}  // namespace

Page measure(const IntegratorUnderTest& subject) {
  Page page{.title = "Stability of " + subject.described(), .sentences = {}, .figures = {}, .tables = {}};
  const auto method = subject.maker()();
  const auto* theory = dynamic_cast<const LinearTheory*>(method.get());
  add_maps(page, subject, theory);
  if (!method->traits().implicit) add_motion_region(page, subject, theory);
  if (subject.has_parameter("delta") && subject.has_parameter("epsilon")) add_row_region(page, subject, theory);
  add_small_steps(page, subject);
  return page;
}

Page measure_on_scene(const IntegratorUnderTest& subject, const study::SceneSource& source, plugin::Registry& registry,
                      const std::vector<study::Overrides>& changes) {
  Page page{.title = fmt::format("Largest bounded step of {} on {}", subject.described(), source.file()),
            .sentences = {},
            .figures = {},
            .tables = {}};
  const double limit = stability_limit(subject.maker(), trammel::Axis::imaginary, most);
  const std::optional<double> ends = limit < most ? std::optional<double>(limit) : std::nullopt;
  std::vector<LargestStep> found;
  for (const study::Overrides& change : changes)
    found.push_back(largest_step(source, registry, subject.object(), ends, change));
  page.sentences.push_back(
      ends ? fmt::format("Without damping the method is stable up to omega h = {}; linear theory divides "
                         "it by the highest frequency of small motions about the start, or about the equilibrium if "
                         "nothing swings at the start.",
                         number(*ends))
           : "The method has no limit of stability that linear theory could predict.");
  if (auto figure = steps_over_values(changes, found)) page.figures.push_back(std::move(*figure));
  page.tables.push_back(table_of_steps(changes, found));
  return page;
}

}  // namespace trammel::stability
