#include "report/html.hpp"

#include <span>
#include <stdexcept>
#include <string_view>

#include <nlohmann/json.hpp>

#include "report/assets.hpp"

namespace trammel::report {

namespace {

using Json = nlohmann::ordered_json;
using std::string_view;

constexpr string_view page_scripts[] = {"dom.js", "numbers.js", "palette.js", "figure.js", "table.js", "page.js"};
constexpr string_view run_scripts[] = {"bytes.js",  "series.js", "animation.js", "camera.js",    "painter.js",
                                       "stage.js",  "clock.js",  "player.js",    "time_plot.js", "plots.js",
                                       "events.js", "facts.js",  "runs.js",      "modes.js"};

std::string escaped(string_view text) {
  std::string all;
  for (const char c : text) switch (c) {
      case '<':
        all += "&lt;";
        break;
      case '&':
        all += "&amp;";
        break;
      default:
        all += c;
    }
  return all;
}

// JSON inside a script element: a text of the scene cannot end the element, because "<" is escaped.
std::string embedded(const Json& data) {
  std::string all;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) c == '<' ? all += "\\u003c" : all += c;
  return all;
}

void add_scripts(std::string& file, std::span<const string_view> names) {
  for (const string_view name : names) file.append(asset(name)).append("\n");
}

}  // namespace

std::string html_file(const std::string& title, const Json& data, Needs needs) {
  const bool runs = needs == Needs::runs;
  if (runs && asset("dygraph.min.js").empty())
    throw std::runtime_error(
        "this program was built without dygraphs, which draws the plots of a report: install libjs-dygraphs and build "
        "again (tools/build does both)");
  std::string file = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  file += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  file += "<meta name=\"generator\" content=\"trammel report\">\n";
  file.append("<title>").append(escaped(title)).append("</title>\n<style>\n").append(asset("report.css"));
  if (runs) file.append(asset("run.css")).append(asset("dygraph.min.css"));
  file += "</style>\n</head>\n<body>\n<main id=\"report\"></main>\n";
  file += "<noscript>This report draws its figures with JavaScript, which is off here.</noscript>\n";
  file.append("<script type=\"application/json\" id=\"data\">").append(embedded(data)).append("</script>\n");
  if (runs) file.append("<script>\n").append(asset("dygraph.min.js")).append("\n</script>\n");
  file += "<script>\n(() => {\n\"use strict\";\n";
  add_scripts(file, page_scripts);
  if (runs) add_scripts(file, run_scripts);
  file.append(asset("main.js")).append("})();\n</script>\n</body>\n</html>\n");
  return file;
}

std::string html(const Page& page) {
  return html_file(page.title, {{"kind", "page"}, {"page", to_json(page)}}, Needs::page);
}

}  // namespace trammel::report
