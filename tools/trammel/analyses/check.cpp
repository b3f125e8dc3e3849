// trammel check LIB|COMPONENT: the conformance kit's verdict.
#include <algorithm>
#include <charconv>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "input.hpp"
#include "progress.hpp"
#include "report/page.hpp"
#include "simulate/results/log_file.hpp"
#include "testing/kit/catalogue.hpp"
#include "testing/kit/child.hpp"
#include "testing/kit/page.hpp"
#include "testing/kit/run.hpp"

namespace trammel::tool {

namespace {

using kit::Verdict;
using Json = nlohmann::ordered_json;

constexpr Option kLevel{"--level", "LEVEL",
                        "quick (the default, a minute) or full (minutes): finer steps, every choice of a parameter"};
constexpr Option kOnly{"--only", "CHECK", "this check alone, e.g. integrator.trial-leaves-no-trace"};
constexpr Option kSeed{"--seed", "N", "of the random numbers in the checks; 1 if left out"};
constexpr Option kWith{"--with", "JSON",
                       "the component's parameters, an object as in a scene (repeatable: forms checked in turn); "
                       "\"space\": \"spatial\" for one in space"};
constexpr Option kExpect{"--expect", "CHECK=REASON", "this check may fail, for this reason (repeatable)"};
constexpr Option kCheckReport{
    "--report", "FILE", "write an HTML page: verdicts, order plots, spectral radius, drifts, work against precision"};
constexpr Option kComponent{"--component", "NAME", "one component of a library with several; all of them if left out"};
constexpr Option kLimit{"--limit", "SECONDS",
                        "of one check, then it counts as timed out; 30 if left out, 4 times as long at level full"};
constexpr Option kInProcess{"--in-process", "",
                            "in this process, for a debugger; else each check runs in one of its own"};
constexpr Option kList{"--list", "", "the checks and their claims, without running them"};

unsigned number_of(std::string_view option, const std::string& text) {
  unsigned n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size())
    throw UsageError(fmt::format("{} {}: expected a whole number >= 0", option, text));
  return n;
}

kit::Level level_of(const std::string& text) {
  if (text == "quick") return kit::Level::quick;
  if (text == "full") return kit::Level::full;
  throw UsageError(fmt::format("--level {}: expected quick or full", text));
}

void require_objects(const std::vector<std::string>& all) {
  for (const std::string& text : all) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object())
      throw UsageError(fmt::format("--with {}: expected a JSON object, e.g. '{{\"mass\": 2}}'", text));
  }
}

kit::Request request_of(const Arguments& a) {
  kit::Request request{.operand = a.operand(), .plugins = a.all("--plugin"), .with = a.all("--with")};
  require_objects(request.with);
  if (a.has("--level")) request.level = level_of(a.last("--level"));
  if (a.has("--seed")) request.seed = number_of("--seed", a.last("--seed"));
  if (a.has("--only")) request.only = a.last("--only");
  if (a.has("--component")) request.component = a.last("--component");
  if (a.has("--limit")) request.limit = std::chrono::seconds(number_of("--limit", a.last("--limit")));
  for (const std::string& text : a.all("--expect")) {
    const auto equals = text.find('=');
    if (equals == text.npos || equals + 1 == text.size())
      throw UsageError(fmt::format("--expect {}: expected CHECK=REASON", text));
    request.expected[text.substr(0, equals)] = text.substr(equals + 1);
  }
  request.in_process = a.has("--in-process");
  request.parallel = std::clamp(int(std::thread::hardware_concurrency()), 1, 8);
  return request;
}

// The component's parameters with the type that a scene would name.
std::vector<std::string> with_type(std::vector<std::string> objects, const std::string& name) {
  for (std::string& text : objects) {
    Json object = {{"type", name}};
    object.update(Json::parse(text));
    text = object.dump();
  }
  return objects;
}

