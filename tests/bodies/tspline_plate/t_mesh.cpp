#include "tspline_plate/mesh/t_mesh.hpp"

#include <gtest/gtest.h>

#include "meshes.hpp"
#include "tspline_plate/mesh/refinement_operator.hpp"

namespace trammel::plate {
namespace {

using test::block;
using test::crossed;

struct Counts {
  int elements, cells, anchors, crossings;
  bool operator==(const Counts&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << c.elements << " elements, " << c.cells << " cells, " << c.anchors << " anchors, " << c.crossings
               << " crossings";
  }
};

Counts counts(const TMesh& mesh) {
  const TsplineBasis basis(mesh);
  return {int(mesh.elements().size()), int(basis.cells().size()), basis.size(),
          int(crossings(mesh, t_junctions(mesh.edges())).size())};
}

// The counts of the reference, which holds those of Wang et al.'s Table 1 (ring) and its inferred Table 4.
TEST(TMesh, CountsOfTheReferenceWithoutClosure) {
  EXPECT_EQ(counts(TMesh::uniform(10, 10)), (Counts{100, 100, 169, 0}));
  EXPECT_EQ(counts(crossed(10, block(4, 6), Closure::none)), (Counts{112, 128, 185, 4}));
  EXPECT_EQ(counts(crossed(10, {{4, 4}}, Closure::none)), (Counts{103, 111, 174, 4}));
  EXPECT_EQ(counts(crossed(10, block(3, 7), Closure::none)), (Counts{148, 180, 225, 4}));
  EXPECT_EQ(counts(crossed(4, {{0, 0}, {1, 0}, {2, 0}, {3, 0}}, Closure::none)), (Counts{28, 36, 72, 0}));
}

TEST(TMesh, CountsOfTheReferenceWithTheSymmetricClosure) {
  EXPECT_EQ(counts(crossed(10, block(4, 6), Closure::both)), (Counts{120, 136, 193, 0}));
  EXPECT_EQ(counts(crossed(10, {{4, 4}}, Closure::both)), (Counts{107, 115, 178, 0}));
  EXPECT_EQ(counts(crossed(10, block(3, 7), Closure::both)), (Counts{156, 188, 233, 0}));
}

TEST(TMesh, CountsOfTheReferenceWithTheGreedyClosure) {
  EXPECT_EQ(counts(crossed(10, block(4, 6), Closure::greedy)), (Counts{116, 132, 189, 0}));
  EXPECT_EQ(counts(crossed(10, {{4, 4}}, Closure::greedy)), (Counts{105, 113, 176, 0}));
  EXPECT_EQ(counts(crossed(10, block(3, 7), Closure::greedy)), (Counts{152, 184, 229, 0}));
}

TEST(TMesh, CrossesTouchingAtACornerNeedTheClosure) {
  const TMesh open = crossed(10, test::diagonal, Closure::none);
  EXPECT_EQ(counts(open), (Counts{112, 154, 189, 26}));
  EXPECT_EQ(counts(crossed(10, test::diagonal, Closure::both)), (Counts{152, 182, 229, 0}));
  const Counts greedy = counts(crossed(10, test::diagonal, Closure::greedy));
  EXPECT_EQ(greedy.crossings, 0);
  EXPECT_LE(greedy.elements, 126);  // of the reference's own greedy rule
}

TEST(TMesh, SymmetricClosureKeepsTheSymmetryOfTheMesh) {
  const TMesh mesh = crossed(10, block(4, 6), Closure::both);
  const EdgeMap& e = mesh.edges();
  ASSERT_EQ(e.lines(0), e.lines(1));
  for (int line = 0; line < e.lines(0); ++line)
    for (int piece = 0; piece < e.lines(0) - 1; ++piece) {
      EXPECT_EQ(e.edge(0, line, piece), e.edge(1, line, piece));                   // u and v swapped
      EXPECT_EQ(e.edge(0, line, piece), e.edge(0, e.lines(0) - 1 - line, piece));  // left and right
    }
}

TEST(TMesh, ALineOfANeighbourIsTakenUp) {
  const TMesh mesh = crossed(2, {{0, 0}, {0, 1}}, Closure::none);
  EXPECT_EQ(mesh.knots(0), (std::vector<double>{0, 0, 0, 0, 0.25, 0.5, 1, 1, 1, 1}));
}

TEST(TMesh, PartialLinesMakeTheMeshThatCrossesMake) {
  std::vector<double> knots = {0, 0.25, 0.5, 1};
  const TMesh drawn = TMesh::tensor(knots, knots, std::vector<PartialLine>{{0, 1, 0, 2}, {1, 1, 0, 2}});
  EXPECT_EQ(drawn.elements(), crossed(2, {{0, 0}}, Closure::none).elements());
}

std::string refusal(std::vector<double> u, std::vector<double> v, std::vector<PartialLine> partial = {}) {
  try {
    TMesh::tensor(u, v, partial);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

TEST(TMesh, RefusesWhatIsNoTMesh) {
  const std::vector<double> k = {0, 1, 2, 3, 4};
  EXPECT_EQ(refusal({0, 2, 1, 3}, k), "u: knots must ascend; 1 follows 2");
  EXPECT_EQ(refusal(k, {0}), "v: found 1 knots, expected 2 or more");
  EXPECT_EQ(refusal({0, 1, 1, 1, 2}, k), "u: the knot 1 stands three times, a C0 line; a plate needs C1: two at most");
  EXPECT_EQ(refusal({0, 0, 1}, k), "u: the end 0 is given more than once; it is repeated by itself");
  EXPECT_EQ(refusal(k, k, {{0, 7, 0, 1}}),
            "line u = 7 from 0 to 1: expected a line between 1 and 3, from < to within 0 to 4");
  EXPECT_NE(refusal(k, k, {{1, 2, 0, 2}, {0, 2, 0, 1}}).find("ends in the open"), std::string::npos);
  EXPECT_NE(refusal(k, k, {{1, 2, 0, 2}, {0, 2, 0, 2}}).find("turns a corner"), std::string::npos);
}

TEST(TMesh, RepeatedInnerKnotsAreLinesWithoutElements) {
  const std::vector<double> repeated = {0, 1, 1, 2}, plain = {0, 1, 2};
  EXPECT_EQ(TMesh::tensor(repeated, plain).elements().size(), 4u);
  EXPECT_EQ(TsplineBasis(TMesh::tensor(repeated, plain)).size(), 6 * 5);
}

}  // namespace
}  // namespace trammel::plate
