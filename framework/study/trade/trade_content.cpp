#include "study/trade/trade_content.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "commands/result.hpp"
#include "report/page.hpp"
#include "simulate/results/log_file.hpp"
#include "simulate/results/provenance.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

std::string digits(double disagreement) {
  return disagreement > 0 ? fmt::format("{:.1f}", -std::log10(disagreement)) : "all";
}

// No error below the floor is claimed.
double shown(const TradeContent& c, double error) {
  return c.reference ? std::max(error, c.reference->floor()) : error;
}

std::string error_text(const TradeContent& c, double error) {
  const double floor = c.reference ? c.reference->floor() : 0;
  return error < floor ? fmt::format("< {:.2g}", floor) : fmt::format("{:.2g}", error);
}

std::string about_reference(const TradeContent& c) {
  const TradeReference& r = *c.reference;
  std::string text = fmt::format(
      "Reference: {} (tolerance {:.2g}) and {} (tolerance {:.2g}), of different families, share {} digits until t = "
      "{:.6g} s; no error below {:.2g} is claimed.",
      r.first.method.name, r.first.tolerance, r.second.method.name, r.second.tolerance, digits(r.disagreement),
      r.trusted_until, r.floor());
  if (r.chaotic)
    text += fmt::format(
        " The motion is chaotic or the references fail to resolve it: they part by more than the target at t = {:.6g} "
        "s of {:.6g} s. Trajectories are compared until t = {:.6g} s.",
        r.differ_at, r.first.result.series.t.back(), r.trusted_until);
  return text;
}

std::string about_choice(const TradeContent& c) {
  if (!c.choice) return fmt::format("No setting that was tried meets the target of {:.2g}.", c.target);
  const Choice& choice = *c.choice;
  std::string text =
      fmt::format("Cheapest choice with errors below {:.2g}: {}; its error is {}, its CPU time {:.3g} s.", c.target,
                  choice.integrator, error_text(c, choice.error), choice.cpu);
  if (!c.dropped.empty()) text += fmt::format(" It also takes {}.", fmt::join(c.dropped, ", "));
  if (choice.own_done)
    text += fmt::format(" The scene as it is: error {}, {:.3g} s.", error_text(c, choice.own_error), choice.own_cpu);
  else
    text += fmt::format(" The scene as it is had not ended after {:.3g} s.", choice.own_cpu);
  return text;
}

std::vector<std::string> sentences(const TradeContent& c) {
  if (!c.reference) return {"No reference was found: " + c.no_reference};
  std::vector<std::string> all;
  if (c.options.target) all.push_back(about_choice(c));
  all.push_back(about_reference(c));
  if (c.options.target && c.target > *c.options.target)
    all.push_back(
        fmt::format("The target of {:.2g} cannot be verified: the references leave {:.2g} open, which is what the "
                    "search aimed at.",
                    *c.options.target, c.target));
  if (!c.equal.empty())
    all.push_back(fmt::format("Equal within the spread of its times: {}.", fmt::join(c.equal, "; ")));
  if (c.separate) {
    std::string text = fmt::format("Errors apart: time integration {}", error_text(c, c.separate->integration));
    if (c.separate->contact) text += fmt::format(", treatment of contacts {}", error_text(c, *c.separate->contact));
    if (c.separate->truncation)
      text +=
          fmt::format(", truncation of the model {} (against finer models)", error_text(c, *c.separate->truncation));
    all.push_back(text + ".");
  }
  if (!c.no_distributions.empty()) all.push_back(c.no_distributions);
  std::vector<std::string> deceived;
  for (const Course& course : c.courses)
    if (course.deceived() > 0)
      deceived.push_back(
          fmt::format("{} in {} of {} runs", course.method.name, course.deceived(), course.samples.size()));
  if (!deceived.empty())
    all.push_back(fmt::format("Finished with errors above ten times the tolerance: {}.", fmt::join(deceived, "; ")));
  all.push_back(fmt::format("{} runs of the methods; the full grid has {}. In all {} runs, {:.3g} s of CPU time.",
                            c.search_runs, c.full_grid, c.runs, c.cpu));
  return all;
}

// Settings that no other beats in both time and error.
std::set<std::pair<std::string, int>> front(const TradeContent& c) {
  std::vector<std::tuple<double, double, std::string, int>> all;
  for (const Course& course : c.courses)
    for (const auto& [level, s] : course.samples)
      if (s.done()) all.emplace_back(s.cpu.least, shown(c, s.error.max), course.method.name, level);
  std::sort(all.begin(), all.end());
  std::set<std::pair<std::string, int>> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [cpu, error, name, level] : all)
    if (error < least) least = error, best.insert({name, level});
  return best;
}

report::Figure work_figure(const TradeContent& c) {
  report::Figure figure{"Work and precision",
                        "",
                        {"largest scaled error", report::Scale::logarithmic},
                        {"CPU time [s]", report::Scale::logarithmic},
                        {}};
  for (const Course& course : c.courses) {
    report::Curve curve{course.method.name, report::Mark::line_and_points, {}, {}};
    for (const auto& [level, s] : course.samples) {
      const std::string note = course.method.setting(level) + (s.reason.empty() ? "" : ": " + s.reason);
      if (s.done())
        curve.points.push_back({shown(c, s.error.max), s.cpu.least, note});
      else
        curve.failures.push_back({course.method.asked(level), s.cpu.least, note});
    }
    figure.curves.push_back(curve);
  }
  return figure;
}

