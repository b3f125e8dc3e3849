// The parameters of a patch. They are those of the plate itself if it has only one patch.
#include "tspline_plate/mesh/patch.hpp"

namespace trammel::plate {

Declaration patch_declaration() {
  constexpr const char* edge_doc = "free, hinged, clamped, symmetric, pole, or held axes such as \"xz\"";
  constexpr const char* corner_doc = "free, hinged, or held axes such as \"z\"";
  const ParameterTraits moment{.unit = "N m/m", .doc = "turns the edge towards the normal and follows it"};
  const ParameterTraits force{.unit = "N/m", .doc = "dead, by reference length"};
  const ParameterTraits pressure{.unit = "N/m", .doc = "dead, into the plate"};
  return part<Patch>("patch", "one patch of a plate's surface")
      .choice("geometry.shape", &Patch::shape,
              {{"rectangle", Patch::Shape::rectangle},
               {"ring", Patch::Shape::ring},
               {"cylinder", Patch::Shape::cylinder},
               {"sphere", Patch::Shape::sphere},
               {"points", Patch::Shape::points}},
              {.doc = "of the undeformed mid-surface"})
      .parameter("geometry.origin", &Patch::origin, {.unit = "m", .doc = "corner u0v0 of a rectangle, else the centre"})
      .parameter("geometry.along_u", &Patch::along_u, {.unit = "m", .doc = "rectangle: its side along u"})
      .parameter("geometry.along_v", &Patch::along_v, {.unit = "m", .doc = "rectangle: its side along v"})
      .parameter("geometry.axis", &Patch::axis, {.doc = "ring, cylinder, sphere: direction of the axis"})
      .parameter("geometry.start", &Patch::start, {.doc = "where angles are counted from"})
      .parameter("geometry.inner_radius", &Patch::inner_radius,
                 {.unit = "m", .min = 0, .above_min = true, .doc = "ring"})
      .parameter("geometry.radius", &Patch::radius,
                 {.unit = "m", .min = 0, .above_min = true, .doc = "ring (outer), cylinder, sphere"})
      .parameter("geometry.length", &Patch::length, {.unit = "m", .min = 0, .above_min = true, .doc = "cylinder"})
      .parameter("geometry.from", &Patch::from,
                 {.unit = "rad", .doc = "angle at the first edge; u runs round cylinders and spheres, v round rings"})
      .parameter(
          "geometry.to", &Patch::to,
          {.unit = "rad",
           .doc = "angle at the other edge; an arc over 2.6 is a spline through the circle at its elements' ends"})
      .parameter("geometry.south", &Patch::south,
                 {.unit = "rad", .min = -1.5708, .max = 1.5708, .doc = "sphere: latitude of v0; -pi/2: the pole"})
      .parameter("geometry.north", &Patch::north,
                 {.unit = "rad", .min = -1.5708, .max = 1.5708, .doc = "sphere: latitude of v1; pi/2: the pole"})
      .parameter("geometry.control_points", &Patch::control_points,
                 {.unit = "m", .doc = "points: x, y, z of each, by rows from v0"})
      .parameter("geometry.weights", &Patch::weights, {.doc = "points: one a control point; none: all 1"})
      .parameter("mesh.elements", &Patch::elements, {.doc = "along u and v, of equal size"})
      .parameter("mesh.elements_u", &Patch::elements_u, {.min = 0, .doc = "their number along u instead, if above 0"})
      .parameter("mesh.elements_v", &Patch::elements_v, {.min = 0, .doc = "their number along v instead, if above 0"})
      .parameter("mesh.u", &Patch::knots_u, {.doc = "distinct knots instead; inner ones may stand twice"})
      .parameter("mesh.v", &Patch::knots_v, {.doc = "distinct knots instead"})
      .parameter("mesh.partial", &Patch::partial_lines,
                 {.doc = "lines drawn in part, four numbers each: 0 (u = const) or 1, line, from, to"})
      .parameter("mesh.cross", &Patch::crossed, {.doc = "elements to split in four, counted by rows from 0"})
      .choice("mesh.closure", &Patch::closure,
              {{"both", Closure::both}, {"greedy", Closure::greedy}, {"none", Closure::none}},
              {.doc = "what makes a T-mesh analysis-suitable; none keeps it as it is"})
      .parameter("edges.u0", &Patch::edge_u0, {.doc = edge_doc})
      .parameter("edges.u1", &Patch::edge_u1, {.doc = edge_doc})
      .parameter("edges.v0", &Patch::edge_v0, {.doc = edge_doc})
      .parameter("edges.v1", &Patch::edge_v1, {.doc = edge_doc})
      .parameter("corners.u0v0", &Patch::corner_u0v0, {.doc = corner_doc})
      .parameter("corners.u1v0", &Patch::corner_u1v0, {.doc = corner_doc})
      .parameter("corners.u0v1", &Patch::corner_u0v1, {.doc = corner_doc})
      .parameter("corners.u1v1", &Patch::corner_u1v1, {.doc = corner_doc})
      .parameter("edge_moment.u0", &Patch::moment_u0, moment)
      .parameter("edge_moment.u1", &Patch::moment_u1, moment)
      .parameter("edge_moment.v0", &Patch::moment_v0, moment)
      .parameter("edge_moment.v1", &Patch::moment_v1, moment)
      .parameter("edge_force.u0", &Patch::force_u0, force)
      .parameter("edge_force.u1", &Patch::force_u1, force)
      .parameter("edge_force.v0", &Patch::force_v0, force)
      .parameter("edge_force.v1", &Patch::force_v1, force)
      .parameter("edge_pressure.u0", &Patch::pressure_u0, pressure)
      .parameter("edge_pressure.u1", &Patch::pressure_u1, pressure)
      .parameter("edge_pressure.v0", &Patch::pressure_v0, pressure)
      .parameter("edge_pressure.v1", &Patch::pressure_v1, pressure)
      .parameter("markers", &Patch::markers,
                 {.doc = "named points [u, v, height over the mid-surface in m] beside centre and corners"});
}

namespace {

struct Same {
  bool operator()(const TimeFunction& a, const TimeFunction& b) const {
    return a.is_constant() && b.is_constant() && a(0) == b(0);
  }
  template <class T>
  bool operator()(const T& a, const T& b) const {
    return a == b;
  }
  template <class T, class U>
  bool operator()(const T&, const U&) const {
    return false;
  }
};

}  // namespace

std::string first_given(const Patch& patch) {
  const Patch untouched;
  for (const Parameter& p : patch_declaration().parameters)
    if (!std::visit(Same{}, p.get(patch), p.get(untouched))) return p.name;
  return "";
}

}  // namespace trammel::plate
