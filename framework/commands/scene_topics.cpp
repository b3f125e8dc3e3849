#include "commands/scene_topics.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plugin/describe.hpp"
#include "run/setting_parts.hpp"
#include "scene/expression.hpp"
#include "simulate/results/contact_event.hpp"
#include "simulate/results/relative_motion.hpp"
#include "simulate/results/series_columns.hpp"

namespace trammel::simulate {
namespace {

using Entries = std::vector<const plugin::Entry*>;

std::string parts_of_a_scene() {
  std::string names;
  for (const plugin::Part& part : setting_parts()) names += (names.empty() ? "" : ", ") + part.name;
  return names;
}

Topic scene() {
  return {"scene", "the keys at the top of a scene file",
          fmt::format(R"page(scene (the whole file)
  JSON with comments (// and /* */). SI units, angles in rad. Every value has a path by its keys, such as
  contacts.floor.restitution, which messages name and --set PATH=VALUE changes.

Keys
  trammel      1: the version of the scene format; required
  title        a line for summaries and reports; description: more of it
  include      another scene file, or a list of them: the keys that stand here win, null removes one
  space        "planar" (2 coordinates, the default) or "spatial" (3)
  gravity      [m/s^2] a vector of 2 or 3 numbers; none if left out
  parameters   names for numbers and texts, used in expressions:            trammel describe expressions
  bodies       objects by name, each with a "type":                         trammel list
  joints       rows between two markers, "between": ["crank.pin", "ground"]: trammel describe markers
  forces       springs, dampers, loads, drives
  contacts     pairs of a marker or surface and what it may strike, with a contact law and friction
  integrator   the method and its steps:                                    trammel describe integrator
  simulate     from when to when:                                           trammel describe simulate
  static       load steps of 'trammel static':                              trammel describe static
  initial      what is done with the state that bodies give:                trammel describe initial
  corrections  of positions, velocities and energy after each step
  record       what is written, and how often:                              trammel describe record
  plugins      libraries of components that are not installed, relative to this file
  $schema      for editors: 'trammel schema > scene.schema.json', then "$schema": "scene.schema.json"

  Bodies, joints, forces and contacts may be repeated: trammel describe for
  Parts with pages of their own: {}
  Next: trammel validate SCENE names every problem of a file at once; trammel explain SCENE shows what was built.
)page",
                      parts_of_a_scene())};
}

Topic expressions() {
  return {
      "expressions", "\"=2*pi*E*I/L\": values computed from parameters, and laws of time",
      fmt::format(R"page(expressions
  A string that begins with = is computed: "mass": "=rho*A*L". It may stand wherever a number may, and in vectors.

  names       those under "parameters", which may use one another in any order; pi
  t           the time [s], where a law of time is expected: "angle": "=0.2*sin(2*pi*5*t)". Rates are exact derivatives
  operators   + - * / ^ and parentheses; ^ binds tighter than a leading minus, and to the right: -2^2 = -4, 2^3^2 = 512
{}  step(x)     0 for x < 0, else 1; sign(x) -1, 0, 1. Where a law jumps, a step of the integrator ends

  Columns of "record": {{"observe": ...}} may compute from other quantities: "=crank.angle - rod.angle"
  A parameter may be chosen by another one: {{"by": "=mesh", "values": {{"coarse": 4, "fine": 16}}, "otherwise": 8}}
  A result that is not finite is an error, as is a parameter that --set changes and nothing uses.
)page",
                  plugin::aligned("functions", 10, fmt::format("{}", fmt::join(scene::function_signatures(), ", "))))};
}

Topic repetition() {
  return {"for", "\"for\": {\"i\": n} repeats a body, joint, force or contact",
          R"page(for (key of a body, joint, force or contact)
  "bodies": {"strut_{i}": {"for": {"i": "=n"}, "type": "bar", "from": ["={i}*a", 0], "to": ["=({i}+1)*a", 0], "mass": 1}},
  "joints": {"pin_{i}": {"for": {"i": "=n-1"}, "type": "revolute", "between": ["strut_{i}.to", "strut_{i+1}.from"]}}

  "i": N        counts 0 ... N - 1
  "i": [a, b]   counts a ... b; b = a - 1 makes no copy
  two names     count all combinations: {"i": 3, "j": 2} makes 6 copies

  In the copies' names and texts {...} is replaced by its value, a whole number: an expression of the counters and of the
  scene's parameters. Elsewhere in these groups and under "record" too: "observe": {"tip": "strut_{n-1}.to.x"}.
  Two copies of one name are an error. --set changes the unit, before it is repeated.
)page"};
}

Topic table() {
  return {"table", "a law of time from a text table: {\"table\": \"quake.csv\", ...}",
          R"page(table (in place of a law of time)
  "x": {"table": "quake.csv", "time": "t", "column": "a_x", "holds": "accelerations", "scale": 9.81}

Keys
  table    the file, relative to the scene's; columns separated by commas, semicolons or blanks; # begins a comment. Its first
           line may name the columns, in double quotes if need be
  time     the column of times, by name or by number from 1; 1 if left out. Times must grow
  column   the column of values, likewise; 2 if left out
  holds    "values" (the default): a quintic spline through them, at rest at both ends; or "accelerations": integrated twice
           exactly from a cubic spline, from rest at 0
  scale    what the values are multiplied by; 1 if left out
  beyond   what holds before the first and after the last row: "hold" (the value of that row goes on), "zero" or
           "repeat". Without it a table must hold the whole run
)page"};
}

std::string components(Space space, bool orientation) {
  std::string names;
  for (const auto& [name, what] : motion_components(space, orientation)) names += (names.empty() ? "" : " ") + name;
  return names;
}

// A line of each body that declares some.
std::string by_body(const Entries& entries, std::string Declaration::*what) {
  std::string lines;
  for (const plugin::Entry* entry : entries) {
    const Declaration& declaration = entry->declaration;
    if (declaration.kind == Kind::body && !(declaration.*what).empty())
      lines += plugin::aligned(declaration.name, 18, declaration.*what);
  }
  return lines;
}

Topic markers(const Entries& entries) {
  return {"markers", "points and frames of bodies that joints, forces and contacts act between",
          fmt::format(R"page(markers
  BODY.MARKER   a point of a body, with axes that turn with it (of points in natural coordinates: without): "beam.tip"
  ground        the origin of the world, with the world's axes
  {{"point": [x, y], "angle": a}}   a frame fixed in the world; in space {{"point": [x, y, z], "angle": a, "axis": [0, 0, 1]}}

  The markers that each body has:
{}
  A misspelt one is answered with those that there are. Their motion can be recorded: trammel describe observables
)page",
                      by_body(entries, &Declaration::markers))};
}

