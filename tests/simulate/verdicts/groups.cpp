// Groups of contacts whose rows depend on each other.
#include "simulate/verdicts/groups.hpp"

#include <gtest/gtest.h>

namespace trammel::test {
namespace {

model::SharedRows three_normals_and_a_tangent() {
  return {.basis = {{0, 0}, {1, 0}, {1, 1}}, .implied = {{2, 0}}, .K = {}, .share = {}, .sliding = {}};
}

TEST(GroupsOfContacts, ShareTheTangentsThatTheirRowsName) {
  model::SharedRows group = three_normals_and_a_tangent();
  EXPECT_FALSE(simulate::shares_tangents(group, 0));
  EXPECT_TRUE(simulate::shares_tangents(group, 1));
  EXPECT_FALSE(simulate::has_sliding(group));
  group.sliding = {2};
  EXPECT_TRUE(simulate::has_sliding(group));
}

TEST(GroupsOfContacts, CountTheRowsThatFollowFromOthers) {
  model::Modes modes;
  EXPECT_EQ(simulate::implied_rows(modes), 0u);
  modes.shared = {three_normals_and_a_tangent(), three_normals_and_a_tangent()};
  EXPECT_EQ(simulate::implied_rows(modes), 2u);
}

// A contact that was released takes no part, so its mode is not asked again; but it may press a moment later, where a
// group then names its row.
TEST(ContactsAskedAnew, TakeThoseThatShareTheirRowsWithThem) {
  model::Modes decided, later;
  decided.contacts.resize(4), later.contacts.resize(4);
  for (const int i : {0, 2, 3}) decided.contacts[std::size_t(i)].closed = true;
  for (model::ContactMode& mode : later.contacts) mode.closed = true;
  later.contacts[3].approach_speed = 1;
  later.shared.push_back({.basis = {{0, 0}, {1, 0}}, .implied = {{2, 0}}, .K = {}, .share = {}, .sliding = {}});
  simulate::keep_others(decided, {true, false, false, false}, later);
  ASSERT_EQ(later.shared.size(), 1u);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(later.contacts[std::size_t(i)].closed) << i;
  EXPECT_EQ(later.contacts[3], decided.contacts[3]);
}

}  // namespace
}  // namespace trammel::test
