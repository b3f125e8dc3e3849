#include "solver.hpp"

#include <cmath>
#include <new>

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <trammel/outside_domain.hpp>

namespace trammel::ida {
namespace {

constexpr int recoverable = 1, fatal = -1;

// The meaning of IDA's codes for a step. The texts live as long as the program.
const char* meaning(int flag) {
  switch (flag) {
    case IDA_ERR_FAIL:
      return "IDA: the error test failed again and again, or with the smallest step";
    case IDA_CONV_FAIL:
      return "IDA: Newton's iteration did not converge, not even with the smallest step";
    case IDA_REP_RES_ERR:
    case IDA_FIRST_RES_FAIL:
    case IDA_RES_FAIL:
      return "IDA: the equations have no finite value, not even with the smallest step";
    case IDA_LSETUP_FAIL:
    case IDA_LSOLVE_FAIL:
      return "IDA: the iteration matrix is singular";
    case IDA_TOO_MUCH_ACC:
      return "IDA: the tolerances are below round-off";
    default:
      return "IDA: the step failed";
  }
}

// Equations keep the factors, so the library's matrix is empty and its linear solver calls them.
int nothing_to_clear(SUNMatrix) {
  return 0;
}

}  // namespace

struct Solver::Library {
  SUNContext context = nullptr;
  void* memory = nullptr;
  N_Vector y = nullptr, y_dot = nullptr, kind = nullptr, out = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver factors = nullptr;

  ~Library() {
    if (memory) IDAFree(&memory);
    if (factors) SUNLinSolFreeEmpty(factors);
    if (matrix) SUNMatFreeEmpty(matrix);
    for (N_Vector v : {y, y_dot, kind, out})
      if (v) N_VDestroy(v);
    if (context) SUNContext_Free(&context);
  }

  void create(Eigen::Index size) {
    if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
    for (N_Vector* v : {&y, &y_dot, &kind, &out})
      if (!(*v = N_VNew_Serial(size, context))) throw std::bad_alloc();
    matrix = SUNMatNewEmpty(context);
    factors = SUNLinSolNewEmpty(context);
    memory = IDACreate(context);
    if (!matrix || !factors || !memory) throw std::bad_alloc();
    matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix->ops->zero = nothing_to_clear;
    factors->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    factors->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  }
};

void Segment::evaluate(double t, Eigen::Index nq, Vec& q, Vec& v) const {
  const Eigen::Index nv = derivatives.rows() - nq;
  q = derivatives.col(order).head(nq), v = derivatives.col(order).tail(nv);
  for (int j = order; j > 0; --j) {  // Horner
    const double factor = (t - end) / j;
    q = derivatives.col(j - 1).head(nq) + factor * q;
    v = derivatives.col(j - 1).tail(nv) + factor * v;
  }
}

Solver::Solver(const Tolerances& tolerances) : tolerances_(tolerances) {}
Solver::~Solver() = default;

// An exception of `call` is kept until the library has returned; a shorter step may stay inside a component's domain.
template <class Call>
int Solver::guarded(Call&& call) {
  try {
    return call() ? 0 : recoverable;
  } catch (const OutsideDomain&) {
    thrown_ = std::current_exception();
    return recoverable;
  } catch (...) {
    thrown_ = std::current_exception();
    return fatal;
  }
}

// The weights make the library's norm, which divides by the number of all unknowns, the root mean square over q and v.
// Multipliers follow from q and v and are not part of the error test.
int Solver::of_weights(const double* y, double* weights) const {
  constexpr double not_judged = 1e-30;
  const Eigen::Index judged = equations_.differential(), all = equations_.size();
  const double share = std::sqrt(double(all) / double(judged));
  for (Eigen::Index i = 0; i < all; ++i)
    weights[i] = i < judged ? share / (tolerances_.relative * std::abs(y[i]) + tolerances_.absolute) : not_judged;
  return 0;
}

// [s] A step that changes y by half of the allowed error: it is this short because the first step is of first order.
double Solver::first_step(const State& now) const {
  constexpr double most = 1e-3;
  double sum = 0;
  const auto add = [&](const Vec& x, const Vec& rate) {
    for (Eigen::Index i = 0; i < rate.size(); ++i) {
      const double allowed = tolerances_.absolute + tolerances_.relative * (i < x.size() ? std::abs(x[i]) : 0);
      sum += std::pow(rate[i] / allowed, 2);
    }
  };
  add(now.q, now.v), add(now.v, now.a);
  const double rate = std::sqrt(sum / double(std::max<Eigen::Index>(1, equations_.differential())));
  return rate * most > 0.5 ? 0.5 / rate : most;
}

// What the library calls: `self` is the solver.
struct Solver::Callbacks {
  static int residual(double t, N_Vector y, N_Vector y_dot, N_Vector F, void* self) {
    Solver& solver = *static_cast<Solver*>(self);
    return solver.guarded([&] {
      return solver.equations_.residual(t, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot), N_VGetArrayPointer(F));
    });
  }
  static int weights(N_Vector y, N_Vector weights, void* self) {
    return static_cast<Solver*>(self)->of_weights(N_VGetArrayPointer(y), N_VGetArrayPointer(weights));
  }
  static int factorise(double t, double c, N_Vector y, N_Vector y_dot, N_Vector, SUNMatrix, void* self, N_Vector,
                       N_Vector, N_Vector) {
    Solver& solver = *static_cast<Solver*>(self);
    return solver.guarded(
        [&] { return solver.equations_.factorise(t, c, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot)); });
  }
  static int solve(SUNLinearSolver factors, SUNMatrix, N_Vector x, N_Vector b, double) {
    Solver& solver = *static_cast<Solver*>(factors->content);
    return solver.guarded([&] { return solver.equations_.solve(N_VGetArrayPointer(b), N_VGetArrayPointer(x)); });
  }
};

