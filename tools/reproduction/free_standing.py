"""The free-standing body on a moving base: Zhang, Wang, Chin. J. Theor. Appl. Mech. 49(6), 1370 (2017).

The available print lost its Table 1 and most formulas, so geometry, damping and starts are partly inferred or chosen
(scenes/free_standing/model.json says which). Lengths are therefore not those of the paper's figures; what happens is.
"""
import numpy as np

from claims import Claim, Verdict, yes_if
from figures import Curve, Figure, Panel
from studies import case, significant as s

TITLE = "A free-standing body on a moving base: the paper's figures and claims"
CASES = {"1a": "e = -0.915 m", "1s": "e = 0", "2a": "e = -3.673 m", "2s": "e = 0", "3v": "Y0 = 0.9 m", "3h": "Y0 = 0"}


DROP = case("figure_5")
CASE = {name: case("figure_6_9_11", scene=name, integrator="", integrator__step__tolerance="") for name in CASES}
FINE = {name: case("figure_6_9_11", scene=name, integrator__step__tolerance=1e-11) for name in CASES}
OTHER = {name: case("figure_6_9_11", scene=name, integrator={"type": "dormand_prince", "step": {"tolerance": 1e-10}}) for name in ("2a", "3h")}
CLOSE = case("figure_7_8_10", scene="1a")
CLOSE_2 = {name: case("figure_7_8_10", scene=name) for name in ("2a", "2s")}
DROPS = {h: case("steps_of_the_drop", parameters__h=h) for h in (1e-5, 1e-6, 1e-7)}
SCHEME = {h: case("cost", parameters__h=h) for h in (1e-5, 1e-6)}
EVENTS = {(method, tol): case("cost", integrator__type=method, integrator__step__tolerance=tol)
          for method, tols in (("dormand_prince", (1e-6, 1e-7)), ("dop853", (1e-6, 1e-8, 1e-9, 1e-10))) for tol in tols}
BEST = case("cost", integrator__step__tolerance=1e-12)


# What is read off a run -----------------------------------------------------------------------------------------------------

def at(result, t, column="x_xd"):
    return result[column][np.argmin(abs(result.t - t))]


def drift(result, period):
    """Over the last period."""
    return at(result, result.t[-1]) - at(result, result.t[-1] - period)


def feet(result):
    return result["y"] - result["y"][0] + 0.4


def error(result, best):
    """The largest difference at the times of both."""
    return max(abs(at(result, t) - at(best, t)) for t in np.arange(0, 10.05, 0.1))


def kinds(result, *names):
    return sum(kind in names for _, kind, _ in result.events)


# Figures --------------------------------------------------------------------------------------------------------------------

def x_xd(figure, title, cases):
    return Figure(f"figure_{figure}", title, [Panel("x_xd", "", "x_xd [m]", [Curve(CASES[c], CASE[c], "x_xd") for c in cases])])


def both_feet(panel, title, unit, column, source):
    return Panel(panel, title, unit, [Curve(f"{side} foot", source, f"{side}_{column}") for side in ("left", "right")])


FIGURES = [
    Figure("figure_5", "Figure 5: the drop, height of the feet", [Panel("y", "", "y [m]", [Curve("y1", DROP, feet)])]),
    x_xd(6, "Figure 6: horizontal base", ["1a", "1s"]),
    Figure("figure_7", "Figure 7: slip velocities, e = -0.915 m", [both_feet("slip", "", "slip velocity [m/s]", "slip", CLOSE)]),
    Figure("figure_8", "Figure 8: contact forces, e = -0.915 m", [
        both_feet("normal", "normal", "F_N [N]", "force", CLOSE), both_feet("friction", "friction", "F_f [N]", "friction", CLOSE)]),
    x_xd(9, "Figure 9: vertical base", ["2a", "2s"]),
    Figure("figure_10", "Figure 10: normal forces on the vertical base", [
        both_feet(name, CASES[name], "F_N [N]", "force", CLOSE_2[name]) for name in ("2a", "2s")]),
    x_xd(11, "Figure 11: both directions", ["3v", "3h"]),
]


# Tables ---------------------------------------------------------------------------------------------------------------------

def displacements(results):
    rows = [["case", "t [s]", "x_xd [m]", "with a hundredth of the tolerance", "by dormand_prince"]]
    for name in CASES:
        end = round(results[CASE[name]].t[-1])
        for t in [1, 2, 3] if end == 3 else [2, 6, 10, end]:
            rows.append([name, t, f"{at(results[CASE[name]], t):.10f}", f"{at(results[FINE[name]], t):.10f}",
                         f"{at(results[OTHER[name]], t):.10f}" if name in OTHER else ""])
    return rows


def costs(results):
    rows = [["method", "steps", "evaluations of f", "CPU [s]", "largest error of x_xd to 10 s [m]"]]
    best = results[BEST]
    runs = [(f"paper's scheme, h = {s(h)} s", SCHEME[h]) for h in SCHEME] + [
        (f"events, {method}, tolerance {s(tol)}", which) for (method, tol), which in EVENTS.items()]
    for name, which in runs:
        r = results[which]
        rows.append([name, r.counts["steps"], r.counts["residual_evaluations"], s(r.cpu), s(error(r, best), 2)])
    return rows


