"""A T-spline plate that refines where it is struck: Wang, Cui, Yu, Lan, Lu, Chin. J. Theor. Appl. Mech. 53(8), 2021.

The available print lost its formulas and the numbers of its tables; data of the pendulum and the ball are chosen (their scenes
say so), so that the curves' times are the paper's and their values need not be.
"""
import numpy as np

from claims import Claim, Verdict, yes_if
from figures import Curve, Figure, Panel
from runs import run, significant as s

TITLE = "A T-spline plate with local refinement: the paper's figures and claims"
TIP = (0.005486869656, 0.000007887090)  # of the continuous shell at the full moment [m]
ROLLUP = {n: run("plate/rollup", parameters__elements=n) for n in (16, 32, 64)}
ROLLUP_STEPS = {n: run("plate/rollup", static__steps=n) for n in (1, 4, 20)}
RING = {"T-spline, 28 elements": run("plate/ring"), "4x4": run("plate/ring", bodies__ring__mesh__cross="[]"),
        "8x8": run("plate/ring", parameters__mesh="8x8", bodies__ring__mesh__cross="[]")}
RING_EXACT = {"inside": 70e6 / 3, "outside": 20e6 / 3}  # von Mises stress of Lame's solution [Pa]
PENDULUM = {mesh: run("plate/pendulum", parameters__mesh=mesh, simulate__until=1) for mesh in ("2x2", "4x4", "8x8")}
BALL = {mesh: run("plate/ball", parameters__mesh=mesh, record__every=0.002) for mesh in ("10x10", "refined", "14x14")}


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
    return Figure(f"figure_{figure}", title, [Panel(column, "", unit, [Curve(mesh, runs[mesh], column) for mesh in runs])])


FIGURES = [
    Figure("figure_5", "Figure 5: the strip's tip while it is rolled up (t is the part of the moment)", [
        Panel(f"tip_{axis}", "", f"{axis} [m]", [Curve(f"{n} elements", ROLLUP[n], f"tip_{axis}") for n in ROLLUP]) for axis in "xz"]),
    Figure("figure_9", "Figure 9: energies of the sheet pendulum, 8x8", [
        Panel("energy", "", "energy [J]", [Curve(e, PENDULUM["8x8"], f"energy_{e}") for e in ("kinetic", "potential", "elastic", "total")])]),
    by_mesh(10, "Figure 10: free corner of the sheet pendulum", PENDULUM, "corner_z", "z [m]"),
    by_mesh(14, "Figure 14: the ball", BALL, "ball_z", "displacement [m]"),
    by_mesh(15, "Figure 15: the plate's centre", BALL, "centre_z", "displacement [m]"),
    by_mesh(16, "Figure 16: elastic energy", BALL, "energy_elastic", "energy [J]"),
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


TABLES = [
    ("rollup", "Roll-up: errors against the continuous shell, and what Newton's method took", [*ROLLUP.values(), *ROLLUP_STEPS.values()], rollup),
    ("ring", "Table 1: von Mises stress of the ring, at the middle of its edges", list(RING.values()), ring),
    ("ball", "Table 4 and figure 17: the ball by mesh", list(BALL.values()), ball),
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


def cost(results):
    refined, fine, coarse = (results[BALL[m]].cpu for m in ("refined", "14x14", "10x10"))
    return yes_if(refined < 0.55 * fine, f"{s(refined / fine)} of 14x14, {s(refined / coarse)} of 10x10")


def momentum(results):
    r = results[BALL["refined"]]
    detail = next((d for _, kind, d in r.events if kind == "refine"), None)
    if not detail:
        return Verdict("no refinement happened", "no")
    before, after = (np.array([float(detail[f"momentum_{axis}_{side}"]) for axis in "xyz"]) for side in ("before", "after"))
    change = np.linalg.norm(after - before) / np.linalg.norm(before)
    return yes_if(change < 1e-12, f"momentum changes by {s(change, 1)} of itself")


CLAIMS = [
    Claim("a moment 2 pi E I / L rolls the strip up to a circle", "circle", "The shell's own limit is 5.5 mm from closing: it stretches.",
          [ROLLUP[16]], circle),
    Claim("stresses of the refined ring are right within 1 per mille", "1 per mille", "Stress converges with h^3; plain 4x4 is 1.2 per "
          "mille off.", list(RING.values()), stresses),
    Claim("the pendulum conserves energy", "so", "rho_inf = 1 dissipates nothing; the rest is the step's error.", list(PENDULUM.values()), energy),
    Claim("the pendulum converges with the mesh", "2x2, 4x4, 8x8", "Bending is cubic.", list(PENDULUM.values()), converges),
    Claim("the locally refined plate is as good as 14x14", "so", "The contact is local; the waves meet the coarse mesh.",
          list(BALL.values()), as_good),
    Claim("it costs half of 14x14", "half, and less than 10x10", "Fewer cells and unknowns.", list(BALL.values()), cost),
    Claim("a refinement keeps the surface's motion", "so", "Old functions are combinations of new ones.", [BALL["refined"]], momentum),
]
