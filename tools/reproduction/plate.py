"""A T-spline plate that refines where it is struck: Wang, Cui, Yu, Lan, Lu, Chin. J. Theor. Appl. Mech. 53(8), 2021.

The available print lost its formulas and the numbers of its tables; data of the pendulum and the ball are chosen (their scenes
say so), so that the curves' times are the paper's and their values need not be. Figures 6, 8 and 12 are taken as the set-ups.
"""
import dataclasses

import numpy as np

from claims import Claim, Verdict, yes_if
from figures import Bars, Curve, Figure, Lines, Panel
from pictures import Colour, Map, Surface
from studies import case, significant as s

TITLE = "A T-spline plate with local refinement: the paper's figures and claims"
TIP = (0.005486869656, 0.000007887090)  # of the continuous shell at the full moment [m]
QUARTERS = [0.25, 0.5, 0.75, 1]  # of the load
ROLLUP = {n: case("figure_5", parameters__elements=n, static__steps="") for n in (16, 32, 64)}
ROLLUP_STEPS = {n: case("figure_5", static__steps=n) for n in (1, 4, 20)}
RING_REFINED = case("figure_7_table_1", bodies__ring__mesh__cross="")
RING = {"T-spline, 28 elements": RING_REFINED,
        **{mesh: case("figure_7_table_1", parameters__mesh=mesh, bodies__ring__mesh__cross=[]) for mesh in ("4x4", "8x8")}}
RING_EXACT = {"inside": 70e6 / 3, "outside": 20e6 / 3}  # von Mises stress of Lame's solution [Pa]
SWINGS = [k / 10 for k in range(11)]  # [s]
PENDULUM = {mesh: case("figure_9_10_11", parameters__mesh=mesh, parameters__hinge="") for mesh in ("2x2", "4x4", "8x8")}
CORNER = {mesh: case("figure_9_10_11", parameters__mesh=mesh, parameters__hinge="corner") for mesh in ("4x4", "8x8")}
STRUCK = 0.22  # [s] just after the first contact
ALONE = {"figure_13_to_17"}  # its cases' times are compared
BALL = {mesh: case("figure_13_to_17", parameters__mesh=mesh) for mesh in ("10x10", "refined", "14x14")}
LIGHT = {mesh: case("light_ball", parameters__mesh=mesh) for mesh in ("10x10", "refined", "14x14")}
STRESS_TIMES = [0.18, 0.218, 0.548, 1]  # [s]
BALL_STRESSES = case("figure_18")


# What is read off a run -----------------------------------------------------------------------------------------------------

def at(result, t, column):
    return result[column][np.argmin(abs(result.t - t))]


def tip_error(result):
    return float(np.hypot(result["tip_x"][-1] - TIP[0], result["tip_z"][-1] - TIP[1]))


def first(result, kind):
    return next((t for t, name, _ in result.events if name == kind), float("nan"))


def apart(one, other, column, until):
    t = np.arange(0, until, 0.002)
    return max(abs(at(one, x, column) - at(other, x, column)) for x in t)


def energy_error(result):
    """Of the total, against the largest kinetic energy."""
    return max(abs(result["energy_total"] - result["energy_total"][0])) / max(result["energy_kinetic"])


# Figures --------------------------------------------------------------------------------------------------------------------

def by_mesh(figure, title, runs, column, unit):
    return Figure(f"figure_{figure}", title, [Panel(column, "", unit, [Curve(mesh, runs[mesh], column) for mesh in runs])], size=(7, 3.6))


def strip(results):
    """The middle line at quarters of the moment, and the arc that the continuous shell takes: EI l^2 theta' = M, EA (l^2 - 1)/2 =
    -EI theta'^2 with the stretch l."""
    length, thickness, bending = 12, 0.1, 100.0
    for part in QUARTERS:
        fields = results[ROLLUP[16]].fields(part)
        middle = fields.points[:, 2].reshape(-1, 3)
        yield f"{part:g} of the moment", middle[:, 0], middle[:, 2], "-"
    for part in QUARTERS:
        stretch = 1
        for _ in range(20):
            turn = part * 2 * np.pi * bending / length / (bending * stretch**2)  # theta' [rad/m]
            stretch = np.sqrt(1 - thickness**2 / 6 * turn**2)
        s = np.linspace(0, length, 25)
        label = "continuous shell" if part == QUARTERS[-1] else "_"
        yield label, stretch / turn * np.sin(turn * s), stretch / turn * (1 - np.cos(turn * s)), "k."


def exact_von_mises(fields):
    """Lame's, at the undeformed radius [Pa]: P/(K^2 - 1) sqrt(1 + 3 R2^4/r^4)."""
    r = np.hypot(fields.points[..., 0], fields.points[..., 1])
    return 10e6 / 3 * np.sqrt(1 + 3 * 16 / r**4)


