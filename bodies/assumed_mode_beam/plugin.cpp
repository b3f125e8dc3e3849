#include <trammel/plugin.hpp>

#include "beam.hpp"

using trammel::beam::AssumedModeBeam;
using trammel::beam::Coupling;

TRAMMEL_PLUGIN(
    trammel::body<AssumedModeBeam>("assumed_mode_beam",
                                   "planar Euler-Bernoulli beam by axial and transverse modes, for small slopes")
        .source("Guo, Zhang, Chen 2017, Acta Physica Sinica 66, 164501, eqs (1)-(4)")
        .markers("root, tip, and those of \"markers\"")
        .observables(
            "angle, angular_velocity, tip_axial, tip_transverse, axial_1 ..., transverse_1 ...: modal coordinates; "
            "axial_rate_1 ..., transverse_rate_1 ...: their rates")
        .parameter("length", &AssumedModeBeam::length, {.unit = "m", .min = 0, .above_min = true, .required = true})
        .parameter("area", &AssumedModeBeam::area,
                   {.unit = "m^2", .min = 0, .above_min = true, .required = true, .doc = "of the cross section"})
        .parameter("second_moment", &AssumedModeBeam::second_moment,
                   {.unit = "m^4", .min = 0, .above_min = true, .required = true, .doc = "of the cross section"})
        .parameter("density", &AssumedModeBeam::density,
                   {.unit = "kg/m^3", .min = 0, .above_min = true, .required = true})
        .parameter("youngs_modulus", &AssumedModeBeam::youngs_modulus,
                   {.unit = "Pa", .min = 0, .above_min = true, .required = true})
        .parameter("modes.axial", &AssumedModeBeam::axial_modes,
                   {.min = 0, .max = trammel::beam::most_modes, .doc = "number of axial modes"})
        .parameter("modes.transverse", &AssumedModeBeam::transverse_modes,
                   {.min = 0, .max = trammel::beam::most_modes, .doc = "number of transverse modes"})
        .parameter("modes.static_axial", &AssumedModeBeam::static_axial,
                   {.doc = "one axial function more, for a tip that is held or pulled along the beam"})
        .parameter("modes.static_transverse", &AssumedModeBeam::static_transverse,
                   {.doc = "two transverse functions more, for a tip that is held, turned or loaded across the beam"})
        .choice(
            "coupling", &AssumedModeBeam::coupling,
            {{"none", Coupling::none}, {"linear", Coupling::linear}, {"full", Coupling::full}},
            {.doc = "full: with foreshortening, within 1 % up to slopes of 0.086; linear: without, up to 0.025; none: "
                    "as linear, with the inertia of the undeformed beam"})
        .parameter("mount.hinge", &AssumedModeBeam::hinge, {.unit = "m", .doc = "the root turns about this point"})
        .parameter("mount.clamped", &AssumedModeBeam::clamped,
                   {.unit = "m", .doc = "the root is fixed here, at `angle`"})
        .parameter("mount.free", &AssumedModeBeam::free, {.unit = "m", .doc = "the root starts here and moves freely"})
        .parameter("angle", &AssumedModeBeam::angle, {.unit = "rad", .doc = "of the beam's axis at the start"})
        .parameter("angular_velocity", &AssumedModeBeam::angular_velocity, {.unit = "rad/s"})
        .parameter("velocity", &AssumedModeBeam::velocity, {.unit = "m/s", .doc = "of the root, mount free"})
        .parameter("hub_inertia", &AssumedModeBeam::hub_inertia, {.unit = "kg m^2", .min = 0})
        .parameter("hub_radius", &AssumedModeBeam::hub_radius, {.unit = "m", .min = 0, .doc = "the beam starts here"})
        .parameter("torque", &AssumedModeBeam::torque, {.unit = "N m", .doc = "drive on the hub, may depend on t"})
        .parameter("markers", &AssumedModeBeam::extra_markers,
                   {.unit = "m", .doc = "named points at x beside root, tip"})
        .parameter("initial.axial", &AssumedModeBeam::axial, {.unit = "m", .doc = "amplitudes A at the start"})
        .parameter("initial.transverse", &AssumedModeBeam::transverse,
                   {.unit = "m", .doc = "amplitudes B at the start"})
        .parameter("initial.axial_rate", &AssumedModeBeam::axial_rate, {.unit = "m/s"})
        .parameter("initial.transverse_rate", &AssumedModeBeam::transverse_rate, {.unit = "m/s"}))