TABLES = [
    ("displacements", "Displacements, and the digits that hold", [*CASE.values(), *FINE.values(), *OTHER.values()], displacements),
    ("cost", "Case 1a over 10 s: cost against error", [*SCHEME.values(), *EVENTS.values(), BEST], costs),
]


# Claims ---------------------------------------------------------------------------------------------------------------------

def rebounds(results):
    r = results[DROP]
    height = feet(r)
    tops = [max(height[(r.t > 0.2869 + 0.573867945 * k) & (r.t < 0.8594 + 0.573867945 * k)]) for k in range(4)]
    equal = sum(abs(top - 0.4) < 1e-5 for top in tops)
    return Verdict("tops " + ", ".join(f"{top:.6f}" for top in tops) + " m",
                   "yes" if equal == len(tops) else "partly" if equal >= 2 else "no")


def steps_coincide(results):
    cut = [f"h = {s(h)}: {s(results[which].t[-1])} s" for h, which in DROPS.items() if not results[which].done]
    if cut:
        return Verdict("stopped early: " + ", ".join(cut), "not judged")
    coarse, *fine = (results[which]["y"] for which in DROPS.values())
    between = [max(abs(a - b)) for a, b in zip([coarse, *fine], fine)]
    until = results[DROPS[1e-6]].t[-1]
    return yes_if(between[-1] < 1e-6, f"largest difference of y to {s(until)} s: h = 1e-5 to 1e-6 {s(between[0], 2)} m, 1e-6 to 1e-7 {s(between[1], 2)} m")


def switching(results):
    r = results[CLOSE]
    n = kinds(r, "slip", "stick", "reversal")
    slips = [abs(float(detail.get("friction", "nan"))) for _, kind, detail in r.events if kind == "slip"]
    return yes_if(n > 20 and kinds(r, "stick") > 5, f"{n} changes between stick and slip in 4 s, {len(slips)} of them releases")


def horizontal(results):
    symmetric, other = drift(results[CASE["1s"]], 2), drift(results[CASE["1a"]], 2)
    return yes_if(abs(symmetric) < 1e-9 < 1e-3 < other, f"drift a period: e = 0 {s(symmetric, 1)} m, e = -0.915 m {other:.10f} m")


def vertical(results):
    symmetric, other = max(abs(results[CASE["2s"]]["x_xd"])), at(results[CASE["2a"]], 3)
    return yes_if(symmetric < 1e-8 < 1e-6 < abs(other), f"e = 0: |x_xd| at most {s(symmetric, 1)} m; e = -3.673 m: {other:.6g} m at 3 s")


def both(results):
    with_vertical, without = drift(results[CASE["3v"]], 4), drift(results[CASE["3h"]], 4)
    return yes_if(abs(with_vertical) > 0.1, f"drift per 4 s: Y0 = 0.9 m {with_vertical:.6f} m, Y0 = 0 {s(without, 2)} m")


def price(results):
    scheme, best = results[SCHEME[1e-6]], results[BEST]
    good = [results[r] for r in EVENTS.values() if error(results[r], best) < 1e-6]
    if not good:
        return Verdict("no event-driven run is within 1e-6 m", "yes")
    cheapest = min(good, key=lambda r: r.counts["residual_evaluations"])
    needless = cheapest.counts["residual_evaluations"] < scheme.counts["residual_evaluations"]
    return Verdict(f"h = 1e-6: {scheme.counts['steps']} steps, {scheme.counts['residual_evaluations']} evaluations, {s(scheme.cpu)} s, error "
                   f"{s(error(scheme, best), 2)} m; event-driven to 1e-6 m: {cheapest.counts['steps']} steps, "
                   f"{cheapest.counts['residual_evaluations']} evaluations, {s(cheapest.cpu)} s, {s(scheme.cpu / cheapest.cpu)} times less",
                   "no" if needless else "yes")


CLAIMS = [
    Claim("the drop rebounds to equal heights", "equal", "A flat elastic landing is unstable in tilt, but only round-off feeds "
          "it, and four rebounds are too few for that.", [DROP], rebounds),
    Claim("results with h = 1e-6 and 1e-7 coincide", "coincide", "Touch-down is located; else the force law's kink lowers the order.",
          list(DROPS.values()), steps_coincide),
    Claim("stick and slip show at once in slip velocity and forces", "visible", "Release drops the force from its static to its kinetic bound.", [CLOSE], switching),
    Claim("horizontal base: a symmetric body is periodic, an unsymmetric one drifts", "so", "One-sided rocking unloads one foot in each "
          "period.", [CASE["1a"], CASE["1s"]], horizontal),
    Claim("vertical base: a symmetric body stays, an unsymmetric one moves sideways", "so", "The feet strike unequally, so the legs' reactions "
          "have a sum.", [CASE["2a"], CASE["2s"]], vertical),
    Claim("both: a symmetric body drifts", "so", "Phase of hopping and shaking.", [CASE["3v"], CASE["3h"]], both),
    Claim("steps of 1e-6 s are needed", "h = 1e-6", "They pay for events that a fixed step does not locate.",
          [SCHEME[1e-6], *EVENTS.values(), BEST], price, expected="no"),
]
