"""Correction of constraint violations on deployable trusses: Chen Xiangyang, Chinese J. Comput. Mech. 19(1), 2002, 74-77.

Half of the paper is readable and its example is not available: the claims are those of its method, on the oscillating mast S1o with
256 steps a period, whose exact model has one degree of freedom (tests/data/truss.json).
"""
import numpy as np

from claims import Claim, yes_if
from figures import Curve, Figure, Panel
from studies import case, significant as s

TITLE = "Correction of constraint violations on a deployable truss: the method's claims"
PERIOD = 2.9309086090986798543  # [s] exact
ENERGY = 5.74525524592173  # [J] exact, constant
QUARTER = (1.02627295792400999, -0.57313956374184361)  # theta and its rate a quarter of a period after the start, exact
STEPS = 100_000
LOCK = 1.80970780453337934  # [s] exact, of the mast S1c


def corrected(position="", velocity="", energy=False):
    given = {"position": position, "velocity": velocity, "energy": energy}
    return {level: how for level, how in given.items() if how}


def mast(**levels):
    return case("corrections", corrections=corrected(**levels), integrator__delta="")


def baumgarte(constant):
    return case("corrections", integrator__delta=constant)


NORM, MASS, TURN = "minimum_norm", "mass_weighted", "null_space_rotation"
METHODS = {
    "no correction": mast(),
    "Baumgarte, 1/s": baumgarte(1),
    "Baumgarte, 20/s": baumgarte(20),
    "energy alone": mast(energy=True),
    "coordinates": mast(position=NORM),
    "velocities": mast(velocity=NORM),
    "coordinates, velocities": mast(position=NORM, velocity=NORM),
    "the same, weighted by mass": mast(position=MASS, velocity=MASS),
    "the same, by rotation": mast(position=NORM, velocity=TURN),
    "coordinates, velocities, energy": mast(position=NORM, velocity=NORM, energy=True),
    "the same, weighted by mass, energy": mast(position=MASS, velocity=MASS, energy=True),
    "the same, by rotation, energy": mast(position=NORM, velocity=TURN, energy=True),
}
LOCKS = {(energy, h): case("lock", corrections=corrected(NORM, NORM, energy), integrator__step=h)
         for energy in (False, True) for h in (16e-3, 8e-3, 4e-3)}


# What is read off a run -----------------------------------------------------------------------------------------------------

def violation(level):
    return lambda result: np.maximum(result[f"constraint_{level}"], 1e-17)


def energy_error(result):
    """Where something moves: at a turning point there is no kinetic energy to correct."""
    moves = result["energy_kinetic"] > 0.05 * ENERGY
    return np.where(moves, np.maximum(abs(result["energy_total"] - ENERGY), 1e-17), np.nan)


def largest(result, values):
    return float(np.nanmax(values(result)))


def phase_error(result):
    """[s] at the last row a quarter of a period off a turning point."""
    phase = np.mod(result.t / PERIOD, 1)
    last = np.flatnonzero(abs(phase - 0.25) < 1e-6)[-1]
    return (result["theta"][last] - QUARTER[0]) / QUARTER[1]


def growth(result, values):
    """Exponent of t, from the first tenth of the run to its end."""
    y = values(result)
    tenth = result.t < result.t[-1] / 10
    return float(np.log10(np.nanmax(y) / np.nanmax(np.where(tenth, y, np.nan))))


def lock_error(result):
    return abs(next(t for t, kind, _ in result.events if kind == "latch") - LOCK)


# Figures --------------------------------------------------------------------------------------------------------------------

def panel(name, title, ylabel, values):
    return Panel(name, title, ylabel, [Curve(label, METHODS[label], values) for label in METHODS], log=True, log_t=True)


FIGURES = [Figure("violations", f"Oscillating mast, Runge-Kutta 4, {STEPS} steps of 1/256 of a period", [
    panel("positions", "rows", "norm of g [m]", violation("position")),
    panel("velocities", "rates of the rows", "norm of G v [m/s]", violation("velocity")),
    panel("energy", "energy", "error [J]", energy_error),
], size=(5.2, 4.6))]


# Tables ---------------------------------------------------------------------------------------------------------------------

def methods_table(results):
    rows = [["correction", "largest g [m]", "largest G v [m/s]", "largest energy error [J]", "its growth", "phase error [s]", "CPU [s]"]]
    for label, which in METHODS.items():
        r = results[which]
        if not r.done:
            rows.append([label, *["breaks down"] * 5, s(r.cpu)])
            continue
        rows.append([label, s(largest(r, violation("position"))), s(largest(r, violation("velocity"))), s(largest(r, energy_error)),
                     f"t^{growth(r, energy_error):.1f}", s(phase_error(r)), s(r.cpu)])
    return rows


