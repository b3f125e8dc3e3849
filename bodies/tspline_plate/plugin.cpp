#include <trammel/plugin.hpp>

#include "plate.hpp"

using trammel::plate::Closure;
using P = trammel::plate::TsplinePlate;

TRAMMEL_PLUGIN(
    trammel::body<P>("tspline_plate", "thin plate or shell on rational bicubic T-splines; its mesh can refine")
        .source("Kiendl et al. 2009, CMAME 198; Wang, Cui, Yu, Lan, Lu 2021, Chin. J. Theor. Appl. Mech. 53(8)")
        .parameter("thickness", &P::thickness, {.unit = "m", .min = 0, .above_min = true, .required = true})
        .parameter("density", &P::density, {.unit = "kg/m^3", .min = 0, .above_min = true, .required = true})
        .parameter("youngs_modulus", &P::youngs_modulus, {.unit = "Pa", .min = 0, .above_min = true, .required = true})
        .parameter("poissons_ratio", &P::poissons_ratio, {.min = -0.99, .max = 0.4999})
        .choice("geometry.shape", &P::shape_kind,
                {{"rectangle", P::Shape::rectangle},
                 {"ring", P::Shape::ring},
                 {"cylinder", P::Shape::cylinder},
                 {"sphere", P::Shape::sphere},
                 {"points", P::Shape::points}},
                {.doc = "of the undeformed mid-surface"})
        .parameter("geometry.origin", &P::origin, {.unit = "m", .doc = "corner u0v0 of a rectangle, else the centre"})
        .parameter("geometry.along_u", &P::along_u, {.unit = "m", .doc = "rectangle: its side along u"})
        .parameter("geometry.along_v", &P::along_v, {.unit = "m", .doc = "rectangle: its side along v"})
        .parameter("geometry.axis", &P::axis, {.doc = "ring, cylinder, sphere: direction of the axis"})
        .parameter("geometry.start", &P::start, {.doc = "where angles are counted from"})
        .parameter("geometry.inner_radius", &P::inner_radius, {.unit = "m", .min = 0, .above_min = true, .doc = "ring"})
        .parameter("geometry.radius", &P::radius,
                   {.unit = "m", .min = 0, .above_min = true, .doc = "ring (outer), cylinder, sphere"})
        .parameter("geometry.length", &P::length, {.unit = "m", .min = 0, .above_min = true, .doc = "cylinder"})
        .parameter("geometry.from", &P::from,
                   {.unit = "rad", .doc = "angle at the first edge; u runs round cylinders and spheres, v round rings"})
        .parameter(
            "geometry.to", &P::to,
            {.unit = "rad",
             .doc = "angle at the other edge; an arc over 2.6 is a spline through the circle at its elements' ends"})
        .parameter("geometry.south", &P::south,
                   {.unit = "rad", .min = -1.57, .max = 1.57, .doc = "sphere: latitude of v0"})
        .parameter("geometry.north", &P::north,
                   {.unit = "rad", .min = -1.57, .max = 1.5708, .doc = "sphere: latitude of v1, short of the pole"})
        .parameter("geometry.control_points", &P::control_points,
                   {.unit = "m", .doc = "points: x, y, z of each, by rows from v0"})
        .parameter("geometry.weights", &P::weights, {.doc = "points: one a control point; none: all 1"})
        .parameter("mesh.elements", &P::elements, {.doc = "along u and v, of equal size"})
        .parameter("mesh.elements_u", &P::elements_u, {.min = 0, .doc = "their number along u instead, if above 0"})
        .parameter("mesh.elements_v", &P::elements_v, {.min = 0, .doc = "their number along v instead, if above 0"})
        .parameter("mesh.u", &P::knots_u, {.doc = "distinct knots instead; inner ones may stand twice"})
        .parameter("mesh.v", &P::knots_v, {.doc = "distinct knots instead"})
        .parameter("mesh.partial", &P::partial_lines,
                   {.doc = "lines drawn in part, four numbers each: 0 (u = const) or 1, line, from, to"})
        .parameter("mesh.cross", &P::crossed, {.doc = "elements to split in four, counted by rows from 0"})
        .choice("mesh.closure", &P::closure,
                {{"both", Closure::both}, {"greedy", Closure::greedy}, {"none", Closure::none}},
                {.doc = "what makes a T-mesh analysis-suitable; none keeps it as it is"})
        .parameter("quadrature", &P::quadrature,
                   {.min = 2, .max = 6, .doc = "Gauss points a direction of a cell, for the stiffness"})
        .parameter("held_axes", &P::held_axes, {.doc = "axes along which nothing moves, such as \"z\""})
        .choice("joined", &P::joined, {{"none", P::Joined::none}, {"u", P::Joined::u}, {"v", P::Joined::v}},
                {.doc = "u: edge u1 goes on at u0, C1 (a closed tube); v: the same along v"})
        .parameter("damping.mass", &P::mass_damping, {.unit = "1/s", .min = 0, .doc = "force -factor M v"})
        .parameter("damping.stiffness", &P::stiffness_damping,
                   {.unit = "s", .min = 0, .doc = "stress by strain rate (Kelvin-Voigt)"})
        .parameter("pressure", &P::pressure, {.unit = "N/m^2", .doc = "along the normal, follows it; may depend on t"})
        .parameter("load", &P::load, {.unit = "N/m^2", .doc = "dead, by reference area"})
        .parameter("load_factor", &P::load_factor,
                   {.doc = "of the dead loads (load, edge_force, edge_pressure); may depend on t"})
        .parameter("velocity", &P::velocity, {.unit = "m/s", .doc = "at the start"})
        .parameter("angular_velocity", &P::angular_velocity,
                   {.unit = "rad/s", .doc = "at the start, about geometry.origin"})
        .parameter("markers", &P::extra_markers,
                   {.doc = "named points [u, v, height over the mid-surface in m] beside centre and corners"})
        .parameter("refine.on_contact", &P::refine_on, {.doc = "contact whose first closing refines the mesh"})
        .parameter("refine.at", &P::refine_at, {.unit = "s", .doc = "time that refines the mesh"})
        .parameter("refine.elements", &P::refine_elements, {.doc = "elements to split in four then"})
        .parameter(
            "refine.near", &P::refine_near,
            {.unit = "m", .min = 0, .doc = "instead: elements so near the place, at every closing of the contact"})
        .choice("refine.indicator", &P::indicator,
                {{"none", trammel::plate::Indicator::none},
                 {"energy_density", trammel::plate::Indicator::energy_density},
                 {"curvature_jump", trammel::plate::Indicator::curvature_jump},
                 {"contact_pressure", trammel::plate::Indicator::contact_pressure}},
                {.doc = "splits elements, at the end of any step, where it is above the threshold"})
        .parameter(
            "refine.threshold", &P::refine_threshold,
            {.min = 0,
             .doc = "energy_density: mean [J/m^2]; curvature_jump: change across the element [1/m]; contact_pressure: "
                    "largest on the element [Pa]"})
        .parameter(
            "refine.levels", &P::refine_levels,
            {.min = 1, .max = 12, .doc = "how often near or the indicator may split an element of the first mesh"})
        .parameter("edges.u0", &P::edge_u0, {.doc = "free, hinged, clamped, symmetric, or held axes such as \"xz\""})
        .parameter("edges.u1", &P::edge_u1, {.doc = "free, hinged, clamped, symmetric, or held axes such as \"xz\""})
        .parameter("edges.v0", &P::edge_v0, {.doc = "free, hinged, clamped, symmetric, or held axes such as \"xz\""})
        .parameter("edges.v1", &P::edge_v1, {.doc = "free, hinged, clamped, symmetric, or held axes such as \"xz\""})
        .parameter("corners.u0v0", &P::corner_u0v0, {.doc = "free, hinged, or held axes such as \"z\""})
        .parameter("corners.u1v0", &P::corner_u1v0, {.doc = "free, hinged, or held axes such as \"z\""})
        .parameter("corners.u0v1", &P::corner_u0v1, {.doc = "free, hinged, or held axes such as \"z\""})
        .parameter("corners.u1v1", &P::corner_u1v1, {.doc = "free, hinged, or held axes such as \"z\""})
        .parameter("edge_moment.u0", &P::moment_u0,
                   {.unit = "N m/m", .doc = "turns the edge towards the normal and follows it"})
        .parameter("edge_moment.u1", &P::moment_u1,
                   {.unit = "N m/m", .doc = "turns the edge towards the normal and follows it"})
        .parameter("edge_moment.v0", &P::moment_v0,
                   {.unit = "N m/m", .doc = "turns the edge towards the normal and follows it"})
        .parameter("edge_moment.v1", &P::moment_v1,
                   {.unit = "N m/m", .doc = "turns the edge towards the normal and follows it"})
        .parameter("edge_force.u0", &P::force_u0, {.unit = "N/m", .doc = "dead, by reference length"})
        .parameter("edge_force.u1", &P::force_u1, {.unit = "N/m", .doc = "dead, by reference length"})
        .parameter("edge_force.v0", &P::force_v0, {.unit = "N/m", .doc = "dead, by reference length"})
        .parameter("edge_force.v1", &P::force_v1, {.unit = "N/m", .doc = "dead, by reference length"})
        .parameter("edge_pressure.u0", &P::pressure_u0, {.unit = "N/m", .doc = "dead, into the plate"})
        .parameter("edge_pressure.u1", &P::pressure_u1, {.unit = "N/m", .doc = "dead, into the plate"})
        .parameter("edge_pressure.v0", &P::pressure_v0, {.unit = "N/m", .doc = "dead, into the plate"})
        .parameter("edge_pressure.v1", &P::pressure_v1, {.unit = "N/m", .doc = "dead, into the plate"}))
