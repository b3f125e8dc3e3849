// Frames of an animation as a report embeds them.
#include "report/animation.hpp"

#include "support/run_scene.hpp"

namespace trammel::report {
namespace {

using test::Folder;
using Json = nlohmann::ordered_json;

std::filesystem::path written(const Folder& folder, int lines, const std::string& end = "") {
  std::filesystem::create_directories(folder.path());
  std::ofstream out(folder.path() / "animation.ndjson");
  for (int k = 0; k < lines; ++k)
    out << fmt::format(R"({{"t":{},"shapes":{{"bar":[[0,0],[1,{}]]}},"contacts":{{"tip":[[1,0],[0,{}]]}}}})", 0.1 * k,
                       k, k)
        << "\n";
  out << end;
  return folder.path() / "animation.ndjson";
}

TEST(AnimationOfAReport, KeepsAllFramesThatFit) {
  const Folder folder;
  const Json animation = read_animation(written(folder, 50), 1'000'000);
  EXPECT_EQ(animation["frames"], 50);
  EXPECT_EQ(animation["stride"], 1);
  EXPECT_EQ(animation["contacts"], Json::array({"tip"}));
  EXPECT_EQ(animation["layouts"].size(), 1u);
}

TEST(AnimationOfAReport, TellsWhichFramesItKept) {
  const Folder folder;
  const Json animation = read_animation(written(folder, 1000), 8000);
  EXPECT_EQ(animation["total"], 1000);
  const int frames = animation["frames"], stride = animation["stride"];
  EXPECT_GT(stride, 1);
  EXPECT_EQ(frames, (1000 - 1 + stride - 1) / stride + 1);  // every stride-th, and the last
}

// 49 m in 65535 steps.
TEST(AnimationOfAReport, RoundsPlacesToASixtyFiveThousandthOfTheirBox) {
  const Folder folder;
  const Json animation = read_animation(written(folder, 50), 1'000'000);
  EXPECT_DOUBLE_EQ(animation["step"], 49.0 / 65535);
}

TEST(AnimationOfAReport, LeavesOutALastLineThatWasCutOff) {
  const Folder folder;
  EXPECT_EQ(read_animation(written(folder, 5, "{\"t\":0.5,\"sha"), 1'000'000)["total"], 5);
}

TEST(AnimationOfAReport, IsNoneWithoutTheFile) {
  EXPECT_TRUE(read_animation("no/such/animation.ndjson", 1000).is_null());
}

}  // namespace
}  // namespace trammel::report
