"""The flexible beam that strikes a plane: Guo, Zhang, Chen, Acta Physica Sinica 66, 164501 (2017).

The paper does not print its gravity (9.81 here), nor which panel of a figure is which; figures 6, 7, 8 are taken as the modal
shares by HHT alpha = 0, alpha = -0.15 and Baumgarte. A cluster is one visible bounce: events less than 0.03 s apart. After
the third cluster all trajectories are chaotic, so every comparison here ends at 1.15 s.
"""
import numpy as np

from beam_table_1 import ALPHAS, MODES, PAIRS, SECONDS_OF_PAPER
from claims import Claims
from studies import case, listed, significant as s

TITLE = "A flexible beam strikes a plane: the paper's tables and claims"
SCENES = "beam_impact"
STIFFNESSES = [1e8, 1e9, 1e10]
BETWEEN = [(0.0, 0.369), (0.39, 0.755), (0.84, 1.15)]  # [s] before cluster 1; between 1 and 2; from 2 on
SIMPLIFIED = "only with the simplifications"
SEEN = 0.02  # [rad] a figure shows a difference of theta larger than the width of a line, of an axis of 2 rad

HHT = {(e, a): case("figure_2_3", scene="figure_2_hht", parameters__e=e, parameters__alpha=value) for e in (0, 0.3) for a, value in ALPHAS}
BAUMGARTE = {(e, p): case("figure_2_3", scene="figure_2_baumgarte", parameters__e=e, parameters__delta=p[0]) for e in (0, 0.3) for p in PAIRS}
FORCE = {K: case("figure_2_3", scene="figure_2_continuous_force", parameters__e=0.3, parameters__K=K) for K in STIFFNESSES}
LOCATED = {(e, p): case("located_impacts", scene="baumgarte", parameters__e=e, parameters__delta=p[0]) for e in (0, 0.3) for p in (PAIRS[0], PAIRS[2])}
ACCURATE = case("located_impacts", scene="accurate", parameters__e=0.3)
TABLE_1 = {(f"HHT alpha = {a}", N): case("table_1", parameters__N=N, parameters__alpha=value) for a, value in ALPHAS for N in MODES}
TABLE_1 |= {(f"Baumgarte ({p[0]}, {p[1]})", N): case("table_1", parameters__N=N, parameters__delta=p[0]) for p in PAIRS for N in MODES}
MODES_HHT = [case("figure_4_5", parameters__N=N, parameters__alpha=0) for N in MODES]
SHARES = {"HHT alpha = 0": case("figure_6_7_8", parameters__alpha=0), "HHT alpha = -0.15": case("figure_6_7_8", parameters__alpha=-0.15),
          "Baumgarte (1000, 5000)": case("figure_6_7_8", scene="figure_8")}
NORMS, NORMS_CONSISTENT = ([case("figure_9", contacts__tip__restart=how, parameters__N=N) for N in MODES] for how in ("carry", "consistent"))
FINE_HHT = [case("rebound", scene="hht", parameters__alpha=value) for _, value in ALPHAS]
LITERAL_HHT = [case("rebound", scene="figure_2_hht", parameters__e=e) for e in (0, 0.3)]

def form(formulation, restart="", onset="", **more):
    return case("index_3", integrator__formulation=formulation, contacts__tip__restart=restart, contacts__tip__onset=onset, **more)

STABILISED, STABILISED_LATE = form("stabilised"), form("stabilised", onset="next_step")
INDEX3 = {"located impacts": form("index3", may_fail=True), "stale accelerations": form("index3", restart="carry", may_fail=True),
          "impact at the step's end": form("index3", onset="next_step", may_fail=True)}
FREE_1E4 = {N: case("adams_steps", scene="baumgarte", parameters__N=N, may_fail=True) for N in (3, 5)}
STEPS_N9 = {h: case("adams_steps", simulate__until=1.25, integrator__step=h, may_fail=True) for h in (1e-6, 1.5e-6, 2e-6)}
N9_AT_2E6 = {"AB4": case("adams_steps", integrator__predictor="ab4", parameters__delta="", may_fail=True),
             "AB4 (0, 0)": case("adams_steps", integrator__predictor="ab4", parameters__delta=0, may_fail=True),
             "AB3": case("adams_steps", integrator__predictor="ab3", may_fail=True)}

