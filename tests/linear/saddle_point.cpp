// What linear/saddle_point.hpp promises, on every solver: random mechanisms and trusses, whose answers are known from
// the pseudo-inverse of the whole in 64 bits of mantissa.
#include "linear/saddle_point.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "linear/frontal_iteration_kkt.hpp"
#include "linear/fronts/frontal_kkt.hpp"
#include "linear/kkt.hpp"
#include "linear/sparse/dependent_rows.hpp"
#include "linear/sparse_iteration_kkt.hpp"
#include "linear/sparse_mass_kkt.hpp"
#include "trusses.hpp"

namespace trammel::numerics {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVec = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

// The same matrices body by body and dense; right sides that redundant rows do not contradict.
struct Problem {
  std::string name;
  std::vector<BodyBlock> bodies;
  Mat S, G, W;  // S = M, W = G, if not said otherwise
  int redundant = 0;
  Vec b, c;

  int nv() const { return int(S.rows()); }
  int nc() const { return int(G.rows()); }
};

void make_dense(Problem& p, int nv, int nc) {
  p.S.setZero(nv, nv), p.G.setZero(nc, nv);
  for (const BodyBlock& body : p.bodies) {
    const Eigen::Index n = body.M.rows();
    p.S.block(body.v0, body.v0, n, n) = body.M;
    for (std::size_t i = 0; i < body.rows.size(); ++i)
      p.G.row(body.rows[i]).segment(body.v0, n) = body.Gt.col(Eigen::Index(i)).transpose();
  }
  p.W = p.G;
}

using Joints = std::vector<std::pair<int, int>>;  // between bodies; -1: the ground
constexpr int velocities = 3, rows_of_joint = 2;

class Mechanism {
 public:
  Mechanism(std::string name, int n, const Joints& joints) : random_(17) {
    p_.name = std::move(name);
    p_.bodies.resize(std::size_t(n));
    for (int k = 0; k < n; ++k) {
      BodyBlock& body = p_.bodies[std::size_t(k)];
      const Mat root = some(velocities, velocities);
      body.v0 = velocities * k;
      body.M = root * root.transpose() + 0.3 * Mat::Identity(velocities, velocities);
      body.Gt.resize(velocities, 0);
    }
    for (const auto& [A, B] : joints) add_joint(A, B);
  }
  // Joint `joint` again, `factor` times as long and turned by about `sine`.
  Mechanism& repeat(int joint, double factor, double sine) {
    for (BodyBlock& body : p_.bodies)
      for (std::size_t i = 0; i < body.rows.size(); ++i)
        if (body.rows[i] == rows_of_joint * joint)
          append(body, factor * (body.Gt.middleCols(Eigen::Index(i), rows_of_joint) +
                                 sine * some(velocities, rows_of_joint)));
    nc_ += rows_of_joint;
    if (sine == 0) p_.redundant += rows_of_joint;
    return *this;
  }
  // Joint `joint` holds nothing: its markers are fixed.
  Mechanism& fix(int joint) {
    for (BodyBlock& body : p_.bodies)
      for (std::size_t i = 0; i < body.rows.size(); ++i)
        if (body.rows[i] / rows_of_joint == joint) body.Gt.col(Eigen::Index(i)).setZero();
    p_.redundant += rows_of_joint;
    return *this;
  }
  // Another joint, of the ground with itself.
  Mechanism& hold_ground() {
    add_joint(-1, -1);
    p_.redundant += rows_of_joint;
    return *this;
  }
  // Factors between 10^-decades and 10^decades.
  Mechanism& scale_masses(double decades) {
    for (BodyBlock& body : p_.bodies) body.M *= std::pow(10, decades * uniform_(random_));
    return *this;
  }
  Mechanism& scale_rows(double decades) {
    Vec factors = some(nc_, 1);
    for (BodyBlock& body : p_.bodies)
      for (std::size_t i = 0; i < body.rows.size(); ++i)
        body.Gt.col(Eigen::Index(i)) *= std::pow(10, decades * factors(body.rows[i]));
    return *this;
  }
  Problem problem() {
    const int nv = velocities * int(p_.bodies.size());
    make_dense(p_, nv, nc_);
    p_.b = some(nv, 1);
    p_.c = p_.G * some(nv, 1);
    return p_;
  }

