// Programs over second-order cones by themselves: closed forms, and the conditions of their minimum.
#include "complementarity/programs/cone_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trammel::complementarity {
namespace {

using Eigen::Index;

Vec random_vector(std::mt19937& random, Index n) {
  std::normal_distribution<double> normal;
  return Vec::NullaryExpr(n, [&] { return normal(random); });
}
Mat random_matrix(std::mt19937& random, Index rows, Index columns) {
  return random_vector(random, rows * columns).reshaped(rows, columns);
}

std::vector<Index> random_cones(std::mt19937& random) {
  std::vector<Index> sizes(1 + random() % 4);
  for (Index& size : sizes) size = 1 + Index(random() % 4);
  return sizes;
}

Index total(const std::vector<Index>& cones) {
  Index n = 0;
  for (const Index size : cones) n += size;
  return n;
}

// The nearest point of the cones.
Vec projected(const std::vector<Index>& cones, Vec x) {
  Index first = 0;
  for (const Index size : cones) {
    auto part = x.segment(first, size);
    const double tail = part.tail(size - 1).norm();
    if (tail <= -part[0]) {
      part.setZero();
    } else if (tail > part[0]) {
      const double edge = (part[0] + tail) / 2;
      part.tail(size - 1) *= edge / tail;
      part[0] = edge;
    }
    first += size;
  }
  return x;
}

double outside(const std::vector<Index>& cones, const Vec& x) {
  return (x - projected(cones, x)).norm();
}

// For y a = P(y a) + (P(y a) - y a), and both parts are in the cones.
TEST(ConeProgram, OfOneRowIsSolvedByAProjection) {
  std::mt19937 random(1);
  int solved = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<Index> cones = random_cones(random);
    const Vec a = random_vector(random, total(cones)), nearest = projected(cones, a);
    if (nearest.norm() < 0.1) continue;  // no x, or a large one
    ++solved;
    const double y = 1 / nearest.squaredNorm();
    const ConeSolution found = solve_cone_program({cones, Vec::Ones(a.size()), a.transpose(), {}, Vec::Ones(1)});
    EXPECT_LE(found.off, 1e-9) << i;
    EXPECT_LE((found.x - y * nearest).norm(), 1e-5 * y * nearest.norm()) << i;  // root of the gap, where x and z are 0
    EXPECT_NEAR(found.y[0], y, 1e-8 * y) << i;
    EXPECT_EQ(found.s, 0) << i;
  }
  EXPECT_GT(solved, 200);
}

// The conditions of the minimum.
void expect_minimum(const ConeProgram& program, const ConeSolution& found, int number) {
  const double size = std::max({1.0, found.x.norm(), std::abs(found.s)});
  Vec missed = program.r - program.G * found.x, rows = program.G.rowwise().norm();
  if (program.u.size() > 0) missed -= found.s * program.u, rows += program.u.cwiseAbs();
  EXPECT_LE(missed.cwiseQuotient(rows).lpNorm<Eigen::Infinity>(), 1e-7 * size) << number;
  EXPECT_LE(outside(program.cones, found.x), 1e-7 * size) << number;
  const Vec z = program.D.cwiseProduct(found.x) - program.G.transpose() * found.y;
  EXPECT_LE(outside(program.cones, z), 1e-7 * (1 + z.norm())) << number;
  EXPECT_LE(std::abs(found.x.dot(z)), 1e-7 * size * (1 + z.norm())) << number;
  if (program.u.size() == 0) return;
  EXPECT_NEAR(program.u.dot(found.y), -1, 1e-7) << number;
}

