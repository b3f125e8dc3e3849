// Blocks by bodies give what dense matrices give.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/assembled_system.hpp"
#include "model/build.hpp"

#include "../plugins/made.hpp"

namespace trammel::test {
namespace {

// A scene of scenes/benchmarks; "sliding": a pendulum that rubs along a plane; "redundant": A02 with a point that rubs along
// a plane, and one that sticks to it.
scene::Scene read_scene(const std::string& name) {
  const std::string folder = TRAMMEL_SOURCE_DIR "/scenes/benchmarks/";
  const auto contact = [](const char* point) {
    return fmt::format(
        R"("{0}": {{"type": "constraint_method", "restitution": 0, "between": ["{1}", {{"plane": {{"point": [0, 1],
                           "normal": [0.1, 1]}}}}], "friction": {{"type": "coulomb", "static": 0.6, "kinetic": 0.4}}}})",
        std::string(point).substr(0, 4), point);
  };
  const auto with = [&](const char* file, const std::string& contacts) {
    return scene::Scene::parse(fmt::format(R"({{"include": "{}{}", "contacts": {{{}}}}})", folder, file, contacts),
                               "contacts.json");
  };
  if (name == "sliding") return with("double_pendulum.json", contact("bob2.point"));
  if (name == "redundant") return with("a02_n10.json", contact("top3.B") + ", " + contact("top6.A"));
  return scene::Scene::load(folder + name + ".json");
}

std::shared_ptr<const model::Model> build_model(const std::string& name) {
  const scene::Scene scene = read_scene(name);
  scene::Problems problems;
  const std::shared_ptr<const model::Model> model = model::build(scene.root(), registry(), problems);
  problems.throw_if_any();
  return model;
}

class Storages : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto model = build_model(GetParam());
    dense = std::make_unique<model::AssembledSystem>(model, model::Storage::dense);
    blocks = std::make_unique<model::AssembledSystem>(model, model::Storage::blocks);
    model::Modes modes;
    modes.contacts.resize(model->contacts.size());
    if (!modes.contacts.empty()) {
      modes.contacts[0] = {.closed = true, .friction = model::ContactMode::Friction::slide, .direction = {1, 0}};
      if (modes.contacts.size() > 1)
        modes.contacts[1] = {.closed = true, .friction = model::ContactMode::Friction::stick};
    }
    dense->initial(q, v);
    v += 0.1 * Vec::LinSpaced(v.size(), -1, 1);
    for (auto* system : {dense.get(), blocks.get()}) {
      system->set_modes(modes);
      system->move_to(0.1, q, v);
    }
  }
  std::unique_ptr<model::AssembledSystem> dense, blocks;
  Vec q, v, a, lambda, a_blocks, lambda_blocks;
};

TEST_P(Storages, GiveTheSameAccelerations) {
  dense->accelerate({.alpha = 2, .beta = 3}, a, lambda);
  blocks->accelerate({.alpha = 2, .beta = 3}, a_blocks, lambda_blocks);
  // Round-off times the condition of the rows.
  EXPECT_LT((a_blocks - a).norm(), 1e-10 * a.norm());
  EXPECT_LT((lambda_blocks - lambda).norm(), 1e-9 * lambda.norm());
}

TEST_P(Storages, GiveTheSameProducts) {
  const Vec x = Vec::LinSpaced(v.size(), 2, -1), y = Vec::LinSpaced(dense->sizes().nc, 1, -2);
  Vec r = x, r_blocks = x, rc = y, rc_blocks = y;
  dense->add_mass_times(2, x, r), blocks->add_mass_times(2, x, r_blocks);
  dense->add_reaction(-3, y, r), blocks->add_reaction(-3, y, r_blocks);
  dense->add_rows_force(0.5, y, r), blocks->add_rows_force(0.5, y, r_blocks);
  dense->add_rows_times(4, x, rc), blocks->add_rows_times(4, x, rc_blocks);
  EXPECT_LT((r - r_blocks).norm(), 1e-14 * r.norm());  // round-off
  EXPECT_LT((rc - rc_blocks).norm(), 1e-14 * rc.norm());
}

TEST_P(Storages, GiveTheSameCorrections) {
  dense->accelerate({}, a, lambda);
  const Vec r = Vec::LinSpaced(v.size(), 2, -1);
  Vec rc = Vec::Zero(dense->sizes().nc);
  dense->add_rows_times(1, r, rc);  // consistent also where rows are redundant
  for (const Blend blend : {Blend{1, 0, 0}, Blend{1, 0.02, 1e-4}, Blend{0, 0, 0, 1}}) {
    Vec da, dlambda, da_blocks, dlambda_blocks;
    dense->factorise(blend, a, lambda);
    blocks->factorise(blend, a, lambda);
    ASSERT_TRUE(dense->correct(r, rc, da, dlambda));
    ASSERT_TRUE(blocks->correct(r, rc, da_blocks, dlambda_blocks));
    EXPECT_LT((da_blocks - da).norm(), 1e-9 * da.norm()) << blend.c_m << " " << blend.c_k;
  }
}

class StoragesWithContacts : public Storages {};

TEST_P(StoragesWithContacts, GiveTheSameAnswerToImpulses) {
  Mat jump, delassus, jump_blocks, delassus_blocks;
  const std::vector<model::ContactDirection> directions = {{0, 0}, {0, 1}};
  dense->impulse_response(directions, jump, delassus);
  blocks->impulse_response(directions, jump_blocks, delassus_blocks);
  EXPECT_LT((jump_blocks - jump).norm(), 1e-10 * jump.norm());
  EXPECT_LT((delassus_blocks - delassus).norm(), 1e-10 * delassus.norm());
  const Vec some = Vec::LinSpaced(dense->sizes().nc, 1, -2);
  EXPECT_NEAR(blocks->balance(some).constraints, dense->balance(some).constraints, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Storages,
                         testing::Values("chain_10", "a04", "a02_n10", "andrews", "sliding", "redundant"),
                         [](const auto& scene) { return std::string(scene.param); });
INSTANTIATE_TEST_SUITE_P(Scenes, StoragesWithContacts, testing::Values("sliding", "redundant"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace trammel::test
