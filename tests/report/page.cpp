// The HTML of a page: complete in itself, whatever its texts contain.
#include "report/page.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace trammel::report {
namespace {

using testing::HasSubstr;
using testing::Not;

Page page() {
  Page p{"Title </script><b>", {"The verdict."}, {}, {}};
  Curve curve{"a", Mark::line_and_points, {{1, 2, "note"}}, {{3, 0, "failed: </script>"}}};
  p.figures.push_back({"Figure", "caption", {"x [s]", Scale::logarithmic}, {"y [m]", Scale::linear}, {curve}});
  p.tables.push_back({"Table", {{"column", "m"}}, {{"1"}}});
  return p;
}

// The data between the tags of their script element.
std::string data_of(const std::string& file) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const auto begin = file.find(open) + open.size();
  return file.substr(begin, file.find("</script>", begin) - begin);
}

TEST(PageAsHtml, HoldsItsDataUnchanged) {
  const nlohmann::ordered_json data = nlohmann::ordered_json::parse(data_of(html(page())));
  EXPECT_EQ(data["kind"], "page");
  EXPECT_EQ(data["page"], to_json(page()));
}

TEST(PageAsHtml, AsksForNoOtherFile) {
  const std::string file = html(page());
  for (const char* asks : {"src=", "href=", "@import", "url("}) EXPECT_THAT(file, Not(HasSubstr(asks)));
}

TEST(PageAsHtml, LetsNoTextBecomeMarkup) {
  EXPECT_THAT(html(page()), HasSubstr("<title>Title &lt;/script>&lt;b></title>"));
  EXPECT_THAT(data_of(html(page())), Not(HasSubstr("<")));
}

}  // namespace
}  // namespace trammel::report