void Solver::restart(System& s, const State& now) {
  equations_.restart(s);
  const Eigen::Index size = equations_.size();
  const bool anew = !ida_ || N_VGetLength(ida_->y) != size;
  if (anew) {
    ida_ = std::make_unique<Library>();
    ida_->create(size);
  }
  Library& ida = *ida_;
  equations_.start(now, N_VGetArrayPointer(ida.y), N_VGetArrayPointer(ida.y_dot));
  if (anew)
    set_up(now.t);
  else
    IDAReInit(ida.memory, now.t, ida.y, ida.y_dot);
  IDASetInitStep(ida.memory, first_step(now));
}

void Solver::set_up(double t) {
  Library& ida = *ida_;
  IDAInit(ida.memory, Callbacks::residual, t, ida.y, ida.y_dot);
  IDASetUserData(ida.memory, this);
  IDASetErrFile(ida.memory, nullptr);
  IDAWFtolerances(ida.memory, Callbacks::weights);
  double* const kind = N_VGetArrayPointer(ida.kind);
  for (Eigen::Index i = 0; i < equations_.size(); ++i) kind[i] = i < equations_.differential() ? 1 : 0;
  IDASetId(ida.memory, ida.kind);
  IDASetSuppressAlg(ida.memory, SUNTRUE);  // index 2
  IDASetMaxOrd(ida.memory, tolerances_.max_order);
  // The multipliers are not in the error test, so the error that Newton's iteration leaves in them would enter the
  // predictions of the next steps. IDA's own value, 0.33 of the tolerance, costs more steps than it saves iterations.
  IDASetNonlinConvCoef(ida.memory, 1e-3);
  if (tolerances_.max_step > 0) IDASetMaxStep(ida.memory, tolerances_.max_step);
  ida.factors->content = this;
  ida.factors->ops->solve = Callbacks::solve;
  IDASetLinearSolver(ida.memory, ida.factors, ida.matrix);
  IDASetJacFn(ida.memory, Callbacks::factorise);
}

Outcome Solver::advance(Segment& segment) {
  Library& ida = *ida_;
  thrown_ = nullptr;
  double t = 0, h = 0;
  IDAGetCurrentTime(ida.memory, &t);
  const double ahead = t + 1 + std::abs(t);  // only its side counts: steps do not end there
  const int flag = IDASolve(ida.memory, ahead, &t, ida.y, ida.y_dot, IDA_ONE_STEP);
  if (flag < 0) {
    if (thrown_) std::rethrow_exception(thrown_);
    return Outcome::reject(meaning(flag));
  }
  IDAGetLastStep(ida.memory, &h);
  IDAGetLastOrder(ida.memory, &segment.order);
  segment.begin = t - h, segment.end = t;
  const Eigen::Index n = equations_.differential();
  if (segment.derivatives.rows() != n || segment.derivatives.cols() < segment.order + 1)
    segment.derivatives.resize(n, tolerances_.max_order + 1);
  for (int j = 0; j <= segment.order; ++j) {
    IDAGetDky(ida.memory, t, j, ida.out);
    segment.derivatives.col(j) = Eigen::Map<const Vec>(N_VGetArrayPointer(ida.out), n);
  }
  return Outcome::accept();
}

}  // namespace trammel::ida