Topic observables(const Entries& entries) {
  std::vector<std::string_view> always(energy_columns.begin(), energy_columns.end());
  always.insert(always.end(), book_columns.begin(), book_columns.end());
  always.insert(always.end(), norm_columns.begin(), norm_columns.end());
  always.insert(always.end(), step_columns.begin(), step_columns.end());
  return {"observables", "what \"record\": {\"observe\": {\"column\": ...}} may name",
          fmt::format(R"page(observables
  "record": {{"observe": {{"tip_y": "beam.tip.y", "force": "contacts.tip.force", "twice": "=2*beam.angle"}}}}

  BODY.MARKER.C         its motion in world axes, C one of
                          in the plane  {}
                          in space      {}
                        of points in natural coordinates: {}
  contacts.NAME.        gap [m], gap_rate [m/s], force [N] >= 0 pushes, closed (0 or 1); with friction: slip [m/s], friction [N],
                        sticks (0 or 1), in space also slip_x ... friction_z in world axes
  joints.NAME.reaction  2-norm of the multipliers of the joint's rows; a joint with friction: load, slip, friction, sticks
  BODY.reaction         likewise of rows that a body has of its own
  energy.               kinetic, potential, elastic, total [J]
  {{"of": "block.com.x", "relative_to": "table.origin", "since_start": true}}
                        a marker's motion as an observer at another marker sees it, less its value at the start

  Of bodies themselves, BODY.NAME:
{}
{})page",
                      components(Space::planar, true), components(Space::spatial, true),
                      components(Space::spatial, false), by_body(entries, &Declaration::observables),
                      plugin::aligned("series.csv", 18, fmt::format("always has t, {}", fmt::join(always, ", "))))};
}

