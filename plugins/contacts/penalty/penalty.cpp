// Penalty contact of a surface with a sphere, a plane or another surface, evaluated at each of its points.
//
//     p = k delta + c delta'  >= 0,     delta = -gap [m],  delta' = -gap_rate [m/s]
//
// By area (default), p is a pressure, k [N/m^3], c [N s/m^3], and the force on a point is p times the area that it
// represents: the contact does not depend on the mesh. By points, p is the force on a point, k [N/m], c [N s/m], as in
// Wang et al. 2021: the stiffness is proportional to the number of points. U = k delta^2 / 2 times the same weight.
#include <algorithm>

#include <trammel/contact.hpp>
#include <trammel/fidelity.hpp>
#include <trammel/plugin.hpp>

namespace {

using namespace trammel;

struct Penalty : ContactForce, ForceBySurfacePoints, HasFidelity {
  enum class By { area, points };
  double stiffness = 0, damping = 0, apart = 0;
  By by = By::area;

  double normal(double gap, double gap_rate, double) const override {
    return gap < 0 ? std::max(0.0, -stiffness * gap - damping * gap_rate) : 0;
  }
  double potential(double gap) const override { return gap < 0 ? 0.5 * stiffness * gap * gap : 0; }
  Slope slope(double gap, double gap_rate, double) const override {
    if (!(gap < 0 && -stiffness * gap - damping * gap_rate > 0)) return {};
    return {.by_gap = -stiffness, .by_rate = -damping};
  }
  double weight(double area) const override { return by == By::area ? area : 1; }
  std::vector<FidelityParameter> fidelity() const override {
    return {{"stiffness"}, {"spacing", FidelityParameter::Costs::more_if_smaller}};
  }
  double spacing(double sphere_radius) const override { return apart > 0 ? apart : sphere_radius / 30; }
};

}  // namespace

TRAMMEL_PLUGIN(
    trammel::contact<Penalty>("penalty", "pressure by penetration, of a surface and a sphere, plane or other surface")
        .source("Wang, Cui, Yu, Lan, Lu 2021, Chin. J. Theor. Appl. Mech. 53(8); weights by area instead of points")
        .parameter("stiffness", &Penalty::stiffness,
                   {.unit = "N/m^3", .min = 0, .above_min = true, .required = true, .doc = "k; N/m by points"})
        .parameter("damping", &Penalty::damping, {.unit = "N s/m^3", .min = 0, .doc = "c; N s/m by points"})
        .choice("by", &Penalty::by, {{"area", Penalty::By::area}, {"points", Penalty::By::points}},
                {.doc = "what a point of the surface weighs: its area, or 1"})
        .parameter("spacing", &Penalty::apart,
                   {.unit = "m",
                    .min = 0,
                    .doc = "between points at most; 0: a thirtieth of the sphere's radius, against a plane or surface "
                           "four Gauss points along each side of an element"}))
