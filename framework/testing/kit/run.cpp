#include "testing/kit/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "plugin/plugin_error.hpp"
#include "plugin/registry.hpp"
#include "scene/suggestion.hpp"
#include "testing/kit/catalogue.hpp"
#include "testing/kit/child.hpp"
#include "testing/kit/examples.hpp"
#include "testing/kit/sample.hpp"

namespace trammel::kit {

namespace {

using Json = nlohmann::ordered_json;

constexpr Kind kinds[] = {Kind::integrator, Kind::body,     Kind::joint,     Kind::force,
                          Kind::contact,    Kind::friction, Kind::correction};

Kind kind_of_name(const std::string& name) {
  for (const Kind kind : kinds)
    if (name == to_string(kind)) return kind;
  throw std::logic_error("no kind " + name);
}

bool is_file(const std::string& operand) {
  std::error_code error;
  return operand.find('/') != operand.npos || operand.ends_with(".so") || std::filesystem::exists(operand, error);
}

std::vector<std::string> parameters_of(const Request& request, const std::string& kind, const std::string& name) {
  return request.with.empty() ? example_of(kind, name).entries : request.with;
}

// --- in a child: the survey ---

std::string interface_of_entry(const Request& request, const plugin::Entry& entry) {
  const Declaration& d = entry.declaration;
  const auto forms = forms_of(entry, parameters_of(request, to_string(d.kind), d.name), Level::quick);
  return interface_of(*make_from(entry, forms.front().entry, forms.front().world));
}

std::vector<const plugin::Entry*> entries_of(const Request& request, plugin::Registry& registry) {
  if (!is_file(request.operand)) {
    for (const std::string& plugin : request.plugins) registry.search(plugin);
    return registry.find_any(request.operand);
  }
  registry.search(request.operand);
  return registry.all();
}

Json look_around(const Request& request) {
  // A library alone needs nothing of the installed ones.
  plugin::Registry registry(is_file(request.operand) ? plugin::Registry::Start::empty
                                                     : plugin::Registry::Start::installed);
  Json found = Json::array();
  std::vector<std::string> names;
  for (const plugin::Entry* entry : entries_of(request, registry)) {
    names.push_back(entry->declaration.name);
    if (!request.component.empty() && entry->declaration.name != request.component) continue;
    found.push_back({{"kind", to_string(entry->declaration.kind)},
                     {"name", entry->declaration.name},
                     {"file", entry->file},
                     {"interface", interface_of_entry(request, *entry)}});
  }
  if (found.empty())
    return {{"nothing", fmt::format("{} has no component \"{}\"{}", request.operand, request.component,
                                    scene::did_you_mean(request.component, names))}};
  return {{"components", found}};
}

std::string survey_as_text(const Request& request) {
  try {
    return look_around(request).dump();
  } catch (const plugin::UnknownComponent& e) {
    return Json{{"nothing", e.what()}}.dump();
  } catch (const plugin::PluginError& e) {
    return Json{{"refused", e.cause()}, {"file", e.origin().file}}.dump();
  } catch (const std::exception& e) {  // no parameters that it accepts
    return Json{{"nothing", e.what()}}.dump();
  }
}

// --- in a child: one check ---

Finding worst(std::vector<std::pair<std::string, Finding>> findings) {
  Finding all;
  bool asked = false;
  for (auto& [form, one] : findings) {
    if (!form.empty()) one.text = fmt::format("[{}] {}", form, one.text);
    asked = asked || one.verdict != Verdict::skipped;
    if (one.verdict == Verdict::failed) all.verdict = Verdict::failed;
    if (!all.text.empty() && all.text.back() != '\n') all.text += '\n';
    all.text += one.text;
  }
  // The same reason for all forms is said once.
  if (!asked) all = {Verdict::skipped, findings.front().second.text};
  return all;
}

Finding ask(const Check& check, const Subject& subject) {
  try {
    if (check.left_out)
      if (const std::string why = check.left_out(subject); !why.empty()) return {Verdict::skipped, why};
    return finding(check.find_out(subject));
  } catch (const std::exception& e) {
    return {Verdict::failed, fmt::format("FAILS: nothing is thrown: {}\n", e.what())};
  } catch (...) {
    return {Verdict::failed, "FAILS: nothing is thrown: it threw something that is no std::exception\n"};
  }
}

Finding find_out(const Request& request, const Surveyed& component, const Check& check) {
  plugin::Registry registry(plugin::Registry::Start::empty);
  registry.load(component.file);
  const plugin::Entry& entry = registry.find(kind_of_name(component.kind), component.name);
  std::vector<std::pair<std::string, Finding>> findings;
  const auto forms = forms_of(entry, parameters_of(request, component.kind, component.name), request.level);
  for (const Form& form : forms)
    findings.emplace_back(forms.size() > 1 ? form.name : "", ask(check, {entry, form, request.level, request.seed}));
  return worst(std::move(findings));
}

std::string as_text(const Finding& finding) {
  return Json{{"verdict", int(finding.verdict)}, {"text", finding.text}}.dump(-1, ' ', false,
                                                                              Json::error_handler_t::replace);
}

// --- in this process ---

Finding finding_of(const Ending& ending) {
  switch (ending.how) {
    case Ending::How::crashed:
      return {Verdict::crashed, ending.cause};
    case Ending::How::timed_out:
      return {Verdict::timed_out, ending.cause};
    default: {
      const Json json = Json::parse(ending.answer);
      return {Verdict(json.at("verdict").get<int>()), json.at("text").get<std::string>()};
    }
  }
}

Checks chosen(const Request& request, const Surveyed& component) {
  Checks all = catalogue(component.interface);
  if (request.only.empty()) return all;
  std::vector<std::string> names;
  for (const Check& check : all) names.push_back(check.words.name);
  std::erase_if(all, [&](const Check& check) { return check.words.name != request.only; });
  if (all.empty())
    throw NothingToCheck(fmt::format("{} \"{}\" has no check \"{}\"{}", component.kind, component.name, request.only,
                                     scene::did_you_mean(request.only, names)));
  return all;
}

std::string expected_reason(const Request& request, const Surveyed& component, const std::string& check) {
  if (const auto given = request.expected.find(check); given != request.expected.end()) return given->second;
  // Examples are of the components that Trammel ships.
  const Example example = example_of(component.kind, component.name);
  const auto known = example.expected.find(check);
  return known != example.expected.end() ? known->second : "";
}

}  // namespace

bool Result::counts_as_failed() const {
  return expected.empty() && (finding.verdict == Verdict::failed || finding.verdict == Verdict::crashed ||
                              finding.verdict == Verdict::timed_out);
}

int Verdicts::count(Verdict verdict) const {
  return int(std::ranges::count(results, verdict, [](const Result& r) { return r.finding.verdict; }));
}

int Verdicts::failed() const {
  return int(std::ranges::count_if(results, &Result::counts_as_failed));
}

std::vector<Surveyed> survey(const Request& request) {
  const Ending ending = run_in_child({[&] { return survey_as_text(request); }, std::chrono::seconds(60)});
  if (ending.how != Ending::How::answered)
    throw CannotBeLoaded(request.operand, fmt::format("{} while its components were made", ending.cause));
  const Json json = Json::parse(ending.answer);
  if (json.contains("nothing")) throw NothingToCheck(json["nothing"].get<std::string>());
  if (json.contains("refused"))
    throw CannotBeLoaded(json["file"].get<std::string>(), json["refused"].get<std::string>());
  std::vector<Surveyed> found;
  for (const Json& c : json.at("components"))
    found.push_back({c.at("kind"), c.at("name"), c.at("file"), c.at("interface")});
  return found;
}

Verdicts run(const Request& request, const Surveyed& component, const std::function<void(const Result&)>& done) {
  Verdicts verdicts{component, {}};
  const Checks checks = chosen(request, component);
  const auto keep = [&](const Check& check, Finding found, double seconds, std::string printed) {
    verdicts.results.push_back({check.words, std::move(found), seconds, std::move(printed),
                                expected_reason(request, component, check.words.name)});
    if (done) done(verdicts.results.back());
  };
  if (request.in_process) {
    for (const Check& check : checks) {
      const auto start = std::chrono::steady_clock::now();
      Finding found = find_out(request, component, check);
      keep(check, std::move(found), std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
           "");
    }
    return verdicts;
  }
  std::vector<Job> jobs;
  for (const Check& check : checks)
    jobs.push_back({[&] { return as_text(find_out(request, component, check)); },
                    request.level == Level::quick ? request.limit : 4 * request.limit});
  run_in_children(jobs, request.parallel, [&](std::size_t i, const Ending& ending) {
    keep(checks[i], finding_of(ending), ending.seconds, ending.printed);
  });
  return verdicts;
}

Json to_json(const Verdicts& v) {
  Json checks = Json::array();
  for (const Result& r : v.results) {
    Json one = {{"name", r.words.name},
                {"verdict", to_string(r.finding.verdict)},
                {"claim", r.words.claim},
                {"equation", r.words.equation},
                {"contract", {{"header", r.words.contract.header}, {"line", r.words.contract.line}}},
                {"found", r.finding.text},
                {"seconds", r.seconds}};
    if (!r.printed.empty()) one["printed"] = r.printed;
    if (!r.expected.empty()) one["expected to fail"] = r.expected;
    checks.push_back(std::move(one));
  }
  return {{"kind", v.component.kind},
          {"name", v.component.name},
          {"file", v.component.file},
          {"of", v.results.size()},
          {"ran", v.asked()},
          {"passed", v.count(Verdict::passed)},
          {"failed", v.failed()},
          {"crashed", v.count(Verdict::crashed)},
          {"timed out", v.count(Verdict::timed_out)},
          {"skipped", v.count(Verdict::skipped)},
          {"checks", std::move(checks)}};
}

}  // namespace trammel::kit
