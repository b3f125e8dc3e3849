// The order of contacts by their properties: it distinguishes contacts that differ in any of them, whatever their
// names.
#include "complementarity/contact_order.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace trammel::complementarity {
namespace {

struct Alike {
  std::vector<ContactPoint> points;
  Mat A;
  Vec b;
};

// Contacts of the same kind on a symmetric body: A and b are the same for each.
Alike alike(std::size_t n, bool given, bool sliding, int tangents) {
  Alike all;
  int rows = 0;
  for (std::size_t i = 0; i < n; ++i) {
    ContactPoint& p = all.points.emplace_back();
    if (given)
      p.given = 2;
    else
      p.normal = rows++;
    p.tangent = rows, p.tangents = tangents, rows += tangents;
    p.kind = sliding ? ContactPoint::Tangent::sliding : ContactPoint::Tangent::resting;
    if (sliding)
      p.ratio = {0.3, tangents == 2 ? 0.2 : 0};
    else
      p.coefficient = 0.5;
  }
  all.A = Mat::Constant(rows, rows, 0.1) + 2 * Mat::Identity(rows, rows);
  all.b = Vec::Constant(rows, -1);
  return all;
}

Alike named_by(const Alike& all, const std::vector<std::size_t>& order) {
  Alike named;
  std::vector<Eigen::Index> rows;
  for (const std::size_t i : order) {
    ContactPoint& p = named.points.emplace_back(all.points[i]);
    const int first = int(rows.size());
    if (all.points[i].normal >= 0) p.normal = first, rows.push_back(all.points[i].normal);
    if (p.tangent < 0) continue;
    p.tangent = int(rows.size());
    for (int k = 0; k < p.tangents; ++k) rows.push_back(all.points[i].tangent + k);
  }
  named.A = all.A(rows, rows), named.b = all.b(rows);
  return named;
}

void expect_one_order(const Alike& all) {
  const OrderedContacts first(all.points, all.A, all.b);
  EXPECT_EQ(first.as_named(first.b()), all.b);
  const Alike expected = named_by(all, first.order());
  EXPECT_EQ(first.A(), expected.A);
  EXPECT_EQ(first.b(), expected.b);
  for (std::size_t k = 0; k < expected.points.size(); ++k) {
    EXPECT_EQ(first.points()[k].normal, expected.points[k].normal);
    EXPECT_EQ(first.points()[k].tangent, expected.points[k].tangent);
  }
  std::vector<std::size_t> order(all.points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  while (std::next_permutation(order.begin(), order.end())) {
    const Alike named = named_by(all, order);
    const OrderedContacts other(named.points, named.A, named.b);
    EXPECT_EQ(other.A(), first.A());
    EXPECT_EQ(other.b(), first.b());
    EXPECT_EQ(other.as_named(other.b()), named.b);
    for (std::size_t k = 0; k < order.size(); ++k) {
      EXPECT_EQ(order[other.order()[k]], first.order()[k]);
      EXPECT_EQ(other.points()[k].normal, first.points()[k].normal);
      EXPECT_EQ(other.points()[k].tangent, first.points()[k].tangent);
    }
  }
}

// The last of three contacts differs from the others, which are exchanged without a trace.
TEST(OrderedContacts, TellsContactsApartByAnyPropertyOfTheirOwn) {
  for (const int tangents : {1, 2}) {
    const auto last = [](Alike& all) -> ContactPoint& { return all.points.back(); };
    const auto expect_told = [&](Alike all, const std::function<void(Alike&)>& differ) {
      differ(all);
      const OrderedContacts one(all.points, all.A, all.b);
      const Alike named = named_by(all, {2, 1, 0});
      const OrderedContacts other(named.points, named.A, named.b);
      const auto place = [](const OrderedContacts& o, std::size_t i) {
        return std::find(o.order().begin(), o.order().end(), i) - o.order().begin();
      };
      EXPECT_EQ(place(one, 2), place(other, 0)) << tangents;
      EXPECT_NE(place(one, 2), 1) << tangents;
      EXPECT_EQ(one.A(), other.A());
    };
    const Alike resting = alike(3, false, false, tangents), given = alike(3, true, false, tangents),
                sliding = alike(3, false, true, tangents);
    expect_told(resting, [&](Alike& all) { last(all).coefficient = 0.6; });
    expect_told(given, [&](Alike& all) { last(all).given = 2.5; });
    for (int k = 0; k < tangents; ++k) {
      expect_told(sliding, [&](Alike& all) { last(all).ratio[k] = 0.5; });
      expect_told(resting, [&](Alike& all) {
        all.A(last(all).normal, last(all).tangent + k) = all.A(last(all).tangent + k, last(all).normal) = -0.1;
      });
      expect_told(resting, [&](Alike& all) { all.A(last(all).tangent + k, last(all).tangent + k) = 3; });
      expect_told(resting, [&](Alike& all) { all.b[last(all).tangent + k] = 0.5; });
    }
    expect_told(resting, [&](Alike& all) { all.A(last(all).normal, last(all).normal) = 3; });
    expect_told(resting, [&](Alike& all) { all.b[last(all).normal] = -0.9; });
  }
}

// Four contacts that differ only in how they act on others, which b, A b and A A b show.
TEST(OrderedContacts, TellsContactsApartByHowTheyActOnOthers) {
  Alike all = alike(4, false, false, 1);
  for (int i = 0; i < 3; ++i) all.A(2 * i, 2 * i + 2) = all.A(2 * i + 2, 2 * i) = 0.3 + 0.1 * i;
  expect_one_order(all);
}

TEST(OrderedContacts, AreInOneOrderWhateverTheirNames) {
  std::mt19937 random(91);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 40; ++i) {
    Alike all = alike(4, i % 4 == 1, i % 4 == 2, 1 + i % 2);
    const Mat G = Mat::NullaryExpr(all.b.size(), all.b.size(), [&] { return any(random); });
    all.A += G * G.transpose();
    for (double& x : all.b) x = any(random);
    expect_one_order(all);
    if (all.points[1].normal < 0) continue;
    all.points[1].tangent = -1;  // without friction; its rows of A are no contact's
    const Alike one_less = named_by(all, {0, 1, 2, 3});
    expect_one_order(one_less);
  }
}

TEST(OrderedContacts, KeepTheirOrderInOtherUnits) {
  std::mt19937 random(92);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 40; ++i) {
    Alike all = alike(5, i % 2, false, 1 + i % 2);
    const Mat G = Mat::NullaryExpr(all.b.size(), all.b.size(), [&] { return any(random); });
    all.A += G * G.transpose();
    for (double& x : all.b) x = any(random);
    if (i % 2)
      for (ContactPoint& p : all.points) p.given = 2 + any(random);
    Alike scaled = all;
    scaled.A /= 1024, scaled.b *= 64;  // masses and accelerations
    for (ContactPoint& p : scaled.points) p.given *= 64 * 1024;
    EXPECT_EQ(OrderedContacts(all.points, all.A, all.b).order(),
              OrderedContacts(scaled.points, scaled.A, scaled.b).order())
        << i;
  }
}

}  // namespace
}  // namespace trammel::complementarity
