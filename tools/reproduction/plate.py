"""A T-spline plate that refines where it is struck: Wang, Cui, Yu, Lan, Lu, Chin. J. Theor. Appl. Mech. 53(8), 2021.

The available print lost its formulas and the numbers of its tables; data of the pendulum and the ball are chosen (their scenes
say so), so that the curves' times are the paper's and their values need not be. Figures 6, 8 and 12 are taken as the set-ups.
"""
import numpy as np

from claims import Claims
from studies import case, significant as s

TITLE = "A T-spline plate with local refinement: the paper's tables and claims"
TIP = (0.005486869656, 0.000007887090)  # of the continuous shell at the full moment [m]
ROLLUP = {(n, steps): case("figure_5", parameters__elements=n, static__steps=steps)
          for n, steps in ((16, ""), (32, ""), (64, ""), (16, 1), (16, 4), (16, 20))}
RING = {"T-spline, 28 elements": case("figure_7_table_1", bodies__ring__mesh__cross=""),
        **{mesh: case("figure_7_table_1", parameters__mesh=mesh, bodies__ring__mesh__cross=[]) for mesh in ("4x4", "8x8")}}
RING_EXACT = {"inside": 70e6 / 3, "outside": 20e6 / 3}  # von Mises stress of Lame's solution [Pa]
PENDULUM = {mesh: case("figure_9_10_11", parameters__mesh=mesh, parameters__hinge="") for mesh in ("2x2", "4x4", "8x8")}
CORNER = {mesh: case("figure_9_10_11", parameters__mesh=mesh, parameters__hinge="corner") for mesh in ("4x4", "8x8")}
ALONE = {"figure_13_to_17"}  # its cases' times are compared
BALL = {mesh: case("figure_13_to_17", parameters__mesh=mesh) for mesh in ("10x10", "refined", "14x14")}
LIGHT = {mesh: case("light_ball", parameters__mesh=mesh) for mesh in BALL}
PICTURES = [("Figure 5: the strip as it rolls up", ROLLUP[16, ""]), ("Figures 6, 7: stress of the ring", RING["T-spline, 28 elements"]),
            ("Figures 8, 11: the sheet pendulum, 8x8", PENDULUM["8x8"]), ("Figure 13: the refined mesh, struck", BALL["refined"]),
            ("Figure 18: stress of the struck plate", case("figure_18"))]

def tip_error(result):
    return float(np.hypot(result["tip_x"][-1] - TIP[0], result["tip_z"][-1] - TIP[1]))

def stress_errors(result):
    """Errors relative to Lame's solution at the middle of the inner and of the outer edge."""
    return {side: result[side][-1] / exact - 1 for side, exact in RING_EXACT.items()}

def apart(one, other, column, until):
    return max(abs(one.at(t, column) - other.at(t, column)) for t in np.arange(0, until, 0.002))

def coordinates(result):
    """The number of the plate's coordinates at the end, without the ball's 3."""
    return max(result.info["sizes"], key=lambda size: size["t"])["nq"] - 3

def rollup(results):
    yield ["elements", "load steps", "iterations", "error of the tip [m]"]
    for (n, _), which in ROLLUP.items():
        r = results[which]
        yield [n, len(r.t) - 1, r.info["newton_iterations"], s(tip_error(r))]

def ring(results):
    yield ["mesh", "inside [MPa]", "error", "outside [MPa]", "error"]
    for name, which in RING.items():
        errors = stress_errors(results[which])
        yield [name, *(text for side, e in errors.items() for text in (f"{results[which][side][-1] / 1e6:.6f}", f"{100 * e:.4f} %"))]

def over_time(runs, column, times):
    def rows(results):
        yield ["", *(f"{t:g} s" for t in times)]
        for name, which in runs.items():
            yield [name, *(f"{results[which].at(t, column):.5f}" for t in times)]
    return rows

def ball(results):
    yield ["mesh", "coordinates", "first contact [s]", "ball at 0.3 s [m]", "ball at 0.4 s [m]", "centre at 0.4 s [m]", "CPU [s]", "of 14x14"]
    for mesh, r in ((mesh, results[which]) for mesh, which in BALL.items()):
        contact = next((t for t, kind, _ in r.events if kind == "contact_close"), float("nan"))
        places = (r.at(0.3, "ball_z"), r.at(0.4, "ball_z"), r.at(0.4, "centre_z"))
        yield [mesh, coordinates(r), *(f"{x:.5f}" for x in (contact, *places)), s(r.cpu), s(r.cpu / results[BALL["14x14"]].cpu)]

