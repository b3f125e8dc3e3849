// Matrices of a linearisation as files, read back as text.
#include <filesystem>

#include "modes/modal_analysis.hpp"
#include "support/run_scene.hpp"

namespace trammel {
namespace {

namespace fs = std::filesystem;
using test::Folder;

// A mass on a spring and a damper, whose rod holds it on the x axis: M = m, D = c, K = k in the one free direction.
constexpr const char* oscillator = R"({
  "trammel": 1, "space": "planar",
  "bodies": {"block": {"type": "rigid_body", "mass": 2, "inertia": 1}},
  "joints": {"guide": {"type": "prismatic", "between": ["ground", "block.com"]}},
  "forces": {"spring": {"type": "spring_damper", "between": [{"point": [-1, 0]}, "block.com"],
                        "stiffness": 50, "damping": 3, "length": 1}},
  "simulate": {"until": 1}})";

struct Entry {
  int row, column;
  double value;
};
std::vector<Entry> read_market(const fs::path& file, std::vector<int>& sizes) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "%%MatrixMarket matrix coordinate real general");
  std::getline(in, line);
  sizes.resize(3);
  in >> sizes[0] >> sizes[1] >> sizes[2];
  std::vector<Entry> entries;
  for (Entry e; in >> e.row >> e.column >> e.value;) entries.push_back(e);
  return entries;
}

TEST(MatrixFiles, HoldTheMatricesOfAnOscillator) {
  const Folder folder;
  simulate::ModesOptions options;
  options.out = folder.path() / "modes";
  options.matrices = folder.path() / "m.npz";
  simulate::analyse_modes(scene::Scene::parse(oscillator, "oscillator.json"), test::registry(), options);

  std::vector<int> sizes;
  const std::vector<Entry> A = read_market(folder.path() / "m_A.mtx", sizes);
  EXPECT_EQ(sizes, (std::vector<int>{2, 2, 3}));  // [0 1; -k/m -c/m]
  for (const Entry& e : A) {
    const double expected = e.row == 1 ? 1.0 : e.column == 1 ? -50.0 / 2 : -3.0 / 2;
    EXPECT_NEAR(e.value, expected, 1e-6 * std::abs(expected)) << e.row << "," << e.column;  // K by differences
  }
  read_market(folder.path() / "m_G.mtx", sizes);
  EXPECT_EQ(sizes[0], 2);
  EXPECT_EQ(sizes[1], 3);
  EXPECT_EQ(test::read_text(folder.path() / "m_rows.txt"), "joints.guide[0]\njoints.guide[1]\n");
  EXPECT_EQ(test::read_text(folder.path() / "m_velocities.txt"), "block[0]\nblock[1]\nblock[2]\n");
  EXPECT_TRUE(fs::exists(folder.path() / "m.npz"));
}

}  // namespace
}  // namespace trammel