 private:
  Mat some(int rows, int columns) {
    return Mat::NullaryExpr(rows, columns, [&] { return uniform_(random_); });
  }
  void append(BodyBlock& body, const Mat& Gt) {
    body.Gt.conservativeResize(velocities, body.Gt.cols() + rows_of_joint);
    body.Gt.rightCols(rows_of_joint) = Gt;
    for (int i = 0; i < rows_of_joint; ++i) body.rows.push_back(nc_ + i);
  }
  void add_joint(int A, int B) {
    for (const int k : {A, B})
      if (k >= 0) append(p_.bodies[std::size_t(k)], some(velocities, rows_of_joint));
    nc_ += rows_of_joint;
  }

  Problem p_;
  int nc_ = 0;
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

Joints chain(int n) {
  Joints joints;
  for (int k = 0; k < n; ++k) joints.emplace_back(k - 1, k);
  return joints;
}
Joints tree(int n) {
  Joints joints;
  for (int k = 0; k < n; ++k) joints.emplace_back(k == 0 ? -1 : (k - 1) / 2, k);
  return joints;
}
Joints loop(int n) {
  Joints joints = chain(n);
  joints.emplace_back(n - 1, -1);
  return joints;
}

Problem of_truss(std::string name, const test::Truss& truss) {
  Problem p{std::move(name), truss.bodies, {}, {}, {}, truss.redundant, truss.b, truss.c};
  make_dense(p, int(truss.b.size()), truss.rows);
  return p;
}

// Rows a (x_i - x_j), which merge unknowns, are known never to change.
Problem of_known_pins(Problem p) {
  p.name += " of pins known to be constant";
  for (BodyBlock& body : p.bodies)
    for (const int row : body.rows)
      body.constant.push_back((p.G.row(row).array() != 0).count() == 2 && p.G.row(row).sum() == 0);
  return p;
}

constexpr const char* unlike_rows = "rows from 1e-6 to 1e6";

std::vector<Problem> problems() {
  return {
      Mechanism("free bodies", 5, {}).problem(),
      Mechanism("chain", 12, chain(12)).problem(),
      Mechanism("tree", 12, tree(12)).problem(),
      Mechanism("loop", 12, loop(12)).problem(),
      Mechanism("masses from 1e-9 to 1e9", 12, chain(12)).scale_masses(9).problem(),
      Mechanism(unlike_rows, 12, tree(12)).scale_rows(6).problem(),
      Mechanism("joints near to dependent", 12, chain(12)).repeat(5, 1, 1e-3).problem(),
      Mechanism("joints said twice", 12, chain(12)).repeat(2, 1, 0).repeat(7, 1, 0).problem(),
      Mechanism("joint said thrice, in other units", 12, loop(12)).repeat(4, 2, 0).repeat(4, -0.5, 0).problem(),
      Mechanism("unlike masses, joint said twice", 12, tree(12)).scale_masses(3).repeat(6, 1, 0).problem(),
      Mechanism("a joint that holds nothing", 12, loop(12)).fix(3).problem(),
      Mechanism("no joint that holds anything", 2, chain(2)).fix(0).fix(1).problem(),
      Mechanism("joint of the ground with itself", 12, chain(12)).hold_ground().problem(),
      Mechanism("free bodies, joint of the ground with itself", 5, {}).hold_ground().problem(),
      Mechanism("no body, joint of the ground with itself", 0, {}).hold_ground().problem(),
      Mechanism("nothing at all", 0, {}).problem(),
      Mechanism("unlike masses, joints said twice or idle", 12, tree(12))
          .scale_masses(3)
          .fix(11)
          .hold_ground()
          .repeat(6, 1, 0)
          .problem(),
      of_truss("mast", test::Truss::mast(4, 1, 0.3)),
      of_truss("prismatic mast", test::Truss::prismatic_mast(2, 1, 0.3)),
      of_truss("hoop", test::Truss::hoop(8, 1, 0.3)),
      of_known_pins(of_truss("mast", test::Truss::mast(4, 1, 0.3))),
      of_known_pins(of_truss("prismatic mast", test::Truss::prismatic_mast(2, 1, 0.3))),
  };
}

struct Solution {
  Vec x, y;
};

Mat whole(const Problem& p) {
  Mat A = Mat::Zero(p.nv() + p.nc(), p.nv() + p.nc());
  A.topLeftCorner(p.nv(), p.nv()) = p.S;
  A.topRightCorner(p.nv(), p.nc()) = p.W.transpose();
  A.bottomLeftCorner(p.nc(), p.nv()) = p.G;
  return A;
}

Vec of_complement(const Problem& p, const Vec& y) {
  if (p.nv() == 0) return Vec::Zero(p.nc());
  const Vec forces = p.W.transpose().cwiseAbs() * y.cwiseAbs() + p.b.cwiseAbs();
  return p.G.cwiseAbs() * (p.S.inverse().cwiseAbs() * forces);
}

// The solution with y of minimum norm, and by how much roundings of the matrix and of the right sides move it:
// |A^+| (|A| |z| + |r|), the first-order bound of Skeel. A solver that forms the complement rounds what the multipliers
// do to the rows by way of S^-1, too: |G| |S^-1| (|W^T| |y| + |b|), which may be much more than what is left of it.
struct Reference {
  Solution solution;
  Vec x_moves, y_moves;

