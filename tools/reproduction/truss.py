"""Correction of constraint violations on deployable trusses: Chen Xiangyang, Chinese J. Comput. Mech. 19(1), 2002, 74-77.

Half of the paper is readable and its example is not available: the claims are those of its method, on the oscillating mast S1o with
256 steps a period, whose exact model has one degree of freedom (tests/data/truss.json).
"""
import numpy as np

from claims import Claims
from studies import case, significant as s

TITLE = "Correction of constraint violations on a deployable truss: the method's claims"
PERIOD = 2.9309086090986798543  # [s] exact
ENERGY = 5.74525524592173  # [J] exact, constant
QUARTER = (1.02627295792400999, -0.57313956374184361)  # theta and its rate a quarter of a period after the start, exact
LOCK = 1.80970780453337934  # [s] exact, of the mast S1c
ROUND_OFF = 1e-14  # of rows in m and m/s; of the energy, relative, ten times as much: a sum over the members

def corrected(position="", velocity="", energy=False):
    return {level: how for level, how in {"position": position, "velocity": velocity, "energy": energy}.items() if how}

def mast(**levels):
    return case("corrections", corrections=corrected(**levels), integrator__delta="")

NORM, MASS, TURN = "minimum_norm", "mass_weighted", "null_space_rotation"
METHODS = {
    "no correction": mast(),
    "Baumgarte, 1/s": case("corrections", integrator__delta=1),
    "Baumgarte, 20/s": case("corrections", integrator__delta=20),
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

class Of:
    """Results of the run of one of the methods: largest violations, and the exponents of t with which they grow."""

    def __init__(self, results, label):
        self.run = r = results[METHODS[label]]
        moves = r["energy_kinetic"] > 0.05 * ENERGY  # at a turning point there is no kinetic energy to correct
        values = (r["constraint_position"], r["constraint_velocity"], np.where(moves, abs(r["energy_total"] - ENERGY), np.nan))
        self.g, self.g_dot, self.energy = (float(np.nanmax(y)) for y in values)
        self.g_grows, _, self.energy_grows = (self.growth(y) for y in values)
        last = np.flatnonzero(abs(np.mod(r.t / PERIOD, 1) - 0.25) < 1e-6)[-1]  # a quarter of a period off a turning point
        self.phase = (r["theta"][last] - QUARTER[0]) / QUARTER[1]  # [s] its error there

    def growth(self, y):
        """The exponent of t with which y grows from the first tenth of the run to its end."""
        tenth = self.run.t < self.run.t[-1] / 10
        return float(np.log10(np.nanmax(np.maximum(y, 1e-17)) / np.nanmax(np.where(tenth, np.maximum(y, 1e-17), np.nan))))

def lock_error(results, energy, h):
    return abs(next(t for t, kind, _ in results[LOCKS[energy, h]].events if kind == "latch") - LOCK)

def methods(results):
    yield ["correction", "largest g [m]", "largest G v [m/s]", "largest energy error [J]", "its growth", "phase error [s]", "CPU [s]"]
    for label, which in METHODS.items():
        if not results[which].done:
            yield [label, *["breaks down"] * 6]
            continue
        of = Of(results, label)
        yield [label, s(of.g), s(of.g_dot), s(of.energy), f"t^{of.energy_grows:.1f}", s(of.phase), s(of.run.cpu)]

def lock(results):
    yield ["step [ms]", "coordinates, velocities", "and energy"]
    for h in (16e-3, 8e-3, 4e-3):
        yield [f"{h * 1e3:g}", *(s(lock_error(results, energy, h)) + " s" for energy in (False, True))]

TABLES = [("methods", "Corrections on the oscillating mast, 100000 steps", methods),
          ("lock", "Error of the time at which the mast S1c locks", lock)]

CLAIMS = Claims()
BOTH, ALL = "coordinates, velocities", "coordinates, velocities, energy"

@CLAIMS("Without correction violations grow without bound", "its motive", "so", "constant error a step in the rates of the rows: G v grows with t, g "
        "and the energy with its square")
def _(results):
    of = Of(results, "no correction")
    return of.g_grows > 1.5, f"g to {s(of.g)} m, as t^{of.g_grows:.2f}"  # nearer to 2 than to 1

@CLAIMS("Correcting coordinates and velocities removes violations", "eq. 15 to 18", "so", "Newton's method on the rows, a projection of the velocities "
        "at the corrected coordinates")
def _(results):
    of = Of(results, BOTH)
    return max(of.g, of.g_dot) < ROUND_OFF, f"g {s(of.g)} m, G v {s(of.g_dot)} m/s"

@CLAIMS("Correcting coordinates alone does not", "section 3", "so", "velocities go on to drift")
def _(results):
    of = Of(results, "coordinates")
    return of.g_dot > 1e6 * ROUND_OFF, f"G v {s(of.g_dot)} m/s"

@CLAIMS("Energy still drifts with corrected coordinates and velocities", "section 4", "so", "in proportion to t, by the method's error")
def _(results):
    of = Of(results, BOTH)
    return of.energy > 1e6 * ROUND_OFF * ENERGY and abs(of.energy_grows - 1) < 0.3, f"{s(of.energy)} J, as t^{of.energy_grows:.2f}"

@CLAIMS("The correction of energy keeps it to round-off", "eq. 8", "so", "velocities scaled within the null space of the rows; it waits at turning "
        "points")
def _(results):
    of = Of(results, ALL)
    return of.energy < 10 * ROUND_OFF * ENERGY and of.g_dot < ROUND_OFF, f"{s(of.energy)} J, G v {s(of.g_dot)} m/s"

@CLAIMS("Alone it leaves violations as they were", "not in the paper", "", "what v moves the rows by is not scaled")
def _(results):
    none, of = Of(results, "no correction"), Of(results, "energy alone")
    return of.energy < 10 * ROUND_OFF * ENERGY and abs(of.g / none.g - 1) < 0.1, f"{s(of.energy)} J, g {s(of.g)} m against {s(none.g)} m"

@CLAIMS("It lowers the error of the phase", "section 4", "so", "the period depends on the energy")
def _(results):
    one, other = Of(results, BOTH).phase, Of(results, ALL).phase
    return abs(other) < 0.2 * abs(one), f"{s(other)} s against {s(one)} s"  # clearly: to less than a fifth

@CLAIMS("Baumgarte's stabilisation bounds violations but does not remove them", "its motive", "so", "they settle where damping balances the error of a "
        "step")
def _(results):
    soft, hard = Of(results, "Baumgarte, 1/s"), Of(results, "Baumgarte, 20/s")
    return abs(soft.g_grows) < 0.3 and hard.g > 100 * ROUND_OFF, f"g {s(soft.g)}, as t^{soft.g_grows:.2f}, and {s(hard.g)} m"

@CLAIMS("The lock is found with the method's fourth order", "not in the paper", "", "events are located by repeating the step")
def _(results):
    errors = [lock_error(results, False, h) for h in (16e-3, 8e-3, 4e-3)]
    orders = [np.log2(a / b) for a, b in zip(errors, errors[1:])]
    return max(abs(order - 4) for order in orders) < 0.2, (  # asymptotic: the next order adds a part that halves with the step
        ", ".join(s(e) + " s" for e in errors) + ", orders " + ", ".join(f"{order:.2f}" for order in orders))
