#include "report/report.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/html.hpp"
#include "report/json_file.hpp"
#include "report/run_data.hpp"

namespace trammel::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool has(const fs::path& folder, const char* file) {
  std::error_code error;
  return fs::exists(folder / file, error);
}

// Joins the pages of `trammel check` on a library into one. Sentences and titles begin with the title of their page.
Json joined(const std::vector<Json>& pages) {
  if (pages.size() == 1) return pages.front();
  Json all = {{"title", fmt::format("{} components", pages.size())}};
  for (const char* key : {"sentences", "figures", "tables"}) all[key] = Json::array();
  for (const Json& page : pages) {
    const std::string title = page.value("title", "");
    for (const Json& sentence : page.at("sentences"))
      all["sentences"].push_back(fmt::format("{}: {}", title, sentence.get<std::string>()));
    for (const char* key : {"figures", "tables"})
      for (Json part : page.at(key)) {
        part["title"] = fmt::format("{}: {}", title, part.value("title", ""));
        all[key].push_back(std::move(part));
      }
  }
  return all;
}

// The "page" of a result, or those of its "components"; null: there is none.
Json page_of(const Json& json) {
  if (const Json* page = find(json, {"page"})) return *page;
  std::vector<Json> pages;
  if (const Json* components = find(json, {"components"}); components && components->is_array())
    for (const Json& component : *components)
      if (const Json* page = find(component, {"page"})) pages.push_back(*page);
  return pages.empty() ? Json(nullptr) : joined(pages);
}

// The page of the file, or of the first of a folder's JSON files that has one. A file that is no JSON, such as a scene
// with comments, has none. null: there is none.
Json page_in(const fs::path& what) {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::is_directory(what, error)) {
    for (const auto& entry : fs::directory_iterator(what))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
  } else {
    files = {what};
  }
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    Json page = page_of(Json::parse(in, nullptr, false));
    if (!page.is_null()) return page;
  }
  return nullptr;
}

std::string title_of(const Json& run) {
  const std::string title = run["result"].value("title", "");
  return title.empty() ? run["name"].get<std::string>() : title;
}

void require_there(const fs::path& what) {
  std::error_code error;
  if (!fs::exists(what, error)) throw ReportRefused(fmt::format("there is no {}", what.string()));
}

std::string of_runs(const std::vector<fs::path>& folders) {
  Json runs = Json::array();
  for (const fs::path& folder : folders) runs.push_back(run_data(folder, Room().shared_by(folders.size())));
  std::string title = title_of(runs.front());
  if (folders.size() > 1) title += fmt::format(" and {} more", folders.size() - 1);
  return html_file(title, {{"kind", "runs"}, {"runs", std::move(runs)}}, Needs::runs);
}

}  // namespace

std::string report(const std::vector<fs::path>& what) {
  for (const fs::path& one : what) require_there(one);
  if (std::all_of(what.begin(), what.end(), [](const fs::path& one) { return has(one, "series.csv"); }))
    return of_runs(what);
  if (what.size() > 1) {
    const auto other =
        std::find_if(what.begin(), what.end(), [](const fs::path& one) { return !has(one, "series.csv"); });
    throw ReportRefused(
        fmt::format("only runs are compared in one report, and {} is none (it has no series.csv): report it alone",
                    other->string()));
  }
  if (has(what.front(), "modes.json")) {
    Json data = modes_data(what.front());
    const std::string title = title_of(data);
    return html_file(title, {{"kind", "modes"}, {"modes", std::move(data)}}, Needs::runs);
  }
  Json page = page_in(what.front());
  if (page.is_null())
    throw ReportRefused(fmt::format(
        "{} holds no results: expected a folder of 'trammel run', 'static' or 'modes', or a JSON file with a "
        "\"page\", as 'trammel check', 'trade', 'study' and 'stability' write it",
        what.front().string()));
  const std::string title = page.value("title", "Trammel");
  return html_file(title, {{"kind", "page"}, {"page", std::move(page)}}, Needs::page);
}

}  // namespace trammel::report