std::string alone(const Arguments& a, const std::string& check) {
  std::string text = fmt::format("trammel check {} --only {} --in-process", shell_quoted(a.operand()), check);
  for (const char* option : {"--component", "--plugin", "--with", "--level", "--seed"})
    for (const std::string& value : a.all(option)) text += fmt::format(" {} {}", option, shell_quoted(value));
  return text;
}

std::string indented(const std::string& text, int columns) {
  std::string all;
  for (const std::string& line : lines(text)) all += fmt::format("{:{}}{}\n", "", columns, line);
  return all;
}

void print_failure(const Arguments& a, const kit::Result& r) {
  constexpr int at = 11;
  fmt::print("{:{}}claim     {}\n", "", at, r.words.claim);
  fmt::print("{:{}}equation  {}\n", "", at, r.words.equation);
  fmt::print("{:{}}contract  {}: \"{}\"\n", "", at, r.words.contract.header, r.words.contract.line);
  fmt::print("{:{}}found\n{}", "", at, indented(r.finding.text, at + 2));
  if (!r.printed.empty()) fmt::print("{:{}}printed\n{}", "", at, indented(r.printed, at + 2));
  if (!r.expected.empty()) fmt::print("{:{}}expected: {}\n", "", at, r.expected);
  fmt::print("{:{}}alone     {}\n", "", at, alone(a, r.words.name));
}

void print_result(const Arguments& a, const kit::Result& r) {
  const bool good = r.finding.verdict == Verdict::passed || r.finding.verdict == Verdict::skipped;
  std::string verdict = to_string(r.finding.verdict);
  if (r.counts_as_failed()) std::transform(verdict.begin(), verdict.end(), verdict.begin(), ::toupper);
  const std::string note = r.finding.verdict == Verdict::skipped  ? lines(r.finding.text + "\n").front()
                           : r.finding.verdict == Verdict::passed ? r.words.claim
                                                                  : "";
  fmt::print("  {:<9}{:<52}{}\n", verdict, r.words.name, note);
  if (!good) print_failure(a, r);
  std::fflush(stdout);
}

std::string plural(int n, const char* word) {
  return fmt::format("{} {}", n, word);
}

void print_summary(const Arguments& a, const kit::Verdicts& v) {
  const int expected = int(std::ranges::count_if(v.results, [](const kit::Result& r) {
    return !r.expected.empty() && r.finding.verdict != Verdict::passed && r.finding.verdict != Verdict::skipped;
  }));
  std::string text = fmt::format("{} {}: {} of {} checks ran: {} passed", v.component.kind, v.component.name, v.asked(),
                                 v.results.size(), v.count(Verdict::passed));
  for (const Verdict verdict : {Verdict::failed, Verdict::crashed, Verdict::timed_out, Verdict::warned})
    if (v.count(verdict) > 0) text += ", " + plural(v.count(verdict), to_string(verdict));
  if (expected > 0) text += fmt::format(" ({} as expected)", expected);
  if (v.count(Verdict::skipped) > 0)
    text += fmt::format("; {} skipped, each with its reason above", v.count(Verdict::skipped));
  fmt::print("\n{}\n", text);
  const std::string with = v.component.file == a.operand() || a.operand().find('/') != std::string::npos
                               ? fmt::format(" --plugin {}", shell_quoted(a.operand()))
                               : "";
  const auto failed = std::ranges::find_if(v.results, &kit::Result::counts_as_failed);
  fmt::print("next: {}\n", failed == v.results.end() ? fmt::format("trammel describe {}{}", v.component.name, with)
                                                     : alone(a, failed->words.name));
}

void print_list(const kit::Surveyed& component) {
  const kit::Checks checks = kit::catalogue(component.interface);
  fmt::print("{} {}: {} checks\n\n", component.kind, component.name, checks.size());
  for (const kit::Check& check : checks) fmt::print("  {:<52}{}\n", check.words.name, check.words.claim);
}

