// What a report keeps of a long series.
#include "report/series.hpp"

#include <algorithm>
#include <cmath>

#include "support/run_scene.hpp"

namespace trammel::report {
namespace {

using test::Folder;

std::filesystem::path written(const Folder& folder, const std::string& text) {
  std::filesystem::create_directories(folder.path());
  std::ofstream(folder.path() / "series.csv") << text;
  return folder.path() / "series.csv";
}

TEST(ReducedSeries, KeepsEveryExtremeOfEachInterval) {
  std::string text = "t,x\n";
  std::vector<double> x;
  for (int k = 0; k < 10000; ++k) {
    x.push_back(k == 7777 ? 9 : k == 1234 ? -9 : std::sin(0.01 * k));
    text += fmt::format("{},{:.17g}\n", k, x.back());
  }
  const Folder folder;
  const Series series = read_series(written(folder, text), 2000);
  EXPECT_EQ(series.rows, 10000);
  ASSERT_EQ(series.columns[1].size(), series.columns[0].size());
  EXPECT_LE(series.columns[0].size() * 2, 2000u + 4);
  EXPECT_TRUE(std::is_sorted(series.columns[0].begin(), series.columns[0].end()));
  for (std::size_t i = 0; i + 1 < series.columns[1].size(); i += 2) {
    const auto begin = x.begin() + std::ptrdiff_t(i / 2 * std::size_t(series.interval));
    const auto [least, largest] = std::minmax_element(begin, std::min(begin + series.interval, x.end()));
    EXPECT_EQ(std::min(series.columns[1][i], series.columns[1][i + 1]), *least) << i;
    EXPECT_EQ(std::max(series.columns[1][i], series.columns[1][i + 1]), *largest) << i;
  }
}

TEST(AShortSeries, IsKeptAsItIs) {
  const Folder folder;
  const Series series = read_series(written(folder, "t,x\n0,1\n0.5,nan\n1,-inf\n"), 1000);
  EXPECT_EQ(series.interval, 1);
  ASSERT_EQ(series.columns[1].size(), 3u);
  EXPECT_EQ(series.columns[1][0], 1);
  EXPECT_TRUE(std::isnan(series.columns[1][1]));
  EXPECT_TRUE(std::isinf(series.columns[1][2]));
}

TEST(ASeries, WhoseLastLineWasCutOffIsReadUpToThere) {
  const Folder folder;
  EXPECT_EQ(read_series(written(folder, "t,x\n0,1\n1,2\n2,"), 1000).columns[0].size(), 2u);
}

TEST(ASeries, WithALineThatIsNoRowNamesFileAndLine) {
  const Folder folder;
  try {
    read_series(written(folder, "t,x\n0,1\n1\n2,3\n"), 1000);
    FAIL() << "accepted";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("series.csv:3: expected 2 numbers"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace trammel::report
