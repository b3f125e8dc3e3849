// Checkpoints that no run has written, with checksums that fit: whatever is missing, of another type or of another
// length is refused as bad input before anything is read beyond its end.
#include <functional>
#include <string>
#include <vector>

#include "support/run_scene.hpp"
#include "support/scenes.hpp"
#include "simulate/results/checkpoint.hpp"
#include "simulate/results/results_folder.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

class ForgedCheckpoint : public testing::TestWithParam<Method> {
 protected:
  // Cut where the bar lies on the plane at one end, so that contacts, friction and rows have something to forge.
  void SetUp() override {
    options.out = folder.path();
    ASSERT_EQ(simulate::run(scene("0.7"), registry(), options).status, simulate::Status::done);
    genuine = simulate::read_checkpoint(file(), hash());
    options.resume = true;
  }
  scene::Scene scene(const char* until) const {
    return scene::Scene::parse(struck_bar, "test.json", {{"integrator", GetParam().json}, {"simulate.until", until}});
  }
  std::filesystem::path file() const { return folder.path() / simulate::newest_checkpoint; }
  std::uint64_t hash() const { return simulate::resume_hash(scene("0.7").root()); }

  // The message for the forged checkpoint; "accepted" if it is not refused.
  std::string refusal(const json& forged) {
    simulate::write_checkpoint(file(), hash(), forged);
    std::filesystem::remove(folder.path() / simulate::checkpoint_before);
    try {
      simulate::run(scene("0.701"), registry(), options);
    } catch (const scene::SceneError& error) {
      return error.what();
    }
    return "accepted";
  }

  // Every value of the checkpoint, changed by `forge` where that returns true.
  void expect_refused(const std::function<bool(json&)>& forge) {
    for (const json::json_pointer& place : places(genuine, json::json_pointer())) {
      json forged = genuine;
      if (!forge(forged[place])) continue;
      EXPECT_NE(refusal(forged).find("cannot resume: "), std::string::npos) << place;
    }
  }
  static std::vector<json::json_pointer> places(const json& object, const json::json_pointer& above) {
    std::vector<json::json_pointer> all;
    for (const auto& [name, value] : object.items()) {
      all.push_back(above / name);
      if (!value.is_object()) continue;
      for (const auto& below : places(value, above / name)) all.push_back(below);
    }
    return all;
  }

  Folder folder;
  simulate::RunOptions options;
  json genuine;
};

TEST_P(ForgedCheckpoint, WithoutOneOfItsValuesIsRefused) {
  for (const json::json_pointer& place : places(genuine, json::json_pointer())) {
    json forged = genuine;
    forged[place.parent_pointer()].erase(place.back());
    EXPECT_NE(refusal(forged).find("cannot resume: "), std::string::npos) << place;
  }
}

TEST_P(ForgedCheckpoint, WithAValueOfAnotherTypeIsRefused) {
  expect_refused([](json& value) {
    value = value.is_string() ? json(1) : json("text");
    return true;
  });
}

TEST_P(ForgedCheckpoint, WithAVectorOfAnotherLengthIsRefused) {
  for (const int change : {-1, 1, 1001})
    expect_refused([change](json& value) {
      if (!value.is_array() || value.empty()) return false;
      if (change < 0) value.erase(value.size() - 1);
      for (int i = 0; i < change; ++i) value.push_back(0u);
      return true;
    });
}

// Of numbers that count or name something; of others any may be one's own.
TEST_P(ForgedCheckpoint, WithANumberThatNamesNothingIsRefused) {
  for (const char* name : {"records", "shared_rows", "contact_0_friction", "field_times", "bytes_series"})
    for (const long long x : {-1LL, 1LL << 20, 1LL << 40, -(1LL << 62)}) {
      json forged = genuine;
      forged[name] = x;
      EXPECT_NE(refusal(forged).find("cannot resume: "), std::string::npos) << name << " " << x;
    }
}

TEST_P(ForgedCheckpoint, WithAStateThatIsNotFiniteIsRefused) {
  for (const char* name : {"q", "v", "a"}) {
    json forged = genuine;
    forged[name][0] = 0x7ff8000000000000u;  // NaN
    EXPECT_NE(refusal(forged).find("cannot resume: "), std::string::npos) << name;
  }
}

// The same bytes in, the same run out: what is refused above is refused for what was changed.
TEST_P(ForgedCheckpoint, IsAcceptedAsItWasWritten) {
  EXPECT_EQ(refusal(genuine), "accepted");
}

INSTANTIATE_TEST_SUITE_P(With, ForgedCheckpoint, testing::ValuesIn(fixed_methods("1e-3")), method_name);

TEST(CheckpointFile, NestedWithoutEndIsRefused) {
  const std::string bytes(1 << 20, '\x81');  // an array of an array of ...
  EXPECT_THROW(simulate::decode_checkpoint(bytes, "checkpoint.cbor", 1), scene::SceneError);
}

}  // namespace
}  // namespace trammel::test