def along_the_radius(results):
    fields = results[RING_REFINED].fields(1)
    r = np.hypot(fields.points[..., 0], fields.points[..., 1]).ravel()
    order = np.argsort(r)
    yield "Lame", r[order], exact_von_mises(fields).ravel()[order] / 1e6, "k-"
    yield "T-spline, all points", r, fields.values["von_mises_middle"].ravel() / 1e6, "."


MIDDLE = Colour("von_mises_middle", "von Mises stress, mid-surface [MPa]", 1e-6)
RING_ERROR = Colour(lambda fields: fields.values["von_mises_middle"] / exact_von_mises(fields) - 1, "error of the stress [per mille]", 1e3)
SHEET_BOX = ((-0.32, 0, -0.32), (0.32, 0.3, 0.06))
PLATE_BOX = ((0, 0, -0.15), (2, 2, 0.05))


def mesh_title(result):
    return f"{len(result.fields(0).points)} elements"


def struck_mesh(mesh):
    def title(result):
        sizes = {size["t"]: size["nq"] for size in result.info["sizes"]}
        elements = len(result.fields(STRUCK).points)
        return f"{mesh}: {elements} elements, {sizes[max(sizes)] - 3} coordinates"  # 3 of the ball
    return Map(mesh.replace("x", "_"), title, BALL[mesh], STRUCK)


def side_view(results):
    """Of the ball over the plate at rest, through the centre."""
    fields = results[BALL["10x10"]].fields(0)
    low, high = fields.points.min(axis=(0, 1, 2)), fields.points.max(axis=(0, 1, 2))
    thickness, clearance, radius = 0.1, 0.12, 0.2
    angle = np.linspace(0, 2 * np.pi, 73)
    x = np.array([low[0], high[0], high[0], low[0], low[0]])
    yield "plate, clamped all around", x, thickness / 2 * np.array([-1, -1, 1, 1, -1]), "k-"
    yield ("ball, 50 kg, let go with the plate at t = 0", (low[0] + high[0]) / 2 + radius * np.cos(angle),
           thickness / 2 + clearance + radius * (1 + np.sin(angle)), "-")


def sheet(t):
    colour = Colour("von_mises_top", "von Mises, top face [kPa]", 1e-3, times=SWINGS, bar=SWINGS.index(t) % 3 == 2)
    return Surface(f"at_{t:g}", f"t = {t:g} s", PENDULUM["8x8"], t, colour, SHEET_BOX)


def stressed_plate(t):
    def title(result):
        return f"t = {t:g} s, {len(result.fields(t).points)} elements, centre at {1e3 * at(result, t, 'centre_z'):.0f} mm"
    colour = Colour("von_mises_top", "von Mises, top face [kPa]", 1e-3)
    return [Surface(f"shape_{t:g}", title, BALL_STRESSES, t, dataclasses.replace(colour, bar=False), PLATE_BOX, 4),
            Map(f"map_{t:g}", f"t = {t:g} s", BALL_STRESSES, t, colour)]


def computing_times(results):
    of = {mesh: results[which].cpu for mesh, which in BALL.items()}
    for mesh, time in of.items():
        yield mesh, time / of["14x14"], f"{time / of['14x14']:.2f}  ({time:.1f} s)"


