// The parameters of all integrators that use NewmarkStep (trammel/methods/newmark_step.hpp), declared once:
//
//     TRAMMEL_PLUGIN(trammel::newmark_parameters(
//         trammel::integrator<HhtAlpha>("hht_alpha", "...").source("...").parameter("alpha", &HhtAlpha::alpha)))
//
// They follow the method's own parameters. The integrator must have the members
//
//     Formulation formulation;  double tolerance = Newton().tolerance;  int max_iterations = Newton().max_iterations;
#pragma once

#include <trammel/methods/newmark_step.hpp>
#include <trammel/parameters.hpp>

namespace trammel {

template <class Method>
Declare<Method> newmark_parameters(Declare<Method> method) {
  return method
      .choice("formulation", &Method::formulation,
              {{"stabilised", Formulation::stabilised}, {"index3", Formulation::index3}},
              {.doc = "stabilised holds positions and velocities of the rows; index3 positions only"})
      .parameter("tolerance", &Method::tolerance,
                 {.min = 0,
                  .max = 1e-2,
                  .usual_max = 1e-8,
                  .above_min = true,
                  .doc = "of Newton's iteration, relative to the size of q and v; a remaining error of a hundredth of "
                         "the step's own error, by the change of its acceleration, is sufficient in any case"})
      .parameter("max_iterations", &Method::max_iterations,
                 {.min = 1, .max = 100, .usual_max = 30, .doc = "of Newton, before a step is rejected"});
}

}  // namespace trammel