def clusters(result):
    """(start, end) of each visible bounce."""
    times = np.array([t for t, _, _ in result.events])
    first = np.flatnonzero(np.diff(times, prepend=-np.inf) >= 0.03)
    return list(zip(times[first], times[np.append(first[1:], len(times)) - 1]))

def energy_after(result, t):
    """At the first record after t, or at the end."""
    return result["energy_total"][min(np.searchsorted(result.t, t, "right"), len(result.t) - 1)]

def energy_after_first(result):
    return energy_after(result, clusters(result)[0][1])

def energy_before_second(result):
    return result["energy_total"][np.searchsorted(result.t, clusters(result)[1][0]) - 1]

def spread(results, runs, interval):
    """The largest difference of theta between any two runs on the records of an interval."""
    times = np.arange(np.ceil(interval[0] * 1000), interval[1] * 1000) / 1000
    theta = np.array([np.interp(times, results[r].t, results[r]["theta"], right=np.nan) for r in runs])
    return np.nanmax(np.nanmax(theta, 0) - np.nanmin(theta, 0))

def spreads(results, runs):
    return [spread(results, runs, interval) for interval in BETWEEN]

def maxima(results, runs, level):
    return [results[run].info["constraint_maxima"][level] for run in runs]

def ending(result):
    return f"survives {s(result.info['t_end'])} s" if result.done else f"breaks down at {s(result.info['t_end'])} s"

def table_1(results):
    yield ["method", "N", "paper [s]", "Trammel [s]", "ratio", "steps", "evaluations", "us per step"]
    for method, seconds in SECONDS_OF_PAPER.items():
        for N, paper in zip(MODES, seconds):
            r = results[TABLE_1[method, N]]
            time = f"{r.cpu:.2f}" if r.done else f"stopped at t = {r.info['t_end']:.4g} s after {r.cpu:.0f}"
            yield [method, N, paper, time, f"{paper / r.cpu:.0f}" if r.done else "", r.counts["steps"], r.counts["residual_evaluations"],
                   f"{r.cpu / r.counts['steps'] * 1e6:.2f}"]

TABLES = [("table_1", "Table 1: CPU time of 2 s, e = 0", table_1)]

CLAIMS = Claims()

@CLAIMS("alpha hardly changes theta(t)", "figure 2", "curves coincide", "Up to bounce 2; then chaos: each alpha leaves the fast modes another phase, "
        "through the contact too, since short steps in free flight change little.", expected="partly")
def _(results):
    found = {e: spreads(results, [HHT[e, a] for a, _ in ALPHAS]) for e in (0, 0.3)}
    text = "; ".join(f"e = {e}: theta differs by {listed(d, 2)} rad before bounce 1, before bounce 2, after" for e, d in found.items())
    text += f"; with 1e-5 s in free flight, e = 0: {listed([spread(results, FINE_HHT, i) for i in BETWEEN[:2]], 2)} rad"
    before, after = max(max(d[:2]) for d in found.values()), max(d[2] for d in found.values())
    return "no" if before > SEEN else "partly" if after > SEEN else "yes", text

@CLAIMS("alpha < 0 loses energy in free flight after an impact", "figure 3", "energy falls between bounces", "Damping of the modes that the steps do "
        "not resolve, which the impact has excited.")
def _(results):
    lost = {a: (energy_after_first(r), energy_before_second(r)) for a, _ in ALPHAS for r in [results[HHT[0, a]]]}
    loss = {a: x - y for a, (x, y) in lost.items()}
    text = "; ".join(f"alpha = {a}: {x:.4f} -> {y:.4f} J" for a, (x, y) in lost.items())
    return loss["0"] < 0.1 * min(loss["-0.15"], loss["-1/3"]), text + " between bounces 1 and 2"  # a tenth: another order