FIGURES = [
    Figure("figure_5", "Figure 5: a strip is rolled up by a moment at its end", [
        Lines("shape", "middle line, 16 elements", "x [m]", "z [m]", [ROLLUP[16]], strip, equal=True),
        *(Panel(f"tip_{axis}", f"tip, {axis}", f"{axis} [m]", [Curve(f"{n} elements", ROLLUP[n], f"tip_{axis}") for n in ROLLUP],
                xlabel="part of the full moment", style=".-") for axis in "xz")], size=(4.6, 4)),
    Figure("figure_6", "Set-up of example 4.2: a quarter ring under pressure at its inner edge", [
        Map("mesh", mesh_title, RING_REFINED, 1, notes=((0.45, 0.45, "10 MPa", -45), (1.5, -0.1, "y held", 0), (-0.1, 1.5, "x held", 90)))],
        size=(6, 4.6)),
    Figure("figure_7", "Figure 7: the ring under inner pressure, T-mesh of 28 elements", [
        Map("stress", "von Mises stress", RING_REFINED, 1, MIDDLE), Map("error", "against Lame's solution", RING_REFINED, 1, RING_ERROR),
        Lines("radius", "over the radius", "r [m]", "von Mises stress [MPa]", [RING_REFINED], along_the_radius)], size=(4.6, 3.6)),
    Figure("figure_8", "Set-up of example 4.3: a sheet of 0.3 m x 0.3 m x 0.01 m, let go from the horizontal", [
        Map(f"mesh_{mesh}", mesh_title, PENDULUM[mesh], 0, notes=((-0.015, 0.15, "hinged edge", 90), (0.285, 0.315, "corner C", 0)))
        for mesh in PENDULUM], size=(4.2, 4)),
    Figure("figure_9", "Figure 9: energies of the sheet pendulum, 8x8", [
        Panel("energy", "", "energy [J]", [Curve(e, PENDULUM["8x8"], f"energy_{e}") for e in ("kinetic", "potential", "elastic", "total")])],
        size=(7, 3.6)),
    by_mesh(10, "Figure 10: free corner of the sheet pendulum by mesh", PENDULUM, "corner_z", "z [m]"),
    Figure("figure_11", "Figure 11: the sheet pendulum, 8x8, hinged along x = 0", [sheet(t) for t in SWINGS[:9]], size=(4.2, 3.2)),
    Figure("figure_12", "Set-up of example 4.4: a ball over a clamped plate of 2 m x 2 m x 0.1 m", [
        Lines("side", "", "x [m]", "z [m]", [BALL["10x10"]], side_view, equal=True)], size=(7, 3.2)),
    Figure("figure_13", f"Figure 13: the three meshes just after the ball has struck, t = {STRUCK} s", [struck_mesh(mesh) for mesh in BALL], size=(3.8, 3.8)),
    by_mesh(14, "Figure 14: the ball by mesh", BALL, "ball_z", "displacement [m]"),
    by_mesh(15, "Figure 15: the plate's centre by mesh", BALL, "centre_z", "displacement [m]"),
    by_mesh(16, "Figure 16: elastic energy of the plate by mesh", BALL, "energy_elastic", "energy [J]"),
    Figure("figure_17", "Figure 17: computing time of 0.65 s by mesh", [
        Bars("cpu", "", "CPU time, part of that of 14x14", list(BALL.values()), computing_times)], size=(5, 3.6)),
    Figure("figure_18", "Figure 18: von Mises stress of the struck plate, mesh refined at the contact (left: heights four times as large)",
           [panel for t in STRESS_TIMES for panel in stressed_plate(t)], size=(5.2, 3.8), columns=2),
]


# Tables ---------------------------------------------------------------------------------------------------------------------

def rollup(results):
    rows = [["elements", "load steps", "iterations", "error of the tip [m]"]]
    for n, which in [*((n, ROLLUP[n]) for n in ROLLUP), *((16, ROLLUP_STEPS[k]) for k in ROLLUP_STEPS)]:
        r = results[which]
        rows.append([n, len(r.t) - 1, r.info["newton_iterations"], s(tip_error(r))])
    return rows


def ring(results):
    rows = [["mesh", "inside [MPa]", "error", "outside [MPa]", "error"]]
    for name, which in RING.items():
        r = results[which]
        row = [name]
        for side, exact in RING_EXACT.items():
            row += [f"{r[side][-1] / 1e6:.6f}", f"{100 * (r[side][-1] / exact - 1):.4f} %"]
        rows.append(row)
    return rows


def ball(results):
    rows = [["mesh", "first contact [s]", "ball at 0.3 s [m]", "ball at 0.4 s [m]", "centre at 0.4 s [m]", "CPU [s]", "of 14x14"]]
    slowest = results[BALL["14x14"]].cpu
    for mesh, which in BALL.items():
        r = results[which]
        rows.append([mesh, f"{first(r, 'contact_close'):.5f}", f"{at(r, 0.3, 'ball_z'):.5f}", f"{at(r, 0.4, 'ball_z'):.5f}",
                     f"{at(r, 0.4, 'centre_z'):.5f}", s(r.cpu), s(r.cpu / slowest)])
    return rows


def pendulum(results):
    times = [k / 10 for k in range(1, 6)]
    rows = [["hinged", "mesh", *(f"{t:g} s" for t in times)]]
    for hinge, runs in (("edge", PENDULUM), ("corner", CORNER)):
        rows += [[hinge, mesh, *(f"{at(results[which], t, 'corner_z'):.5f}" for t in times)] for mesh, which in runs.items()]
    return rows


def light_ball(results):
    times = (0.3, 0.4, 0.5, 0.59)
    return [["mesh", *(f"{t:g} s" for t in times)],
            *([mesh, *(f"{at(results[which], t, 'ball_z'):.5f}" for t in times)] for mesh, which in LIGHT.items())]


