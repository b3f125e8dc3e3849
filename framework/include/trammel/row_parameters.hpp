// The parameters of all explicit integrators that concern rows (trammel/methods/runge_kutta.hpp), declared once:
//
//     TRAMMEL_PLUGIN(trammel::row_parameters(trammel::integrator<RungeKutta4>("runge_kutta_4", "...").source("...")))
//
// The integrator must have the members
//
//     double delta, epsilon;  RungeKutta::Rows rows = RungeKutta::Rows::baumgarte;
#pragma once

#include <trammel/parameters.hpp>
#include <trammel/methods/runge_kutta.hpp>

namespace trammel {

template <class Method>
Declare<Method> row_parameters(Declare<Method> method) {
  return method
      .parameter("delta", &Method::delta,
                 {.unit = "1/s",
                  .min = 0,
                  .doc = "Baumgarte's weight of the velocity rows: g'' + 2 delta g' + epsilon^2 g = 0"})
      .parameter("epsilon", &Method::epsilon,
                 {.unit = "1/s", .min = 0, .doc = "Baumgarte's weight of the position rows"})
      .choice("rows", &Method::rows, RungeKutta::rows_choices(), {.doc = RungeKutta::rows_doc});
}

}  // namespace trammel
