#include "run/setting_parts.hpp"

#include <algorithm>

#include "run/settings.hpp"

namespace trammel::simulate {
namespace {

using plugin::Part;
using Type = Parameter::Type;

Part::Key key(const char* name, Type type, ParameterTraits traits, ParameterValue fallback = {}) {
  return {{name, type, false, traits, {}, {}, {}}, std::move(fallback)};
}

Part integrator() {
  return {
      "integrator",
      "The method, and its steps. Its own parameters stand beside these: 'trammel list' shows the methods, 'trammel "
      "describe hht_alpha' one of them.",
      R"({"type": "hht_alpha", "step": 1e-4, "contact_step": 1e-6, ...})",
      {key("type", Type::text, {.doc = "without an integrator Trammel chooses one, see below"}, std::string("dop853")),
       key("step", Type::number,
           {.unit = "s",
            .min = 0,
            .above_min = true,
            .required = true,
            .doc = "a fixed step, or {\"tolerance\": 1e-9}: 'trammel describe step'"}),
       key("contact_step", Type::number,
           {.unit = "s",
            .min = 0,
            .above_min = true,
            .doc = "likewise, while a contact is closed and for simulate.contact_hold after an event; \"step\" if "
                   "left out"})},
      {}};
}

Part step() {
  const StepChoice defaults;
  return {
      "step",
      "integrator.step and integrator.contact_step. A number is a fixed step [s], shortened only to meet records and "
      "events. An object keeps the error of each step, component by component in the mean square, below absolute + "
      "relative |v| in velocities, and below absolute + relative min(|q|, 2 h |v|) in coordinates: 2 h |v| is the "
      "way of two steps, so the place of a scene does not matter. That takes a method with an error estimate.",
      R"("step": 1e-4   or   "step": {"tolerance": 1e-9, "max": 1e-3})",
      {key("tolerance", Type::number,
           {.min = 0,
            .usual_min = 1e-15,
            .above_min = true,
            .doc = "relative to the motion and to the scene's size, more than round-off; needed unless both others are "
                   "given"}),
       key("relative", Type::number, {.min = 0, .doc = "\"tolerance\" if left out"}),
       key("absolute", Type::number,
           {.unit = "m, rad, m/s, rad/s",
            .min = 0,
            .above_min = true,
            .doc =
                "\"relative\" times the scene's size, its largest gap, body or distance of joined markers, but 1 m at "
                "most, if left out"}),
       key("initial", Type::number,
           {.unit = "s", .min = 0, .above_min = true, .doc = "first trial; record.every if left out"}),
       key("min", Type::number,
           {.unit = "s",
            .min = 0,
            .above_min = true,
            .doc = "where the error asks for less the run ends; what round-off of t leaves if left out"}),
       key("max", Type::number,
           {.unit = "s",
            .min = 0,
            .above_min = true,
            .doc = "20 times record.every if left out, and at most that; contacts ask for shorter steps where laws of "
                   "t vary"},
           defaults.most)},
      {"A scene without an integrator is run by dop853 with errors below 1e-9; with \"rows\": \"projected\" where "
       "bodies whose masses differ by more than 1e7 are tied by joints, and in runs of rows over 1000 s; and by "
       "hht_alpha with errors below 1e-7 a step, which damps what is fast beside the rest, where the fastest motion "
       "goes through more than a million radians in the run (of n > 10 coordinates 10/n million; of more than 100 the "
       "errors are below 1e-5). The summary, 'trammel explain' and \"integrator_choice\" in result.json give the "
       "choice and its reason.",
       "A run whose error-controlled steps are far shorter than its records need says so after some seconds, with what "
       "makes them so short and what cures it. \"newton_iterations\" in result.json counts the points at which an "
       "implicit method solved for increments of the motion, rejected steps and those that locate events among them; "
       "solutions for the rows alone are not counted.",
       "A step must be at least 16 units in the last place of the largest |t| of the run (7.1e-15 s for 2 s): t + h "
       "loses smaller ones in rounding."}};
}

Part simulate() {
  const Settings defaults;
  return {
      "simulate",
      "From when to when, and how events are taken.",
      R"("simulate": {"until": 2.0, "contact_hold": 5e-3})",
      {key("start", Type::number, {.unit = "s"}, defaults.start),
       key("until", Type::number, {.unit = "s", .required = true, .doc = "not before start"}),
       key("contact_hold", Type::number,
           {.unit = "s",
            .min = 0,
            .doc = "contact_step goes on so long after an event: for the flights within one visible bounce"},
           defaults.contact_hold),
       key("chatter_steps", Type::number,
           {.min = 0, .doc = "a rebound that the steps cannot follow sticks, see below; 0: never"},
           defaults.chatter_steps),
       key("event_limit", Type::number,
           {.unit = "events", .min = 1, .doc = "more than these in a thousandth of the run end it: an event storm"},
           double(defaults.event_limit))},
      {"Chatter: with restitution e > 0 a body that comes to rest bounces without end in a finite time. A rebound of "
       "speed u+ is taken with e = 0, so that the contact closes, if with fixed steps its flight 2 u+/|gap "
       "acceleration| would last fewer than chatter_steps of them, or with controlled steps its height u+^2/(2 |gap "
       "acceleration|) would be less than chatter_steps times the error allowed in a position. Slower than the "
       "contact's own capture_speed e is 0 always."}};
}

Part initial() {
  Part::Key consistent = key("consistent", Type::text, {.doc = "as in the summary"}, std::string("check"));
  consistent.declared.choices = {"check", "project"};
  return {
      "initial",
      "What is done with the state that the bodies' parameters give. \"check\": it must satisfy joints and penetrate "
      "no rigid contact. \"project\": the nearest state that does is taken, nearest in kinetic energy, and where a "
      "contact was penetrated in elastic energy too. \"equilibrium\": one at rest near it.",
      R"("initial": "project"   or   "initial": {"consistent": "project"})",
      {consistent},
      {}};
}

Part record() {
  return {
      "record",
      "What series.csv holds, and when pictures are taken.",
      R"("record": {"every": 1e-3, "observe": {"tip_y": "beam.tip.y", "angle": "beam.angle"}})",
      {key("every", Type::number,
           {.unit = "s", .min = 0, .above_min = true, .doc = "between rows; a thousandth of the run if left out"}),
       key("fields", Type::numbers,
           {.unit = "s",
            .doc = "times whose fields, such as stresses over a plate, go to fields.ndjson with the first row at or "
                   "after each; none if left out"})},
      {"\"observe\" names columns: a quantity of a body (beam.angle), of a marker (beam.tip.y), of a contact or joint, "
       "or \"=...\" computed from such. A name that does not exist is answered with those that do."}};
}

Part statics() {
  const Settings defaults;
  return {
      "static",
      "Load steps of 'trammel static', from simulate.start to simulate.until (0 to 1 if left out).",
      R"("static": {"steps": 8})",
      {key("steps", Type::integer, {.min = 1, .max = 1e6}, defaults.load_steps),
       key("tolerance", Type::number,
           {.min = 0, .above_min = true, .doc = "of what is left unbalanced, relative to the load"},
           defaults.load_tolerance),
       key("iterations", Type::integer,
           {.min = 1, .max = 1e6, .doc = "of Newton's method before a load step is divided"}, defaults.load_iterations),
       key("arc_length", Type::boolean, {.doc = "the path may turn back in t: past a largest load"},
           defaults.arc_length)},
      {}};
}

}  // namespace

const std::vector<Part>& setting_parts() {
  static const std::vector<Part> parts = {integrator(), step(), simulate(), initial(), record(), statics()};
  return parts;
}

const Part& setting_part(std::string_view name) {
  const std::vector<Part>& parts = setting_parts();
  return *std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.name == name; });
}

}  // namespace trammel::simulate