@CLAIMS("high modes are excited; alpha damps them, not the low ones", "figures 6 to 8", "W7 vanishes, W1 stays", "As above.")
def _(results):
    def median(run, column):
        inside = (results[run].t >= 0.70) & (results[run].t <= 0.755)
        return np.median(results[run][column][inside])
    w1, w7 = ({m: median(r, column) for m, r in SHARES.items()} for column in ("W1", "W7"))
    undamped, damped, baumgarte = w7.values()
    text = "; ".join(f"{m}: W7 {s(w7[m], 2)}, W1 {s(w1[m], 2)}" for m in SHARES)
    # Vanishes: by another order. Stays: within what a curve between 0 and 1 shows.
    return damped < 0.1 * min(undamped, baumgarte) and max(w1.values()) - min(w1.values()) < 0.05, text + " (medians, 0.70 to 0.755 s)"

@CLAIMS("delta and epsilon change theta(t) much", "figure 2", "clearly different curves", "An onset not located leaves an overshoot C0, and -epsilon^2 "
        "C0 acts as a force; a row switched on while the tip separates does work.", expected=SIMPLIFIED)
def _(results):
    published = [spread(results, [BAUMGARTE[e, p] for p in PAIRS], BETWEEN[1]) for e in (0, 0.3)]
    located = [spread(results, [LOCATED[e, p] for p in (PAIRS[0], PAIRS[2])], BETWEEN[1]) for e in (0, 0.3)]
    text = (f"before bounce 2 theta differs by {s(published[0], 2)} (e = 0), {s(published[1], 2)} rad (e = 0.3) with the paper's "
            f"simplifications; {s(located[0], 2)}, {s(located[1], 2)} rad without")
    return "yes" if max(located) > SEEN else SIMPLIFIED if max(published) > SEEN else "no", text

@CLAIMS("energy rises at impact 1 for (0, 0) and (10, 50), e = 0.3", "figure 3", "rises; not for (1000, 5000)", "The row is switched on while the tip "
        "leaves with e v: its force does the work f C'.", expected=SIMPLIFIED)
def _(results):
    start = results[ACCURATE]["energy_total"][0]
    published = [energy_after(results[BAUMGARTE[0.3, p]], 0.45) for p in PAIRS]
    located = [energy_after(results[LOCATED[0.3, p]], 0.45) for p in (PAIRS[0], PAIRS[2])]
    work = [results[BAUMGARTE[0.3, p]].info["energy_supplied"]["constraints"] for p in PAIRS]
    text = (f"{start:.3f} -> {listed(published, 4)} J for the three pairs with the row on while the tip separates (its force did "
            f"{listed(work, 3)} J of work in 2 s); {listed(located, 6)} J for (0, 0), (1000, 5000) without")
    rises = published[0] > start and published[1] > start > published[2]
    return "no" if not rises else SIMPLIFIED if max(located) < start else "yes", text

@CLAIMS("Baumgarte's largest velocity and acceleration violations", "text", "(10, 50): 1e-4, 1e-1; (1000, 5000): 1e-1, 1e3",
        "epsilon^2 C0 with the overshoot C0 of looking for contact at the steps' ends only.", expected=SIMPLIFIED)
def _(results):
    found = {p: results[BAUMGARTE[0, p]].info["constraint_maxima"] for p in PAIRS[1:]}
    exact = results[LOCATED[0, (1000, 5000)]].info["constraint_maxima"]
    paper = {(10, 50): (1e-4, 1e-1), (1000, 5000): (1e-1, 1e3)}
    def near(maxima, p):  # the paper gives powers of ten
        return all(0.1 < maxima[k] / x < 10 for k, x in zip(("velocity", "acceleration"), paper[p]))
    text = "; ".join(f"{p}: {s(m['velocity'], 2)} m/s, {s(m['acceleration'], 2)} m/s^2" for p, m in found.items())
    text += f"; located onset (1000, 5000): {s(exact['velocity'], 2)} m/s, {s(exact['acceleration'], 2)} m/s^2"
    return "no" if not all(near(m, p) for p, m in found.items()) else "yes" if near(exact, (1000, 5000)) else SIMPLIFIED, text

@CLAIMS("HHT's velocity constraint holds to round-off", "figure 9", "1e-14", "It is an equation of the Newton system.")
def _(results):
    worst = maxima(results, NORMS, "velocity")
    return max(worst) < 1e-12, f"{listed(worst, 2)} m/s for N = 3, 5, 7, 9"  # round-off of speeds of some m/s in sums over the modes

