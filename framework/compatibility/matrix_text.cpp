// The matrix as tables for a terminal and as JSON.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compatibility/matrix.hpp"

namespace trammel::compatibility {
namespace {

using json = nlohmann::ordered_json;
using Row = std::vector<std::string>;

bool contains(const std::vector<Need>& all, Need need) {
  return std::find(all.begin(), all.end(), need) != all.end();
}

const char* mark(bool yes) {
  return yes ? "yes" : "-";
}

std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> width(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t j = 0; j < row.size(); ++j) width[j] = std::max(width[j], row[j].size());
  std::string text;
  for (const Row& row : rows) {
    std::string line = " ";
    for (std::size_t j = 0; j < row.size(); ++j) line += fmt::format(" {:<{}} ", row[j], width[j]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string integrators(const Matrix& matrix) {
  Row head = {""};
  for (const Need need : every_need) head.emplace_back(name(need));
  head.emplace_back("dense_output"), head.emplace_back("maps_history");
  std::vector<Row> rows = {head};
  for (const IntegratorForm& one : matrix.integrators) {
    Row row = {one.form.name()};
    for (const Need need : every_need) row.emplace_back(mark(contains(one.takes, need)));
    row.emplace_back(mark(one.dense_output)), row.emplace_back(mark(one.maps_history));
    rows.push_back(row);
  }
  return "integrators, by what scenes need\n" + table(rows);
}

std::string needs_of(const LawPair& laws) {
  std::string text = laws.fixed_steps ? "fixed steps" : "";
  for (const Need need : laws.needs) text += (text.empty() ? "" : ", ") + std::string(name(need));
  return text.empty() ? "nothing" : text;
}

std::string name_of(const std::optional<Form>& form, const char* without) {
  return form ? form->name() : without;
}

std::string laws(const Matrix& matrix) {
  std::vector<std::string> reasons;
  const auto no = [&reasons](const std::string& reason) {
    auto known = std::find(reasons.begin(), reasons.end(), reason);
    if (known == reasons.end()) known = reasons.insert(reasons.end(), reason);
    return fmt::format("no [{}]", known - reasons.begin() + 1);
  };
  const auto allowed = [&no](const std::string& why_not) { return why_not.empty() ? "yes" : no(why_not); };
  std::vector<Row> rows = {{"contact", "friction", "run", "static", "modes", "needs of the integrator"}};
  for (const LawPair& one : matrix.laws) {
    const bool apart = !one.why_not.empty();
    rows.push_back({name_of(one.contact, "in a joint"), name_of(one.friction, "none"), allowed(one.why_not),
                    apart ? "-" : allowed(one.why_no_statics), apart ? "-" : allowed(one.why_no_modes),
                    apart ? "-" : needs_of(one)});
  }
  std::string text = "laws of contact and friction\n" + table(rows);
  for (std::size_t i = 0; i < reasons.size(); ++i) text += fmt::format("  [{}] {}\n", i + 1, reasons[i]);
  return text;
}

std::string corrections(const Matrix& matrix) {
  std::vector<Row> rows = {{"", "position", "velocity", "energy", "needs of bodies"}};
  for (const CorrectionForm& one : matrix.corrections) {
    Row row = {one.form.name()};
    for (const auto level : {Correction::Level::position, Correction::Level::velocity, Correction::Level::energy})
      row.emplace_back(mark(std::find(one.levels.begin(), one.levels.end(), level) != one.levels.end()));
    row.emplace_back(one.needs_momentum ? "momentum" : "nothing");
    rows.push_back(row);
  }
  return "corrections, with every integrator\n" + table(rows);
}

std::string bodies(const Matrix& matrix) {
  std::vector<Row> rows = {{"", "rows", "rotations in space", "refines", "momentum", "exact tangent", "surface",
                            "fields", "limit of theory"}};
  for (const BodyKind& one : matrix.bodies)
    rows.push_back({one.type, mark(one.rows), mark(one.rotations), mark(one.refines), mark(one.momentum),
                    mark(one.exact_tangent), mark(one.surface), mark(one.fields), mark(one.theory_limit)});
  return "bodies: what they need (rows, rotations, refines: events) and what they offer\n" + table(rows);
}

json form_json(const Form& form) {
  json one = {{"name", form.type}};
  if (!form.parameter.empty()) one["parameters"] = {{form.parameter, form.choice}};
  return one;
}

json names(const std::vector<Need>& needs) {
  json all = json::array();
  for (const Need need : needs) all.push_back(name(need));
  return all;
}

json verdict(const std::string& why_not) {
  return why_not.empty() ? json{{"allowed", true}} : json{{"allowed", false}, {"why", why_not}};
}

json law_json(const LawPair& laws) {
  json one;
  one["contact"] = laws.contact ? form_json(*laws.contact) : json();
  one["friction"] = laws.friction ? form_json(*laws.friction) : json();
  one["run"] = verdict(laws.why_not);
  const bool apart = !laws.why_not.empty();
  one["static"] = verdict(apart ? laws.why_not : laws.why_no_statics);
  one["modes"] = verdict(apart ? laws.why_not : laws.why_no_modes);
  one["needs"] = names(laws.needs);
  one["needs_fixed_steps"] = laws.fixed_steps;
  return one;
}

}  // namespace

std::string text(const Matrix& matrix) {
  return integrators(matrix) + "\n" + laws(matrix) + "\n" + corrections(matrix) + "\n" + bodies(matrix);
}

json to_json(const Matrix& matrix) {
  json all = {{"needs", json::array()},
              {"integrators", json::array()},
              {"laws", json::array()},
              {"corrections", json::array()},
              {"bodies", json::array()}};
  for (const Need need : every_need) all["needs"].push_back({{"name", name(need)}, {"what", noun(need)}});
  for (const IntegratorForm& one : matrix.integrators) {
    json entry = form_json(one.form);
    entry["takes"] = names(one.takes);
    entry["dense_output"] = one.dense_output, entry["maps_history"] = one.maps_history;
    all["integrators"].push_back(entry);
  }
  for (const LawPair& one : matrix.laws) all["laws"].push_back(law_json(one));
  for (const CorrectionForm& one : matrix.corrections) {
    json entry = form_json(one.form);
    entry["levels"] = json::array();
    for (const Correction::Level level : one.levels) entry["levels"].push_back(to_string(level));
    entry["needs_momentum"] = one.needs_momentum;
    all["corrections"].push_back(entry);
  }
  for (const BodyKind& one : matrix.bodies)
    all["bodies"].push_back({{"name", one.type},
                             {"rows", one.rows},
                             {"rotations", one.rotations},
                             {"refines", one.refines},
                             {"momentum", one.momentum},
                             {"exact_tangent", one.exact_tangent},
                             {"surface", one.surface},
                             {"fields", one.fields},
                             {"theory_limit", one.theory_limit}});
  return all;
}

}  // namespace trammel::compatibility