report::Figure calibration(const TradeContent& c) {
  report::Figure figure{"Calibration",
                        "What a tolerance gives on this scene",
                        {"tolerance asked", report::Scale::logarithmic},
                        {"largest scaled error", report::Scale::logarithmic},
                        {}};
  for (const Course& course : c.courses) {
    if (course.method.varied != Method::Varied::tolerance) continue;
    report::Curve curve{course.method.name, report::Mark::line_and_points, {}, {}};
    for (const auto& [level, s] : course.samples)
      (s.done() ? curve.points : curve.failures)
          .push_back({course.method.asked(level), s.done() ? shown(c, s.error.max) : 0, s.reason});
    figure.curves.push_back(curve);
  }
  return figure;
}

report::Table work_table(const TradeContent& c) {
  const auto best = front(c);
  report::Table table{"Methods (* on the Pareto front)",
                      {{"", ""},
                       {"method", ""},
                       {"setting", ""},
                       {"error max", ""},
                       {"rms", ""},
                       {"multipliers", ""},
                       {"CPU time", "s"},
                       {"to", "s"},
                       {"runs", ""},
                       {"steps", ""},
                       {"evaluations", ""},
                       {"factorisations", ""},
                       {"", ""}},
                      {}};
  for (const Course& course : c.courses)
    for (const auto& [level, s] : course.samples)
      table.rows.push_back(
          {best.contains({course.method.name, level}) ? "*" : "", course.method.name, course.method.setting(level),
           s.done() ? error_text(c, s.error.max) : to_string(s.status),
           s.done() ? fmt::format("{:.2g}", s.error.rms) : "",
           s.done() ? fmt::format("{:.2g}", s.error.multipliers) : "", fmt::format("{:.3g}", s.cpu.least),
           s.cpu.repetitions > 1 ? fmt::format("{:.3g}", s.cpu.most) : "", std::to_string(s.cpu.repetitions),
           std::to_string(s.counts.steps), std::to_string(s.counts.evaluations),
           std::to_string(s.counts.factorizations), s.deceived ? "deceived" : s.reason.substr(0, 100)});
  return table;
}

report::Table fidelity_table(const TradeContent& c) {
  report::Table table{"Models", {{"change", ""}, {"difference", ""}, {"CPU time", "s"}, {"", ""}}, {}};
  for (const RungResult& r : c.rungs)
    table.rows.push_back({r.rung.what,
                          r.status == CaseResult::Status::done ? error_text(c, r.difference) : to_string(r.status),
                          fmt::format("{:.3g}", r.cpu), r.rung.finer ? "finer" : r.reason.substr(0, 100)});
  return table;
}

report::Table distribution_table(const TradeContent& c) {
  report::Table table{
      "Beyond the horizon: perturbed starts",
      {{"", ""}, {"choice", ""}, {"spread", ""}, {"reference", ""}, {"spread", ""}, {"starts", ""}, {"", ""}},
      {}};
  for (const Distribution& d : c.distributions)
    table.rows.push_back({d.what, fmt::format("{:.6g}", d.mean), fmt::format("{:.2g}", d.spread),
                          fmt::format("{:.6g}", d.reference_mean), fmt::format("{:.2g}", d.reference_spread),
                          std::to_string(d.starts), d.alike() ? "alike" : "differs"});
  return table;
}

report::Table refused_table(const TradeContent& c) {
  report::Table table{"Not capable", {{"method", ""}, {"why", ""}}, {}};
  for (const Refusal& r : c.methods.refused) table.rows.push_back({r.type, r.reason});
  return table;
}

report::Page page_of(const TradeContent& c, const std::string& title) {
  report::Page page{"Speed against accuracy: " + title, sentences(c), {}, {}};
  if (!c.courses.empty()) page.figures = {work_figure(c), calibration(c)}, page.tables.push_back(work_table(c));
  if (!c.rungs.empty()) page.tables.push_back(fidelity_table(c));
  if (!c.distributions.empty()) page.tables.push_back(distribution_table(c));
  if (!c.methods.refused.empty()) page.tables.push_back(refused_table(c));
  return page;
}

// Adds a null for each member that `base` has and `over` lacks, because an include merges objects of one type.
void remove_others(const json& base, json& over) {
  for (const auto& [key, value] : base.items()) {
    if (!over.contains(key))
      over[key] = nullptr;
    else if (value.is_object() && over[key].is_object())
      remove_others(value, over[key]);
  }
}

