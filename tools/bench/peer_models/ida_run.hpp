// A run of SUNDIALS' IDA (BDF of variable order) on F(t, y, y') = 0 with dense factors and an exact Jacobian.
#pragma once

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "measured.hpp"

namespace peers {

/// A mechanism's equations of motion as IDA takes them.
class Dae {
 public:
  virtual ~Dae() = default;
  virtual void residual(double t, const double* y, const double* y_dot, double* r) const = 0;
  /// J = dF/dy + c dF/dy', zero on entry.
  virtual void jacobian(double t, double c, const double* y, const double* y_dot, SUNMatrix J) const = 0;
};

struct Start {
  std::vector<double> y, y_dot;
  std::vector<double> differential;  // 1; 0 for multipliers
};

struct Tolerances {
  double relative, absolute, multipliers;  // multipliers: absolute
};

inline void check(int flag) {
  if (flag < 0) throw std::runtime_error(IDAGetReturnFlagName(flag));
}

/// From 0 to `until`; the series is the end alone, all of y.
inline Measured run(const Dae& dae, const Start& start, const Tolerances& tolerances, double until) {
  Measured m;
  char version[32];
  SUNDIALSGetVersion(version, sizeof version);
  m.peer = std::string("SUNDIALS IDA ") + version;

  SUNContext context;
  SUNContext_Create(nullptr, &context);
  const sunindextype n = start.y.size();
  const auto vector = [&](const std::vector<double>& from) {
    N_Vector v = N_VNew_Serial(n, context);
    std::copy(from.begin(), from.end(), N_VGetArrayPointer(v));
    return v;
  };
  N_Vector y = vector(start.y), y_dot = vector(start.y_dot), differential = vector(start.differential);
  N_Vector absolute = N_VClone(y);
  for (sunindextype i = 0; i < n; ++i) {
    NV_Ith_S(absolute, i) = start.differential[i] == 1 ? tolerances.absolute : tolerances.multipliers;
  }
  SUNMatrix J = SUNDenseMatrix(n, n, context);
  SUNLinearSolver factors = SUNLinSol_Dense(y, J, context);
  void* ida = IDACreate(context);
  try {
    check(IDAInit(
        ida,
        [](double t, N_Vector y, N_Vector y_dot, N_Vector r, void* dae) {
          static_cast<const Dae*>(dae)->residual(t, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot),
                                                 N_VGetArrayPointer(r));
          return 0;
        },
        0, y, y_dot));
    check(IDASetUserData(ida, const_cast<Dae*>(&dae)));
    check(IDASVtolerances(ida, tolerances.relative, absolute));
    check(IDASetId(ida, differential));
    check(IDASetSuppressAlg(ida, SUNTRUE));
    check(IDASetLinearSolver(ida, factors, J));
    check(IDASetJacFn(ida, [](double t, double c, N_Vector y, N_Vector y_dot, N_Vector, SUNMatrix J, void* dae,
                              N_Vector, N_Vector, N_Vector) {
      static_cast<const Dae*>(dae)->jacobian(t, c, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot), J);
      return 0;
    }));
    check(IDASetMaxNumSteps(ida, 1'000'000));
    check(IDASetStopTime(ida, until));
    check(IDASetErrFile(ida, nullptr));

    double t = 0;
    const double begin = cpu_seconds();
    const int flag = IDASolve(ida, until, &t, y, y_dot, IDA_NORMAL);
    m.cpu = cpu_seconds() - begin;
    check(flag);
    m.series.emplace_back(t, std::vector<double>(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + n));
  } catch (const std::exception& e) {
    m.failure = e.what();
  }
  IDAGetNumSteps(ida, &m.steps);
  IDAGetNumResEvals(ida, &m.evaluations);
  IDAFree(&ida);
  SUNLinSolFree(factors);
  SUNMatDestroy(J);
  for (N_Vector v : {y, y_dot, differential, absolute}) N_VDestroy(v);
  SUNContext_Free(&context);
  return m;
}

}  // namespace peers
