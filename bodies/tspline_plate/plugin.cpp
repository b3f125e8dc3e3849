#include <trammel/plugin.hpp>

#include "tspline_plate/plate.hpp"

using P = trammel::plate::TsplinePlate;

TRAMMEL_PLUGIN(
    trammel::body<P>("tspline_plate", "thin plate or shell on rational bicubic T-splines; its mesh can refine")
        .source("Kiendl et al. 2009, CMAME 198; Wang, Cui, Yu, Lan, Lu 2021, Chin. J. Theor. Appl. Mech. 53(8)")
        .markers(
            "centre, u0v0, u1v0, u0v1, u1v1, and those of \"markers\"; of a body with named patches PATCH_centre, ...")
        .observables(
            "von_mises_top, von_mises_middle, von_mises_bottom: the largest [Pa]; energy_membrane, energy_bending "
            "[J]; elements; von_mises_top_MARKER, von_mises_middle_MARKER, von_mises_bottom_MARKER")
        .parameter("thickness", &P::thickness, {.unit = "m", .min = 0, .above_min = true, .required = true})
        .parameter("density", &P::density, {.unit = "kg/m^3", .min = 0, .above_min = true, .required = true})
        .parameter("youngs_modulus", &P::youngs_modulus, {.unit = "Pa", .min = 0, .above_min = true, .required = true})
        .parameter("poissons_ratio", &P::poissons_ratio,
                   {.min = -0.99, .max = 0.4999, .doc = "lateral over axial strain"})
        .own_part(&P::sole_patch, trammel::plate::patch_declaration())
        .parts(
            "patches", &P::named_patches, trammel::plate::patch_declaration(),
            {.doc =
                 "several instead, by name; their elements count through, their markers are \"NAME_centre\" and so on"})
        .parts("joined", &P::joined, trammel::plate::joined_declaration(),
               {.doc = "edges that meet, of two patches or of one (a tube); both must be divided alike"})
        .parameter("quadrature", &P::quadrature,
                   {.min = 2, .max = 6, .doc = "Gauss points a direction of a cell, for the stiffness"})
        .parameter("held_axes", &P::held_axes, {.doc = "axes along which nothing moves, such as \"z\""})
        .parameter("damping.mass", &P::mass_damping, {.unit = "1/s", .min = 0, .doc = "force -factor M v"})
        .parameter("damping.stiffness", &P::stiffness_damping,
                   {.unit = "s", .min = 0, .doc = "stress by strain rate (Kelvin-Voigt)"})
        .parameter("pressure", &P::pressure, {.unit = "N/m^2", .doc = "along the normal, follows it; may depend on t"})
        .parameter("load", &P::load, {.unit = "N/m^2", .doc = "dead, by reference area"})
        .parameter("load_factor", &P::load_factor,
                   {.doc = "of the dead loads (load, edge_force, edge_pressure); may depend on t"})
        .parameter("velocity", &P::velocity, {.unit = "m/s", .doc = "at the start"})
        .parameter("angular_velocity", &P::angular_velocity,
                   {.unit = "rad/s", .doc = "at the start, about geometry.origin (of the first patch)"})
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
            {.min = 1, .max = 12, .doc = "how often near or the indicator may split an element of the first mesh"}))