// The overrides as a file to be included after the scene.
json override_file(const TradeContent& c) {
  json all = json::object();
  const scene::Scene scene = c.source.with();
  for (const scene::Override& o : c.choice->overrides) {
    json* at = &all;
    std::string rest = o.path;
    for (auto dot = rest.find('.'); dot != rest.npos; dot = rest.find('.'))
      at = &(*at)[rest.substr(0, dot)], rest.erase(0, dot + 1);
    json value = json::parse(o.value, nullptr, false);
    if (value.is_discarded()) value = o.value;
    (*at)[rest] = value;
  }
  if (const scene::Value* own = scene.root().find("integrator"); own && all.contains("integrator")) {
    const json base = json::parse(json_text(*own));
    if (base.is_object() && base.value("type", "") == all["integrator"].value("type", ""))
      remove_others(base, all["integrator"]);
  }
  return all;
}

std::string csv_of(const TradeContent& c) {
  std::string text =
      "method,family,setting,asked,status,error_max,error_rms,error_multipliers,cpu_min,cpu_max,repetitions,steps,"
      "evaluations,jacobians,factorizations,newton_iterations,deceived\n";
  for (const Course& course : c.courses)
    for (const auto& [level, s] : course.samples)
      text +=
          fmt::format("\"{}\",{},{},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{},{},{},{},{},{}\n",
                      course.method.name, course.method.family, course.method.setting(level),
                      course.method.asked(level), to_string(s.status), s.error.max, s.error.rms, s.error.multipliers,
                      s.cpu.least, s.cpu.most, s.cpu.repetitions, s.counts.steps, s.counts.evaluations,
                      s.counts.jacobians, s.counts.factorizations, s.counts.newton_iterations, s.deceived ? 1 : 0);
  return text;
}

json choice_json(const Choice& choice) {
  json set = json::array();
  for (const scene::Override& o : choice.overrides) set.push_back(o.path + "=" + o.value);
  return {{"integrator", choice.integrator}, {"set", set},
          {"error", choice.error},           {"cpu_s", choice.cpu},
          {"own_cpu_s", choice.own_cpu},     {"own_error", choice.own_done ? json(choice.own_error) : json()}};
}

json to_json(const TradeContent& c, const report::Page& page, plugin::Registry& registry) {
  const scene::Scene scene = c.source.with();
  json all = {{"trammel_trade", 1},
              {"status", c.reference ? "done" : "failed"},
              {"scene", c.source.file()},
              {"scene_hash", fmt::format("{:016x}", scene.hash())}};
  all.update(simulate::provenance(scene, c.options.command, registry.identities()));
  if (c.options.target) all["target"] = *c.options.target;
  if (c.reference)
    all["reference"] = {{"first", c.reference->first.method.name},
                        {"first_tolerance", c.reference->first.tolerance},
                        {"second", c.reference->second.method.name},
                        {"second_tolerance", c.reference->second.tolerance},
                        {"disagreement", c.reference->disagreement},
                        {"floor", c.reference->floor()},
                        {"differ_at", c.reference->differ_at},
                        {"trusted_until", c.reference->trusted_until},
                        {"chaotic", c.reference->chaotic}};
  if (c.choice) all["choice"] = choice_json(*c.choice);
  json deceived = json::object();
  for (const Course& course : c.courses) deceived[course.method.name] = course.deceived();
  all["deceived"] = deceived;
  all["runs"] = c.runs, all["search_runs"] = c.search_runs, all["full_grid"] = c.full_grid, all["cpu_time_s"] = c.cpu;
  all["page"] = report::to_json(page);
  return all;
}

std::string text_of(const report::Page& page) {
  std::string text = page.title + "\n";
  for (const std::string& sentence : page.sentences) text += "  " + sentence + "\n";
  for (const report::Table& table : page.tables) {
    text += "\n" + table.title + "\n";
    std::vector<std::size_t> width;
    for (const report::Column& column : table.columns)
      width.push_back(column.name.size() + (column.unit.empty() ? 0 : column.unit.size() + 3));
    for (const auto& row : table.rows)
      for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
    text += " ";
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      const report::Column& column = table.columns[k];
      text +=
          fmt::format(" {:<{}}", column.unit.empty() ? column.name : column.name + " [" + column.unit + "]", width[k]);
    }
    for (const auto& row : table.rows) {
      text += "\n ";
      for (std::size_t k = 0; k < row.size(); ++k) text += fmt::format(" {:<{}}", row[k], width[k]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

TradeReport write_trade(const TradeContent& c, plugin::Registry& registry) {
  const report::Page page = page_of(c, simulate::title_of(c.source.with()));
  TradeReport report{c.choice, to_json(c, page, registry).dump(2, ' ', false, json::error_handler_t::replace),
                     text_of(page), c.reference.has_value()};
  const auto write = [&](const char* name, const std::string& text) {
    simulate::write_whole(c.options.out / name, text);
  };
  write("trade.json", report.json + "\n");
  write("trade.csv", csv_of(c));
  if (c.choice) {
    write("choice.json", override_file(c).dump(2) + "\n");
    write("scene.chosen.json", c.source.with(c.choice->overrides).resolved());
    report.summary += fmt::format(
        "\nTo use it: trammel run {0}/scene.chosen.json, or \"include\": [\"SCENE\", \"choice.json\"] with "
        "{0}/choice.json\n",
        c.options.out.string());
  }
  report.summary += fmt::format("Results are in {}", c.options.out.string());
  return report;
}

}  // namespace trammel::study