std::vector<kit::Surveyed> components_of(const kit::Request& request) {
  try {
    return kit::survey(request);
  } catch (const kit::NothingToCheck& e) {
    throw UsageError(e.what());
  } catch (const kit::CannotBeLoaded& e) {
    throw plugin::PluginError(e.file, e.what());
  }
}

kit::Verdicts verdicts_of(const Arguments& a, kit::Request request, const kit::Surveyed& component, bool quiet) {
  request.with = with_type(request.with, component.name);
  if (!quiet)
    fmt::print("{} {} of {}, level {}, seed {}\n\n", component.kind, component.name, component.file,
               request.level == kit::Level::quick ? "quick" : "full", request.seed);
  ProgressBar bar(!quiet);
  const std::size_t of = request.only.empty() ? kit::catalogue(component.interface).size() : 1;
  std::size_t done = 0;
  try {
    return kit::run(request, component, [&](const kit::Result& r) {
      bar.clear();
      if (!quiet) print_result(a, r);
      bar.draw(double(++done) / double(of), fmt::format("{} of {} checks", done, of));
    });
  } catch (const kit::NothingToCheck& e) {
    throw UsageError(e.what());
  }
}

// Measuring the page takes minutes and executes the plugin's code, so it runs in a child process, too.
report::Page page_of(const kit::Request& request, const kit::Surveyed& component, const kit::Verdicts& verdicts) {
  report::Page page = kit::verdict_page(verdicts);
  const kit::Ending ending = kit::run_in_child({[&] {
                                                  try {
                                                    return kit::text_of(kit::measured_page(request, component, page));
                                                  } catch (const std::exception& e) {
                                                    return std::string("!") + e.what();
                                                  }
                                                },
                                                std::chrono::minutes(10)});
  if (ending.how == kit::Ending::How::answered && !ending.answer.starts_with('!'))
    return kit::page_of_text(ending.answer);
  page.sentences.push_back(
      fmt::format("The figures could not be measured: {}.",
                  ending.how == kit::Ending::How::answered ? ending.answer.substr(1) : ending.cause));
  return page;
}

// my.html for the only component, my_NAME.html for one of several.
std::string report_file(std::string file, const std::string& name, bool several) {
  if (!several) return file;
  const auto dot = file.rfind('.');
  return file.insert(dot == file.npos ? file.size() : dot, "_" + name);
}

Exit check(const Arguments& a) {
  const kit::Request request = request_of(a);
  const bool json = a.has("--json");
  Json components = Json::array();
  int failed = 0;
  const auto found = components_of(request);
  for (const kit::Surveyed& component : found) {
    if (a.has("--list")) {
      print_list(component);
      continue;
    }
    const kit::Verdicts verdicts = verdicts_of(a, request, component, json);
    failed += verdicts.failed();
    components.push_back(kit::to_json(verdicts));
    if (!json) print_summary(a, verdicts);
    if (!a.has("--report")) continue;
    const std::string file = report_file(a.last("--report"), component.name, found.size() > 1);
    const report::Page page = page_of(request, component, verdicts);
    simulate::write_whole(file, report::html(page));
    components.back()["page"] = report::to_json(page);
    if (!json) fmt::print("report: {}\n", file);
  }
  if (json)
    print_json({{"status", failed ? "failed" : "done"},
                {"level", request.level == kit::Level::quick ? "quick" : "full"},
                {"seed", request.seed},
                {"components", components}});
  return failed ? Exit::failed : Exit::done;
}

}  // namespace

Command check_command() {
  return {"check",
          "LIB|COMPONENT",
          "Measure whether a plugin keeps its contract and its claims, each check in a process of its own.",
          {kLevel, kOnly, kComponent, kSeed, kLimit, kWith, kExpect, kCheckReport, kPlugin, kInProcess, kList, kJson},
          check};
}

}  // namespace trammel::tool