SWINGS = {f"hinged at the {hinge}, {mesh}": which for hinge, runs in (("edge", PENDULUM), ("corner", CORNER)) for mesh, which in runs.items()}
TABLES = [
    ("rollup", "Roll-up: errors against the continuous shell, and what Newton's method took", rollup),
    ("ring", "Table 1: von Mises stress of the ring, at the middle of its edges", ring),
    ("pendulum", "Sheet pendulum: z of the free corner [m]", over_time(SWINGS, "corner_z", (0.1, 0.2, 0.3, 0.4, 0.5))),
    ("ball", "Table 4 and figure 17: the ball by mesh", ball),
    ("light_ball", "Case B, a ball of 20 kg: its displacement by mesh [m]", over_time(LIGHT, "ball_z", (0.3, 0.4, 0.5, 0.59))),
]

CLAIMS = Claims()

@CLAIMS("a moment 2 pi E I / L rolls the strip up to a circle", "figure 5", "circle", "The shell stretches, so that it does not quite close.")
def _(results):
    r = results[ROLLUP[16, ""]]
    # 16 cubic elements a turn: of the strip's 12 m this is what a figure cannot show.
    return tip_error(r) < 3e-3, f"tip {s(tip_error(r), 2)} m from the exact one with 16 elements, in {r.info['newton_iterations']} iterations"

@CLAIMS("stresses of the refined ring are right within 1 per mille", "table 1", "1 per mille", "Stress converges faster than the mesh is refined.")
def _(results):
    worst = max(map(abs, stress_errors(results[RING["T-spline, 28 elements"]]).values()))
    return worst < 1e-3, f"{1e3 * worst:.2f} per mille"

@CLAIMS("the pendulum conserves energy", "figure 9", "so", "rho_inf = 1 dissipates nothing; the rest is the step's error.")
def _(results):
    worst = {mesh: max(abs(r["energy_total"] - r["energy_total"][0])) / max(r["energy_kinetic"])
             for mesh, r in ((mesh, results[which]) for mesh, which in PENDULUM.items())}
    # A hundredth of what the figure shows.
    return max(worst.values()) < 1e-4, ", ".join(f"{mesh} {s(e, 2)}" for mesh, e in worst.items()) + " of the largest kinetic energy"

@CLAIMS("the pendulum converges with the mesh", "figure 10", "2x2, 4x4, 8x8", "Bending is cubic.")
def _(results):
    coarse, fine = (apart(results[PENDULUM[a]], results[PENDULUM[b]], "corner_z", 1) for a, b in (("2x2", "4x4"), ("4x4", "8x8")))
    return fine < 0.5 * coarse, f"largest difference to 1 s: 2x2 to 4x4 {s(coarse, 2)} m, 4x4 to 8x8 {s(fine, 2)} m"  # at least order 1

@CLAIMS("the locally refined plate is as good as 14x14", "figures 14 to 16", "so", "The contact is local; the waves meet the coarse mesh.")
def _(results):
    difference = apart(results[BALL["refined"]], results[BALL["14x14"]], "ball_z", 0.59)
    return difference < 2e-3, f"ball trajectories differ by up to {s(difference, 2)} m until 0.59 s"  # a line's width of an axis of 0.2 m

@CLAIMS("the same for a ball of 20 kg (case B), within 0.5 mm until 0.59 s", "example 4.4", "so", "Part of the difference is of Gauss points and "
        "points of contact (scenes/plate/README.md); both meshes are farther from a very fine one.", expected="partly")
def _(results):
    early, late = (apart(results[LIGHT["refined"]], results[LIGHT["14x14"]], "ball_z", until) for until in (0.41, 0.59))
    return ("yes" if late < 5e-4 else "partly" if early < 5e-4 else "no",
            f"ball trajectories differ by up to {1e3 * early:.2f} mm until 0.4 s, {1e3 * late:.2f} mm until 0.59 s")

@CLAIMS("it costs half of 14x14", "table 4, figure 17", "half, and less than 10x10", "Its coordinates lie between those of the two: less than 10x10 it "
        "can take by fewer steps only.", expected="no")
def _(results):
    coarse, refined, fine = (results[which] for which in BALL.values())
    half, less = refined.cpu <= 0.5 * fine.cpu, refined.cpu < coarse.cpu
    return ("yes" if half and less else "partly" if half or less else "no",
            f"{s(refined.cpu / fine.cpu)} of 14x14, {s(refined.cpu / coarse.cpu)} of 10x10; "
            f"{', '.join(f'{coordinates(r)}' for r in (coarse, refined, fine))} coordinates")

@CLAIMS("a refinement keeps the surface's motion", "text", "so", "Old functions are combinations of new ones.")
def _(results):
    detail = next((d for _, kind, d in results[BALL["refined"]].events if kind == "refine"), None)
    if not detail:
        return False, "no refinement happened"
    before, after = (np.array([float(detail[f"momentum_{axis}_{side}"]) for axis in "xyz"]) for side in ("before", "after"))
    change = np.linalg.norm(after - before) / np.linalg.norm(before)
    return change < 1e-12, f"momentum changes by {s(change, 1)} of itself"  # round-off of a sum over the elements
