// What is reported of bodies that bend further than their theory allows.
#include "simulate/watch/theory_watch.hpp"

#include <gmock/gmock.h>

#include <trammel/body.hpp>
#include <trammel/testing/archive.hpp>

namespace trammel::simulate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Bends : Body {
  Coordinates coordinates() const override { return Coordinates::flat(1); }
  void initial(Out, Out) const override {}
  void mass(double, In, Matrix&) const override {}
  void force(double, In, In, Out) const override {}
  Energy energy(double, In, In) const override { return {}; }
  std::span<const std::string> markers() const override { return {}; }
  void motion(int, double, In, In, Motion&) const override {}
};

struct BendsLittle final : Bends, TheoryLimit {
  Bounds bounds() const override { return {"slope", 0.1, 1, "others bend further"}; }
  double stretched(double, In q) const override { return std::abs(q[0]); }
};

// The slopes of bodies "a" and "c" are the first and the last coordinate; "b" may bend as it likes.
model::Model three_bodies() {
  model::Model model;
  const auto add = [&model](const char* name, std::unique_ptr<Body> body) {
    model::BodyEntry& entry = model.bodies.emplace_back();
    entry.name = name, entry.body = std::move(body);
  };
  add("a", std::make_unique<BendsLittle>());
  add("b", std::make_unique<Bends>());
  add("c", std::make_unique<BendsLittle>());
  model.lay_out();
  return model;
}

TEST(TheoryWatch, TellsWhenEachBodyPassedItsBoundAndWhenItBentMost) {
  const model::Model model = three_bodies();
  TheoryWatch watch(model);
  EXPECT_EQ(watch.look(0, Vec{{0.05, 3, 0}}), "");
  EXPECT_THAT(watch.warnings(), IsEmpty());
  EXPECT_EQ(watch.look(1, Vec{{0.2, 3, 0.1}}), "");
  EXPECT_EQ(watch.look(2, Vec{{-0.7, 3, 0}}), "");
  EXPECT_EQ(watch.look(3, Vec{{0, 3, 0}}), "");
  EXPECT_EQ(watch.look(4, Vec{{0.6, 3, 0}}), "");
  EXPECT_THAT(
      watch.warnings(),
      ElementsAre("bodies.a: its slope passed 0.1 at t = 1, where the error of its theory reaches 1 %, and went "
                  "up to 0.7 at t = 2; others bend further"));
  EXPECT_EQ(watch.look(5, Vec{{0, 3, 0.2}}), "");
  EXPECT_THAT(watch.warnings(), ElementsAre(HasSubstr("bodies.a: its slope passed 0.1 at t = 1,"),
                                            HasSubstr("bodies.c: its slope passed 0.1 at t = 5,")));
}

TEST(TheoryWatch, EndsTheRunWhereNoBodyHasTheShapeAndNotAtTheBound) {
  const model::Model model = three_bodies();
  TheoryWatch watch(model);
  EXPECT_EQ(watch.look(0, Vec{{1, 3, -1}}), "");
  EXPECT_THAT(watch.look(1, Vec{{0, 3, -1.5}}),
              HasSubstr("bodies.c cannot have this shape: its slope is 1.5, and a body's is 1 at most"));
}

TEST(TheoryWatch, RemembersInAResumedRunWhatItSawBefore) {
  const model::Model model = three_bodies();
  TheoryWatch watch(model), resumed(model);
  ASSERT_EQ(watch.look(1, Vec{{0.2, 3, 0.1}}), "");
  ASSERT_EQ(watch.look(2, Vec{{0.3, 3, 0.4}}), "");
  MemoryArchive archive;
  watch.archive(archive);
  archive.reading = true;
  resumed.archive(archive);
  ASSERT_EQ(resumed.look(3, Vec{{0.25, 3, 0.25}}), "");
  EXPECT_EQ(resumed.warnings(), watch.warnings());
}

}  // namespace
}  // namespace trammel::simulate