@CLAIMS("HHT's acceleration violation is large and grows with N", "figure 9", "1e4", "Accelerations and multipliers of before the impact are kept at "
        "the onset.", expected=SIMPLIFIED)
def _(results):
    carried, solved = (maxima(results, runs, "acceleration") for runs in (NORMS, NORMS_CONSISTENT))
    text = f"{listed(carried, 2)} m/s^2 for N = 3, 5, 7, 9 with accelerations carried over; {listed(solved, 2)} with them solved anew"
    large = min(carried) > 1e3 and carried[-1] > carried[0]  # the paper gives a power of ten, of the largest
    return SIMPLIFIED if large and max(solved) < 1e3 else "yes" if min(carried + solved) > 1e3 else "no", text

@CLAIMS("Baumgarte diverges for N = 9, e = 0", "figures 4, 5", "diverges", "Not Baumgarte's doing: AB4 in PECE mode is unstable on the whole imaginary "
        "axis, and the highest axial mode lies far out on it. Without stabilisation the energy grows alike; with AB3, stable there, it does not.",
        expected="only for longer steps")
def _(results):
    text = "; ".join(f"h = {h:g}: {ending(results[r])}, E = {s(results[r]['energy_total'][-1])} J" for h, r in STEPS_N9.items())
    text += "; at 0.6 s with h = 2e-6: " + ", ".join(f"{name} {results[r]['energy_total'][-1]:.4g} J" for name, r in N9_AT_2E6.items())
    # Energy far above the start's is a breakdown that has not met infinity yet.
    broken = {h: not r.done or r["energy_total"][-1] > 1.03 * r["energy_total"][0] for h in STEPS_N9 for r in [results[STEPS_N9[h]]]}
    return "yes" if broken[1e-6] else "only for longer steps" if broken[2e-6] else "no", text

@CLAIMS("Adams with 1e-4 s in free flight", "text", "used", "Beyond the method's stability for the highest axial mode; the scenes use shorter steps.",
        expected="no")
def _(results):
    text = "; ".join(f"N = {N}: {ending(results[r])}, after {results[r].counts['steps']} steps" for N, r in FREE_1E4.items())
    return all(results[r].done for r in FREE_1E4.values()), text

@CLAIMS("N matters strongly from bounce 2", "figures 4, 5", "curves separate", "The impulse goes with the tip's effective mass, about 1/N: each N is "
        "another system.")
def _(results):
    before, between, after = spreads(results, MODES_HHT)
    seconds = [clusters(results[r])[1][0] for r in MODES_HHT]
    impulses = [float(results[r].events[0][2]["impulse"]) for r in MODES_HHT]
    return after > 10 * before and after > 5 * SEEN, (  # strongly: by another order, and at a glance
        f"theta differs by {s(before, 2)}, {s(between, 2)}, {s(after, 2)} rad before bounce 1, before bounce 2, after; bounce 2 at "
        f"{listed(seconds, 4)} s; first impulse {listed(impulses, 3)} N s")

@CLAIMS("HHT and the continuous force agree", "figures 2, 3", "curves coincide", "The law's nominal e is not the restitution it gives.",
        expected="bounce 1 only")
def _(results):
    before = spread(results, [HHT[0.3, "-0.15"], FORCE[1e10]], BETWEEN[0])
    seconds = [clusters(results[FORCE[K]])[1][0] for K in STIFFNESSES]
    exact = clusters(results[ACCURATE])[1][0]
    first = [float(detail.get("approach", detail.get("separation"))) for _, _, detail in results[FORCE[1e10]].events[:2]]
    text = (f"theta agrees to {s(before, 2)} rad before bounce 1; bounce 2 at {listed(seconds, 5)} s for K = 1e8, 1e9, 1e10 "
            f"and {s(exact, 5)} s by the constraint method; first impact's restitution {s(first[1] / first[0], 3)}, nominal 0.3")
    # 2e-3 s is a line's width on the figures' axis of 2 s.
    return "no" if before > SEEN else "yes" if max(abs(t - exact) for t in seconds) < 2e-3 else "bounce 1 only", text

