// animation.ndjson, and what result.json says of columns and of what does not move.
#include <cmath>

#include <gmock/gmock.h>

#include "statics/static_run.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

struct Pictures {
  std::vector<nlohmann::json> lines;
  nlohmann::json result;
};

Pictures pictures_of(const std::string& text, Runner run = simulate::run) {
  const Folder folder;
  simulate::RunOptions options;
  options.out = folder.path();
  Pictures all;
  all.result = nlohmann::json::parse(run(scene::Scene::parse(text, "test.json"), registry(), options).result_json);
  for (const std::string& line : split(read_text(folder.path() / "animation.ndjson"), '\n'))
    all.lines.push_back(nlohmann::json::parse(line));
  return all;
}

// A block of 2 kg that rests on an incline of 0.3 rad with friction, held by a spring along x.
const std::string block = R"scene({
  "trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {"block": {"type": "point_mass", "mass": 2, "position": [0, 0]}},
  "contacts": {"floor": {"type": "constraint_method", "restitution": 0,
    "friction": {"type": "coulomb", "static": 0.9, "kinetic": 0.9},
    "between": ["block.com", {"plane": {"point": [0, 0], "normal": ["=-sin(0.3)", "=cos(0.3)"]}}]}},
  "forces": {"spring": {"type": "spring_damper", "between": [{"point": [-1, 0]}, "block.com"], "stiffness": 4, "length": 0.5}},
  "simulate": {"until": 0.1},
  "record": {"every": 0.05, "observe": {"x": "block.com.x", "force": "contacts.floor.force", "sum": "=block.com.x+1"}}
})scene";

// Gravity and the spring, 2 N towards its end at x = -1, are balanced by the contact as a whole.
TEST(Animation, ShowsForcesOnTheirBodyInWorldAxes) {
  const Pictures pictures = pictures_of(block);
  ASSERT_EQ(pictures.lines.size(), 3u);
  const nlohmann::json& last = pictures.lines.back();
  const auto& contact = last.at("contacts").at("floor");
  EXPECT_NEAR(contact[1][0], 2, 1e-4);  // five digits
  EXPECT_NEAR(contact[1][1], 20, 1e-3);
  const auto& spring = last.at("forces").at("spring");
  EXPECT_EQ(spring[0], nlohmann::json::array({-1, 0}));
  EXPECT_NEAR(spring[2][0], -2, 1e-4);
  EXPECT_NEAR(spring[2][1], 0, 1e-9);
}

TEST(Result, TellsThePlanesThatStandStill) {
  const nlohmann::json drawing = pictures_of(block).result.at("drawing");
  ASSERT_EQ(drawing["planes"].size(), 1u);
  EXPECT_NEAR(drawing["planes"][0]["normal"][0], -std::sin(0.3), 1e-15);
}

TEST(Result, TellsUnitMeaningAndPathOfEachColumn) {
  const nlohmann::json columns = pictures_of(block).result.at("columns").at("series");
  std::map<std::string, nlohmann::json> named;
  for (const auto& column : columns) named[column["name"]] = column;
  EXPECT_EQ(named["x"]["unit"], "m");
  EXPECT_EQ(named["x"]["path"], "bodies.block");
  EXPECT_EQ(named["force"]["unit"], "N");
  EXPECT_EQ(named["force"]["path"], "contacts.floor");
  EXPECT_EQ(named["sum"]["meaning"], "=block.com.x+1");
  EXPECT_EQ(named["energy_total"]["unit"], "J");
  EXPECT_EQ(named["steps"]["unit"], "1");
}

// A strip bent by an end moment t N m/m: the stress on top is 6 M / h^2 all over.
TEST(Animation, HasThePlatesFacesWithTheirStress) {
  const Pictures pictures = pictures_of(R"({
    "trammel": 1, "space": "spatial", "gravity": [0, 0, 0],
    "bodies": {"strip": {"type": "tspline_plate", "geometry": {"shape": "rectangle", "along_u": [1, 0, 0], "along_v": [0, 0.2, 0]},
      "mesh": {"elements": "4x1"}, "thickness": 0.01, "density": 1000, "youngs_modulus": 1e9, "poissons_ratio": 0,
      "quadrature": 4, "edges": {"u0": "clamped"}, "edge_moment": {"u1": "=t"}}},
    "static": {"steps": 2}, "simulate": {"until": 1}})",
                                        simulate::run_static);
  const nlohmann::json faces = pictures.lines.back().at("faces").at("strip");
  EXPECT_EQ(faces["quads"].size(), 16u);   // two along each side of four elements
  EXPECT_EQ(faces["points"].size(), 27u);  // 9 x 3: each point once
  EXPECT_EQ(faces["values"].size(), 27u);
  for (const double stress : faces["values"]) EXPECT_NEAR(stress, 6 * 1 / 1e-4, 0.01 * 6e4);  // of four elements
  for (const auto& quad : faces["quads"])
    for (int k = 0; k < 4; ++k) EXPECT_LT(quad[std::size_t(k)], 27);
  EXPECT_EQ(pictures.result["drawing"]["face_values"]["strip"], "von Mises stress on the top [Pa]");
}

TEST(EventsOfAPlanarScene, HaveAColumnForEachFigure) {
  const Folder folder;
  simulate::RunOptions options;
  options.out = folder.path();
  simulate::run(scene::Scene::parse(block, "test.json"), registry(), options);
  EXPECT_EQ(split(read_text(folder.path() / "events.csv"), '\n').front(),
            "t,kind,component,impulse,approach,separation,energy_lost,friction,direction");
}

}  // namespace
}  // namespace trammel::test