def lock_table(results):
    rows = [["step [ms]", "coordinates, velocities", "and energy"]]
    for h in (16e-3, 8e-3, 4e-3):
        rows.append([f"{h * 1e3:g}", *(s(lock_error(results[LOCKS[c, h]])) + " s" for c in (False, True))])
    return rows


TABLES = [
    ("methods", f"Corrections on the oscillating mast, {STEPS} steps", list(METHODS.values()), methods_table),
    ("lock", "Error of the time at which the mast S1c locks", list(LOCKS.values()), lock_table),
]


# Claims ---------------------------------------------------------------------------------------------------------------------

def claim(text, paper, why, labels, judge):
    runs = [METHODS[label] for label in labels]
    return Claim(text, paper, why, runs, lambda results: judge(*(results[r] for r in runs)))


BOTH, ALL = "coordinates, velocities", "coordinates, velocities, energy"
CLAIMS = [
    claim("Without correction violations grow without bound", "its motive", "constant error a step in the rates of the rows: G v grows "
          "with t, g and the energy with its square", ["no correction"],
          lambda r: yes_if(growth(r, violation("position")) > 1.5, f"g to {s(largest(r, violation('position')))} m, as "
                           f"t^{growth(r, violation('position')):.2f}")),
    claim("Correcting coordinates and velocities removes violations", "eq. 15 to 18", "Newton's method on the rows, a projection of "
          "the velocities at the corrected coordinates", [BOTH],
          lambda r: yes_if(max(largest(r, violation("position")), largest(r, violation("velocity"))) < 1e-14,
                           f"g {s(largest(r, violation('position')))} m, G v {s(largest(r, violation('velocity')))} m/s")),
    claim("Correcting coordinates alone does not", "section 3", "velocities go on to drift", ["coordinates"],
          lambda r: yes_if(largest(r, violation("velocity")) > 1e-8, f"G v {s(largest(r, violation('velocity')))} m/s")),
    claim("Energy still drifts with corrected coordinates and velocities", "section 4", "in proportion to t, by the method's error",
          [BOTH], lambda r: yes_if(largest(r, energy_error) > 1e-6, f"{s(largest(r, energy_error))} J, as t^{growth(r, energy_error):.2f}")),
    claim("The correction of energy keeps it to round-off", "eq. 8", "velocities scaled within the null space of the rows; it waits at "
          "turning points", [ALL],
          lambda r: yes_if(largest(r, energy_error) < 1e-13 * ENERGY and largest(r, violation("velocity")) < 1e-14,
                           f"{s(largest(r, energy_error))} J, G v {s(largest(r, violation('velocity')))} m/s")),
    claim("Alone it leaves violations as they were", "not in the paper", "what v moves the rows by is not scaled", ["no correction", "energy alone"],
          lambda none, energy: yes_if(largest(energy, energy_error) < 1e-13 * ENERGY
                                      and abs(largest(energy, violation("position")) / largest(none, violation("position")) - 1) < 0.1,
                                      f"{s(largest(energy, energy_error))} J, g {s(largest(energy, violation('position')))} m")),
    claim("It lowers the error of the phase", "section 4", "the period depends on the energy", [BOTH, ALL],
          lambda one, other: yes_if(abs(phase_error(other)) < 0.2 * abs(phase_error(one)),
                                    f"{s(phase_error(other))} s against {s(phase_error(one))} s")),
    claim("Baumgarte's stabilisation bounds violations but does not remove them", "its motive", "they settle where damping balances the "
          "error of a step; larger constants are worse", ["Baumgarte, 1/s", "Baumgarte, 20/s"],
          lambda soft, hard: yes_if(abs(growth(soft, violation("position"))) < 0.3 and largest(hard, violation("position")) > 1e-12,
                                    f"g {s(largest(soft, violation('position')))} and {s(largest(hard, violation('position')))} m")),
    Claim("The lock is found with the method's fourth order", "not in the paper", "events are located by repeating the step",
          list(LOCKS.values()), lambda results: yes_if(
              all(abs(np.log2(lock_error(results[LOCKS[False, a]]) / lock_error(results[LOCKS[False, b]])) - 4) < 0.2
                  for a, b in ((16e-3, 8e-3), (8e-3, 4e-3))),
              ", ".join(s(lock_error(results[LOCKS[False, h]])) + " s" for h in (16e-3, 8e-3, 4e-3)))),
]
