// Sparse matrices, and blocks by bodies, give what dense matrices give.
#include <array>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/build.hpp"
#include "system/assembled_system.hpp"
#include "system/least_multipliers.hpp"

#include "support/made.hpp"

namespace trammel::test {
namespace {

// A scene of scenes/benchmarks; "mast": one of trusses, whose pins' rows never change; "sliding": a pendulum that rubs
// along a plane; "redundant": A02 with a point that rubs along a plane, and one that sticks to it.
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
  if (name == "mast") return scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/truss/prismatic_mast.json");
  return scene::Scene::load(folder + name + ".json");
}

std::shared_ptr<const model::Model> build_model(const std::string& name) {
  const scene::Scene scene = read_scene(name);
  scene::Problems problems;
  const std::shared_ptr<const model::Model> model = model::build(scene.root(), registry(), problems);
  problems.throw_if_any();
  return model;
}

class Storages : public testing::TestWithParam<std::tuple<const char*, model::Storage>> {
 protected:
  void SetUp() override {
    const auto [scene, storage] = GetParam();
    const auto model = build_model(scene);
    dense = std::make_unique<model::AssembledSystem>(model, model::Storage::dense);
    other = std::make_unique<model::AssembledSystem>(model, storage);
    model::Modes modes;
    modes.contacts.resize(model->contacts.size());
    if (!modes.contacts.empty()) {
      modes.contacts[0] = {.closed = true, .friction = model::ContactMode::Friction::slide, .direction = {1, 0}};
      if (modes.contacts.size() > 1)
        modes.contacts[1] = {.closed = true, .friction = model::ContactMode::Friction::stick};
    }
    dense->initial(q, v);
    v += 0.1 * Vec::LinSpaced(v.size(), -1, 1);
    for (auto* system : {dense.get(), other.get()}) {
      system->set_modes(modes);
      system->move_to(0.1, q, v);
    }
  }
  std::unique_ptr<model::AssembledSystem> dense, other;
  Vec q, v, a, lambda, a_other, lambda_other;
};

TEST_P(Storages, GiveTheSameAccelerations) {
  dense->accelerate({.alpha = 2, .beta = 3}, a, lambda);
  other->accelerate({.alpha = 2, .beta = 3}, a_other, lambda_other);
  model::minimise_norm(*other, lambda_other);  // as records have them
  // Round-off times the condition of the rows.
  EXPECT_LT((a_other - a).norm(), 1e-10 * a.norm());
  EXPECT_LT((lambda_other - lambda).norm(), 1e-9 * lambda.norm());
}

TEST_P(Storages, GiveTheSameRowsAtEachPoint) {
  for (const double t : {0.1, 0.2}) {
    const Vec q_t = q + Vec::LinSpaced(q.size(), 0, t), v_t = v + Vec::LinSpaced(v.size(), t, 0);
    dense->move_to(t, q_t, v_t), other->move_to(t, q_t, v_t);
    EXPECT_LT((other->g() - dense->g()).norm(), 1e-14 * (1 + q_t.norm()));  // round-off
    EXPECT_LT((other->g_dot() - dense->g_dot()).norm(), 1e-14 * (1 + v_t.norm()));
    dense->constraint_acceleration(v_t, a), other->constraint_acceleration(v_t, a_other);
    EXPECT_LT((a_other - a).norm(), 1e-14 * (1 + a.norm()));
  }
}

TEST_P(Storages, GiveTheSameProducts) {
  const Vec x = Vec::LinSpaced(v.size(), 2, -1), y = Vec::LinSpaced(dense->sizes().nc, 1, -2);
  Vec r = x, r_other = x, rc = y, rc_other = y;
  dense->add_mass_times(2, x, r), other->add_mass_times(2, x, r_other);
  dense->add_reaction(-3, y, r), other->add_reaction(-3, y, r_other);
  dense->add_rows_force(0.5, y, r), other->add_rows_force(0.5, y, r_other);
  dense->add_rows_times(4, x, rc), other->add_rows_times(4, x, rc_other);
  EXPECT_LT((r - r_other).norm(), 1e-14 * r.norm());  // round-off
  EXPECT_LT((rc - rc_other).norm(), 1e-14 * rc.norm());
}

TEST_P(Storages, GiveTheSameCorrections) {
  dense->accelerate({}, a, lambda);
  const Vec r = Vec::LinSpaced(v.size(), 2, -1);
  Vec rc = Vec::Zero(dense->sizes().nc);
  dense->add_rows_times(1, r, rc);  // consistent also where rows are redundant
  for (const Blend blend : {Blend{1, 0, 0}, Blend{1, 0.02, 1e-4}, Blend{0, 0, 0, 1}}) {
    Vec da, dlambda, da_other, dlambda_other;
    dense->factorise(blend, a, lambda);
    other->factorise(blend, a, lambda);
    ASSERT_TRUE(dense->correct(r, rc, da, dlambda));
    ASSERT_TRUE(other->correct(r, rc, da_other, dlambda_other));
    EXPECT_LT((da_other - da).norm(), 1e-9 * da.norm()) << blend.c_m << " " << blend.c_k;
  }
}

class StoragesWithContacts : public Storages {};

TEST_P(StoragesWithContacts, GiveTheSameAnswerToImpulses) {
  Mat jump, delassus, jump_other, delassus_other;
  const std::vector<model::ContactDirection> directions = {{0, 0}, {0, 1}};
  dense->impulse_response(directions, jump, delassus);
  other->impulse_response(directions, jump_other, delassus_other);
  EXPECT_LT((jump_other - jump).norm(), 1e-10 * jump.norm());
  EXPECT_LT((delassus_other - delassus).norm(), 1e-10 * delassus.norm());
  const Vec some = Vec::LinSpaced(dense->sizes().nc, 1, -2);
  EXPECT_NEAR(other->balance(some).constraints, dense->balance(some).constraints, 1e-12);
}

constexpr std::array others = {model::Storage::sparse, model::Storage::blocks};
std::string name_of(const testing::TestParamInfo<std::tuple<const char*, model::Storage>>& info) {
  const auto [scene, storage] = info.param;
  return std::string(scene) + (storage == model::Storage::sparse ? "_sparse" : "_blocks");
}

INSTANTIATE_TEST_SUITE_P(Scenes, Storages,
                         testing::Combine(testing::Values("chain_10", "a04", "a02_n10", "andrews", "mast", "sliding",
                                                          "redundant"),
                                          testing::ValuesIn(others)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Scenes, StoragesWithContacts,
                         testing::Combine(testing::Values("sliding", "redundant"), testing::ValuesIn(others)), name_of);

// A plate of 12 x 12 elements with a ball on it.
TEST(Storage, IsSparseForPlatesAndDenseForSmallOnes) {
  const auto storage_of = [](const char* mesh) {
    scene::Problems problems;
    const scene::Scene scene = scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/plate/ball.json",
                                                  {{"parameters.mesh", fmt::format("\"{}\"", mesh)}});
    return model::storage_for(*model::build(scene.root(), registry(), problems));
  };
  EXPECT_EQ(storage_of("12x12"), model::Storage::sparse);
  EXPECT_EQ(storage_of("4x4"), model::Storage::dense);
}

}  // namespace
}  // namespace trammel::test