  Reference(const Problem& p, bool by_complement) {
    const int nv = p.nv(), nc = p.nc();
    if (nv + nc == 0) return;
    const Long A = whole(p).cast<long double>();
    // x in units of the bodies' masses; rows at length one where that does not change what minimum norm means.
    LongVec D = LongVec::Ones(nv + nc);
    for (const BodyBlock& body : p.bodies)
      D.segment(body.v0, body.M.rows()).setConstant(1 / std::sqrt((long double)(body.M.diagonal().maxCoeff())));
    if (p.redundant == 0)
      D.tail(nc) = (A.bottomLeftCorner(nc, nv) * D.head(nv).asDiagonal()).rowwise().norm().cwiseInverse();
    Eigen::CompleteOrthogonalDecomposition<Long> cod(nv + nc, nv + nc);
    cod.setThreshold(1e-14L);
    cod.compute(D.asDiagonal() * A * D.asDiagonal());
    const Long inverse = D.asDiagonal() * cod.pseudoInverse() * D.asDiagonal();
    LongVec right(nv + nc);
    right << p.b.cast<long double>(), p.c.cast<long double>();
    const LongVec z = inverse * right;
    LongVec rounded = A.cwiseAbs() * z.cwiseAbs() + right.cwiseAbs();
    if (by_complement) rounded.tail(nc) += of_complement(p, z.tail(nc).cast<double>()).cast<long double>();
    const LongVec moves = inverse.cwiseAbs() * rounded;
    solution = {z.head(nv).cast<double>(), z.tail(nc).cast<double>()};
    x_moves = moves.head(nv).cast<double>(), y_moves = moves.tail(nc).cast<double>();
  }
};

// Each solver with its own storage, filled from a Problem.
//   forms_complement  G S^-1 W^T, as LU of the whole does in eliminating S, without refinement of what that loses
//   scales_rows       rows may differ in length by more than the regularisation of redundant ones allows, 1e-5
struct DenseMass {
  static constexpr bool forms_complement = true, scales_rows = true;
  MassKkt kkt;
  bool factorise(const Problem& p) { return kkt.factorise(p.S, p.G); }
  bool solve(const Problem& p, Solution& s) { return kkt.solve(p.b, p.c, s.x, s.y); }
};
struct SparseStoredMass : DenseMass {
  bool factorise(const Problem& p) { return kkt.factorise(Eigen::SparseMatrix<double>(p.S.sparseView()), p.G, p.G); }
};
struct ByBodies {
  static constexpr bool forms_complement = true, scales_rows = true;
  SparseMassKkt kkt;
  bool factorise(const Problem& p) { return kkt.factorise(p.bodies, p.nc(), SparseMassKkt::Metric::mass); }
  bool solve(const Problem& p, Solution& s) {
    if (!kkt.solve(p.bodies, p.b, p.c, s.x, s.y)) return false;
    kkt.minimise_norm(p.bodies, s.y);
    return true;
  }
};
struct ByFronts {
  static constexpr bool forms_complement = false, scales_rows = true;
  FrontalKkt kkt;
  LeastMultipliers least;
  bool factorise(const Problem& p) {
    least.factorise(p.bodies, p.nc(), rank_tolerance_at(0));
    return kkt.factorise(p.bodies, p.nc(), false, rank_tolerance_at(0));
  }
  bool solve(const Problem& p, Solution& s) {
    if (!kkt.solve(p.bodies, p.b, p.c, s.x, s.y)) return false;
    least.minimise(s.y);
    return true;
  }
};
struct DenseIteration {
  static constexpr bool forms_complement = true, scales_rows = true;
  IterationKkt kkt;
  bool factorise(const Problem& p) {
    kkt.begin(p.nv(), p.nc()).topLeftCorner(p.nv(), p.nv()) = p.S;
    return kkt.factorise(p.W, p.G);
  }
  bool solve(const Problem& p, Solution& s) { return kkt.solve(p.b, p.c, s.x, s.y); }
};
struct SparseIteration {
  static constexpr bool forms_complement = false, scales_rows = false;
  SparseIterationKkt kkt;
  bool factorise(const Problem& p) { return kkt.factorise(whole(p).sparseView(), p.nv()); }
  bool solve(const Problem& p, Solution& s) { return kkt.solve(p.b, p.c, s.x, s.y); }
};
struct FrontalIteration {
  static constexpr bool forms_complement = false, scales_rows = true;
  FrontalIterationKkt kkt;
  bool factorise(const Problem& p) {
    const Mat A = whole(p);
    Matrix target = Matrix::onto(kkt.sum());
    kkt.factorise(p.nv(), p.G, rank_tolerance_at(0), [&] {
      for (int j = 0; j < int(A.cols()); ++j)
        for (int i = 0; i < int(A.rows()); ++i)
          if (A(i, j) != 0) target.add(i, j, A(i, j));
    });
    return true;
  }
  bool solve(const Problem& p, Solution& s) { return kkt.solve(p.b, p.c, s.x, s.y); }
};

template <class Solver>
class SaddlePoint : public testing::Test {
 protected:
  // Each problem by the same solver, one after the other.
  void for_each_problem(const std::function<void(const Problem&)>& check) {
    for (const Problem& p : problems()) {
      if (!Solver::scales_rows && p.name == unlike_rows) continue;
      SCOPED_TRACE(p.name);
      ASSERT_TRUE(solver_.factorise(p));
      check(p);
    }
  }
  Solution solve(const Problem& p) {
    Solution s;
    EXPECT_TRUE(solver_.solve(p, s));
    return s;
  }
  Solver solver_;
};
struct Names {
  template <class Solver>
  static std::string GetName(int) {
    const std::string name = testing::internal::GetTypeName<Solver>();
    return name.substr(name.rfind(':') + 1);
  }
};
using Solvers =
    testing::Types<DenseMass, SparseStoredMass, ByBodies, ByFronts, DenseIteration, SparseIteration, FrontalIteration>;
TYPED_TEST_SUITE(SaddlePoint, Solvers, Names);

double largest(const Vec& v) {
  return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0;
}

template <class Solver>
void expect_solution(const Problem& p, const Solution& s) {
  const Reference exact(p, Solver::forms_complement);
  const double round_off = (p.nv() + p.nc()) * eps;  // of sums as long as the system
  const double of_x = round_off * largest(exact.x_moves);
  EXPECT_LE(largest(s.x - exact.solution.x), of_x);
  const Vec of_forces = p.S.cwiseAbs() * s.x.cwiseAbs() + p.W.transpose().cwiseAbs() * s.y.cwiseAbs() + p.b.cwiseAbs();
  EXPECT_LE(largest(p.S * s.x + p.W.transpose() * s.y - p.b), round_off * largest(of_forces));
  if (p.nc() == 0) return;
  const Vec of_rows = p.G.cwiseAbs() * s.x.cwiseAbs() + p.c.cwiseAbs();
  EXPECT_LE(largest(p.G * s.x - p.c), round_off * largest(of_rows) + of_x * p.G.cwiseAbs().rowwise().sum().maxCoeff());
  EXPECT_LE(largest(s.y - exact.solution.y), round_off * largest(exact.y_moves));
}

TYPED_TEST(SaddlePoint, SolvesBothEquationsWithMultipliersOfMinimumNorm) {
  this->for_each_problem([&](const Problem& p) { expect_solution<TypeParam>(p, this->solve(p)); });
}

TYPED_TEST(SaddlePoint, KnowsWhetherRowsAreRedundant) {
  if constexpr (KnowsRedundantRows<decltype(TypeParam::kkt)>)
    this->for_each_problem([&](const Problem& p) { EXPECT_EQ(this->solver_.kkt.redundant(), p.redundant > 0); });
  else
    GTEST_SKIP() << "it finds what balances the forces, not which rows are redundant";
}

// The other one has the same pattern; the solver of the fixture has seen other patterns, too.
TYPED_TEST(SaddlePoint, GivesTheSameBitsAgainAndAfterAnotherSystem) {
  this->for_each_problem([&](const Problem& p) {
    const Solution after_others = this->solve(p), again = this->solve(p);
    EXPECT_EQ(again.x, after_others.x);
    EXPECT_EQ(again.y, after_others.y);
    Problem other = p;
    for (BodyBlock& body : other.bodies) body.M *= 3;
    other.S *= 3;
    TypeParam solver;
    Solution first, in_place;
    ASSERT_TRUE(solver.factorise(p) && solver.solve(p, first));
    ASSERT_TRUE(solver.factorise(other) && solver.factorise(p) && solver.solve(p, in_place));
    EXPECT_EQ(in_place.x, first.x);
    EXPECT_EQ(in_place.y, first.y);
    EXPECT_EQ(after_others.x, first.x);
    EXPECT_EQ(after_others.y, first.y);
  });
}

// Whether factorising or solving reports it.
template <class Solver>
bool solves(const Problem& p) {
  Solver solver;
  Solution s;
  return solver.factorise(p) && solver.solve(p, s);
}

// The last body has no mass, nothing holds it, and a force acts on it.
TYPED_TEST(SaddlePoint, ReportsAMatrixThatIsSingularBeyondTheRows) {
  for (Problem p : {Mechanism("free", 5, {}).problem(), Mechanism("tree", 13, tree(12)).problem(),
                    Mechanism("twice", 13, chain(12)).repeat(2, 1, 0).problem()}) {
    SCOPED_TRACE(p.name);
    p.bodies.back().M.setZero();
    p.S.bottomRows(velocities).setZero();
    EXPECT_FALSE(solves<TypeParam>(p));
  }
}

TYPED_TEST(SaddlePoint, ReportsWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Problem given = Mechanism("tree", 12, tree(12)).problem();
  ASSERT_TRUE(solves<TypeParam>(given));
  Problem p = given;
  p.b(7) = nan;
  EXPECT_FALSE(solves<TypeParam>(p)) << "force";
  p = given, p.c(7) = nan;
  EXPECT_FALSE(solves<TypeParam>(p)) << "right side of a row";
  p = given, p.bodies[4].M(1, 1) = nan, p.S(velocities * 4 + 1, velocities * 4 + 1) = nan;
  EXPECT_FALSE(solves<TypeParam>(p)) << "mass";
  p = given, p.bodies[4].Gt(1, 0) = nan, make_dense(p, p.nv(), p.nc());
  EXPECT_FALSE(solves<TypeParam>(p)) << "row";
}

TEST(DependentRows, AreTheRedundantOnesOfEachProblem) {
  for (const Problem& p : problems()) {
    const auto dependent = dependent_rows(SparseRows(p.G.sparseView()), rank_tolerance_at(0));
    EXPECT_EQ(int(dependent.size()), p.redundant) << p.name;
    EXPECT_EQ(rank_of_rows(p.G, rank_tolerance_at(0)), p.nc() - p.redundant) << p.name;
    FrontalKkt fronts;
    ASSERT_TRUE(fronts.factorise(p.bodies, p.nc(), false, rank_tolerance_at(0)));
    EXPECT_EQ(fronts.dependent(), p.redundant) << p.name;
  }
}

// Friction and gyroscopic forces: S is not symmetric, and rows push aside, too, the same for rows that say the same.
Problem unsymmetric(Problem p) {
  Mat aside = Mat::Identity(p.nv(), p.nv());
  for (int i = 0; i + 1 < p.nv(); ++i)
    if (i % velocities == 0) aside(i, i + 1) = 0.3;
  p.W = p.G * aside;
  for (int i = 0; i + velocities < p.nv(); ++i) p.S(i, i + velocities) += 0.2;
  p.name += ", unsymmetric";
  return p;
}

template <class Solver>
class UnsymmetricSaddlePoint : public SaddlePoint<Solver> {};
using SolversOfAnyMatrix = testing::Types<DenseIteration, SparseIteration, FrontalIteration>;
TYPED_TEST_SUITE(UnsymmetricSaddlePoint, SolversOfAnyMatrix, Names);

TYPED_TEST(UnsymmetricSaddlePoint, SolvesBothEquationsWithMultipliersOfMinimumNorm) {
  for (Mechanism mechanism : {Mechanism("chain", 12, chain(12)), Mechanism("tree", 12, tree(12)),
                              Mechanism("loop", 12, loop(12)), Mechanism("twice", 12, chain(12)).repeat(3, 1, 0)}) {
    const Problem p = unsymmetric(mechanism.problem());
    SCOPED_TRACE(p.name);
    ASSERT_TRUE(this->solver_.factorise(p));
    expect_solution<TypeParam>(p, this->solve(p));
  }
}

static_assert(FactorisesSaddlePoints<MassKkt, Mat, Mat> && SolvesSaddlePoints<MassKkt> && KnowsRedundantRows<MassKkt>);
static_assert(FactorisesSaddlePoints<IterationKkt, Mat, Mat> && SolvesSaddlePoints<IterationKkt> &&
              KnowsRedundantRows<IterationKkt>);
using Bodies = std::vector<BodyBlock>;
static_assert(FactorisesSaddlePoints<SparseMassKkt, Bodies, int, SparseMassKkt::Metric> &&
              SolvesSaddlePoints<SparseMassKkt, Bodies> && KnowsRedundantRows<SparseMassKkt>);
static_assert(FactorisesSaddlePoints<FrontalKkt, Bodies, int, bool, double> && SolvesSaddlePoints<FrontalKkt, Bodies> &&
              KnowsRedundantRows<FrontalKkt>);
static_assert(FactorisesSaddlePoints<SparseIterationKkt, Eigen::SparseMatrix<double>, int> &&
              SolvesSaddlePoints<SparseIterationKkt>);
static_assert(SolvesSaddlePoints<FrontalIterationKkt>);

}  // namespace
}  // namespace trammel::numerics