@CLAIMS("alpha towards -1/3 speeds HHT up 1.8 times", "table 1", "305 to 166 s, 9818 to 7233 s", "Iterations a step differ little; the number of "
        "contact steps is chaotic.", expected="no")
def _(results):
    times = {a: [results[TABLE_1[f"HHT alpha = {a}", N]] for N in MODES] for a, _ in ALPHAS}
    per_step = {a: [r.counts["newton_iterations"] / r.counts["steps"] for r in rs] for a, rs in times.items()}
    ratios = {N: x.cpu / y.cpu for N, x, y in zip(MODES, times["0"], times["-1/3"]) if x.done and y.done}
    text = (f"time for alpha = 0 / time for -1/3: {listed(ratios.values(), 2)} for N = {listed(ratios)}; iterations a step "
            + "; ".join(f"{a}: {listed(n, 3)}" for a, n in per_step.items()) + "; thousand contact steps "
            + "; ".join(f"{a}: {listed([r.counts['contact_steps'] / 1000 for r in rs], 3)}" for a, rs in times.items()))
    return min(ratios.values()) > 1.2, text  # half of the paper's least gain, 9818/7233

@CLAIMS("HHT is dearer than Adams", "table 1", "3 to 4 times", "A step is, by its iterations; a run is not, because Adams needs its short steps "
        "everywhere.", expected="per step only")
def _(results):
    def both(of):
        return [of(results[TABLE_1["HHT alpha = -0.15", N]]) / of(results[TABLE_1["Baumgarte (1000, 5000)", N]]) for N in MODES]
    step, whole = both(lambda r: r.cpu / r.counts["steps"]), both(lambda r: r.cpu)
    return ("yes" if min(step + whole) > 1 else "per step only" if min(step) > 1 else "no",
            f"HHT / Adams a step: {listed(step, 2)}; a run: {listed(whole, 2)} for N = 3, 5, 7, 9")

@CLAIMS("HHT without stabilisation diverges", "text", "diverges", "Only if the impact is not located: position rows alone then pull the overshoot back "
        "within one step, at a speed far above the motion's. Stale accelerations do no such harm.", expected=SIMPLIFIED)
def _(results):
    index3 = {name: results[r] for name, r in INDEX3.items()}
    text = "; ".join(f"index 3, {name}: {ending(r)}, |G v| {s(r.info['constraint_maxima']['velocity'], 2)} m/s" for name, r in index3.items())
    text += f"; stabilised, impact at the step's end: {ending(results[STABILISED_LATE])}"
    if index3["located impacts"].done:
        text += (f"; energy after bounce 1 {energy_after_first(index3['located impacts']):.6f} J by index 3, "
                 f"{energy_after_first(results[STABILISED]):.6f} J stabilised")
    fails = [not r.done for r in index3.values()]
    simplified = fails[2] and not any(fails[:2]) and results[STABILISED_LATE].done
    return SIMPLIFIED if simplified else "yes" if all(fails) else "no", text

@CLAIMS("the row switched on at once is right for e > 0 with HHT", "implied by its algorithm", "energies of e = 0.3",
        "Stabilisation makes C' = 0 an equation, which erases the rebound in the first step.", expected="no")
def _(results):
    plastic, literal = (energy_after_first(results[run]) for run in LITERAL_HHT)
    right = energy_after_first(results[HHT[0.3, "0"]])
    # A figure of 3 J shows 0.01 J; e itself must matter.
    return "not judged" if abs(right - plastic) < 0.01 else abs(literal - right) < 0.01, (
        f"energy after bounce 1: e = 0 {plastic:.4f} J, e = 0.3 with the row on at once {literal:.4f} J, with a free rebound {right:.4f} J")

@CLAIMS("2 s of N = 9, HHT alpha = 0, take hours", "table 1", "9818 s", "Another machine, and code of our time.", expected="no")
def _(results):
    ratios = [paper / results[TABLE_1[method, N]].cpu for method, row in SECONDS_OF_PAPER.items() for N, paper in zip(MODES, row)
              if results[TABLE_1[method, N]].done]
    slowest = results[TABLE_1["HHT alpha = 0", 9]].cpu
    return slowest > 3600, f"{s(slowest)} s of CPU; whole table {s(min(ratios), 2)} to {s(max(ratios), 2)} times less than the paper's"