TABLES = [
    ("rollup", "Roll-up: errors against the continuous shell, and what Newton's method took", [*ROLLUP.values(), *ROLLUP_STEPS.values()], rollup),
    ("ring", "Table 1: von Mises stress of the ring, at the middle of its edges", list(RING.values()), ring),
    ("pendulum", "Sheet pendulum: z of the free corner [m]", [*PENDULUM.values(), *CORNER.values()], pendulum),
    ("ball", "Table 4 and figure 17: the ball by mesh", list(BALL.values()), ball),
    ("light_ball", "Case B, a ball of 20 kg: its displacement by mesh [m]", list(LIGHT.values()), light_ball),
]


# Claims ---------------------------------------------------------------------------------------------------------------------

def circle(results):
    r = results[ROLLUP[16]]
    return yes_if(tip_error(r) < 3e-3, f"tip {s(tip_error(r), 2)} m from the exact one with 16 elements, in {r.info['newton_iterations']} iterations")


def stresses(results):
    r = results[RING["T-spline, 28 elements"]]
    worst = max(abs(r[side][-1] / exact - 1) for side, exact in RING_EXACT.items())
    return yes_if(worst < 1e-3, f"{1e3 * worst:.2f} per mille")


def energy(results):
    worst = {mesh: energy_error(results[which]) for mesh, which in PENDULUM.items()}
    return yes_if(max(worst.values()) < 1e-4, ", ".join(f"{mesh} {s(e, 2)}" for mesh, e in worst.items()) + " of the largest kinetic energy")


def converges(results):
    coarse, fine = (apart(results[PENDULUM[a]], results[PENDULUM[b]], "corner_z", 1) for a, b in (("2x2", "4x4"), ("4x4", "8x8")))
    return yes_if(fine < 0.5 * coarse, f"largest difference to 1 s: 2x2 to 4x4 {s(coarse, 2)} m, 4x4 to 8x8 {s(fine, 2)} m")


def as_good(results):
    difference = apart(results[BALL["refined"]], results[BALL["14x14"]], "ball_z", 0.59)
    return yes_if(difference < 2e-3, f"ball trajectories differ by up to {s(difference, 2)} m until 0.59 s")


def light_as_good(results):
    early, late = (apart(results[LIGHT["refined"]], results[LIGHT["14x14"]], "ball_z", until) for until in (0.41, 0.59))
    verdict = "yes" if late < 5e-4 else "partly" if early < 5e-4 else "no"
    return Verdict(f"ball trajectories differ by up to {1e3 * early:.2f} mm until 0.4 s, {1e3 * late:.2f} mm until 0.59 s", verdict)


def cost(results):
    refined, fine, coarse = (results[BALL[m]].cpu for m in ("refined", "14x14", "10x10"))
    half, less = refined <= 0.5 * fine, refined < coarse
    return Verdict(f"{s(refined / fine)} of 14x14, {s(refined / coarse)} of 10x10", "yes" if half and less else "partly" if half or less else "no")


def momentum(results):
    r = results[BALL["refined"]]
    detail = next((d for _, kind, d in r.events if kind == "refine"), None)
    if not detail:
        return Verdict("no refinement happened", "no")
    before, after = (np.array([float(detail[f"momentum_{axis}_{side}"]) for axis in "xyz"]) for side in ("before", "after"))
    change = np.linalg.norm(after - before) / np.linalg.norm(before)
    return yes_if(change < 1e-12, f"momentum changes by {s(change, 1)} of itself")


CLAIMS = [
    Claim("a moment 2 pi E I / L rolls the strip up to a circle", "circle", "The shell stretches, so that it does not quite close.",
          [ROLLUP[16]], circle),
    Claim("stresses of the refined ring are right within 1 per mille", "1 per mille", "Stress converges faster than the mesh is "
          "refined.", list(RING.values()), stresses),
    Claim("the pendulum conserves energy", "so", "rho_inf = 1 dissipates nothing; the rest is the step's error.", list(PENDULUM.values()), energy),
    Claim("the pendulum converges with the mesh", "2x2, 4x4, 8x8", "Bending is cubic.", list(PENDULUM.values()), converges),
    Claim("the locally refined plate is as good as 14x14", "so", "The contact is local; the waves meet the coarse mesh.",
          list(BALL.values()), as_good),
    Claim("the same for a ball of 20 kg (case B), within 0.5 mm until 0.59 s", "so", "Part of the difference is of Gauss points and points of "
          "contact (scenes/plate/README.md); both meshes are farther from a very fine one.", [LIGHT["refined"], LIGHT["14x14"]], light_as_good,
          expected="partly"),
    Claim("it costs half of 14x14", "half, and less than 10x10", "Its coordinates lie between those "
          "of the two: less than 10x10 it can take by fewer steps only.", list(BALL.values()), cost, expected="no"),
    Claim("a refinement keeps the surface's motion", "so", "Old functions are combinations of new ones.", [BALL["refined"]], momentum),
]
