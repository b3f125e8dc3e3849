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

// JSON inside of a script element: a text of the scene cannot end the element, because "<" stands as an escape.
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
  (void)runs;
  std::string file = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  file += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  file += "<meta name=\"generator\" content=\"trammel report\">\n";
  file.append("<title>").append(escaped(title)).append("</title>\n<style>\n").append(asset("report.css"));
  file += "</style>\n</head>\n<body>\n<main id=\"report\"></main>\n";
  file += "<noscript>This report draws its figures with JavaScript, which is off here.</noscript>\n";
  file.append("<script type=\"application/json\" id=\"data\">").append(embedded(data)).append("</script>\n");
  file += "<script>\n(() => {\n\"use strict\";\n";
  add_scripts(file, page_scripts);
  file.append(asset("main.js")).append("})();\n</script>\n</body>\n</html>\n");
  return file;
}

std::string html(const Page& page) {
  return html_file(page.title, {{"kind", "page"}, {"page", to_json(page)}}, Needs::page);
}

}  // namespace trammel::report