ConeProgram random_program(std::mt19937& random, bool with_s) {
  ConeProgram program;
  program.cones = random_cones(random);
  const Index n = total(program.cones), rows = 1 + Index(random() % unsigned(n));
  program.D = random_vector(random, n).cwiseAbs().array() + 0.1;
  program.G = random_matrix(random, rows, n);
  Vec inside = projected(program.cones, random_vector(random, n));
  Index first = 0;
  for (const Index size : program.cones) inside[first] += 1, first += size;
  program.r = program.G * inside;
  if (with_s) {
    program.u = random_vector(random, rows);
    program.r += std::normal_distribution<double>()(random) * program.u;
  }
  program.r /= program.r.lpNorm<Eigen::Infinity>();
  return program;
}

TEST(ConeProgram, FindsTheMinimumOfRandomPrograms) {
  std::mt19937 random(2);
  int accurate = 0;
  for (int i = 0; i < 600; ++i) {
    const ConeProgram program = random_program(random, i % 2 == 0);
    const ConeSolution found = solve_cone_program(program);
    EXPECT_LE(found.off, 1e-7) << i;
    accurate += found.off <= 1e-11;
    expect_minimum(program, found, i);
  }
  EXPECT_GT(accurate, 570);  // of some, round-off grows before
}

TEST(ConeProgram, LeavesOutRowsThatFollowFromOthers) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    ConeProgram program = random_program(random, i % 2 == 0);
    const ConeSolution found = solve_cone_program(program);
    const Mat all = random_matrix(random, program.G.rows() + 3, program.G.rows());
    program.G = all * program.G, program.r = all * program.r;
    if (program.u.size() > 0) program.u = all * program.u;
    const ConeSolution again = solve_cone_program(program);
    expect_minimum(program, again, i);
    // To the root of the gap.
    EXPECT_NEAR(again.s, found.s, 1e-5 * (1 + std::abs(found.s))) << i;
    EXPECT_LE((again.x - found.x).norm(), 1e-5 * (1 + found.x.norm())) << i;
  }
}

// r - s u stays in the cones: the least ratio, or where the quadratic cone's edge is met.
TEST(ConeProgram, FindsTheLargestLoadThatConesCarry) {
  std::mt19937 random(4);
  for (int i = 0; i < 300; ++i) {
    const Index flat = Index(random() % 4), round = 1 + Index(random() % 3);
    std::vector<Index> cones(std::size_t(flat), 1);
    cones.push_back(1 + round);
    const Index n = total(cones);
    Vec u = random_vector(random, n).cwiseAbs().array() + 0.1, r = random_vector(random, n);
    u.tail(round).setZero();
    double largest = (r[flat] - r.tail(round).norm()) / u[flat];
    for (Index k = 0; k < flat; ++k) largest = std::min(largest, r[k] / u[k]);
    const ConeSolution found = solve_cone_program({cones, Vec::Zero(n), Mat::Identity(n, n), u, r});
    EXPECT_NEAR(found.s, largest, 1e-8 * (1 + std::abs(largest))) << i;
    EXPECT_LE((found.x - (r - largest * u)).norm(), 1e-8 * (1 + r.norm())) << i;
  }
}

// Of x_0 and x_1 = c T: a force T of 1 is carried by x_0 >= 1 / c, however thin the cone.
TEST(ConeProgram, HoldsInThinCones) {
  for (const double c : {1.0, 1e-2, 1e-4, 1e-6}) {
    const ConeSolution found = solve_cone_program({{2}, Vec{{1, c * c}}, Mat{{0, c}}, {}, Vec::Ones(1)});
    EXPECT_NEAR(c * found.x[0], 1, 1e-9) << c;
    EXPECT_NEAR(c * found.x[1], 1, 1e-9) << c;
  }
}

TEST(ConeProgram, SaysByHowMuchRowsAreMissedWhereNothingInTheConesSolvesThem) {
  EXPECT_GT(solve_cone_program({{1}, Vec::Ones(1), Mat::Ones(1, 1), {}, Vec{{-1}}}).off, 0.5);
  EXPECT_GT(solve_cone_program({{2}, Vec::Ones(2), Mat::Identity(2, 2), {}, Vec{{0.5, 1}}}).off, 0.01);
}

}  // namespace
}  // namespace trammel::complementarity