Topic events() {
  std::string kinds;
  using Kind = ContactEvent::Kind;
  for (const auto& [kind, what] :
       {std::pair{Kind::impact,
                  "velocities jumped: impulse [N s], approach and separation [m/s], energy_lost [J], friction [N s]"},
        {Kind::close, "a contact's row or force became active: approach [m/s]"},
        {Kind::open, "a contact ended, it would pull: separation [m/s]"},
        {Kind::lift, "after an impact without rebound the bodies accelerate apart: the contact stays open"},
        {Kind::stick, "friction [N] holds the contact, or joint, from now on"},
        {Kind::slip, "it slides from now on: friction [N], direction of the slip"},
        {Kind::reversal, "it slid through rest: from now on the other way"},
        {Kind::latch, "a latch locked for good: as impact"}})
    kinds += plugin::aligned(to_string(kind), 14, what);
  return {
      "events", "the content of events.csv: impacts, openings, sticking, latches, refinements",
      fmt::format(R"page(events
  events.csv has a line an event: t [s], kind, component (its path in the scene), and a column for each figure,
  in SI units, empty where an event has none.

{}{}
  Found within a step and located to round-off of t, as far as doubles can hold it. How contacts decide: trammel describe
  constraint_method, trammel describe continuous_force, trammel describe coulomb.
)page",
                  kinds,
                  plugin::aligned("refine", 14,
                                  "a body replaced its coordinates: cause, coordinates, energies, mass and momentum "
                                  "before and after"))};
}

Topic study() {
  return {"study", "the file of 'trammel study': many runs of a scene, or of several",
          R"page(study (a file of its own)
  {
    "study": 1,
    "scene": "pendulum.json",
    "vary": {"bodies.rod.length": [0.5, 1, 2],
             "bodies.rod.mass": {"from": 0.1, "to": 10, "count": 5, "scale": "log"}},
    "reduce": {"swing": {"observe": "theta", "as": "max"}}
  }

Keys
  study    1: the version of the format; required. title: a line for reports
  scene    the scene's file, relative to the study; not needed where "vary" has "scene" in every case
  set      values of every case by dotted path, as --set: {"simulate.until": 5}
  vary     lists or ranges of values by dotted path, or a list of cases: [{"parameters.L": 1}, {"parameters.L": 2}].
           The path "scene" varies the scene: "scene": ["hht.json", "baumgarte.json"]
  mode     of paths: grid (every combination, the last path varies fastest), zip (the first value of each, the second, ...),
           random or sobol (ranges without "count"; "count": the number of cases, "seed")
  reduce   a number of each case by name: "observe" a column of its records, "as" final, initial, max, min, max_abs,
           mean, rms (less "reference": a number, or {"file": "measured.csv", "column": "theta"}) or first_crossing
           of a "level" in a "direction" (up, down, any)
  keep     true: each case's results folder is kept, out/NAME/cases/0 and so on, as 'trammel run' or 'trammel static'
           writes it; reductions may then observe constraint_position, _velocity and _acceleration, too
  figures  of the report of a study that keeps its cases: [{"title": "Figure 2", "observe": "theta"}, ...], "observe" a
           column or a list of them; "cases": {"parameters.L": 1} draws those with these values, a list of such objects
           those that meet one; "scale": "log", "time": "log" are the axes'. Without: each column that is reduced

  'trammel study STUDY.json' writes study.csv and study.npz, a row a case, and runs only cases that are missing when it
  is called again. --shard I/N runs a part, 'trammel study merge' joins parts, --estimate proposes how many.
  Examples: scenes/beam_impact/studies
)page"};
}

}  // namespace

std::vector<Topic> scene_topics(const Entries& entries) {
  return {scene(), expressions(), repetition(), table(), markers(entries), observables(entries), events(), study()};
}

}  // namespace trammel::simulate
